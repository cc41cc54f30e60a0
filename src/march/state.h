/// The unknowns at one instant, and what a step reports about them.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace thermocontact::march {

/// Nodal fields [nodes][components]; those of absent physics are empty.
struct State {
    int step = 0;
    double time = 0;                   ///< s
    std::vector<double> displacement;  ///< u, m
    std::vector<double> velocity;      ///< w, m/s
    std::vector<double> temperature;   ///< theta, K

    /// The rates that the next step begins with (step_rule.h), of the three fields; empty where the scheme
    /// takes none, and before the first step.
    double last_step = 0;  ///< size of the step that left them, s; 0: there are none
    std::vector<double> displacement_rate, velocity_rate, temperature_rate;

    /// Of adaptive steps (step_error.h): how often the scene's step is to be halved next, and the last y'' of
    /// the fields with the time since it held.
    int halvings = 0;
    double curvature_lag = 0;  ///< s; 0: there is none
    std::vector<double> displacement_curvature, velocity_curvature, temperature_curvature;
};

/// How a nonlinear solve went.
struct SolveReport {
    int iterations = 0;
    int retries = 0;  ///< solves beyond the first

    void add(const SolveReport& other) {
        iterations += other.iterations;
        retries += other.retries;
    }
};

/// Where the time of the steps went, s.
struct StepSeconds {
    double triangular_solves = 0;  ///< both passes through the sparse factors
    double newton = 0;             ///< the condensed nonlinear problems
    double audit = 0;              ///< operators on the new state, balances, norms

    void add(const StepSeconds& other) {
        triangular_solves += other.triangular_solves;
        newton += other.newton;
        audit += other.audit;
    }
};

/// Named numbers of a step, in the order of the history's columns.
using Record = std::vector<std::pair<std::string, double>>;

}  // namespace thermocontact::march
