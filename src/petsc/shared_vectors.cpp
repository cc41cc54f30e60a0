#include "petsc/shared_vectors.h"

#include <algorithm>

#include "petsc/check.h"

namespace thermocontact::petsc {
namespace {

bool in_order(const parallel::NodeNumbers& numbers) {
    if (static_cast<std::int32_t>(numbers.global.size()) != numbers.total()) {
        return false;
    }
    for (std::size_t node = 0; node < numbers.global.size(); ++node) {
        if (numbers.global[node] != static_cast<std::int32_t>(node)) {
            return false;
        }
    }
    return numbers.begin() == 0 && numbers.end() == numbers.total();
}

}  // namespace

SharedVectors::SharedVectors(const parallel::NodeNumbers& numbers, int components)
    : numbers_(&numbers), components_(components), whole_(in_order(numbers)) {
    begin_ = numbers.begin() * components;
    owned_ = numbers.end() * components - begin_;
    check(VecCreateMPI(PETSC_COMM_WORLD, owned_, PETSC_DETERMINE, shape_.put()));
    const auto nodes = static_cast<PetscInt>(numbers.global.size());
    check(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, nodes * components, nullptr, local_.put()));
    Indices all;
    check(ISCreateBlock(PETSC_COMM_SELF, components, nodes, numbers.global.data(), PETSC_COPY_VALUES,
                        all.put()));
    check(VecScatterCreate(shape_, all, local_, nullptr, scatter_.put()));
}

Vector SharedVectors::make() const {
    Vector result;
    check(VecDuplicate(shape_, result.put()));
    check(VecZeroEntries(result));
    return result;
}

PetscInt SharedVectors::global_index(std::size_t dof) const {
    const auto b = static_cast<std::size_t>(components_);
    return numbers_->global[dof / b] * components_ + static_cast<PetscInt>(dof % b);
}

PetscInt SharedVectors::owned_index(std::size_t dof) const {
    const PetscInt index = global_index(dof) - begin_;
    return index >= 0 && index < owned_ ? index : -1;
}

void SharedVectors::add_up(const std::vector<double>& local, Vec shared) {
    if (whole_) {
        put(local, shared);
        return;
    }
    check(VecPlaceArray(local_, local.data()));
    check(VecZeroEntries(shared));
    check(VecScatterBegin(scatter_, local_, shared, ADD_VALUES, SCATTER_REVERSE));
    check(VecScatterEnd(scatter_, local_, shared, ADD_VALUES, SCATTER_REVERSE));
    check(VecResetArray(local_));
}

void SharedVectors::put(const std::vector<double>& local, Vec shared) const {
    double* values = nullptr;
    check(VecGetArray(shared, &values));
    if (whole_) {
        std::ranges::copy(local, values);
        check(VecRestoreArray(shared, &values));
        return;
    }
    const auto b = static_cast<std::size_t>(components_);
    for (std::size_t node = 0; node < numbers_->global.size(); ++node) {
        if (const PetscInt first = owned_index(node * b); first >= 0) {
            std::copy_n(local.data() + node * b, b, values + first);
        }
    }
    check(VecRestoreArray(shared, &values));
}

void SharedVectors::take(Vec shared, std::vector<double>& local) {
    if (whole_) {
        const double* values = nullptr;
        check(VecGetArrayRead(shared, &values));
        std::copy_n(values, local.size(), local.begin());
        check(VecRestoreArrayRead(shared, &values));
        return;
    }
    check(VecPlaceArray(local_, local.data()));
    check(VecScatterBegin(scatter_, shared, local_, INSERT_VALUES, SCATTER_FORWARD));
    check(VecScatterEnd(scatter_, shared, local_, INSERT_VALUES, SCATTER_FORWARD));
    check(VecResetArray(local_));
}

}  // namespace thermocontact::petsc
