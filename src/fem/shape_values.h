/// Shape functions of the Lagrange element at points of the reference cell.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace thermocontact::fem {

/// [points][nodes] at `points` [points][dimension of the cell], nodes in Basix order; for cell and degree see
/// make_lagrange().
std::vector<double> shape_values(const std::string& cell, int degree, std::span<const double> points);

}  // namespace thermocontact::fem
