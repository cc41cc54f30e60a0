#include "output/results.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <system_error>

#include "error.h"
#include "number.h"
#include "output/earlier_results.h"
#include "output/files.h"
#include "output/summary.h"
#include "parallel/together.h"

namespace thermocontact::output {
namespace {

/// "fields/body_000007.vtu", "fields/body_000007_p3.vtu" for the piece of process 3.
std::string numbered(const std::string& stem, int step, const std::string& extension) {
    std::array<char, 16> number{};
    std::snprintf(number.data(), number.size(), "_%06d", step);
    return "fields/" + stem + number.data() + extension;
}

std::string piece(int rank) {
    return "_p" + std::to_string(rank) + ".vtu";
}

void write_row(std::ofstream& file, const march::Record& record, bool names) {
    std::string row;
    for (const auto& [name, value] : record) {
        row += (row.empty() ? "" : ",") + (names ? name : exact_text(value));
    }
    file << row << '\n' << std::flush;
}

void check(const std::ofstream& file, const std::filesystem::path& path) {
    if (!file) {
        throw SystemError("cannot write " + path.string() + " (disk full?)");
    }
}

}  // namespace

Results::Results(FolderClaim claim, const scene::Scene& scene, march::Simulation& simulation,
                 const Checkpoint* earlier)
    : claim_(std::move(claim)),
      scene_(&scene),
      simulation_(&simulation),
      grids_(std::make_unique<FieldGrids>(scene, simulation)),
      checkpoints_(folder(), scene, simulation, earlier != nullptr ? earlier->run : new_run()) {
    bool continues = false;
    if_first([&] {
        continues = earlier != nullptr && run_of(folder() / checkpoint_name) == earlier->run;
        if (!continues) {
            clear_results(folder());
        }
    });
    continues = simulation.team().any(continues);
    // before anything that is later goes: what is left must be what the checkpoint says at any moment
    checkpoints_.write(earlier != nullptr ? Sync::yes : Sync::no);
    if_first([&] { open_files(continues); });
    last_fields_ = static_cast<int>(simulation.team().max(static_cast<double>(last_fields_)));
    if (!continues) {
        add_fields();
    }
}

void Results::follow(march::Simulation& simulation, int mesh) {
    if (mesh != mesh_) {
        mesh_ = mesh;
        simulation_ = &simulation;
        grids_ = std::make_unique<FieldGrids>(*scene_, simulation);
        checkpoints_.follow(simulation);
    }
}

void Results::open_files(bool continues) {
    if (continues) {
        const int step = simulation_->state().step;
        std::error_code ignored;
        std::filesystem::remove(folder() / "summary.json", ignored);
        has_header_ = keep_rows(folder() / "history.csv", step);
        steps_have_header_ = scene_->time.tolerance && keep_rows(folder() / "steps.csv", step);
        entries_ = keep_fields(folder(), step, fields_are_due());
        const bool written = std::ranges::any_of(
            entries_, [&](const PvdEntry& entry) { return entry.time == simulation_->state().time; });
        last_fields_ = written ? step : -1;
    }
    const auto open = [&](std::ofstream& file, const char* name) {
        file.open(folder() / name, continues ? std::ios::app : std::ios::trunc);
        if (!file) {
            throw SystemError("cannot write " + (folder() / name).string());
        }
    };
    open(history_, "history.csv");
    if (scene_->time.tolerance) {
        open(steps_, "steps.csv");
    }
    if (!scene_->output.fields.empty()) {
        make_folder(folder() / "fields");
    }
}

bool Results::fields_are_due() const {
    return simulation_->state().step % scene_->output.every == 0 || simulation_->finished();
}

/// Work that writes files: where these are missing because the folder is, it is the folder that is told.
void Results::told(const std::function<void()>& work) const {
    try {
        work();
    } catch (const SystemError&) {
        claim_.require();
        throw;
    }
}

void Results::if_first(const std::function<void()>& work) const {
    const parallel::Team& team = simulation_->team();
    parallel::together(team, [&] {
        if (team.rank() == 0) {
            work();
        }
    });
}

void Results::add_rows(const march::Record& record) {
    if (!has_header_) {
        write_row(history_, record, true);
        has_header_ = true;
    }
    write_row(history_, record, false);
    check(history_, folder() / "history.csv");
}

/// A row an attempt. Where no solution was found, there is no estimate.
void Results::add_attempts() {
    std::string rows;
    if (!steps_have_header_) {
        rows = "step,time,size,error_estimate,field,outcome\n";
        steps_have_header_ = true;
    }
    for (const march::Attempt& attempt : simulation_->attempts()) {
        const bool failed = attempt.outcome == march::Attempt::Outcome::failed;
        rows += std::to_string(simulation_->state().step) + "," + exact_text(attempt.end) + "," +
                exact_text(attempt.size) + "," + (failed ? "" : exact_text(attempt.error)) + "," +
                attempt.of + "," + march::name(attempt.outcome) + "\n";
    }
    steps_ << rows << std::flush;
    check(steps_, folder() / "steps.csv");
}

march::Record Results::add_step() {
    march::Record record = simulation_->record();
    told([&] {
        if_first([&] {
            claim_.require();  // a row is written to the open file, wherever that is
            add_rows(record);
            if (scene_->time.tolerance) {
                add_attempts();
            }
        });
        if (fields_are_due()) {
            write_fields();
        }
    });
    return record;
}

void Results::write_grid(const std::string& name, const VtuGrid& grid) {
    const int step = simulation_->state().step;
    const parallel::Team& team = simulation_->team();
    const bool alone = team.size() == 1;
    const std::string whole = numbered(name, step, alone ? ".vtu" : ".pvtu");
    const std::string own = alone ? whole : numbered(name, step, piece(team.rank()));
    parallel::together(team, [&] { write_whole(folder() / own, to_vtu(grid)); });
    if (!alone) {  // lists pieces that are there
        if_first([&] {
            std::vector<std::string> files;
            files.reserve(static_cast<std::size_t>(team.size()));
            for (int rank = 0; rank < team.size(); ++rank) {
                files.push_back(std::filesystem::path(numbered(name, step, piece(rank))).filename());
            }
            write_whole(folder() / whole, to_pvtu(grid, files));
        });
    }
    entries_.push_back({simulation_->state().time, name == "body" ? 0 : 1, whole});
}

void Results::add_fields() {
    told([&] { write_fields(); });
}

void Results::add_checkpoint() {
    told([&] { checkpoints_.write(Sync::yes); });
}

void Results::write_fields() {
    const int step = simulation_->state().step;
    if (scene_->output.fields.empty() || last_fields_ == step) {
        return;
    }
    write_grid("body", grids_->body());
    if (grids_->has_contact()) {
        write_grid("contact", grids_->contact());
    }
    if_first([&] { write_whole(folder() / "fields.pvd", to_pvd(entries_)); });
    last_fields_ = step;
}

void Results::finish(const std::string& status, const std::string& reason, const Seconds& seconds,
                     const std::vector<BalanceCondition>& conditions, const nlohmann::ordered_json& plan) {
    nlohmann::ordered_json content = summary(*scene_, *simulation_, status, reason, seconds, conditions);
    if (!plan.is_null()) {
        content["plan"] = plan;
    }
    told([&] { if_first([&] { write_whole(folder() / "summary.json", content.dump(2) + "\n"); }); });
}

void write_setup_failure(const std::filesystem::path& folder, const scene::Scene& scene,
                         const std::string& reason) {
    clear_results(folder);
    const nlohmann::ordered_json summary{{"status", "failed"},
                                         {"version", version_text()},
                                         {"reason", reason},
                                         {"scene", scene.resolved},
                                         {"steps", 0}};
    write_whole(folder / "summary.json", summary.dump(2) + "\n");
}

}  // namespace thermocontact::output
