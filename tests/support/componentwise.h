/// A nonlinear term whose components do not know of each other.
#pragma once

#include <functional>

#include "solve/newton.h"

namespace thermocontact::support {

/// F_i(x) = f(x_i), with f' as given: right or wrong.
class Componentwise : public solve::NonlinearTerm {
  public:
    using Function = std::function<double(double)>;
    Componentwise(Function f, Function derivative) : f_(std::move(f)), derivative_(std::move(derivative)) {}

    void evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& value) override { value = x.unaryExpr(f_); }
    void visit_derivative(const Eigen::VectorXd& x, const Piece& visit) override {
        for (std::int32_t i = 0; i < x.size(); ++i) {
            const double value = derivative_(x[i]);
            visit(std::span(&i, 1), std::span(&value, 1));
        }
    }

  private:
    Function f_, derivative_;
};

}  // namespace thermocontact::support
