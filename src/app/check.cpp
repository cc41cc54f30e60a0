#include "app/check.h"

#include <Eigen/Eigenvalues>
#include <iostream>

#include "app/exit_code.h"
#include "model/physics.h"
#include "number.h"
#include "scene/reader.h"

namespace thermocontact::app {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Smallest eigenvalue of a symmetric matrix, row-major.
double smallest_eigenvalue(const std::vector<double>& values) {
    const auto n = static_cast<Eigen::Index>(std::lround(std::sqrt(static_cast<double>(values.size()))));
    const Eigen::Map<const Matrix> matrix(values.data(), n, n);
    return Eigen::SelfAdjointEigenSolver<Matrix>(matrix, Eigen::EigenvaluesOnly).eigenvalues()[0];
}

/// Smallest m with C eps : eps >= m |eps|^2: the Voigt matrix with its shear scaled to the tensor norm.
double ellipticity(const scene::VoigtTensor& tensor, int dimension) {
    const auto n = static_cast<Eigen::Index>(dimension * (dimension + 1) / 2);
    Matrix scaled = Eigen::Map<const Matrix>(tensor.matrix.data(), n, n);
    for (Eigen::Index i = dimension; i < n; ++i) {
        scaled.row(i) *= std::sqrt(2.0);
        scaled.col(i) *= std::sqrt(2.0);
    }
    return smallest_eigenvalue({scaled.data(), scaled.data() + scaled.size()});
}

void line(bool holds, const std::string& text) {
    std::cout << "  " << (holds ? "holds   " : "BROKEN  ") << text << "\n";
}

void print_hypotheses(const scene::Scene& scene) {
    std::cout << "hypotheses of the theory (paper, Section 2), on the scene's own data\n";
    if (scene.material) {
        const auto& material = *scene.material;
        const double viscous = material.viscosity ? ellipticity(*material.viscosity, scene.dimension) : 0.0;
        line(viscous > 0, "(H1) viscosity elliptic: m_a = " + short_text(viscous) +
                              (material.viscosity ? "" : ", no viscosity is modelled"));
        const double elastic = material.elasticity ? ellipticity(*material.elasticity, scene.dimension) : 0.0;
        line(elastic > 0, "(H2) elasticity elliptic: m_b = " + short_text(elastic));
    }
    if (scene.heat) {
        const double m =
            scene.heat->conductivity ? smallest_eigenvalue(scene.heat->conductivity->matrix) : 0.0;
        line(m > 0, "(H3 ii) conductivity elliptic: m_d = " + short_text(m) +
                        (m > 0 ? "" : "; heat does not diffuse in every direction"));
    }
    for (const auto& [name, boundary] : scene.boundaries) {
        if (!boundary.contact) {
            continue;
        }
        const scene::Contact& contact = *boundary.contact;
        if (contact.compliance) {
            line(contact.compliance->exponent == 1, "boundary." + name + ": p_n Lipschitz, L_nu = c_n = " +
                                                        short_text(contact.compliance->stiffness));
        }
        if (contact.conductance) {
            line(true, "boundary." + name +
                           ": k_c bounded, M_kc = " + short_text(contact.conductance->coefficient));
        }
    }
}

}  // namespace

int check(const CheckCommand& command) {
    const scene::Scene scene = scene::read_scene(command.scene, command.overrides);
    std::cout << command.scene.string() << ": valid\n";
    std::cout << "physics\n";
    for (const std::string& name : model::physics_of(scene)) {
        std::cout << "  " << name << "\n";
    }
    print_hypotheses(scene);
    return exit_completed;
}

}  // namespace thermocontact::app
