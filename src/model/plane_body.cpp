#include "model/plane_body.h"

#include <cmath>
#include <limits>

namespace thermocontact::model {
namespace {

/// Of a Voigt matrix (xx, yy, xy), engineering shear, whose entries may be rounded.
std::optional<fem::Isotropic> isotropic(const scene::VoigtTensor& tensor) {
    const std::vector<double>& C = tensor.matrix;
    if (tensor.own || C.size() != 9) {
        return std::nullopt;
    }
    const double trace = C[1], shear = 2 * C[8];
    const double rounding = 4 * std::numeric_limits<double>::epsilon() * (std::abs(trace) + std::abs(shear));
    const double expected[9] = {trace + shear, trace, 0, trace, trace + shear, 0, 0, 0, shear / 2};
    for (std::size_t i = 0; i < C.size(); ++i) {
        if (!(std::abs(C[i] - expected[i]) <= rounding)) {
            return std::nullopt;
        }
    }
    return fem::Isotropic{trace, shear};
}

}  // namespace

std::optional<PlaneBody> plane_body(const scene::Scene& scene, const mesh::Mesh& mesh,
                                    const fem::Space& space, const fem::NodeGraph& graph) {
    const auto& material = scene.material;
    if (!scene.regions.empty() || !material || !material->elasticity || !material->viscosity) {
        return std::nullopt;
    }
    const auto elasticity = isotropic(*material->elasticity), viscosity = isotropic(*material->viscosity);
    if (!elasticity || !viscosity) {
        return std::nullopt;
    }
    // stiffness of C e = tr(e) I, by the rule that integrates the others
    fem::Form form(fem::find_kernel("elasticity.stiffness", mesh.cell, space.element.degree), mesh,
                   {{"E", {1, 1, 0, 1, 1, 0, 0, 0, 0}}});
    return PlaneBody{fem::assemble_matrix(std::move(form), space, graph, 2, 2), *elasticity, *viscosity};
}

}  // namespace thermocontact::model
