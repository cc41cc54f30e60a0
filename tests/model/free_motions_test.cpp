// What nothing holds of a body, in words.

#include "model/free_motions.h"

#include <gtest/gtest.h>

#include "model/nodal.h"
#include "model/physics.h"
#include "model/rigid_motions.h"
#include "support/scenes.h"
#include "support/thread_team.h"

namespace thermocontact::model {
namespace {

const std::string rest = "time = {end = 1, steps = 1}\nmaterial.elasticity = {young = 1, poisson = 0.2}\n";
const std::string plate = rest + "mesh = {upper = [2.0, 1.0], cells = [4, 2]}\n";
const std::string box = rest + "mesh = {shape = \"box\", upper = [2.0, 1.0, 1.0], cells = [4, 2, 2]}\n";
const std::string friction =
    "boundary.bottom.contact.friction = {coefficient = 0.3, regularisation = 1e-3}\n";
const std::string coulomb = "boundary.bottom.contact.friction = {coefficient = 0.3, regularisation = 0}\n";
const std::string all_of_the_plate =
    "the body is free to move along x, to move along y and to turn about (1, 0.5)";

std::string contact(const std::string& gap = "-0.1") {
    return "boundary.bottom.contact.compliance.stiffness = 100\nboundary.bottom.contact.gap = " + gap + "\n";
}

/// What holds a part of a scene's body, at rest.
class Held {
  public:
    Held(const scene::Scene& scene, parallel::Part part, const parallel::Team& team)
        : scene_(&scene),
          part_(std::move(part)),
          team_(&team),
          surfaces_(make_contact_surfaces(scene, part_.mesh, part_.space)),
          velocity_(part_.space.nodes.size() * static_cast<std::size_t>(scene.dimension), 0.0),
          contact_(part_.space, scene.dimension, velocity_) {
        for (const auto& surface : surfaces_) {
            const fem::Fields fields{{"w", {&velocity_, scene.dimension, &part_.space.dofmap}},
                                     {"u_old", {&velocity_, scene.dimension, &part_.space.dofmap}},
                                     {"g", {&surface->gap, 1, &part_.space.dofmap}}};
            contact_.add("compliance", part_.mesh, *surface, contact_constants(surface->laws, 1.0), fields);
            if (surface->laws.friction) {
                contact_.add("friction", part_.mesh, *surface, contact_constants(surface->laws, 1.0), fields);
            }
        }
    }

    std::optional<FreeMotions::Found> free() {
        const auto prescribed = Prescribed::displacement(*scene_, part_.mesh, part_.space);
        FreeMotions motions(part_.space, part_.numbers, *team_, prescribed.fixed(), scene_->dimension);
        motions.hold(Springs(*scene_, part_.mesh, part_.space));
        return motions.left_by(contact_);
    }

    std::string motions() {
        const auto found = free();
        return found ? found->motions : "held";
    }

  private:
    const scene::Scene* scene_;
    parallel::Part part_;
    const parallel::Team* team_;
    ContactSurfaces surfaces_;
    std::vector<double> velocity_;
    FacetTerm contact_;
};

struct Case {
    std::string name, scene, motions;
};

class FreeMotionsOf : public testing::TestWithParam<Case> {
  protected:
    scene::Scene scene = scene::read(GetParam().scene);

    std::vector<std::string> on(int processes) {
        std::vector<parallel::Part> parts;  // made one after the other: METIS is not made for threads
        for (int rank = 0; rank < processes; ++rank) {
            const mesh::Mesh mesh = mesh::make_mesh(scene.mesh);
            parts.push_back(parallel::take_part(mesh, fem::make_space(mesh, scene.degree), processes, rank));
        }
        std::vector<std::string> found(parts.size());
        support::ThreadTeam::run(processes, [&](const parallel::Team& team) {
            const auto rank = static_cast<std::size_t>(team.rank());
            found[rank] = Held(scene, parts[rank], team).motions();
        });
        return found;
    }
};

/// The same words on every process, however many there are.
TEST_P(FreeMotionsOf, InWords) {
    for (const int processes : {1, 2, 5}) {
        EXPECT_EQ(on(processes),
                  std::vector<std::string>(static_cast<std::size_t>(processes), GetParam().motions));
    }
}

INSTANTIATE_TEST_SUITE_P(
    Bodies, FreeMotionsOf,
    testing::Values(
        Case{"nothing", plate, all_of_the_plate},
        Case{"clamped", plate + "boundary.top.displacement = [0.0, 0.0]\n", "held"},
        Case{"roller", plate + "boundary.top.displacement = [\"free\", 0.0]\n",
             "the body is free to move along x"},
        Case{"sideways", plate + "boundary.top.displacement = [0.0, \"free\"]\n",
             "the body is free to move along y and to turn about (1, 1)"},
        Case{"two_rollers",
             plate + "boundary.top.displacement = [\"free\", 0.0]\nboundary.left.displacement = [0.0, "
                     "\"free\"]\n",
             "held"},
        Case{"springs", plate + "boundary.left.spring.stiffness = 1e-9\n", "held"},
        Case{"springs_along_x", plate + "boundary.left.spring.stiffness = [[3.0, 0.0], [0.0, 0.0]]\n",
             "the body is free to move along y"},
        Case{"springs_along_a_slope",
             plate + "boundary.bottom.spring.stiffness = [[9.0, 12.0], [12.0, 16.0]]\n",
             "the body is free to move along (-0.8, 0.6)"},
        Case{"springs_and_roller",
             plate +
                 "boundary.top.displacement = [\"free\", 0.0]\nboundary.left.spring.stiffness = [[2.0, 0.0], "
                 "[0.0, 0.0]]\n",
             "held"},
        Case{"springs_and_contact",
             plate + contact() + "boundary.right.spring.stiffness = [[0.0, 0.0], [0.0, 1e9]]\n",
             "the body is free to move along x"},
        Case{"springs_in_space",
             box + "boundary.front.spring.stiffness = [[0.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 5.0]]\n",
             "the body is free to move along x, to move along y and to turn about the axis along z through "
             "(1, 0.5, 0.5)"},
        Case{"frictionless", plate + contact(), "the body is free to move along x"},
        Case{"frictionless_far_away",
             rest + "mesh = {lower = [1e6, 1e6], upper = [1000002.0, 1000001.0], cells = [4, 2]}\n" +
                 contact(),
             "the body is free to move along x"},
        Case{"frictionless_degree_2", plate + contact() + "space.degree = 2\n",
             "the body is free to move along x"},
        Case{"frictionless_and_roller", plate + contact() + "boundary.left.displacement = [0.0, \"free\"]\n",
             "held"},
        Case{"friction", plate + contact() + friction, "held"},
        Case{"one_facet", plate + contact("\"x < 0.3 ? -1 : 1\""), "the body is free to move along x"},
        Case{"open", plate + contact("1.0") + friction, all_of_the_plate},
        Case{"exact_friction", plate + contact() + coulomb, "held"},
        Case{"exact_friction_open", plate + contact("1.0") + coulomb, all_of_the_plate},
        Case{
            "in_space", box,
            "the body is free to move along x, to move along y, to move along z, to turn about the axis "
            "along "
            "z through (1, 0.5, 0.5), to turn about the axis along y through (1, 0.5, 0.5) and to turn about "
            "the axis along x through (1, 0.5, 0.5)"},
        Case{"hung_in_space", box + "boundary.right.displacement = [\"free\", 0.0, 0.0]\n",
             "the body is free to move along x, to turn about the axis along z through (2, 0.5, 0.5) and to "
             "turn "
             "about the axis along y through (2, 0.5, 0.5)"},
        Case{"tracked_in_space", box + "boundary.bottom.displacement = [\"free\", 0.0, 0.0]\n",
             "the body is free to move along x"},
        Case{"frictionless_in_space", box + contact(),
             "the body is free to move along x, to move along z and to turn about the axis along y through "
             "(1, "
             "0.5, 0.5)"},
        Case{"hexahedra_of_degree_2",
             rest +
                 "mesh = {shape = \"box\", upper = [2.0, 1.0, 1.0], cells = [4, 2, 2], cell = "
                 "\"tensor\"}\nspace.degree = 2\n" +
                 contact(),
             "the body is free to move along x, to move along z and to turn about the axis along y through "
             "(1, "
             "0.5, 0.5)"},
        Case{"friction_in_space", box + contact() + friction, "held"}),
    [](const auto& info) { return info.param.name; });

/// A body whose cells in the middle are taken out, with the given fixed nodes.
class TwoBodies {
  public:
    TwoBodies() {
        const std::size_t width = 3;
        std::vector<std::int32_t> kept;
        for (std::size_t i = 0; i < at_.space.dofmap.cell_nodes.size(); i += width) {
            const auto of_cell = at_.space.dofmap.of(static_cast<std::int32_t>(i / width));
            const double middle = (x(of_cell[0]) + x(of_cell[1]) + x(of_cell[2])) / 3;
            if (middle < 1 || middle > 2) {
                kept.insert(kept.end(), of_cell.begin(), of_cell.end());
            }
        }
        at_.space.dofmap.cell_nodes = kept;
    }

    /// With both components of the nodes fixed that a predicate of x and y names.
    template <typename Fixed>
    std::string motions(Fixed fixed) {
        std::vector<char> marks;
        for (const mesh::Point& p : at_.space.nodes) {
            marks.insert(marks.end(), 2, fixed(p[0], p[1]) ? 1 : 0);
        }
        const auto part = parallel::take_part(at_.mesh, at_.space, 1, 0);
        std::vector<double> field(marks.size(), 0.0);
        FacetTerm no_contact(at_.space, 2, field);
        const auto found =
            FreeMotions(at_.space, part.numbers, parallel::Alone(), marks, 2).left_by(no_contact);
        return found ? found->motions : "held";
    }

  private:
    double x(std::int32_t node) const { return at_.space.nodes[static_cast<std::size_t>(node)][0]; }

    support::Discretisation at_{rest + "mesh = {upper = [3.0, 1.0], cells = [3, 1]}\n"};
};

TEST(FreeMotionsOfTwoBodies, EachHasItsOwn) {
    TwoBodies bodies;
    EXPECT_EQ(bodies.motions([](double x, double) { return x == 0 || x == 3; }), "held");
    EXPECT_EQ(
        bodies.motions([](double x, double) { return x == 0; }),
        "the body around (2.5, 0.5) is free to move along x, to move along y and to turn about (2.5, 0.5)");
    EXPECT_EQ(bodies.motions([](double x, double y) { return x == 0 || (x == 3 && y == 1); }),
              "the body around (2.5, 0.5) is free to turn about (3, 1)");
    EXPECT_EQ(
        bodies.motions([](double x, double y) { return (x == 0 || x == 2) && y == 1; }),
        "the body around (0.5, 0.5) is free to turn about (0, 1), the body around (2.5, 0.5) is free to "
        "turn about (2, 1)");
}

/// Motions in the columns of a matrix, about (1, 2, 3) and of size 2.
std::vector<std::string> told(const Eigen::MatrixXd& columns, int components) {
    return in_words(columns, Eigen::Vector3d(1, 2, 3), 2, components);
}

TEST(RigidMotionsInWords, OfTheSpaceAndNotOfItsBasis) {
    Eigen::MatrixXd one(3, 1), two(3, 2);
    one << 3, 4, 0;
    EXPECT_EQ(told(one, 2), std::vector<std::string>{"move along (0.6, 0.8)"});
    one << 1, 0, 2;  // u_x = 1 - 2 y vanishes at y = 1/2, in units of 2 about 2
    EXPECT_EQ(told(one, 2), std::vector<std::string>{"turn about (1, 3)"});
    two << 1, 1, 0, 0, 1, -1;
    EXPECT_EQ(told(two, 2), (std::vector<std::string>{"move along x", "turn about (1, 2)"}));
    EXPECT_EQ(told(Eigen::MatrixXd::Ones(1, 1), 1), std::vector<std::string>{"change alike everywhere"});
}

/// Rotations about an axis off the centre, about one that no coordinate axis shows, and with a drift along
/// it.
TEST(RigidMotionsInWords, InSpace) {
    Eigen::MatrixXd motion(6, 1);
    motion << 1, 0, 0, 1, 0, 0;  // about z: u_x = 1 - y
    EXPECT_EQ(told(motion, 3), std::vector<std::string>{"turn about the axis along z through (1, 4, 3)"});
    motion << 0, 0, 0, 0, -4, 3;  // spin (3, 4, 0)
    EXPECT_EQ(told(motion, 3),
              std::vector<std::string>{"turn about the axis along (0.6, 0.8, 0) through (1, 2, 3)"});
    motion << 0, 0, 5, 1, 0, 0;
    EXPECT_EQ(told(motion, 3), std::vector<std::string>{"screw about the axis along z through (1, 2, 3)"});
}

}  // namespace
}  // namespace thermocontact::model
