/// How a scene is discretised: what a plan chooses. The physics, the friction's regularisation and the
/// contact's quadrature stay the scene's.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace thermocontact::plan {

/// Instants at which runs are compared: every eighth of the time. Every run has a multiple of as many steps.
inline constexpr int instants = 8;

/// A way to step through time.
struct Stepping {
    std::string scheme;  ///< time.scheme
    bool adaptive;       ///< by time.tolerance
};

struct Discretisation {
    int degree;
    int scale;  ///< the cells along each axis are those of the coarsest mesh times this; 1: a mesh of a file
    Stepping stepping;
    int steps;
    double tolerance;  ///< of adaptive steps
    /// [d] ratios of mesh.grading, of quadrilaterals or hexahedra: these are nested when graded. Empty: the
    /// scene's own cells, graded as it says.
    std::vector<scene::Grading> grading = {};
    /// [d] so many times as many cells along an axis as the scene's proportions give it; empty: as many.
    std::vector<int> stretch = {};
};

/// What the mesh is like, whatever its number of cells: "degree 2", "degree 2 graded 16 16 1 4 stretched 2
/// 1".
std::string kind_of_mesh(int degree, const std::vector<scene::Grading>& grading,
                         const std::vector<int>& stretch = {});
std::string kind_of_mesh(const Discretisation& choice);

/// The largest ratio; 1 where the mesh is the scene's.
double steepest(const std::vector<scene::Grading>& grading);

/// Of rectangles and boxes: the lower and the upper one of each axis.
inline constexpr std::array<const char*, 6> side_names = {"left", "right", "bottom", "top", "front", "back"};

/// Steps of the scene when these are divided adaptively: the shortest part is 1/4096 of the time.
inline constexpr int adaptive_steps = 16;

/// The coarsest mesh of a scene's proportions, [d]; axes with one cell keep it. Empty: the mesh is a file's.
std::vector<int> coarsest_cells(const scene::Scene& scene);

/// [d] cells of a scale of the coarsest mesh, stretched as Discretisation says.
std::vector<int> scaled_cells(const std::vector<int>& coarsest, const std::vector<int>& scene_cells,
                              int scale, const std::vector<int>& stretch = {});

/// Whether runs are to be solved by condensing (solver.strategy), whatever their steps: on meshes that are
/// chosen, where the scene leaves it open. Pilots and what they foresee would else be of different ones.
bool is_condensed(const scene::Scene& scene);

/// `scene`, whose scheme is that of `choice` already, so discretised.
scene::Scene discretised(scene::Scene scene, const Discretisation& choice);

/// The keys that do the same: "mesh.cells=[16,16]", ..., for --set. `scene` is the one planned for.
std::vector<std::string> settings(const scene::Scene& scene, const Discretisation& choice);

/// How often a scene writes its fields after the begin.
int frames_of(const scene::Scene& scene);

/// Steps between outputs, of which there are about `frames`, the instants compared among them.
int output_every(int steps, int frames);

/// The key that chooses a stepping, and, where it adapts, its tolerance.
std::vector<std::string> settings(const Stepping& stepping, double tolerance);

/// The largest proper divisor: a run of so many parts has all points of the coarser one. 1 of a prime number.
int coarser(int count);

/// The same of the coarser mesh, and of fewer steps or the larger tolerance.
Discretisation coarser_in_space(Discretisation choice);
Discretisation coarser_in_time(Discretisation choice);

/// Twice the cells; twice the steps, or a smaller tolerance.
Discretisation finer_in_space(Discretisation choice);
Discretisation finer_in_time(Discretisation choice);

/// Half the cells along this axis alone; nothing where their number cannot be halved. `scene_cells` [d]: axes
/// with one cell keep it.
std::optional<Discretisation> halved_along(const Discretisation& from, std::size_t axis,
                                           const std::vector<int>& scene_cells);

/// In space, where the mesh can be refined, and in time.
Discretisation finer(const Discretisation& choice, bool refinable);

/// The tolerances of pilots, one after another.
inline constexpr double first_tolerance = 1.0 / 16, tolerance_ratio = 8;

/// "bdf2, adaptive".
std::string describe(const Stepping& stepping);

}  // namespace thermocontact::plan
