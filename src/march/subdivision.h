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
    explicit Subdivision(int halvings = 0) : halvings_(halvings), smallest_(length()) {}

    bool done() const { return position_ == whole; }

    /// Length of the part to try, and where it ends, as shares of the step; exact in binary.
    double length() const { return share(whole >> halvings_); }
    double end() const { return share(position_ + (whole >> halvings_)); }

    /// The part succeeded: the next one begins, twice as long where that fits and is wanted.
    void accept(bool lengthen = true) {
        position_ += whole >> halvings_;
        if (lengthen && halvings_ > 0 && position_ % (whole >> (halvings_ - 1)) == 0) {
            --halvings_;
        }
    }

    /// The part failed: half of it is next. False where enough was tried.
    bool fail() {
        ++failures_;
        return failures_ < most_failures && halve();
    }

    /// The part erred too much: the same. False where it is the shortest there is.
    bool reject() {
        const bool halved = halve();
        rejections_ += halved ? 1 : 0;
        return halved;
    }

    int halvings() const { return halvings_; }
    int rejections() const { return rejections_; }

    int failures() const { return failures_; }
    /// Length of the shortest part tried, as a share of the step.
    double smallest() const { return smallest_; }

  private:
    static constexpr int whole = 1 << most_halvings;
    bool halve() {
        if (halvings_ == most_halvings) {
            return false;
        }
        ++halvings_;
        smallest_ = std::min(smallest_, length());
        return true;
    }

    static double share(int parts) { return static_cast<double>(parts) / whole; }

    int position_ = 0;
    int halvings_;
    int failures_ = 0;
    int rejections_ = 0;
    double smallest_;
};

}  // namespace thermocontact::march
