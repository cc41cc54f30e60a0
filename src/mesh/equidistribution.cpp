#include "mesh/equidistribution.h"

#include <cmath>
#include <limits>

namespace thermocontact::mesh {

std::vector<double> bisections_wanted(const std::vector<double>& squares, double aim, int degree,
                                      int dimension) {
    const double d = dimension, order = 2 * degree + d;
    double sum = 0;
    for (const double square : squares) {
        sum += std::pow(square, d / order);
    }
    // aim^2 = lambda^(2p/(2p+d)) sum square^(d/(2p+d))
    const double log_lambda = (2 * std::log2(aim) - std::log2(sum)) * order / (2 * degree);
    std::vector<double> result;
    result.reserve(squares.size());
    for (const double square : squares) {
        result.push_back(square > 0 ? d / order * (std::log2(square) - log_lambda)
                                    : -std::numeric_limits<double>::infinity());
    }
    return result;
}

}  // namespace thermocontact::mesh
