/// Forms evaluated at the nodes of facets against the same over whole cells.
#include "fem/facet_form.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>

#include "mesh/cell_shape.h"
#include "mesh/shapes.h"
#include "model/physics.h"
#include "support/scenes.h"

namespace thermocontact::fem {
namespace {

constexpr int rule = 3;

std::string scene_text(const std::string& cell, int degree) {
    const bool space = cell == "tetrahedron" || cell == "hexahedron";
    const std::string kind = cell == "triangle" || cell == "tetrahedron" ? "simplex" : "tensor";
    return std::string("mesh = {") + (space ? "shape = \"box\", cells = [2, 1, 1]" : "cells = [3, 2]") +
           ", cell = \"" + kind + "\"}\nspace.degree = " + std::to_string(degree) +
           "\ntime = {end = 1, steps = 1}\nmaterial.density = 1\n"
           "material.elasticity = {young = 1, poisson = 0.2}\n"
           "[boundary.left.contact]\ncompliance = {stiffness = 3, exponent = 1.5}\n"
           "friction = {coefficient = 0.3, regularisation = 0.1}\n";
}

struct Case {
    const char* cell;
    int degree;
};

/// Friction on the whole boundary, with numbers that fit no plane field at all nodes.
class FacetForms : public testing::TestWithParam<Case> {
  protected:
    FacetForms() {
        std::mt19937 random(1);
        std::uniform_real_distribution<double> number(0.5, 1.5);
        for (auto* values : {&w_, &u_old_, &v_F_}) {
            values->resize(at_.node_count() * components_);
        }
        g_.resize(at_.node_count());
        for (auto* values : {&w_, &u_old_, &v_F_, &g_}) {
            for (double& value : *values) {
                value = number(random);
            }
        }
        for (double& value : g_) {
            value -= 100;  // closed everywhere
        }
    }

    Form form(const std::string& name) const {
        const Dofmap* dofmap = &at_.space.dofmap;
        return {find_kernel(name, GetParam().cell, GetParam().degree),
                at_.mesh,
                model::contact_constants(at_.surfaces.front()->laws, 0.2),
                {{"w", {&w_, d_, dofmap}},
                 {"u_old", {&u_old_, d_, dofmap}},
                 {"v_F", {&v_F_, d_, dofmap}},
                 {"g", {&g_, 1, dofmap}}},
                rule};
    }
    FacetForm facet_form(const std::string& name) const {
        return {form(name), at_.space, at_.mesh, nodes_, d_};
    }
    std::vector<double> tensor(FacetForm& of, std::size_t facet) const {
        const auto values = of.tensor(facet);
        return {values.begin(), values.end()};
    }

    support::Discretisation at_{scene_text(GetParam().cell, GetParam().degree)};
    int d_ = at_.scene.dimension;
    std::size_t components_ = static_cast<std::size_t>(d_);
    std::vector<double> w_, u_old_, v_F_, g_;
    FacetNodes nodes_{at_.space, at_.mesh.facets};
    std::map<std::string, double> changed_;
};

INSTANTIATE_TEST_SUITE_P(Cells, FacetForms,
                         testing::Values(Case{"triangle", 1}, Case{"triangle", 2}, Case{"quadrilateral", 1},
                                         Case{"quadrilateral", 2}, Case{"tetrahedron", 1},
                                         Case{"tetrahedron", 2}, Case{"hexahedron", 1},
                                         Case{"hexahedron", 2}),
                         [](const auto& info) {
                             return std::string(info.param.cell) + std::to_string(info.param.degree);
                         });

/// Sums of some hundred terms of the largest one's size, in another order.
double round_off(const std::vector<double>& values) {
    double largest = 0;
    for (const double value : values) {
        largest = std::max(largest, std::abs(value));
    }
    return 100 * std::numeric_limits<double>::epsilon() * largest;
}

TEST_P(FacetForms, AreThoseOfCellsAtTheFacetsNodesAndTheRestOfThoseIsZero) {
    for (const char* name : {"friction.residual", "friction.jacobian"}) {
        Form of_cells = form(name);
        FacetForm of_facets = facet_form(name);
        const std::size_t size = static_cast<std::size_t>(at_.space.dofmap.nodes_per_cell) * components_;
        const std::size_t columns = of_cells.rank() == 2 ? size : 1;
        for (std::size_t facet = 0; facet < at_.mesh.facets.size(); ++facet) {
            std::vector<double> whole(size * columns, 0.0);
            of_cells.add_facet(at_.mesh.facets[facet], whole);
            const double tolerance = round_off(whole);
            ASSERT_GT(tolerance, 0);
            std::vector<std::size_t> places;
            for (const int node : nodes_.in_cell(facet)) {
                for (std::size_t c = 0; c < components_; ++c) {
                    places.push_back(static_cast<std::size_t>(node) * components_ + c);
                }
            }
            const std::vector<double> found = tensor(of_facets, facet);
            ASSERT_EQ(found.size(), columns == 1 ? places.size() : places.size() * places.size());
            std::size_t at = 0;
            for (const std::size_t row : places) {
                for (std::size_t j = 0; j < (columns == 1 ? 1 : places.size()); ++j, ++at) {
                    double& entry = whole[row * columns + (columns == 1 ? 0 : places[j])];
                    EXPECT_NEAR(found[at], entry, tolerance) << name << " of facet " << facet;
                    entry = 0;
                }
            }
            for (const double rest : whole) {
                EXPECT_NEAR(rest, 0, tolerance) << name << " of facet " << facet;
            }
        }
    }
}

/// What is kept is computed anew where any value that it depends on has changed.
TEST_P(FacetForms, FollowEveryValueThatTheyTake) {
    FacetForm of_facets = facet_form("friction.residual");
    const std::size_t last = at_.mesh.facets.size() - 1;
    std::vector<double> before = tensor(of_facets, last);
    EXPECT_EQ(tensor(of_facets, last), before);
    const auto expect_change = [&](const std::string& of) {
        const std::vector<double> now = tensor(of_facets, last);
        EXPECT_NE(now, before) << of;
        EXPECT_EQ(now, tensor(of_facets, last)) << of;
        FacetForm anew = facet_form("friction.residual");
        for (const auto& [name, value] : changed_) {
            anew.set_constant(name, value);
        }
        EXPECT_EQ(now, tensor(anew, last)) << of;
        before = now;
    };
    const auto node = static_cast<std::size_t>(nodes_.of(last).back());
    for (auto* values : {&w_, &u_old_, &v_F_}) {
        for (std::size_t c = 0; c < components_; ++c) {
            (*values)[node * components_ + c] += 0.01 * static_cast<double>(c + 1);
        }
        expect_change("a field");
    }
    g_[node] += 0.01;
    expect_change("the gap");
    for (const auto& [name, value] : {std::pair{"k", 0.3}, {"eps", 0.2}}) {
        changed_[name] = value;
        of_facets.set_constant(name, value);
        expect_change(name);
    }
}

}  // namespace
}  // namespace thermocontact::fem
