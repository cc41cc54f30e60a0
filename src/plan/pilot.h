/// A run in memory that is compared with others: no results are written.
#pragma once

#include <functional>
#include <vector>

#include "march/simulation.h"
#include "plan/discretisation.h"
#include "plan/quantity.h"

namespace thermocontact::plan {

/// The fields at one instant, or, where a single number is asked for, that.
struct Frame {
    march::Nodal displacement, velocity, temperature;
    double value = 0;
};

struct Costs {
    double setup = 0, factor = 0, steps = 0;  ///< s
    int factorisations = 0;
    /// That the same steps take where 1, 2, ... factors of each balance are kept.
    std::vector<int> factorisations_keeping = {};
    int attempts = 0;      ///< steps, and parts of adaptive ones, that were solved
    double processor = 0;  ///< s of processor time in all
    double end = 0;        ///< s to judge the digits left
    double frame = 0;      ///< s to put the fields into the form of their files once
    double unknowns = 0;
    double factor_bytes = 0;  ///< of one factor of each balance
};

struct Pilot {
    Discretisation discretisation;
    std::vector<Frame> frames;  ///< [instants]
    Costs costs;
    double damped = 0;  ///< energy that the scheme dissipated, of the largest that there was: see Recorder
};

/// Whether motions go on for ever: those that a scheme damps are then missing in what it converges to as long
/// as its steps do not resolve them, and its differences do not show it.
bool is_undamped(const scene::Scene& scene);

/// Collects what is compared, from a simulation as it marches.
class Recorder {
  public:
    /// Of a run of so many steps of the scene.
    Recorder(Quantity quantity, int steps) : quantity_(quantity), steps_(steps) {}

    /// After each step, with its row of the history.
    void note(march::Simulation& simulation, const march::Record& row);

    const std::vector<Frame>& frames() const { return frames_; }
    /// Of the largest energy, kinetic and of strain; of strain alone where nothing else damps: motions that
    /// go on for ever are vibrations, and a body that slides has far more energy than these.
    double damped(bool undamped) const {
        const double largest = undamped ? largest_strain_energy_ : largest_energy_;
        return largest > 0 ? dissipated_ / largest : 0.0;
    }
    int attempts() const { return attempts_; }

  private:
    Quantity quantity_;
    int steps_;
    std::vector<Frame> frames_;
    double dissipated_ = 0, largest_energy_ = 0, largest_strain_energy_ = 0;
    int attempts_ = 0;
};

/// Marches `scene`, which is discretised as `discretisation` says; `check` is called after every step and may
/// throw. Throws NumericsError, what Simulation throws, and parallel::BackendNeeded.
Pilot run_pilot(const scene::Scene& scene, const Discretisation& discretisation, Quantity quantity,
                const parallel::Backend* backend, const std::function<void()>& check);

}  // namespace thermocontact::plan
