/// Balance: why no solution was found, and which datum is to blame.
#include <algorithm>
#include <cmath>
#include <span>

#include "march/balance.h"
#include "number.h"
#include "solve/condition.h"

namespace thermocontact::march {
namespace {

constexpr double loosest_tolerance = 1e-4;  ///< that a message advises
constexpr double least_share = 0.01;        ///< of rounding, for which contact is named and not the body
constexpr double many_decades = 1e8;        ///< between contact and body: half of the digits there are

std::string failure_text(const std::string& name, const std::string& width, const solve::NewtonResult& first,
                         const solve::ContinuationResult* ladder) {
    std::string text = name + " balance: Newton stopped after " + std::to_string(first.iterations) +
                       " iterations (" + solve::describe(first.end) + ", relative residual " +
                       short_text(first.residual) + ")";
    if (ladder != nullptr) {
        text += "; continuation in " + width + " stopped after " + std::to_string(ladder->rungs) +
                " solves (" + solve::describe(ladder->newton.end) + ", relative residual " +
                short_text(ladder->newton.residual) + ")";
    }
    return text;
}

const char* words_of_body(const std::string& balance) {
    return balance == "heat" ? "heat.capacity and heat.conductivity" : "material";
}

const char* words_of_law(const model::FacetTerm& contact, std::size_t law) {
    const std::string& name = contact.law_name(law);
    if (name == "friction") {
        return contact.has_exact_friction() ? "friction.coefficient"
                                            : "friction.coefficient over friction.regularisation";
    }
    return name == "compliance" ? "compliance.stiffness" : "conductance.coefficient";
}

double largest_entry(model::FacetTerm& contact, std::size_t law) {
    double largest = 0;
    contact.visit_derivative_of(law, [&](std::span<const std::int32_t>, std::span<const double> values) {
        for (const double value : values) {
            largest = std::max(largest, std::abs(value));
        }
    });
    return largest;
}

double largest_diagonal_entry(const fem::BlockMatrix& matrix, const std::vector<std::int32_t>& dofs) {
    double largest = 0;
    const auto c = static_cast<std::size_t>(matrix.rows);
    for (const std::int32_t dof : dofs) {
        const auto node = static_cast<std::size_t>(dof) / c, i = static_cast<std::size_t>(dof) % c;
        const auto block = static_cast<std::size_t>(matrix.graph->offsets[node]);  // the diagonal one
        largest = std::max(largest, std::abs(matrix.values[(block * c + i) * c + i]));
    }
    return largest;
}

/// The law whose derivative, as the fields are, is larger than the body's by the most, where that is by many
/// decades.
std::string what_outweighs(const std::string& balance, model::FacetTerm& contact,
                           const fem::BlockMatrix& matrix, const std::vector<std::int32_t>& dofs,
                           const parallel::Team& team) {
    std::vector<double> largest;
    for (std::size_t law = 0; law < contact.law_count(); ++law) {
        largest.push_back(largest_entry(contact, law));
    }
    largest.push_back(largest_diagonal_entry(matrix, dofs));
    team.max(largest);
    const double of_body = largest.back();
    largest.pop_back();
    const auto law = std::ranges::max_element(largest);
    if (law == largest.end() || !(*law > many_decades * of_body)) {
        return "";
    }
    return std::string("; ") + words_of_law(contact, static_cast<std::size_t>(law - largest.begin())) +
           " makes contact " + short_text(*law / of_body) + " times as stiff as the body by its " +
           words_of_body(balance) +
           ", which loses as many digits there; use values that differ by fewer decades";
}

}  // namespace

/// Every process must call.
std::string Balance::why_not(const Eigen::VectorXd& x, const solve::NewtonResult& first,
                             const solve::ContinuationResult* ladder) {
    const double round_off =
        ladder != nullptr ? std::max(first.round_off, ladder->newton.round_off) : first.round_off;
    problem().evaluate_at(x, contact_);
    std::string text = failure_text(name_, contact_.regularisation_key(), first, ladder);
    text += round_off > options_.tolerance ? what_rounds(x, round_off)
                                           : what_outweighs(name_, contact_, systems_.front()->matrix,
                                                            contact_dofs(), strategy_->team());
    if (first.end == solve::NewtonEnd::not_solved) {
        text += std::string("; stiffness that differs by many decades (") +
                (name_ == "heat" ? "heat.conductivity" : "poisson near 0.5, a stiff contact") +
                ") is too much for multigrid: try solver.strategy = \"condensed\"";
    }
    return text;
}

/// The law, or the body, whose terms rounding takes most from, the digits that it leaves, and what to do.
std::string Balance::what_rounds(const Eigen::VectorXd& x, double round_off) {
    std::vector<double> sums = contact_.magnitudes(x);
    const std::vector<double> of_body = solve::product_of_magnitudes(systems_.front()->matrix, *unknown_);
    sums.push_back(0);
    for (const std::int32_t dof : contact_dofs()) {
        sums.back() += of_body[static_cast<std::size_t>(dof)];
    }
    strategy_->team().sum(sums);
    // what presses on the body is balanced by it: of two such terms contact's own is named
    const auto law = static_cast<std::size_t>(std::max_element(sums.begin(), sums.end() - 1) - sums.begin());
    const bool by_contact = contact_.law_count() > 0 && sums[law] >= least_share * sums.back();
    const std::string looser =
        round_off > loosest_tolerance
            ? ""
            : ", or a solver.tolerance of " + short_text(std::pow(10, std::ceil(std::log10(round_off))));
    return "; the last bits of the unknowns are worth " + short_text(round_off) + " of the terms, by " +
           (by_contact ? words_of_law(contact_, law) : words_of_body(name_)) + ": " +
           std::to_string(static_cast<int>(std::max(0.0, -std::log10(round_off)))) + " digits are left, " +
           std::to_string(static_cast<int>(-std::log10(options_.tolerance))) +
           " are asked for; use values that differ by fewer decades" + looser;
}

}  // namespace thermocontact::march
