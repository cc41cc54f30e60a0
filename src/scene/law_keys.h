/// The keys of laws, which their files declare (forms/law.py), among those of the table.
#pragma once

#include <vector>

#include "scene/schema.h"

namespace thermocontact::scene {

/// All keys but the parameters of laws (schema_table.cpp).
std::vector<Key> keys_beside_laws();

}  // namespace thermocontact::scene
