/// Marches one manufactured solution and prints how far the discrete one is from it at the end.
///
///     manufactured SCENE STUDY BODY CASE
///
/// SCENE holds the laws, the initial and the prescribed values (verification/manufactured_parts/scenes.py
/// writes it); the sources that make the solution exact, and the errors, are the kernels STUDY.BODY_...
/// compiled from UFL, and STUDY.CASE_... on contact boundaries. Output: one line of JSON, norms of the errors
/// by name. Exit codes: 1 failed, 2 usage, 3 numerics failed.

#include <cmath>
#include <exception>
#include <iostream>
#include <nlohmann/json.hpp>

#include "error.h"
#include "march/simulation.h"
#include "mesh/shapes.h"
#include "scene/reader.h"

extern "C" {
extern const thermocontact_kernel manufactured_kernels[];
extern const int manufactured_kernel_count;
}

namespace {

using namespace thermocontact;

class Manufactured {
  public:
    /// `body` and `contact`: what the names of the kernels begin with, "in_space.coupled_".
    Manufactured(const scene::Scene& scene, std::string body, std::string contact)
        : scene_(&scene),
          body_(std::move(body)),
          contact_(std::move(contact)),
          mesh_(mesh::make_mesh(scene.mesh)) {}

    model::Sources sources() const {
        model::Sources result;
        if (scene_->material) {
            result.mechanical = balance("body_force", "traction", "contact_traction");
        }
        if (scene_->heat) {
            result.thermal = balance("heat_source", "heat_flux", "contact_heat_flux");
        }
        return result;
    }

    nlohmann::ordered_json errors(const march::Simulation& simulation) const {
        nlohmann::ordered_json result;
        if (scene_->material) {
            for (const char* error : {"displacement", "strain", "velocity"}) {
                result[error] = norm(simulation, error);
            }
        }
        if (scene_->heat) {
            for (const char* error : {"temperature", "gradient"}) {
                result[error] = norm(simulation, error);
            }
        }
        return result;
    }

  private:
    fem::Kernel kernel(const std::string& name) const {
        const fem::KernelTable table(manufactured_kernels,
                                     static_cast<std::size_t>(manufactured_kernel_count));
        return fem::find_kernel(name, mesh_.cell, scene_->degree, table);
    }

    std::vector<model::Source> balance(const char* body, const char* side, const char* contact) const {
        std::vector<model::Source> sources{{kernel(body_ + body), ""}};
        for (const std::string& boundary : mesh_.boundary_names) {
            const auto entry = scene_->boundaries.find(boundary);
            const bool touches = entry != scene_->boundaries.end() && entry->second.contact;
            sources.push_back({kernel(touches ? contact_ + contact : body_ + side), boundary});
        }
        return sources;
    }

    double norm(const march::Simulation& simulation, const std::string& error) const {
        const march::State& state = simulation.state();
        const fem::Dofmap* dofmap = &simulation.space().dofmap;
        const fem::Fields fields{{"u_h", {&state.displacement, scene_->dimension, dofmap}},
                                 {"w_h", {&state.velocity, scene_->dimension, dofmap}},
                                 {"theta_h", {&state.temperature, 1, dofmap}}};
        fem::Form form(kernel(body_ + "error_" + error), mesh_, {{"t", {state.time}}}, fields);
        double square = 0;
        for (std::int32_t cell = 0; cell < mesh_.cell_count(); ++cell) {
            form.add_cell(cell, {&square, 1});
        }
        return std::sqrt(square);
    }

    const scene::Scene* scene_;
    std::string body_, contact_;
    mesh::Mesh mesh_;
};

}  // namespace

int main(int argc, char** argv) {
    if (argc != 5) {
        std::cerr << "usage: manufactured SCENE STUDY BODY CASE\n";
        return 2;
    }
    try {
        const std::string study = std::string(argv[2]) + ".";
        const scene::Scene scene = scene::read_scene(argv[1]);
        const Manufactured manufactured(scene, study + argv[3] + "_", study + argv[4] + "_");
        march::Simulation simulation(scene, manufactured.sources());
        while (!simulation.finished()) {
            simulation.advance();
        }
        std::cout << manufactured.errors(simulation) << "\n";
        return 0;
    } catch (const NumericsError& error) {
        std::cerr << "manufactured: " << error.what() << "\n";
        return 3;
    } catch (const std::exception& error) {
        std::cerr << "manufactured: " << error.what() << "\n";
        return 1;
    }
}
