/// What a person sees while a run goes on: a header, then one live line (a line now and then where there is
/// no terminal).
#pragma once

#include <string>

#include "march/simulation.h"
#include "stopwatch.h"

namespace thermocontact::output {

class Progress {
  public:
    /// `quiet` prints nothing at all.
    Progress(const scene::Scene& scene, bool quiet);

    void header(const march::Simulation& simulation) const;
    /// `record`: the step's row of the history.
    void step(const march::Simulation& simulation, const march::Record& record);
    void line(const std::string& text) const;

  private:
    const scene::Scene* scene_;
    bool quiet_, terminal_;
    Stopwatch total_;
    double last_shown_ = 0;
};

}  // namespace thermocontact::output
