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

std::string numbered(const char* stem, int step) {
    std::array<char, 64> name{};
    std::snprintf(name.data(), name.size(), "fields/%s_%06d.vtu", stem, step);
    return name.data();
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
    for (const char* file : {"summary.json", "history.csv", "fields.pvd"}) {
        std::filesystem::remove(folder / file, ignored);
    }
    for (const auto& entry : std::filesystem::directory_iterator(folder / "fields", ignored)) {
        if (entry.path().extension() == ".vtu") {
            std::filesystem::remove(entry.path(), ignored);
        }
    }
}

}  // namespace

Results::Results(std::filesystem::path folder, const scene::Scene& scene, march::Simulation& simulation)
    : folder_(std::move(folder)), scene_(&scene), simulation_(&simulation), grids_(scene, simulation) {
    make_folder(folder_);
    clear(folder_);
    history_.open(folder_ / "history.csv", std::ios::trunc);
    if (!history_) {
        throw SystemError("cannot write " + (folder_ / "history.csv").string());
    }
    if (!scene.output.fields.empty()) {
        make_folder(folder_ / "fields");
        add_fields();
    }
}

void Results::add_step() {
    const march::Record record = simulation_->record();
    if (history_.tellp() == 0) {
        write_row(history_, record, true);
    }
    write_row(history_, record, false);
    if (!history_) {
        throw SystemError("cannot write " + (folder_ / "history.csv").string() + " (disk full?)");
    }
    const int step = simulation_->state().step;
    if (step % scene_->output.every == 0 || simulation_->finished()) {
        add_fields();
    }
}

void Results::add_fields() {
    const int step = simulation_->state().step;
    if (scene_->output.fields.empty() || last_fields_ == step) {
        return;
    }
    const double time = simulation_->state().time;
    entries_.push_back({time, 0, numbered("body", step)});
    write_whole(folder_ / entries_.back().file, to_vtu(grids_.body()));
    if (grids_.has_contact()) {
        entries_.push_back({time, 1, numbered("contact", step)});
        write_whole(folder_ / entries_.back().file, to_vtu(grids_.contact()));
    }
    write_whole(folder_ / "fields.pvd", to_pvd(entries_));
    last_fields_ = step;
}

void Results::finish(const std::string& status, const std::string& reason, const Seconds& seconds) {
    write_whole(folder_ / "summary.json",
                summary(*scene_, *simulation_, status, reason, seconds).dump(2) + "\n");
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
