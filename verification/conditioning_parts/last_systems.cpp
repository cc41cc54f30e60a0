/// Prints the linear systems of a scene's last step, and how the condensed strategy solves them.
///
///     last_systems SCENE
///
/// Output: JSON, by balance: `matrix` T = A + dF/dx at the last solution x, dense, over the unknowns that are
/// not prescribed; `rhs` T x, rounded; `solution` of that, found as in a step; `condition` and
/// `contact_condition` as in the summary. Exit codes: 1 failed, 2 usage, 3 numerics failed.

#include <exception>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numeric>

#include "error.h"
#include "march/simulation.h"
#include "scene/reader.h"
#include "solve/condensed_problem.h"

namespace {

using namespace thermocontact;

/// A linear system takes one iteration of Newton's, and its polish; what residual that leaves is to be seen.
constexpr double one_iteration = 1e-6;
constexpr int most_iterations = 3;

/// J x.
class Linear : public solve::NonlinearTerm {
  public:
    explicit Linear(Eigen::MatrixXd J) : J_(std::move(J)), unknowns_(static_cast<std::size_t>(J_.rows())) {
        std::iota(unknowns_.begin(), unknowns_.end(), 0);
    }
    void evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& value) override { value = J_ * x; }
    void visit_derivative(const Eigen::VectorXd&, const Piece& visit) override {
        const Eigen::MatrixXd rows = J_.transpose();  // row-major
        visit(unknowns_, std::span(rows.data(), static_cast<std::size_t>(rows.size())));
    }

  private:
    Eigen::MatrixXd J_;
    std::vector<std::int32_t> unknowns_;
};

/// dF/dx at the last solution, over the contact unknowns.
Eigen::MatrixXd derivative_of(march::Balance& balance) {
    const std::vector<std::int32_t>& dofs = balance.contact_dofs();
    const auto count = static_cast<Eigen::Index>(dofs.size());
    Eigen::VectorXd x(count);
    for (Eigen::Index i = 0; i < count; ++i) {
        x[i] = balance.solution()[static_cast<std::size_t>(dofs[static_cast<std::size_t>(i)])];
    }
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(count, count);
    balance.contact().add_derivative(x, J);
    return J;
}

/// A + J over all dofs.
Eigen::MatrixXd full_matrix(const march::Balance& balance, const Eigen::MatrixXd& J) {
    const std::size_t size = balance.solution().size();
    const auto n = static_cast<Eigen::Index>(size);
    Eigen::MatrixXd T(n, n);
    for (std::size_t j = 0; j < size; ++j) {
        std::vector<double> unit(size, 0.0);
        unit[j] = 1;
        const std::vector<double> column = balance.matrix().multiply(unit);
        T.col(static_cast<Eigen::Index>(j)) = Eigen::Map<const Eigen::VectorXd>(column.data(), n);
    }
    const std::vector<std::int32_t>& dofs = balance.contact_dofs();
    for (std::size_t i = 0; i < dofs.size(); ++i) {
        for (std::size_t j = 0; j < dofs.size(); ++j) {
            T(dofs[i], dofs[j]) += J(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
        }
    }
    return T;
}

/// Solves T y = T x, where x is the last solution.
nlohmann::json solved(march::Balance& balance) {
    const Eigen::MatrixXd J = derivative_of(balance);
    const Eigen::MatrixXd T = full_matrix(balance, J);
    const std::vector<char>& fixed = balance.prescribed().fixed();
    std::vector<double> x = balance.solution();
    std::vector<Eigen::Index> free;
    for (std::size_t dof = 0; dof < x.size(); ++dof) {
        if (fixed[dof] != 0) {
            x[dof] = 0;
        } else {
            free.push_back(static_cast<Eigen::Index>(dof));
        }
    }
    const Eigen::VectorXd product =
        T * Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
    std::vector<double> rhs(product.begin(), product.end());

    solve::Condensed strategy{solve::InteriorOrders(*balance.matrix().graph)};
    const auto problem = strategy.prepare({balance.name(),
                                           balance.matrix(),
                                           fixed,
                                           balance.contact_nodes(),
                                           !balance.contact().has_friction(),
                                           {one_iteration, most_iterations}});
    Linear F(J);
    std::vector<double> solution(x.size(), 0.0);
    Eigen::VectorXd contact = problem->begin(rhs, solution);
    const solve::NewtonResult result = problem->solve(F, contact);
    problem->finish(contact, solution);
    const auto condition = problem->condition(solution);

    nlohmann::json json{{"end", solve::describe(result.end)}};
    if (condition) {
        json["condition"] = condition->system;
        json["contact_condition"] = condition->contact.value_or(1.0);
    }
    json["matrix"] = nlohmann::json::array();
    for (const Eigen::Index i : free) {
        const Eigen::VectorXd row = T(i, free);
        json["matrix"].push_back(std::vector<double>(row.begin(), row.end()));
        json["rhs"].push_back(product[i]);
        json["solution"].push_back(solution[static_cast<std::size_t>(i)]);
    }
    return json;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "usage: last_systems SCENE\n";
        return 2;
    }
    try {
        const scene::Scene scene = scene::read_scene(argv[1], {});
        march::Simulation simulation(scene);
        while (!simulation.finished()) {
            simulation.advance();
        }
        nlohmann::json systems = nlohmann::json::object();
        for (march::Balance* balance : simulation.balances()) {
            systems[balance->name()] = solved(*balance);
        }
        std::cout << systems << "\n";
    } catch (const NumericsError& error) {
        std::cerr << "last_systems: " << error.what() << "\n";
        return 3;
    } catch (const std::exception& error) {
        std::cerr << "last_systems: " << error.what() << "\n";
        return 1;
    }
    return 0;
}
