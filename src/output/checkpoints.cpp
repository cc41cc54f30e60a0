#include "output/checkpoints.h"

#include "output/checkpoint.h"
#include "parallel/together.h"

namespace thermocontact::output {
namespace {

constexpr double largest_share = 0.02;  ///< of the time, for checkpoints that nobody asked for
constexpr double cost_of_sync = 0.02;   ///< s, a guess before the first one that waits for the disk

}  // namespace

Checkpoints::Checkpoints(std::filesystem::path folder, const scene::Scene& scene,
                         const march::Simulation& simulation, std::string run)
    : folder_(std::move(folder)), scene_(&scene), simulation_(&simulation), run_(std::move(run)) {}

bool Checkpoints::due() const {
    const int step = simulation_->state().step;
    if (scene_->output.checkpoint_every) {
        return step % *scene_->output.checkpoint_every == 0;
    }
    return simulation_->team().rank() == 0 && cost_ < largest_share * since_last_.seconds();
}

void Checkpoints::write(Sync sync) {
    if (last_step_ == simulation_->state().step) {
        return;
    }
    const Stopwatch stopwatch;
    const march::Snapshot snapshot = simulation_->snapshot();
    parallel::together(simulation_->team(), [&] {
        if (simulation_->team().rank() == 0) {
            write_whole(folder_ / checkpoint_name, to_bytes({run_, snapshot}, *scene_), sync);
        }
    });
    last_step_ = simulation_->state().step;
    cost_ = stopwatch.seconds() + (sync == Sync::no ? cost_of_sync : 0);
    since_last_ = {};
}

}  // namespace thermocontact::output
