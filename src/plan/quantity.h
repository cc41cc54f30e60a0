/// What the accuracy of a run is asked of.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace thermocontact::plan {

/// `norms`: w, eps(u) and theta in L2 (MODEL.md, 2); the others are numbers of the whole body at one time.
enum class Quantity { norms, peak_pressure, contact_force, temperature, contact_share };

/// As the command line has them, in the order of the enumeration.
const std::vector<std::string>& quantity_names();

/// "peak_pressure", ...
const std::string& name(Quantity quantity);

/// The quantity of that name. Throws SceneError with the nearest one.
Quantity quantity_of(const std::string& word);

/// What is compared: of the norms "velocity" (with inertia), "strain" and "temperature", as far as the scene
/// has them, else the quantity alone. Throws SceneError where the scene has not got it.
std::vector<std::string> components_of(Quantity quantity, const scene::Scene& scene);

}  // namespace thermocontact::plan
