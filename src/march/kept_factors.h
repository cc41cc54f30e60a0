/// How many factors a balance keeps beside the one that it makes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace thermocontact::march {

/// Of its numbers, while a factor is made: itself and the fronts' updates (solve/forecast.cpp), and half as
/// much for the matrix and what else a step takes.
constexpr double copies_while_made = 2.5;

/// That each balance keeps where steps are adapted and memory allows it: a rung each, and changes between
/// two.
constexpr std::size_t adaptive_factors = 12;

/// Of the memory that is to be had before the first factor is made, so much is left to others: with less,
/// what programs read again and again is no longer at hand, and all wait for the disk.
constexpr double share_left = 0.25;

/// Of `kept` factors of `bytes` each so many, the latest ones, as leave room for another one where
/// `available` bytes are to be had. One stays: what fails while another is made is told of its balance.
inline std::size_t factors_beside_another(std::size_t kept, double bytes, double available) {
    while (kept > 1 && available < copies_while_made * bytes) {
        available += bytes;
        --kept;
    }
    return kept;
}

/// What was used how long ago: how many factors are made in all, whatever the number of those that are kept.
class Recency {
  public:
    void note(double tau) {
        const auto found = std::ranges::find(latest_, tau);
        if (found == latest_.end()) {
            latest_.insert(latest_.begin(), tau);
            return;
        }
        const auto depth = static_cast<std::size_t>(found - latest_.begin());
        again_.resize(std::max(again_.size(), depth + 1));
        ++again_[depth];
        std::rotate(latest_.begin(), found, found + 1);
    }

    /// Where the latest `kept` ones, at least one, are at hand.
    int made(std::size_t kept) const {
        int result = static_cast<int>(latest_.size());
        for (std::size_t depth = kept; depth < again_.size(); ++depth) {
            result += again_[depth];
        }
        return result;
    }

  private:
    std::vector<double> latest_;  ///< each tau once, the last one first
    std::vector<int> again_;      ///< [depth] how often one was used again after so many others
};

}  // namespace thermocontact::march
