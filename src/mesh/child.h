/// Work that may crash, hang or take all memory, done by a process of its own.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace thermocontact::mesh {

struct ChildLimits {
    std::uint64_t memory;  ///< bytes of data
    std::uint64_t time;    ///< s of processor time
};

/// What `work` returned, computed in a child process. What it throws is thrown here with the same text:
/// SystemError as such, other exceptions as std::runtime_error. Throws std::runtime_error too where the child
/// ends by itself: "it crashed (signal 11)", "it takes more than 30 s". Throws SystemError if there can be no
/// child.
std::string run_in_child(const std::function<std::string()>& work, const ChildLimits& limits);

}  // namespace thermocontact::mesh
