/// A number or a formula in x, y, z, t, as scenes write them.
#pragma once

#include <array>
#include <memory>
#include <string>

namespace thermocontact::scene {

class Expression {
  public:
    /// The constant `value`.
    explicit Expression(double value = 0.0);

    /// Parses `formula` (muParser syntax; variables x, y, t and, for `dimension` 3, z; constants pi, e).
    /// Throws SceneError saying what is wrong and at which character, with the nearest known name.
    Expression(const std::string& formula, int dimension);

    /// Value at point x [3] (m) and time t (s). Throws NumericsError if it is not finite.
    double operator()(const std::array<double, 3>& x, double t) const;

    bool depends_on_time() const;
    bool is_zero() const;             ///< the constant 0
    const std::string& text() const;  ///< as written

  private:
    struct Formula;
    std::shared_ptr<Formula> formula_;  ///< empty: constant
    double value_ = 0.0;
    std::string text_;
};

}  // namespace thermocontact::scene
