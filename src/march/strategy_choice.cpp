#include "march/strategy_choice.h"

#include <cmath>

#include "error.h"
#include "number.h"
#include "solve/condensed_problem.h"
#include "solve/forecast.h"

namespace thermocontact::march {
namespace {

/// Both strategies, foreseen.
struct Prospect {
    solve::Cost condensed, krylov;
    double contact_unknowns = 0;
    solve::Storage storage = solve::Storage::doubles;  ///< of the factors
    bool fits = true;                                  ///< condensing, in memory and indices
};

/// Two digits: it is a forecast.
std::string about(double value) {
    const double unit = value > 0 ? std::pow(10.0, std::floor(std::log10(value)) - 1) : 1;
    return short_text(std::round(value / unit) * unit);
}

std::string gibibytes(double bytes) {
    return about(bytes / (1U << 30U)) + " GiB";
}

std::string text(const solve::Cost& cost) {
    return gibibytes(cost.bytes) + ", " + about(cost.seconds) + " s";
}

solve::Cost condensed_cost(const std::vector<solve::BalanceSize>& sizes, int steps, solve::Storage storage) {
    solve::Cost cost;
    for (const solve::BalanceSize& size : sizes) {
        cost += solve::condensed_cost(size, steps, solve::bytes_of(storage));
    }
    return cost;
}

/// What the scene asks for, or, for "auto", words where doubles do not fit in `memory`: a step takes as long
/// with the one as with the other.
solve::Storage storage_of_factors(const std::string& asked, const std::vector<solve::BalanceSize>& sizes,
                                  double memory) {
    const bool too_large = condensed_cost(sizes, 0, solve::Storage::doubles).bytes > memory;
    return asked == "single" || (asked == "auto" && too_large) ? solve::Storage::words
                                                               : solve::Storage::doubles;
}

Prospect foresee(const scene::Scene& scene, const fem::NodeGraph& graph, const fem::Space& space,
                 const model::ContactSurfaces& surfaces, solve::InteriorOrders& orders, double memory) {
    Prospect result;
    result.krylov.seconds = solve::petsc_start;
    std::vector<solve::BalanceSize> sizes;
    std::vector<char> counted;  // the contact nodes of `node`, a factor with one unknown a node
    solve::BalanceSize node{};
    const auto add = [&](int components, const std::vector<char>& contact) {
        solve::BalanceSize size = solve::measure(graph, components, contact);
        const bool dense_fits = solve::can_condense(size) && solve::condensed_cost(size, 0).bytes <= memory;
        if (dense_fits) {
            if (counted != contact) {  // mostly the balances share them
                node = solve::measure(graph, 1, contact, orders.without(contact));
                counted = contact;
            }
            const double b = components;
            size.factor_entries = b * b * node.factor_entries;
            size.factor_operations = b * b * b * node.factor_operations;
        }
        result.fits = result.fits && dense_fits && solve::can_condense(size);
        sizes.push_back(size);
    };
    if (scene.material) {
        add(scene.dimension, model::nodes_with(surfaces, space, &scene::Contact::compliance));
    }
    if (scene.heat) {
        add(1, model::nodes_with(surfaces, space, &scene::Contact::conductance));
    }
    result.storage = storage_of_factors(scene.solver.factor, sizes, memory);
    result.condensed = condensed_cost(sizes, scene.time.steps, result.storage);
    for (const solve::BalanceSize& size : sizes) {
        result.contact_unknowns += size.contact_unknowns;
        result.krylov += solve::newton_krylov_cost(size, scene.time.steps);
    }
    result.fits = result.fits && result.condensed.bytes <= memory;
    return result;
}

StrategyChoice newton_krylov(const parallel::Part& part, const parallel::Backend* backend, std::string why) {
    if (backend == nullptr) {
        throw parallel::BackendNeeded();
    }
    return {backend->newton_krylov(part), std::move(why)};
}

}  // namespace

StrategyChoice choose_strategy(const scene::Scene& scene, const fem::NodeGraph& graph,
                               const parallel::Part& part, const model::ContactSurfaces& surfaces,
                               const parallel::Backend* backend, double memory) {
    const std::string& asked = scene.solver.strategy;
    const int processes = backend != nullptr ? backend->team().size() : 1;
    if (processes > 1 && asked == "condensed") {
        throw SceneError("solver.strategy = \"condensed\" runs on one process, and mpirun started " +
                         std::to_string(processes) +
                         "; expected \"newton-krylov\" or \"auto\", or a start without mpirun");
    }
    if (processes > 1) {
        return newton_krylov(part, backend, std::to_string(processes) + " processes");
    }
    if (asked == "newton-krylov") {
        return newton_krylov(part, backend, "asked for");
    }
    solve::InteriorOrders orders(graph,
                                 mesh::grid_places(scene.mesh, part.mesh.points.size(), part.space.nodes));
    const Prospect prospect = foresee(scene, graph, part.space, surfaces, orders, memory);
    const std::string contact = short_text(prospect.contact_unknowns) + " contact unknowns";
    if (asked == "condensed") {
        if (!prospect.fits) {
            throw SystemError("solver.strategy = \"condensed\" needs about " +
                              gibibytes(prospect.condensed.bytes) + " for factors and " + contact + ", and " +
                              gibibytes(memory) +
                              " are available; expected \"newton-krylov\" or \"auto\", or a coarser mesh");
        }
        return {std::make_unique<solve::Condensed>(std::move(orders), prospect.storage),
                "asked for; " + contact};
    }
    const std::string compared = contact + "; foreseen: condensed " +
                                 (prospect.fits ? text(prospect.condensed) : "does not fit in memory") +
                                 ", newton-krylov " + text(prospect.krylov);
    if (!prospect.fits || prospect.krylov.seconds < prospect.condensed.seconds) {
        return newton_krylov(part, backend, compared);
    }
    return {std::make_unique<solve::Condensed>(std::move(orders), prospect.storage), compared};
}

}  // namespace thermocontact::march
