#include "app/check.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <limits>

#include "app/exit_code.h"
#include "mesh/shapes.h"
#include "model/physics.h"
#include "number.h"
#include "scene/reader.h"
#include "theory/hypotheses.h"

namespace thermocontact::app {
namespace {

/// The next power of ten.
double rounded_up(double value) {
    return std::pow(10.0, std::ceil(std::log10(std::max(value, std::numeric_limits<double>::epsilon()))));
}

void print_constants(const theory::Constants& constants, bool sprung) {
    const auto line = [](const std::optional<double>& value, const char* name, const char* inequality) {
        if (value) {
            std::cout << "  " << name << " = " << std::left << std::setw(12) << short_text(*value)
                      << inequality << "\n";
        }
    };
    std::cout << "constants on this mesh, relative error below "
              << short_text(rounded_up(constants.relative_error))
              << " (finer meshes: s1, s2 larger, c_k, c_f smaller)\n";
    line(constants.s1, "s1 ", "(2.14) |v| on Gamma_C <= s1 |eps(v)|, v in V");
    line(constants.s2, "s2 ", "(2.15) |eta| on Gamma_C <= s2 |grad eta|, eta in Q");
    line(constants.c_k, "c_k", "(2.12) |eps(v)| >= c_k (|v|^2 + |eps(v)|^2)^(1/2), v in V");
    line(constants.c_f, "c_f", "(2.13) |grad eta| >= c_f |eta|, eta in Q");
    line(constants.r_a, "r_a",
         sprung ? "(L_nu + L_tau) |v|^2 on Gamma_C <= r_a ((E eps(v), eps(v)) + int k_s v.v), v in V"
                : "(L_nu + L_tau) |v|^2 on Gamma_C <= r_a (E eps(v), eps(v)), v in V");
    line(constants.r_d, "r_d", "M_kc |eta|^2 on Gamma_C <= r_d (K grad eta, grad eta), eta in Q");
}

const char* word(theory::Verdict verdict) {
    switch (verdict) {
        case theory::Verdict::holds:
            return "holds";
        case theory::Verdict::fails:
            return "FAILS";
        default:
            return "n/a";
    }
}

void print_conditions(const std::vector<theory::Condition>& conditions, int times) {
    std::cout << "hypotheses of the theory (paper, Section 2) on the scene's data, expressions sampled at "
                 "the nodes "
                 "and "
              << times << " times\n";
    for (const auto& [label, verdict, statement, numbers] : conditions) {
        std::cout << "  " << std::left << std::setw(6) << word(verdict) << std::setw(14) << label
                  << statement;
        const char* separator = ": ";
        for (const auto& [name, value, where] : numbers) {
            std::cout << std::exchange(separator, ", ") << name << " = " << short_text(value) << where;
        }
        std::cout << "\n";
    }
}

void print_theory(const scene::Scene& scene) {
    const mesh::Mesh mesh = mesh::make_mesh(scene.mesh);
    const fem::Space space = fem::make_space(mesh, scene.degree);
    const std::vector<theory::Piece> pieces = theory::pieces_of(scene, mesh);
    const theory::Constants constants = theory::find_constants(scene, pieces, mesh, space);
    const theory::Samples samples = theory::take_samples(scene, pieces, mesh, space);
    print_constants(constants, model::has_spring(scene));
    print_conditions(theory::judge(scene, pieces, constants, samples), samples.times);
}

}  // namespace

int check(const CheckCommand& command) {
    const scene::Scene scene = scene::read_scene(command.scene, command.overrides);
    std::cout << command.scene.string() << ": valid\n";
    std::cout << "physics\n";
    for (const std::string& name : model::physics_of(scene)) {
        std::cout << "  " << name << "\n";
    }
    print_theory(scene);
    return exit_completed;
}

}  // namespace thermocontact::app
