/// A block of text before the bytes of a checkpoint that says how many follow and what their checksum is, so
/// that no damage goes unnoticed. HDF5 calls it a user block: its own tools pass over it.
#pragma once

#include <string>
#include <string_view>

namespace thermocontact::output {

/// Of what the sealed bytes hold: raised whenever a program could not read what an earlier one wrote.
inline constexpr int checkpoint_format = 1;

std::string seal(std::string_view bytes);

/// The bytes that were sealed. Throws SceneError with the reason where these are not sealed bytes, are of
/// another format, cut short or changed.
std::string_view unseal(std::string_view sealed);

}  // namespace thermocontact::output
