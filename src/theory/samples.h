/// The data of a scene that are expressions, by their values at the nodes and times where a run takes them.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "fem/space.h"
#include "scene/scene.h"
#include "theory/pieces.h"

namespace thermocontact::theory {

/// Values of one kind of data; without any (`smallest` > `largest`) the scene has none.
struct Range {
    double smallest = std::numeric_limits<double>::infinity();
    double largest = -std::numeric_limits<double>::infinity();
    std::string failure;  ///< why a value could not be had (it is not finite); empty otherwise

    bool present() const { return smallest <= largest || !failure.empty(); }
    bool finite() const { return failure.empty(); }
    double magnitude() const { return present() ? std::max(std::abs(smallest), std::abs(largest)) : 0.0; }
};

struct Samples {
    int times = 0;                 ///< at most so many instants of the run, the first and last among them
    Range body_force;              ///< f0, all components, N/m^3
    Range traction;                ///< f1, Pa
    Range anchor;                  ///< u_s of springs, m
    Range heat_source;             ///< q0, W/m^3
    Range heat_flux;               ///< W/m^2
    Range gap;                     ///< g, m
    Range foundation_temperature;  ///< theta_F, K
    Range clamp;                   ///< prescribed displacement, m
    Range prescribed_temperature;  ///< K
    Range initial_on_clamp;        ///< u0 and u0' where the displacement is prescribed, m and m/s
};

Samples take_samples(const scene::Scene& scene, const std::vector<Piece>& pieces, const mesh::Mesh& mesh,
                     const fem::Space& space);

}  // namespace thermocontact::theory
