#include "model/law_samples.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "error.h"
#include "model/physics.h"
#include "number.h"

namespace thermocontact::model {
namespace {

constexpr std::size_t most_points = 64;  // in a cell; the largest rule has 27
constexpr std::size_t stresses = 6;      // xx, yy, zz, yz, xz, xy
constexpr double round_off = 1e-10;      // relative; sums of a kernel are far below

std::size_t strains(int dimension) {
    return dimension == 3 ? 6 : 3;
}

std::vector<fem::Constants> constants_of(const scene::Scene& scene, const mesh::Mesh& mesh,
                                         const std::string& form) {
    if (form == "f") {
        return {body_force_constants(scene)};
    }
    return form == "q0" ? source_constants(scene, mesh) : body_constants(scene, mesh);
}

fem::Form bound_form(const scene::Scene& scene, const mesh::Mesh& mesh, const std::string& form,
                     const std::vector<fem::Constants>& constants) {
    return fem::Form::by_region(fem::find_kernel("at_points." + form, mesh.cell, scene.degree, scene.kernels),
                                mesh, constants);
}

/// Of one point: its rows of stresses times strains, judged.
class TensorJudge {
  public:
    TensorJudge(const scene::Scene& scene, const mesh::Mesh& mesh, const std::string& form)
        : mesh_(&mesh),
          law_(form == "E" ? *scene.material->elasticity->own : *scene.material->viscosity->own),
          d_(scene.dimension),
          n_(static_cast<Eigen::Index>(strains(scene.dimension))),
          scaled_(n_, n_) {}

    using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

    /// The matrix on symmetric tensors with their Euclidean norm.
    const Matrix& operator()(const double* rows, std::int32_t cell) {
        const Eigen::Map<const Matrix> all(rows, stresses, n_);
        if (!all.allFinite()) {
            refuse("is not finite", cell);
        }
        const double largest = all.cwiseAbs().maxCoeff();
        if (d_ == 2 && all.middleRows(3, 2).cwiseAbs().maxCoeff() > round_off * largest) {
            refuse("has components yz or xz, which no plane state has", cell);
        }
        for (Eigen::Index i = 0; i < n_; ++i) {
            const Eigen::Index row = d_ == 2 && i == 2 ? 5 : i;
            for (Eigen::Index j = 0; j < n_; ++j) {
                scaled_(i, j) =
                    all(row, j) * (i < d_ ? 1.0 : std::sqrt(2.0)) * (j < d_ ? 1.0 : std::sqrt(2.0));
            }
        }
        if ((scaled_ - scaled_.transpose()).cwiseAbs().maxCoeff() > round_off * largest) {
            refuse("is not symmetric: the stress of a strain e1 times e2 differs from that of e2 times e1",
                   cell);
        }
        require_positive(largest, cell);
        return scaled_;
    }

  private:
    void require_positive(double largest, std::int32_t cell) const {
        const Matrix shifted = scaled_ + round_off * largest * Matrix::Identity(n_, n_);
        if (largest > 0 && shifted.llt().info() != Eigen::Success) {
            const double smallest =
                Eigen::SelfAdjointEigenSolver<Matrix>(scaled_, Eigen::EigenvaluesOnly).eigenvalues()[0];
            refuse("is not positive semidefinite: its smallest eigenvalue is " + short_text(smallest), cell);
        }
    }

    [[noreturn]] void refuse(const std::string& why, std::int32_t cell) const {
        std::array<double, 3> middle{};
        const auto width = static_cast<std::size_t>(mesh_->vertices_per_cell);
        for (std::size_t v = 0; v < width; ++v) {
            const auto vertex = mesh_->cells[static_cast<std::size_t>(cell) * width + v];
            for (std::size_t axis = 0; axis < 3; ++axis) {
                middle[axis] +=
                    mesh_->points[static_cast<std::size_t>(vertex)][axis] / static_cast<double>(width);
            }
        }
        std::string place = short_text(middle[0]);
        for (int axis = 1; axis < d_; ++axis) {
            place += ", " + short_text(middle[static_cast<std::size_t>(axis)]);
        }
        throw SceneError(place_of(law_) + ": stress " + why + ", in the cell around (" + place + ")");
    }

    const mesh::Mesh* mesh_;
    scene::Law law_;
    int d_;
    Eigen::Index n_;
    Matrix scaled_;
};

/// Calls `take` with the judged matrix of every point; neighbours that are alike are judged once.
template <typename Take>
void visit(const scene::Scene& scene, const mesh::Mesh& mesh, const std::string& form,
           std::span<const std::int32_t> cells, Take take) {
    LawSamples samples(scene, mesh, form);
    TensorJudge judge(scene, mesh, form);
    std::vector<double> last;
    for (const std::int32_t cell : cells) {
        const std::span<const double> values = samples.at(cell);
        for (std::size_t i = 0; i < values.size(); i += samples.size()) {
            const std::span<const double> rows = values.subspan(i, samples.size());
            if (!std::ranges::equal(rows, last)) {
                take(judge(rows.data(), cell));
                last.assign(rows.begin(), rows.end());
            }
        }
    }
}

}  // namespace

LawSamples::LawSamples(const scene::Scene& scene, const mesh::Mesh& mesh, const std::string& form)
    : size_(form == "q0"  ? 1
            : form == "f" ? static_cast<std::size_t>(scene.dimension)
                          : stresses * strains(scene.dimension)),
      law_(bound_form(scene, mesh, form, constants_of(scene, mesh, form))),
      weights_(bound_form(scene, mesh, "weights", {fem::Constants{}})) {}

std::span<const double> LawSamples::at(std::int32_t cell, double t) {
    law_.set_constant("t", t);
    values_.assign(most_points * size_, 0.0);
    of_points_.assign(most_points, 0.0);
    law_.add_cell(cell, values_);
    weights_.add_cell(cell, of_points_);
    // the rule's points are those that have a weight
    const auto points = static_cast<std::size_t>(std::ranges::find(of_points_, 0.0) - of_points_.begin());
    for (std::size_t i = 0; i < points * size_; ++i) {
        values_[i] /= of_points_[i / size_];
    }
    return {values_.data(), points * size_};
}

std::string place_of(const scene::Law& law) {
    return law.file + ":" + std::to_string(law.line);
}

fem::Constants body_force_constants(const scene::Scene& scene) {
    fem::Constants constants{{"t", {0.0}}};
    for (const auto& [name, value] : scene.own_body_force->constants) {
        constants[name] = {value};
    }
    return constants;
}

std::vector<fem::Constants> source_constants(const scene::Scene& scene, const mesh::Mesh& mesh) {
    std::vector<fem::Constants> sets = body_constants(scene, mesh);
    for (fem::Constants& constants : sets) {
        constants["t"] = {0.0};
    }
    return sets;
}

TensorRange range_of_own_tensor(const scene::Scene& scene, const mesh::Mesh& mesh, const std::string& form,
                                std::span<const std::int32_t> cells) {
    TensorRange range;
    visit(scene, mesh, form, cells, [&](const auto& matrix) {
        const Eigen::VectorXd values =
            Eigen::SelfAdjointEigenSolver<TensorJudge::Matrix>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
        const double largest = values.cwiseAbs().maxCoeff();
        range.largest = std::max(range.largest, largest);
        // as for tensors that a scene states: what is zero comes out as round-off of either sign
        const double zero = 10 * std::numeric_limits<double>::epsilon() * largest;
        range.smallest = std::min(range.smallest, std::abs(values[0]) <= zero ? 0.0 : values[0]);
    });
    return range;
}

void check_own_tensors(const scene::Scene& scene, const mesh::Mesh& mesh) {
    if (!scene.material) {
        return;
    }
    std::vector<std::int32_t> cells(static_cast<std::size_t>(mesh.cell_count()));
    std::iota(cells.begin(), cells.end(), 0);
    const auto check = [&](const std::optional<scene::VoigtTensor>& tensor, const std::string& form) {
        if (tensor && tensor->own) {
            visit(scene, mesh, form, cells, [](const auto&) {});
        }
    };
    check(scene.material->elasticity, "E");
    check(scene.material->viscosity, "Visc");
}

}  // namespace thermocontact::model
