/// Wall time since construction.
#pragma once

#include <chrono>

namespace thermocontact {

class Stopwatch {
  public:
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Runs `action` and adds the time it took to `seconds`, also when it throws.
template <typename Action>
decltype(auto) timed(double& seconds, Action&& action) {
    struct Adder {
        double& seconds;
        Stopwatch stopwatch;
        ~Adder() { seconds += stopwatch.seconds(); }
    } adder{seconds, {}};
    return action();
}

}  // namespace thermocontact
