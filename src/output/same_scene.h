/// Whether a checkpoint can be gone on with under a scene.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace thermocontact::output {

/// What differs between two resolved scenes and must not, one phrase a key: "material.density is 2.0 here and
/// 1.0 there". `title`, `output`, `solver` and the name of the mesh file may differ, and `time.end` with
/// `time.steps` as long as they make the same step.
std::vector<std::string> differences(const nlohmann::ordered_json& here, const nlohmann::ordered_json& there);

}  // namespace thermocontact::output
