/// Tasks beside each other that may throw.
#pragma once

#include <cstddef>
#include <exception>
#include <functional>
#include <vector>

#include "fem/traversal.h"

namespace thermocontact::fem {

/// Calls task(0) to task(count - 1), each once, whatever others throw; then throws what the first of them
/// (not the earliest) threw, the same however many threads there are.
inline void run_throwing(const Beside& beside, int count, const std::function<void(int)>& task) {
    std::vector<std::exception_ptr> failures(static_cast<std::size_t>(count));
    beside(count, [&](int number) {
        try {
            task(number);
        } catch (...) {
            failures[static_cast<std::size_t>(number)] = std::current_exception();
        }
    });
    for (const std::exception_ptr& failure : failures) {
        if (failure) {
            std::rethrow_exception(failure);
        }
    }
}

}  // namespace thermocontact::fem
