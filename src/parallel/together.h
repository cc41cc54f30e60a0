/// Work that may fail on one process only: the others must hear of it before they wait for that one.
#pragma once

#include <functional>
#include <optional>
#include <type_traits>

#include "parallel/team.h"

namespace thermocontact::parallel {

/// What a user reads where memory runs out.
inline constexpr const char* out_of_memory = "out of memory; use a coarser mesh or degree";

/// Calls `work` on every process. Where it throws on some, all of them throw the error of the first of those:
/// SceneError, NumericsError, or SystemError for anything else. Every process must call; `work` itself must
/// not wait for others. One process alone throws what `work` throws.
void try_together(const Team& team, const std::function<void()>& work);

/// The same for work with a result.
template <typename Work>
std::invoke_result_t<Work> together(const Team& team, Work&& work) {
    if constexpr (std::is_void_v<std::invoke_result_t<Work>>) {
        try_together(team, work);
    } else {
        std::optional<std::invoke_result_t<Work>> result;
        try_together(team, [&] { result.emplace(work()); });
        return std::move(*result);
    }
}

}  // namespace thermocontact::parallel
