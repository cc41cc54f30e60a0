#include "solve/forecast.h"

#include <algorithm>
#include <limits>
#include <new>

#include "solve/cholmod.h"

namespace thermocontact::solve {
namespace {

constexpr double bytes_a_second = 1e10;
constexpr double operations_a_second = 2.5e10;

// Condensing: a step reads the factor twice; Newton multiplies by S, and factors its derivative, this often.
constexpr double passes = 2, dense_products = 8, dense_factorisations = 2;
// Of each number of L there is one in the panels. While these are made, updates of fronts wait in double
// precision: those of one level of a dissection, which are fewer; a second copy covers them. Of the dense
// block: the matrix that is factored, L, S, Newton's derivative and its factors.
constexpr double copies_of_dense_block = 5;

// Newton-Krylov, in products with an assembled matrix that would be read: an iteration, and the hierarchy's
// set-up.
constexpr double products_an_iteration = 1.5, products_of_setup = 50;
constexpr double iterations_a_step = 35, iterations_of_linear_step = 15;
constexpr double seconds_an_iteration = 2e-5;  ///< whatever the size
constexpr double bytes_an_entry = 12;          ///< a value and its column
constexpr double krylov_bytes_an_unknown = 2100;

std::vector<std::int32_t> factor_order(const std::vector<char>& contact,
                                       std::span<const std::int32_t> interior) {
    std::vector<std::int32_t> order(interior.begin(), interior.end());
    for (std::size_t node = 0; node < contact.size(); ++node) {
        if (contact[node] != 0) {
            order.push_back(static_cast<std::int32_t>(node));
        }
    }
    return order;
}

}  // namespace

BalanceSize measure(const fem::NodeGraph& graph, int components, const std::vector<char>& contact) {
    const double b = components, nodes = graph.node_count();
    const auto contact_nodes =
        static_cast<double>(std::ranges::count_if(contact, [](char c) { return c != 0; }));
    return {b * nodes, b * b * (2 * static_cast<double>(graph.columns.size()) - nodes), b * contact_nodes, 0,
            0};
}

BalanceSize measure(const fem::NodeGraph& graph, int components, const std::vector<char>& contact,
                    std::span<const std::int32_t> interior) {
    BalanceSize result = measure(graph, components, contact);
    CholmodCommon common;
    common->nmethods = 1;
    common->method[0].ordering = CHOLMOD_GIVEN;
    common->supernodal = CHOLMOD_SIMPLICIAL;  // counts only
    const SymmetricMatrix pattern{graph.node_count(), graph.offsets, graph.columns, {}};
    cholmod_sparse matrix = view(pattern);
    std::vector<std::int32_t> order = factor_order(contact, interior);
    const FactorPointer factor(cholmod_analyze_p(&matrix, order.data(), nullptr, 0, common.get()), {&common});
    if (factor == nullptr) {
        throw std::bad_alloc();
    }
    // a node's columns have `components` times its entries each, and there are as many of them
    const double b = components;
    result.factor_entries = b * b * common->lnz;
    result.factor_operations = b * b * b * common->fl;
    return result;
}

Cost condensed_cost(const BalanceSize& balance, int steps, double bytes_a_number) {
    const double block = balance.contact_unknowns * balance.contact_unknowns;
    const double lu = 2.0 / 3.0 * block * balance.contact_unknowns;
    const double step =
        (passes * balance.factor_entries * bytes_a_number + dense_products * block * sizeof(double)) /
            bytes_a_second +
        dense_factorisations * lu / operations_a_second;
    return {balance.factor_entries * (sizeof(double) + bytes_a_number) +
                copies_of_dense_block * block * sizeof(double),
            balance.factor_operations / operations_a_second + steps * step};
}

Cost newton_krylov_cost(const BalanceSize& balance, int steps) {
    const double product = bytes_an_entry * balance.matrix_entries / bytes_a_second;
    const double iterations =
        steps * (balance.contact_unknowns > 0 ? iterations_a_step : iterations_of_linear_step);
    return {
        krylov_bytes_an_unknown * balance.unknowns,
        products_of_setup * product + iterations * (products_an_iteration * product + seconds_an_iteration)};
}

bool can_condense(const BalanceSize& balance) {
    const double half_block = balance.contact_unknowns * balance.contact_unknowns / 2;
    return std::max(balance.factor_entries, balance.matrix_entries + half_block) <
           static_cast<double>(std::numeric_limits<std::int32_t>::max());
}

}  // namespace thermocontact::solve
