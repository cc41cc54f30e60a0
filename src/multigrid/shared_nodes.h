/// Nodes that several processes hold, and what they tell each other of them. Nodal vectors are consistent: at
/// a shared node every process holds the same, to the last bit.
#pragma once

#include <cstdint>
#include <vector>

#include "parallel/part.h"
#include "parallel/team.h"

namespace thermocontact::multigrid {

/// Rows of blocks, in single precision, by the global number of their columns.
struct Rows {
    std::size_t length = 0;             ///< floats of a block
    std::vector<std::int32_t> offsets;  ///< [rows + 1]
    std::vector<std::int32_t> columns;  ///< in order
    std::vector<float> values;          ///< [columns][length]
};

class SharedNodes {
  public:
    /// Keeps a reference to `team`. Every process must call.
    SharedNodes(parallel::NodeNumbers numbers, const parallel::Team& team);

    const parallel::NodeNumbers& numbers() const { return numbers_; }
    const parallel::Team& team() const { return *team_; }
    std::size_t node_count() const { return numbers_.global.size(); }
    bool owned(std::size_t node) const {
        const std::int32_t global = numbers_.global[node];
        return global >= numbers_.begin() && global < numbers_.end();
    }

    /// Adds up what the processes hold at shared nodes, in order of their ranks, the owner first; `values`
    /// [nodes][stride].
    template <typename T>  // float, double
    void add_up(std::vector<T>& values, std::size_t stride) const;

    /// The same of rows, one for each node.
    void add_up(Rows& rows) const;

    /// Zero at nodes that another process owns.
    void keep_owned(std::vector<float>& values, std::size_t stride) const;

    /// Over all processes, each node counted once.
    double dot(const std::vector<float>& a, const std::vector<float>& b, std::size_t stride) const;

  private:
    struct Neighbour {
        int rank;
        std::vector<std::int32_t> theirs;  ///< nodes held here that it owns
        std::vector<std::int32_t> ours;    ///< nodes owned here that it holds, in its order
    };

    parallel::NodeNumbers numbers_;
    const parallel::Team* team_;
    std::vector<Neighbour> neighbours_;  ///< by rank
};

}  // namespace thermocontact::multigrid
