#include "mesh/marked_edges.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace thermocontact::mesh {
namespace {

/// Edges are compared by it: equal lengths that differ in round-off count as equal, whatever the cell.
using EdgeOrder = std::tuple<std::int64_t, std::int32_t, std::int32_t>;

EdgeOrder order_of(const Mesh& mesh, std::int32_t a, std::int32_t b) {
    const Point &x = mesh.points[static_cast<std::size_t>(a)], &y = mesh.points[static_cast<std::size_t>(b)];
    const double length = std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]);
    constexpr double nine_digits = 1e9;
    return {std::llround(nine_digits * std::log(length)), std::min(a, b), std::max(a, b)};
}

/// Of the face `places` of the cell, what its longest edge leaves out.
std::int8_t left_out_of(const Mesh& mesh, std::span<const std::int32_t> vertices,
                        const std::array<std::int8_t, 3>& places) {
    const auto opposite = [&](std::size_t i) {
        return order_of(mesh, vertices[static_cast<std::size_t>(places[(i + 1) % 3])],
                        vertices[static_cast<std::size_t>(places[(i + 2) % 3])]);
    };
    std::size_t best = 0;
    for (const std::size_t i : {std::size_t{1}, std::size_t{2}}) {
        best = opposite(i) > opposite(best) ? i : best;
    }
    return places[best];
}

}  // namespace

MarkedEdges mark_longest(const Mesh& mesh, std::span<const std::int32_t> vertices) {
    MarkedEdges result;
    std::size_t a = 0, b = 1;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        for (std::size_t j = i + 1; j < vertices.size(); ++j) {
            if (order_of(mesh, vertices[i], vertices[j]) > order_of(mesh, vertices[a], vertices[b])) {
                a = i;
                b = j;
            }
        }
    }
    std::size_t next = 0;
    for (const std::size_t place : {a, b}) {
        result.order[next++] = static_cast<std::int8_t>(place);
    }
    for (std::size_t place = 0; place < vertices.size(); ++place) {
        if (place != a && place != b) {
            result.order[next++] = static_cast<std::int8_t>(place);
        }
    }
    if (vertices.size() == 4) {
        std::array<std::int32_t, 4> ordered{};
        for (std::size_t i = 0; i < 4; ++i) {
            ordered[i] = vertices[static_cast<std::size_t>(result.order[i])];
        }
        result.left_out = {left_out_of(mesh, ordered, {1, 2, 3}), left_out_of(mesh, ordered, {0, 2, 3})};
    }
    return result;
}

/// Arnold, Mukherjee and Pouly, BisectTet. The face that the half inherits gives its refinement edge; on its
/// other faces the edge opposite to the new vertex is marked, except on the one that the halves share where
/// the parent is planar and flagged: there it is that from the new vertex to the new refinement edge.
HalfOfCell half_of(const std::array<std::int8_t, 2>& left_out, bool flag, std::size_t kept, int vertices) {
    const auto own = static_cast<std::int8_t>(kept);
    if (vertices == 3) {
        return {{own, 2, middle_of_edge, 0}};
    }
    const std::int8_t out = left_out[1 - kept];  // of the inherited face, which is opposite to the other end
    HalfOfCell half;
    std::size_t next = 0;
    for (const std::int8_t place : {own, std::int8_t{2}, std::int8_t{3}}) {
        if (place != out) {
            half.order[next++] = place;
        }
    }
    half.order[2] = out;
    half.order[3] = middle_of_edge;
    const bool planar = left_out[0] == left_out[1] && left_out[0] >= 2;
    for (std::size_t end = 0; end < 2; ++end) {  // of the new refinement edge; the face opposite to it
        const bool shared = half.order[end] == own;
        half.left_out[end] = static_cast<std::int8_t>(shared && planar && flag ? 2 : 3);
    }
    half.flag = planar && !flag;
    return half;
}

}  // namespace thermocontact::mesh
