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

void print_body(const scene::Scene& scene) {
    if (scene.material) {
        const auto& [density, elasticity, viscosity] = *scene.material;
        const double m_b = viscosity ? ellipticity(*viscosity, scene.dimension) : 0.0;
        line(m_b > 0,
             "(H1) viscosity elliptic: m_b = " + short_text(m_b) + (viscosity ? "" : ", none is modelled"));
        const double m_a = elasticity ? ellipticity(*elasticity, scene.dimension) : 0.0;
        line(m_a > 0,
             "(H2) elasticity elliptic: m_a = " + short_text(m_a) + (elasticity ? "" : ", none is modelled"));
    }
    if (scene.heat) {
        const auto& conductivity = scene.heat->conductivity;
        const double m_d = conductivity ? smallest_eigenvalue(conductivity->matrix) : 0.0;
        line(m_d > 0, "(H3 ii) conductivity elliptic: m_d = " + short_text(m_d) +
                          (m_d > 0 ? "" : "; heat does not diffuse in every direction"));
    }
}

void print_contact(const std::string& name, const scene::Contact& contact) {
    const std::string where = "boundary." + name + ": ";
    if (contact.compliance) {
        const double L_nu = contact.compliance->stiffness;
        const double L_tau = contact.friction ? contact.friction->coefficient * L_nu : 0.0;
        line(contact.compliance->exponent == 1, where + "(H8 iv) p_n, p_t Lipschitz: L_nu = " +
                                                    short_text(L_nu) + ", L_tau = " + short_text(L_tau));
        std::cout << "  open    " << where
                  << "(2.23) asks for m_a > (L_nu + L_tau) s1^2 = " << short_text(L_nu + L_tau)
                  << " s1^2; the trace constant s1 of the mesh is not computed\n";
    }
    if (contact.conductance) {
        const double M_kc = contact.conductance->coefficient;
        line(true, where + "(H7 i) k_c bounded: M_kc = " + short_text(M_kc));
        std::cout << "  open    " << where << "(2.23) asks for m_d > M_kc s2^2 = " << short_text(M_kc)
                  << " s2^2; the trace constant s2 of the mesh is not computed\n";
    }
}

void print_hypotheses(const scene::Scene& scene) {
    std::cout << "hypotheses of the theory (paper, Section 2), on the scene's own data\n";
    print_body(scene);
    for (const auto& [name, boundary] : scene.boundaries) {
        if (boundary.contact) {
            print_contact(name, *boundary.contact);
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
