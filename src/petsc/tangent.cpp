#include "petsc/tangent.h"

#include <cmath>
#include <utility>

#include "petsc/check.h"
#include "petsc/events.h"

namespace thermocontact::petsc {

Tangent::Tangent(const fem::BlockMatrix& matrix, const std::vector<char>& fixed, SharedVectors& vectors)
    : matrix_(&matrix), vectors_(&vectors), local_x_(fixed.size()), local_y_(fixed.size()) {
    for (std::size_t dof = 0; dof < fixed.size(); ++dof) {
        if (fixed[dof] != 0) {
            fixed_dofs_.push_back(static_cast<std::int32_t>(dof));
            if (const PetscInt index = vectors.owned_index(dof); index >= 0) {
                owned_fixed_.push_back(index);
            }
        }
    }
    const Vector diagonal = vectors.make();
    put_diagonal(diagonal);
    const double* values = nullptr;
    check(VecGetArrayRead(diagonal, &values));
    for (const PetscInt index : owned_fixed_) {
        fixed_diagonal_.push_back(values[index]);
    }
    check(VecRestoreArrayRead(diagonal, &values));
    const PetscInt owned = vectors.owned();
    check(
        MatCreateShell(PETSC_COMM_WORLD, owned, owned, PETSC_DETERMINE, PETSC_DETERMINE, this, shell_.put()));
    check(MatSetBlockSize(shell_, matrix.rows));
    check(MatShellSetOperation(shell_, MATOP_MULT, reinterpret_cast<void (*)()>(&Tangent::multiply)));
    check(MatShellSetOperation(shell_, MATOP_GET_DIAGONAL,
                               reinterpret_cast<void (*)()>(&Tangent::get_diagonal)));
}

namespace {

/// Calls work(tangent) for the one of a shell; no exception leaves through PETSc's frames.
template <typename Work>
PetscErrorCode in_tangent(Mat shell, Work&& work) {
    Tangent* tangent = nullptr;
    if (const PetscErrorCode code = MatShellGetContext(shell, &tangent); code != 0) {
        return code;
    }
    try {
        work(*tangent);
    } catch (const SystemError&) {
        return PETSC_ERR_LIB;
    }
    return 0;
}

}  // namespace

PetscErrorCode Tangent::multiply(Mat shell, Vec x, Vec y) {
    return in_tangent(shell, [&](Tangent& tangent) { tangent.apply(x, y); });
}

PetscErrorCode Tangent::get_diagonal(Mat shell, Vec diagonal) {
    return in_tangent(shell, [&](Tangent& tangent) { tangent.put_diagonal(diagonal); });
}

void Tangent::put_diagonal(Vec diagonal) {
    const auto b = static_cast<std::size_t>(matrix_->rows);
    for (std::size_t dof = 0; dof < local_y_.size(); ++dof) {
        const std::size_t node = dof / b, component = dof % b;
        const auto block = static_cast<std::size_t>(matrix_->graph->offsets[node]);
        local_y_[dof] = matrix_->values[(block * b + component) * b + component];
    }
    const std::int32_t* dofs = derivative_.dofs.data();
    const double* values = derivative_.values.data();
    for (const std::int32_t n : derivative_.sizes) {
        for (std::int32_t i = 0; i < n; ++i) {
            local_y_[static_cast<std::size_t>(dofs[i])] += values[i * n + i];
        }
        dofs += n;
        values += std::ptrdiff_t{n} * n;
    }
    vectors_->add_up(local_y_, diagonal);
}

void Tangent::zero_fixed(Vec shared) const {
    double* values = nullptr;
    check(VecGetArray(shared, &values));
    for (const PetscInt index : owned_fixed_) {
        values[index] = 0.0;
    }
    check(VecRestoreArray(shared, &values));
}

void Tangent::zero_fixed(std::vector<double>& values) const {
    for (const std::int32_t dof : fixed_dofs_) {
        values[static_cast<std::size_t>(dof)] = 0.0;
    }
}

void Tangent::multiply_constant(const std::vector<double>& x, Vec y) {
    const Timed timed(Events::all().product);
    matrix_->multiply(x, local_y_);
    zero_fixed(local_y_);
    vectors_->add_up(local_y_, y);
}

void Tangent::apply(Vec x, Vec y) {
    const Timed timed(Events::all().product);
    vectors_->take(x, local_x_);
    zero_fixed(local_x_);
    matrix_->multiply(local_x_, local_y_);
    check(PetscLogFlops(4.0 * static_cast<double>(matrix_->values.size())));  // each entry serves twice
    add_derivative(local_x_, local_y_);
    zero_fixed(local_y_);
    vectors_->add_up(local_y_, y);
    const double* given = nullptr;
    double* result = nullptr;
    check(VecGetArrayRead(x, &given));
    check(VecGetArray(y, &result));
    for (std::size_t i = 0; i < owned_fixed_.size(); ++i) {
        result[owned_fixed_[i]] = fixed_diagonal_[i] * given[owned_fixed_[i]];
    }
    check(VecRestoreArray(y, &result));
    check(VecRestoreArrayRead(x, &given));
}

namespace {

/// y += the pieces times x, each entry of which passes through `of_entry`.
template <typename OfEntry>
void add_products(const multigrid::Pieces& pieces, const std::vector<double>& x, std::vector<double>& y,
                  OfEntry&& of_entry) {
    const std::int32_t* dofs = pieces.dofs.data();
    const double* values = pieces.values.data();
    for (const std::int32_t n : pieces.sizes) {
        for (std::int32_t i = 0; i < n; ++i, values += n) {
            double sum = 0;
            for (std::int32_t j = 0; j < n; ++j) {
                sum += of_entry(values[j]) * x[static_cast<std::size_t>(dofs[j])];
            }
            y[static_cast<std::size_t>(dofs[i])] += sum;
        }
        dofs += n;
    }
}

}  // namespace

void Tangent::add_derivative(const std::vector<double>& x, std::vector<double>& y) const {
    add_products(derivative_, x, y, [](double value) { return value; });
}

void Tangent::add_derivative_magnitudes(const std::vector<double>& x, std::vector<double>& y) const {
    add_products(derivative_, x, y, [](double value) { return std::abs(value); });
}

void Tangent::transpose() {
    double* values = derivative_.values.data();
    for (const std::int32_t n : derivative_.sizes) {
        for (std::int32_t i = 0; i < n; ++i) {
            for (std::int32_t j = 0; j < i; ++j) {
                std::swap(values[i * n + j], values[j * n + i]);
            }
        }
        values += std::ptrdiff_t{n} * n;
    }
}

void Tangent::drop_derivative() {
    derivative_.sizes.clear();
    derivative_.dofs.clear();
    derivative_.values.clear();
}

void Tangent::set_derivative(solve::NonlinearTerm& F, const Eigen::VectorXd& x,
                             const std::vector<std::int32_t>& dofs) {
    drop_derivative();
    F.visit_derivative(x, [&](std::span<const std::int32_t> unknowns, std::span<const double> values) {
        const std::size_t before = derivative_.dofs.size();
        for (std::size_t i = 0; i < unknowns.size(); ++i) {
            if (unknowns[i] < 0) {
                continue;
            }
            derivative_.dofs.push_back(dofs[static_cast<std::size_t>(unknowns[i])]);
            for (std::size_t j = 0; j < unknowns.size(); ++j) {
                if (unknowns[j] >= 0) {
                    derivative_.values.push_back(values[i * unknowns.size() + j]);
                }
            }
        }
        derivative_.sizes.push_back(static_cast<std::int32_t>(derivative_.dofs.size() - before));
    });
}

}  // namespace thermocontact::petsc
