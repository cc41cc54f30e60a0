/// How many factors a balance keeps beside the one that it makes.
#pragma once

#include <algorithm>
#include <cstddef>

namespace thermocontact::march {

/// Of its numbers, while a factor is made: itself and the fronts' updates (solve/forecast.cpp), and half as
/// much for the matrix and what else a step takes.
constexpr double copies_while_made = 2.5;

/// Of `kept` factors of `bytes` each so many, the latest ones, as leave room for another one where
/// `available` bytes are to be had. One stays: what fails while another is made is told of its balance.
inline std::size_t factors_beside_another(std::size_t kept, double bytes, double available) {
    while (kept > 1 && available < copies_while_made * bytes) {
        available += bytes;
        --kept;
    }
    return kept;
}

}  // namespace thermocontact::march
