#include "output/results.h"

#include <array>
#include <cstdio>
#include <system_error>

#include "error.h"
#include "number.h"
#include "output/files.h"
#include "output/summary.h"

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

/// Removes what an earlier run left, and nothing else.
void clear(const std::filesystem::path& folder) {
    std::error_code ignored;
    for (const char* file : {"summary.json", "history.csv", "steps.csv", "fields.pvd"}) {
        std::filesystem::remove(folder / file, ignored);
    }
    for (const auto& entry : std::filesystem::directory_iterator(folder / "fields", ignored)) {
        if (entry.path().extension() == ".vtu" || entry.path().extension() == ".pvtu") {
            std::filesystem::remove(entry.path(), ignored);
        }
    }
}

}  // namespace

Results::Results(std::filesystem::path folder, const scene::Scene& scene, march::Simulation& simulation)
    : folder_(std::move(folder)), scene_(&scene), simulation_(&simulation), grids_(scene, simulation) {
    if (first_process()) {
        make_folder(folder_);
        clear(folder_);
        history_.open(folder_ / "history.csv", std::ios::trunc);
        if (!history_) {
            throw SystemError("cannot write " + (folder_ / "history.csv").string());
        }
        if (scene.time.tolerance) {
            steps_.open(folder_ / "steps.csv", std::ios::trunc);
        }
        if (!scene.output.fields.empty()) {
            make_folder(folder_ / "fields");
        }
    }
    simulation.team().sum(0);  // the others wait for the folder
    add_fields();
}

void Results::add_history(const march::Record& record) {
    const auto add = [&](std::ofstream& file, const char* name, const march::Record& row) {
        if (file.tellp() == 0) {
            write_row(file, row, true);
        }
        write_row(file, row, false);
        if (!file) {
            throw SystemError("cannot write " + (folder_ / name).string() + " (disk full?)");
        }
    };
    add(history_, "history.csv", record);
    if (scene_->time.tolerance) {
        for (const auto& [end, length, error] : simulation_->parts()) {
            add(steps_, "steps.csv",
                {{"step", simulation_->state().step},
                 {"time", end},
                 {"length", length},
                 {"error_estimate", error}});
        }
    }
}

march::Record Results::add_step() {
    march::Record record = simulation_->record();
    if (first_process()) {
        add_history(record);
    }
    const int step = simulation_->state().step;
    if (step % scene_->output.every == 0 || simulation_->finished()) {
        add_fields();
    }
    return record;
}

void Results::write_grid(const std::string& name, const VtuGrid& grid) {
    const int step = simulation_->state().step, processes = simulation_->team().size();
    const int part = name == "body" ? 0 : 1;
    const std::string collected = numbered(name, step, processes == 1 ? ".vtu" : ".pvtu");
    entries_.push_back({simulation_->state().time, part, collected});
    if (processes == 1) {
        write_whole(folder_ / collected, to_vtu(grid));
        return;
    }
    write_whole(folder_ / numbered(name, step, piece(simulation_->team().rank())), to_vtu(grid));
    if (first_process()) {
        std::vector<std::string> files;
        for (int rank = 0; rank < processes; ++rank) {
            files.push_back(std::filesystem::path(numbered(name, step, piece(rank))).filename());
        }
        write_whole(folder_ / collected, to_pvtu(grid, files));
    }
}

void Results::add_fields() {
    const int step = simulation_->state().step;
    if (scene_->output.fields.empty() || last_fields_ == step) {
        return;
    }
    write_grid("body", grids_.body());
    if (grids_.has_contact()) {
        write_grid("contact", grids_.contact());
    }
    if (first_process()) {
        write_whole(folder_ / "fields.pvd", to_pvd(entries_));
    }
    last_fields_ = step;
}

void Results::finish(const std::string& status, const std::string& reason, const Seconds& seconds) {
    const nlohmann::ordered_json content = summary(*scene_, *simulation_, status, reason, seconds);
    if (first_process()) {
        write_whole(folder_ / "summary.json", content.dump(2) + "\n");
    }
}

void write_setup_failure(const std::filesystem::path& folder, const scene::Scene& scene,
                         const std::string& reason) {
    clear(folder);
    const nlohmann::ordered_json summary{{"status", "failed"},
                                         {"version", version_text()},
                                         {"reason", reason},
                                         {"scene", scene.resolved},
                                         {"steps", 0}};
    write_whole(folder / "summary.json", summary.dump(2) + "\n");
}

}  // namespace thermocontact::output
