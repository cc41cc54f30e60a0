#include "model/error_in_space.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fem/form.h"
#include "model/gradient_recovery.h"
#include "model/physics.h"

namespace thermocontact::model {
namespace {

/// Relative to the largest value of a field: a hundred thousand times the round-off of one.
constexpr double noise_level = 1e-11;

struct Energy {
    const char *error, *energy;  ///< forms
    const char* field;           ///< the coefficient of the form that the field is
    std::vector<const char*> recovered;
};

class Estimator {
  public:
    Estimator(const scene::Scene& scene, const mesh::Mesh& mesh, const fem::Space& space)
        : mesh_(&mesh),
          space_(&space),
          kernels_(scene.kernels),
          constants_(body_constants(scene, mesh)),
          recovery_(mesh, space, scene.regions.empty() ? std::vector<std::int32_t>{} : mesh.cell_regions) {}

    FieldEstimate operator()(const Energy& energy, const std::vector<double>& values, int components) const {
        const auto gradients = recovery_(values, components);
        fem::Fields fields{{energy.field, {&values, components, &space_->dofmap}}};
        for (std::size_t c = 0; c < gradients.size(); ++c) {
            fields[energy.recovered[c]] = {&gradients[c], mesh_->dimension, &recovery_.dofmap()};
        }
        FieldEstimate result{by_cells(energy.error, fields)};
        const auto norm = [](const std::vector<double>& squares) {
            return std::sqrt(std::accumulate(squares.begin(), squares.end(), 0.0));
        };
        result.error = norm(result.squares);
        result.size = norm(by_cells(energy.energy, fields));
        const std::vector<double> rounding = alternating(values);
        fields[energy.field] = {&rounding, components, &space_->dofmap};
        result.noise = norm(by_cells(energy.energy, fields));
        return result;
    }

  private:
    std::vector<double> by_cells(const char* form, const fem::Fields& fields) const {
        auto kernel = fem::kernel_in_force(form, mesh_->cell, space_->element.degree, kernels_);
        auto bound = fem::Form::by_region(std::move(kernel), *mesh_, constants_, fields);
        std::vector<double> result(static_cast<std::size_t>(mesh_->cell_count()), 0.0);
        for (std::int32_t cell = 0; cell < mesh_->cell_count(); ++cell) {
            double& square = result[static_cast<std::size_t>(cell)];
            bound.add_cell(cell, {&square, 1});
            square = std::max(square, 0.0);
        }
        return result;
    }

    /// A field of the size of round-off whose sign changes from value to value.
    static std::vector<double> alternating(const std::vector<double>& values) {
        double largest = 0;
        for (const double value : values) {
            largest = std::max(largest, std::abs(value));
        }
        std::vector<double> result(values.size());
        for (std::size_t i = 0; i < result.size(); ++i) {
            result[i] = (i % 2 == 0 ? noise_level : -noise_level) * largest;
        }
        return result;
    }

    const mesh::Mesh* mesh_;
    const fem::Space* space_;
    scene::KernelTable kernels_;
    std::vector<fem::Constants> constants_;
    GradientRecovery recovery_;
};

}  // namespace

ErrorInSpace estimate_error(const scene::Scene& scene, const mesh::Mesh& mesh, const fem::Space& space,
                            const std::vector<double>& displacement, const std::vector<double>& velocity,
                            const std::vector<double>& temperature) {
    const Estimator estimate(scene, mesh, space);
    ErrorInSpace result;
    if (scene.material && scene.material->elasticity) {
        result.deformation =
            estimate({"estimate.elastic_error", "estimate.elastic_energy", "u", {"G0", "G1", "G2"}},
                     displacement, scene.dimension);
    } else if (scene.material && scene.material->viscosity) {
        result.deformation =
            estimate({"estimate.viscous_error", "estimate.viscous_energy", "w", {"G0", "G1", "G2"}}, velocity,
                     scene.dimension);
    }
    if (scene.heat && scene.heat->conductivity) {
        result.heat =
            estimate({"estimate.heat_error", "estimate.heat_energy", "theta", {"H"}}, temperature, 1);
    }
    return result;
}

bool has_energy(const scene::Scene& scene) {
    return (scene.material && (scene.material->elasticity || scene.material->viscosity)) ||
           (scene.heat && scene.heat->conductivity);
}

}  // namespace thermocontact::model
