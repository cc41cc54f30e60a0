"""Meshes that adapt: bisection, fields carried over, the estimate, what the history tells of it."""

from .mutation import Mutation

MUTATIONS = (
    Mutation(
        "bisection-closure",
        "src/mesh/forest.cpp",
        " && !result.has_hanging_node(cell)",
        "",
        "missing",
        "no hanging nodes",
    ),
    Mutation(
        "bisection-flag",
        "src/mesh/marked_edges.cpp",
        "shared && planar && flag ? 2 : 3",
        "shared && planar ? 2 : 3",
        "missing",
        "only planar tetrahedra that are flagged mark the other edge; else shapes degenerate",
    ),
    Mutation(
        "bisection-boundary",
        "src/mesh/forest.cpp",
        "child.boundaries[v] = parent.boundaries[1 - kept];",
        "child.boundaries[v] = parent.boundaries[kept];",
        "index",
        "the facet that a half keeps is opposite to the other end of the edge",
    ),
    Mutation(
        "transfer-coarser",
        "src/fem/nested_transfer.cpp",
        "x[end] - x[other]",
        "x[end]",
        "missing",
        "coordinates within a half add up to 1",
    ),
    Mutation(
        "recovery-edges",
        "src/model/gradient_recovery.cpp",
        "add(edge, 0.5);",
        "add(edge, 1);",
        "factor",
        "in the middle of an edge the mean of both ends' polynomials",
    ),
    Mutation(
        "estimate-noise",
        "src/march/mesh_control.cpp",
        "field.error / std::max(largest, field.noise)",
        "field.error / largest",
        "range",
        "round-off of a field without gradient is no error of the mesh",
    ),
    Mutation(
        "remeshing-term",
        "src/march/adaptive_march.cpp",
        "now.strain - before.stored.strain",
        "0.0",
        "missing",
        "the energy that another mesh does not hold is told",
    ),
    Mutation(
        "remeshing-prescribed",
        "src/march/adaptive_march.cpp",
        "        model::Prescribed::displacement(*scene_, to.mesh, to.space).apply(state.time, state.displacement);\n",
        "",
        "missing",
        "values prescribed hold at new nodes before the step, or the velocity there is wrong by h^2/k",
    ),
    Mutation(
        "remeshing-from-before",
        "src/march/adaptive_march.cpp",
        "const fem::NestedTransfer transfer(*before.on, to);",
        "const fem::NestedTransfer transfer(*on_, to);",
        "state",
        "a step that is repeated begins with the state before it, on the mesh of that",
    ),
)
