/// What the fronts of a sparse Cholesky factorisation are made of (fronts.h): entries of the matrix, and what
/// is left by the children in the elimination tree of the supernodes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solve/supernodes.h"
#include "solve/symmetric_matrix.h"

namespace thermocontact::solve {

class FrontTree {
  public:
    /// What it refers to must stay.
    FrontTree(const SymmetricMatrix& matrix, const Supernodes& supernodes);

    const Supernodes& supernodes() const { return *supernodes_; }

    /// Supernodes whose first row below the triangle is among the columns of this one, ascending.
    std::span<const std::int32_t> children(std::size_t number) const;

    /// Rows below the supernode's triangle in the order of its front: those of the first child, of the next,
    /// then of the matrix, each where it occurs first. Which of them are eliminated earlier does not count,
    /// so that fronts of equal parts of a grid are equal wherever these lie.
    std::span<const std::int32_t> below(std::size_t number) const;

    /// Writes where each row of the supernode is in its front, its own columns first, to `local` [rows of the
    /// factor].
    void locate(std::size_t number, std::vector<std::int32_t>& local) const;

    /// Calls call(column, place, value) with the matrix's entries in the supernode's columns, located so;
    /// those of one column after each other, in any order.
    template <typename Call>
    void each_entry(std::size_t number, const std::vector<std::int32_t>& local, Call&& call) const {
        each_of_matrix(number, [&](std::int32_t column, std::size_t row, double value) {
            call(column, local[row], value);
        });
    }

    /// Where the rows below a child's triangle are in the front that was located.
    void places(std::size_t child, const std::vector<std::int32_t>& local,
                std::vector<std::int32_t>& result) const;

  private:
    /// Calls call(column, row of the factor, value).
    template <typename Call>
    void each_of_matrix(std::size_t number, Call&& call) const {
        const Supernode supernode = (*supernodes_)[number];
        for (std::int32_t c = 0; c < supernode.columns; ++c) {
            const std::int32_t column = supernode.first + c;
            const auto own = static_cast<std::size_t>(supernodes_->order()[static_cast<std::size_t>(column)]);
            for (auto i = static_cast<std::size_t>(matrix_->offsets[own]);
                 i < static_cast<std::size_t>(matrix_->offsets[own + 1]); ++i) {
                const auto row = place_[static_cast<std::size_t>(matrix_->rows[i])];
                call(c, static_cast<std::size_t>(row), matrix_->values[i]);
            }
        }
    }

    void find_children();
    void order_rows();

    const SymmetricMatrix* matrix_;
    const Supernodes* supernodes_;
    std::vector<std::int32_t> place_;     ///< [rows of the matrix]: in the factor
    std::vector<std::int32_t> children_;  ///< of the first supernode, of the next, ...
    std::vector<std::size_t> offsets_;    ///< [supernodes + 1]: of children_
    std::vector<std::int32_t> below_;     ///< of the first supernode, of the next, ...
    std::vector<std::size_t> begins_;     ///< [supernodes + 1]: of below_
};

}  // namespace thermocontact::solve
