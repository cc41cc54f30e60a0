/// Matrices of bodies in parts, for the tests of multigrid.
#pragma once

#include "multigrid/preconditioner.h"
#include "support/dense.h"
#include "support/scenes.h"

namespace thermocontact::multigrid {

/// A square, or a cube with `dimension` 3, of `cells` a side: isotropic elasticity with some mass, or
/// conduction with `scalar`; what lies at y = 1 is fixed, and a vector body rolls at x = 0.
struct Body {
    support::Discretisation whole;
    parallel::Part part;
    fem::NodeGraph graph;
    fem::BlockMatrix A;
    std::vector<char> fixed;

    Body(int dimension, int cells, bool scalar, int processes = 1, int rank = 0)
        : whole(text(dimension, cells)),
          part(parallel::take_part(whole.mesh, whole.space, processes, rank)),
          graph(fem::make_node_graph(part.space)),
          A(fem::zero_matrix(graph, scalar ? 1 : dimension, scalar ? 1 : dimension)),
          fixed(part.space.nodes.size() * static_cast<std::size_t>(A.rows), 0) {
        const fem::Constants constants{
            {"rho", {1e-3}}, {"c", {1e-3}}, {"K", identity(dimension)}, {"E", stiffness(dimension)}};
        for (const char* name : {scalar ? "heat_capacity.capacity" : "inertia.mass",
                                 scalar ? "conduction.conduction" : "elasticity.stiffness"}) {
            auto kernel = fem::find_kernel(name, dimension == 2 ? "triangle" : "tetrahedron", 1);
            A.add(1.0, fem::assemble_matrix({std::move(kernel), part.mesh, constants}, part.space, graph,
                                            A.rows, A.rows));
        }
        const auto rows = static_cast<std::size_t>(A.rows);
        for (std::size_t dof = 0; dof < fixed.size(); ++dof) {
            const mesh::Point& x = part.space.nodes[dof / rows];
            const bool rolls = rows > 1 && dof % rows == 0 && x[0] == 0.0;
            fixed[dof] = x[1] == 1.0 || rolls ? 1 : 0;
        }
    }

    std::size_t dofs() const { return fixed.size(); }

    static std::string text(int dimension, int cells) {
        const std::string n = std::to_string(cells);
        return "time = {end = 1, steps = 1}\nheat.capacity = 1\nmesh = " +
               (dimension == 2 ? "{cells = [" + n + ", " + n + "]}"
                               : "{shape = \"box\", cells = [" + n + ", " + n + ", " + n + "]}");
    }
    static std::vector<double> identity(int dimension) {
        std::vector<double> result(static_cast<std::size_t>(dimension * dimension), 0.0);
        for (std::size_t i = 0; i < static_cast<std::size_t>(dimension); ++i) {
            result[i * static_cast<std::size_t>(dimension) + i] = 1.0;
        }
        return result;
    }

    /// Voigt's matrix with lambda = mu = 1.
    static std::vector<double> stiffness(int dimension) {
        const int n = dimension == 2 ? 3 : 6;
        std::vector<double> result(static_cast<std::size_t>(n * n), 0.0);
        for (int i = 0; i < n; ++i) {
            for (int j = 0; j < n; ++j) {
                const bool normal = i < dimension && j < dimension;
                result[static_cast<std::size_t>(i * n + j)] = (normal ? 1.0 : 0.0) + (i != j          ? 0.0
                                                                                      : i < dimension ? 2.0
                                                                                                      : 1.0);
            }
        }
        return result;
    }
};

/// Conjugate gradients for A x = b with b and x of the free dofs, added up over the processes.
struct Solver {
    const Body& body;
    const parallel::Team& team;
    Preconditioner preconditioner;
    SharedNodes nodes;

    Solver(const Body& of, const parallel::Team& with)
        : body(of), team(with), preconditioner(of.A, of.fixed, of.part, with), nodes(of.part.numbers, with) {
        preconditioner.renew({});
    }

    std::vector<double> product(const std::vector<double>& x) const {
        std::vector<double> y = body.A.multiply(free(x));
        nodes.add_up(y, static_cast<std::size_t>(body.A.rows));
        return free(y);
    }
    std::vector<double> free(std::vector<double> x) const {
        for (std::size_t dof = 0; dof < x.size(); ++dof) {
            x[dof] = body.fixed[dof] != 0 ? 0.0 : x[dof];
        }
        return x;
    }
    double dot(const std::vector<double>& a, const std::vector<double>& b) const {
        double sum = 0;
        for (std::size_t dof = 0; dof < a.size(); ++dof) {
            sum += nodes.owned(dof / static_cast<std::size_t>(body.A.rows)) ? a[dof] * b[dof] : 0.0;
        }
        return team.sum(sum);
    }

    /// Iterations that lower the residual of a random right-hand side 1e8-fold, 100 at most.
    int iterations() {
        std::vector<double> r = free(noise(1)), z(r.size()), p, x(r.size(), 0.0);
        const double wanted = 1e-16 * dot(r, r);
        preconditioner.apply(r, z);
        p = z;
        double energy = dot(r, z);
        for (int k = 1; k <= 100; ++k) {
            const std::vector<double> q = product(p);
            const double length = energy / dot(p, q);
            for (std::size_t dof = 0; dof < r.size(); ++dof) {
                r[dof] -= length * q[dof];
            }
            if (dot(r, r) <= wanted) {
                return k;
            }
            preconditioner.apply(r, z);
            const double next = dot(r, z);
            for (std::size_t dof = 0; dof < r.size(); ++dof) {
                p[dof] = z[dof] + next / energy * p[dof];
            }
            energy = next;
        }
        return 101;
    }

    /// The same at a node wherever it is held.
    std::vector<double> noise(unsigned seed) const {
        const auto size = static_cast<std::size_t>(body.A.rows);
        const auto all =
            support::random_numbers(static_cast<std::size_t>(body.part.numbers.total()) * size, seed);
        std::vector<double> result(body.dofs());
        for (std::size_t dof = 0; dof < result.size(); ++dof) {
            const auto node = static_cast<std::size_t>(body.part.numbers.whole[dof / size]);
            result[dof] = all[node * size + dof % size];
        }
        return result;
    }
};

}  // namespace thermocontact::multigrid
