/// From a scene file to a validated scene.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace thermocontact::scene {

/// Reads and validates the scene file `path`; each of `overrides` is "KEY=VALUE" with a TOML value and beats
/// the file. Throws SceneError with one line: place, key, what was expected, and the nearest valid name.
Scene read_scene(const std::filesystem::path& path, const std::vector<std::string>& overrides = {});

}  // namespace thermocontact::scene
