/// A step that is taken in parts where it fails as a whole: parts of 1/2, 1/4, ... of it, each begun at a
/// multiple of its own length, so that few lengths occur and their factors are of use again.
#pragma once

#include <algorithm>

namespace thermocontact::march {

class Subdivision {
  public:
    static constexpr int most_halvings = 8;
    static constexpr int most_failures = 32;  ///< in one step, whatever succeeds between

    bool done() const { return position_ == whole; }

    /// Length of the part to try, and where it ends, as shares of the step; exact in binary.
    double length() const { return share(whole >> halvings_); }
    double end() const { return share(position_ + (whole >> halvings_)); }

    /// The part succeeded: the next one begins, twice as long where that fits.
    void accept() {
        position_ += whole >> halvings_;
        if (halvings_ > 0 && position_ % (whole >> (halvings_ - 1)) == 0) {
            --halvings_;
        }
    }

    /// The part failed: half of it is next. False where enough was tried.
    bool halve() {
        ++failures_;
        if (halvings_ == most_halvings || failures_ == most_failures) {
            return false;
        }
        ++halvings_;
        smallest_ = std::min(smallest_, length());
        return true;
    }

    int failures() const { return failures_; }
    /// Length of the shortest part tried, as a share of the step.
    double smallest() const { return smallest_; }

  private:
    static constexpr int whole = 1 << most_halvings;
    static double share(int parts) { return static_cast<double>(parts) / whole; }

    int position_ = 0;
    int halvings_ = 0;
    int failures_ = 0;
    double smallest_ = 1;
};

}  // namespace thermocontact::march
