/// A step that is taken in parts where it fails as a whole, or errs too much: parts of 1/2, 1/4, ... of it,
/// each begun at a multiple of its own length, so that few lengths occur and their factors are of use again.
#pragma once

#include <algorithm>

namespace thermocontact::march {

class Subdivision {
  public:
    static constexpr int most_halvings = 8;
    static constexpr int most_failures = 32;  ///< in one step, whatever succeeds between

    /// Begins with parts of the step halved that often.
    explicit Subdivision(int halvings = 0)
        : halvings_(std::clamp(halvings, 0, most_halvings)), smallest_(length()) {}

    bool done() const { return position_ == whole; }

    /// Length of the part to try, and where it ends, as shares of the step; exact in binary.
    double length() const { return share(units()); }
    double end() const { return share(position_ + units()); }

    /// The part succeeded: the next one begins, twice as long so many times as it fits.
    void accept(int doublings = 1) {
        position_ += units();
        for (; doublings > 0 && halvings_ > 0 && position_ % (2 * units()) == 0; --doublings) {
            --halvings_;
        }
    }

    /// The part failed: half of it is next. False where enough was tried.
    bool fail() {
        ++failures_;
        return failures_ < most_failures && shorten(1);
    }

    /// The part errs too much: next is one halved so many times, or the shortest. False where it is that.
    bool reject(int halvings) { return shorten(halvings); }

    /// Of the length to try.
    int halvings() const { return halvings_; }

    int failures() const { return failures_; }
    /// Length of the shortest part tried, as a share of the step.
    double smallest() const { return smallest_; }

  private:
    static constexpr int whole = 1 << most_halvings;
    static double share(int units) { return static_cast<double>(units) / whole; }

    int units() const { return whole >> halvings_; }

    bool shorten(int halvings) {
        if (halvings_ == most_halvings) {
            return false;
        }
        halvings_ = std::min(halvings_ + halvings, most_halvings);
        smallest_ = std::min(smallest_, length());
        return true;
    }

    int position_ = 0;
    int halvings_;
    int failures_ = 0;
    double smallest_;
};

}  // namespace thermocontact::march
