/// Where compiled laws are kept from one run to the next: $XDG_CACHE_HOME/thermocontact, else
/// ~/.cache/thermocontact.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace thermocontact::laws {

/// The file `name` of the cache. Where it is not there yet, `make(folder)` makes it in an empty folder of its
/// own and returns its path; it is moved into the cache whole. Of several processes that want files of the
/// cache one makes at a time, and the others find what it has made. Throws SystemError where there is no
/// folder to write to that belongs to this user, and what `make` throws, which leaves nothing behind.
std::filesystem::path cached(
    const std::string& name,
    const std::function<std::filesystem::path(const std::filesystem::path& folder)>& make);

}  // namespace thermocontact::laws
