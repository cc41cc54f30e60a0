/// All that a simulation needs to go on from where another one stopped, on any number of processes.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "march/state.h"
#include "solve/newton.h"

namespace thermocontact::march {

/// What a dense Newton iteration with the system of `tau` (s) goes on with.
struct KeptSystem {
    double tau;
    solve::KeptDerivative derivative;
};

struct Snapshot {
    State state;    ///< nodal fields in the order of the whole mesh's nodes
    Totals totals;  ///< over the steps so far
    /// By balance ("momentum", "heat"): with it, the next steps agree to the last bit. Strategies that keep
    /// no such thing have none.
    std::map<std::string, std::vector<KeptSystem>> kept = {};
    std::vector<std::int64_t> bisections =
        {};  ///< of an adapted mesh (mesh/forest.h), which the fields are on
};

}  // namespace thermocontact::march
