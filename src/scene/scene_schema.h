/// The keys that one scene may have.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "scene/schema.h"

namespace thermocontact::scene {

/// The schema with the parameters of the law files that the scene names. Throws SceneError where these, or
/// the file itself, cannot be read; the rest of the scene is not judged.
std::shared_ptr<const Schema> schema_of_scene(const std::filesystem::path& path,
                                              const std::vector<std::string>& overrides);

}  // namespace thermocontact::scene
