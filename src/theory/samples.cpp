#include "theory/samples.h"

#include <cmath>
#include <numeric>
#include <span>

#include "error.h"
#include "model/law_samples.h"
#include "number.h"

namespace thermocontact::theory {
namespace {

using Nodes = std::vector<std::int32_t>;

constexpr int most_times = 101;

class Sampler {
  public:
    Sampler(const scene::Scene& scene, const fem::Space& space)
        : space_(space), all_(space.nodes.size()), intervals_(std::min(scene.time.steps, most_times - 1)) {
        std::iota(all_.begin(), all_.end(), 0);
        for (int i = 0; i <= intervals_; ++i) {
            times_.push_back(scene.time.end * i / intervals_);
        }
    }

    int times() const { return static_cast<int>(times_.size()); }
    const Nodes& everywhere() const { return all_; }

    void take(const scene::Expression& expression, const Nodes& nodes, Range& range) const {
        take(expression, nodes, expression.depends_on_time() ? std::span(times_) : std::span(times_).first(1),
             range);
    }
    void take(std::span<const scene::Expression> expressions, const Nodes& nodes, Range& range) const {
        for (const scene::Expression& expression : expressions) {
            take(expression, nodes, range);
        }
    }
    void take_at_start(const scene::Expression& expression, const Nodes& nodes, Range& range) const {
        take(expression, nodes, std::span(times_).first(1), range);
    }

    /// A law of a file, at the points of its rule.
    void take(model::LawSamples law, const mesh::Mesh& mesh, const scene::Law& of, Range& range) const {
        for (const double t : times_) {
            for (std::int32_t cell = 0; cell < mesh.cell_count(); ++cell) {
                for (const double value : law.at(cell, t)) {
                    if (!std::isfinite(value)) {
                        range.failure = model::place_of(of) + ": no finite number at t = " + short_text(t);
                        return;
                    }
                    range.smallest = std::min(range.smallest, value);
                    range.largest = std::max(range.largest, value);
                }
            }
        }
    }

  private:
    void take(const scene::Expression& expression, const Nodes& nodes, std::span<const double> times,
              Range& range) const {
        try {
            for (const double t : times) {
                for (const std::int32_t node : nodes) {
                    const double value = expression(space_.nodes[static_cast<std::size_t>(node)], t);
                    range.smallest = std::min(range.smallest, value);
                    range.largest = std::max(range.largest, value);
                }
            }
        } catch (const NumericsError& error) {
            range.failure = error.what();
        }
    }

    const fem::Space& space_;
    Nodes all_;
    int intervals_;
    std::vector<double> times_;
};

Nodes nodes_of(const fem::Space& space, const std::vector<std::int32_t>& cells) {
    Nodes nodes;
    for (const std::int32_t cell : cells) {
        const auto of_cell = space.dofmap.of(cell);
        nodes.insert(nodes.end(), of_cell.begin(), of_cell.end());
    }
    std::ranges::sort(nodes);
    const auto repeated = std::unique(nodes.begin(), nodes.end());
    nodes.erase(repeated, nodes.end());
    return nodes;
}

void sample_clamp(const scene::Scene& scene, const scene::Boundary& boundary, const Nodes& nodes,
                  const Sampler& sampler, Samples& samples) {
    for (std::size_t c = 0; c < boundary.displacement.size(); ++c) {
        if (boundary.displacement[c]) {
            sampler.take(*boundary.displacement[c], nodes, samples.clamp);
            for (const auto* initial : {&scene.initial.displacement, &scene.initial.velocity}) {
                if (!initial->empty()) {
                    sampler.take_at_start((*initial)[c], nodes, samples.initial_on_clamp);
                }
            }
        }
    }
}

void sample_boundary(const scene::Boundary& boundary, const Nodes& nodes, const Sampler& sampler,
                     Samples& samples) {
    sampler.take(boundary.traction, nodes, samples.traction);
    if (boundary.spring) {
        sampler.take(boundary.spring->anchor, nodes, samples.anchor);
    }
    if (boundary.temperature) {
        sampler.take(*boundary.temperature, nodes, samples.prescribed_temperature);
    }
    if (boundary.heat_flux) {
        sampler.take(*boundary.heat_flux, nodes, samples.heat_flux);
    }
    if (boundary.contact) {
        sampler.take(boundary.contact->gap, nodes, samples.gap);
        if (boundary.contact->conductance) {
            sampler.take(boundary.contact->conductance->foundation_temperature, nodes,
                         samples.foundation_temperature);
        }
    }
}

}  // namespace

Samples take_samples(const scene::Scene& scene, const std::vector<Piece>& pieces, const mesh::Mesh& mesh,
                     const fem::Space& space) {
    const Sampler sampler(scene, space);
    Samples samples;
    samples.times = sampler.times();
    sampler.take(scene.body_force, sampler.everywhere(), samples.body_force);
    if (scene.own_body_force) {
        sampler.take(model::LawSamples(scene, mesh, "f"), mesh, *scene.own_body_force, samples.body_force);
    }
    if (scene.heat && scene.heat->own_source) {
        sampler.take(model::LawSamples(scene, mesh, "q0"), mesh, *scene.heat->own_source,
                     samples.heat_source);
    }
    for (const Piece& piece : pieces) {
        if (piece.heat && piece.heat->source) {
            sampler.take(*piece.heat->source, nodes_of(space, piece.cells), samples.heat_source);
        }
    }
    for (const auto& [name, boundary] : scene.boundaries) {
        const auto index = std::ranges::find(mesh.boundary_names, name) - mesh.boundary_names.begin();
        const Nodes& nodes = space.boundary_nodes[static_cast<std::size_t>(index)];
        sample_clamp(scene, boundary, nodes, sampler, samples);
        sample_boundary(boundary, nodes, sampler, samples);
    }
    return samples;
}

}  // namespace thermocontact::theory
