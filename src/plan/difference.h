/// How far two runs are apart.
///
/// Of the norms: for each of w, eps(u) and theta the largest L2 norm of the difference over the instants,
/// of the fields themselves: the coarser solution is evaluated on the finer mesh (transfer.h). Of another
/// quantity: its largest difference. Errors are these relative to the largest norm, or value, of the finer
/// run.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fem/block_matrix.h"
#include "plan/pilot.h"
#include "plan/transfer.h"

namespace thermocontact::plan {

/// Norms of the fields of one mesh and degree.
class Norms {
  public:
    Norms(const scene::Scene& scene, const std::vector<std::string>& components);
    Norms(const Norms&) = delete;
    Norms& operator=(const Norms&) = delete;
    Norms(Norms&&) = delete;
    Norms& operator=(Norms&&) = delete;
    ~Norms() = default;

    const Domain& domain() const { return domain_; }

    /// [components]
    std::vector<double> of(const Frame& frame) const;

  private:
    Domain domain_;
    fem::NodeGraph graph_;
    struct Term {
        march::Nodal Frame::*field;
        fem::BlockMatrix gram;
    };
    std::vector<Term> terms_;
};

class Comparison {
  public:
    /// `scene` gives what does not change between the runs.
    Comparison(const scene::Scene& scene, Quantity quantity);

    const std::vector<std::string>& components() const { return components_; }

    /// [components]; the mesh of `fine` is as fine as that of `coarse`, and its degree as high. Where they
    /// are not nested, the norms are those of the coarser function as the finer mesh interpolates it.
    std::vector<double> difference(const Pilot& coarse, const Pilot& fine);

    /// The largest norm or value of a run itself.
    std::vector<double> size(const Pilot& run);

  private:
    const Norms& norms_of(const Discretisation& discretisation);

    const scene::Scene* scene_;
    Quantity quantity_;
    std::vector<std::string> components_;
    std::map<std::pair<std::string, int>, std::unique_ptr<Norms>> norms_;  ///< by kind and scale
};

}  // namespace thermocontact::plan
