/// The numbers of a law: of the built-in one or of a scene's file.
#pragma once

#include <string>

#include "scene/scene.h"
#include "scene/settings.h"

namespace thermocontact::scene {

/// The constants of the law in force, from its table `at`.KIND over those of `general`; infinite where
/// neither says anything.
Law read_law(const Settings& s, const std::string& kind, const std::string& at, const Law& general = {});

}  // namespace thermocontact::scene
