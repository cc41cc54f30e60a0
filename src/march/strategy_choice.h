/// Which strategy solves a scene, and why.
#pragma once

#include <memory>
#include <string>

#include "fem/block_matrix.h"
#include "model/contact_surface.h"
#include "parallel/backend.h"
#include "scene/scene.h"
#include "solve/condensed_system.h"

namespace thermocontact::march {

struct StrategyChoice {
    std::unique_ptr<solve::Strategy> strategy;
    std::string why;  ///< for header and summary
};

/// What the scene asks for, or, for "auto", newton-krylov on several processes and on one the faster of those
/// that fit in `memory` (bytes). Throws SceneError where "condensed" is asked for on several processes,
/// SystemError where it is on one and does not fit, parallel::BackendNeeded where newton-krylov is the choice
/// and `backend` is null. All arguments must outlive the strategy.
StrategyChoice choose_strategy(const scene::Scene& scene, const fem::NodeGraph& graph,
                               const parallel::Part& part, const model::ContactSurfaces& surfaces,
                               const parallel::Backend* backend, double memory);

}  // namespace thermocontact::march
