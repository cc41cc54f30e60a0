#include "output/results.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "base64.h"
#include "error.h"
#include "output/files.h"
#include "output/summary.h"
#include "support/scenes.h"

namespace thermocontact::output {
namespace {

namespace fs = std::filesystem;

/// A folder of the running test's own.
class ResultFiles : public testing::Test {
  protected:
    ResultFiles() { fs::create_directories(folder); }
    ~ResultFiles() override { fs::remove_all(folder); }

    static std::string content(const fs::path& path) {
        std::ostringstream text;
        text << std::ifstream(path, std::ios::binary).rdbuf();
        return text.str();
    }
    static void put(const fs::path& path, const std::string& text) { std::ofstream(path) << text; }
    static std::set<std::string> names(const fs::path& in) {
        std::set<std::string> result;
        for (const auto& entry : fs::directory_iterator(in)) {
            result.insert(entry.path().filename().string());
        }
        return result;
    }
    static std::vector<std::vector<std::string>> rows(const fs::path& csv) {
        std::vector<std::vector<std::string>> result;
        std::istringstream lines(content(csv));
        for (std::string line; std::getline(lines, line);) {
            std::istringstream cells(line);
            result.emplace_back();
            for (std::string cell; std::getline(cells, cell, ',');) {
                result.back().push_back(cell);
            }
        }
        return result;
    }

    /// Runs a scene of the repository and returns its summary.
    nlohmann::ordered_json run(const std::string& name, const support::Overrides& overrides) {
        scene = support::repository_scene(name, overrides);
        simulation.emplace(scene);
        Results results({folder, simulation->team()}, scene, *simulation);
        while (!simulation->finished()) {
            simulation->advance();
            results.add_step();
        }
        results.add_fields();
        results.finish("completed", "", {}, {});
        return nlohmann::ordered_json::parse(content(folder / "summary.json"));
    }

    const fs::path folder =
        fs::path(testing::TempDir()) / ("thermocontact-results-" + std::to_string(getpid()) + "-" +
                                        testing::UnitTest::GetInstance()->current_test_info()->name());
    scene::Scene scene;
    std::optional<march::Simulation> simulation;
};

TEST_F(ResultFiles, WriteWholeReplacesAFile) {
    write_whole(folder / "a.txt", "first");
    write_whole(folder / "a.txt", std::string("second\0half", 11));
    EXPECT_EQ(content(folder / "a.txt"), std::string("second\0half", 11));
    EXPECT_EQ(names(folder), std::set<std::string>{"a.txt"}) << "nothing is left beside it";
}

/// Below a regular file nothing can be written, not even by root.
TEST_F(ResultFiles, WriteWholeFailsWithoutATrace) {
    put(folder / "file", "untouched");
    try {
        write_whole(folder / "file" / "a.txt", "text");
        FAIL() << "no exception";
    } catch (const SystemError& error) {
        EXPECT_NE(std::string(error.what()).find((folder / "file" / "a.txt").string()), std::string::npos)
            << error.what();
        EXPECT_NE(std::string(error.what()).find("Not a directory"), std::string::npos) << error.what();
    }
    EXPECT_EQ(content(folder / "file"), "untouched");
    EXPECT_EQ(names(folder), std::set<std::string>{"file"});
}

/// Where the rename fails (a folder has the name), the half of the work that was done does not stay either.
TEST_F(ResultFiles, WriteWholeOverAFolder) {
    fs::create_directories(folder / "taken" / "inside");
    EXPECT_THROW(write_whole(folder / "taken", "text"), SystemError);
    EXPECT_TRUE(fs::is_directory(folder / "taken"));
    EXPECT_EQ(names(folder), std::set<std::string>{"taken"}) << "the part file stays behind";
}

TEST_F(ResultFiles, FullDiskIsASystemError) {
    if (!fs::exists("/dev/full")) {
        GTEST_SKIP() << "no /dev/full";
    }
    fs::create_symlink("/dev/full", folder / "a.txt.part");
    EXPECT_THROW(write_whole(folder / "a.txt", std::string(1 << 20, 'x')), SystemError);
    EXPECT_FALSE(fs::exists(folder / "a.txt"));
}

TEST_F(ResultFiles, MakeFolder) {
    make_folder(folder / "a" / "b");
    EXPECT_TRUE(fs::is_directory(folder / "a" / "b"));
    EXPECT_NO_THROW(make_folder(folder / "a" / "b"));
    put(folder / "file", "");
    EXPECT_THROW(make_folder(folder / "file" / "c"), SystemError);
    EXPECT_THROW(make_folder(folder / "file"), SystemError);
}

const support::Overrides small{"mesh.cells=[4,4]", "time.steps=5"};

support::Overrides with(const support::Overrides& more) {
    support::Overrides result = small;
    result.insert(result.end(), more.begin(), more.end());
    return result;
}

/// The output steps: the first, each `every`-th, the last.
TEST_F(ResultFiles, PvdAndFilesAgree) {
    run("paper", with({"output.every=2"}));
    const std::string pvd = content(folder / "fields.pvd");
    std::vector<std::array<std::string, 3>> found;
    for (std::size_t at = pvd.find("<DataSet "); at != std::string::npos;
         at = pvd.find("<DataSet ", at + 1)) {
        found.push_back({between(pvd, "timestep=\"", "\"", at), between(pvd, "part=\"", "\"", at),
                         between(pvd, "file=\"", "\"", at)});
        EXPECT_TRUE(fs::exists(folder / found.back()[2])) << found.back()[2];
    }
    ASSERT_EQ(found.size(), 8U);
    const int steps[] = {0, 2, 4, 5};
    for (std::size_t i = 0; i < 8; ++i) {
        const int step = steps[i / 2];
        EXPECT_EQ(std::stod(found[i][0]), 1.0 * step / 5);
        EXPECT_EQ(found[i][1], std::to_string(i % 2));
        EXPECT_EQ(found[i][2], std::string("fields/") + (i % 2 == 0 ? "body" : "contact") + "_00000" +
                                   std::to_string(step) + ".vtu");
    }
    EXPECT_EQ(names(folder / "fields").size(), 8U) << "no other files";
    EXPECT_EQ(names(folder), (std::set<std::string>{"checkpoint.h5", "fields", "fields.pvd", "history.csv",
                                                    "summary.json"}));
}

/// The last state, read back from its files.
TEST_F(ResultFiles, FieldsAreTheState) {
    for (const int degree : {1, 2}) {
        run("paper", with({"space.degree=" + std::to_string(degree)}));
        const std::string body = content(folder / "fields/body_000005.vtu"),
                          contact = content(folder / "fields/contact_000005.vtu");
        const march::State& state = simulation->state();
        const std::size_t nodes = simulation->space().nodes.size();
        const auto displacement = read_array<double>(body, "displacement", "Float64", 3);
        const auto velocity = read_array<double>(body, "velocity", "Float64", 3);
        const auto points = read_array<double>(body, "Points", "Float64", 3);
        ASSERT_EQ(displacement.size(), 3 * nodes);
        for (std::size_t node = 0; node < nodes; ++node) {
            for (std::size_t c = 0; c < 3; ++c) {
                EXPECT_EQ(displacement[3 * node + c], c < 2 ? state.displacement[2 * node + c] : 0.0);
                EXPECT_EQ(velocity[3 * node + c], c < 2 ? state.velocity[2 * node + c] : 0.0);
                EXPECT_EQ(points[3 * node + c], simulation->space().nodes[node][c]);
            }
        }
        EXPECT_EQ(read_array<double>(body, "temperature", "Float64", 1), state.temperature);
        EXPECT_EQ(read_array<double>(body, "stress", "Float64", 6).size(), 6U * 32);
        EXPECT_EQ(read_array<double>(body, "von_mises", "Float64", 1).size(), 32U);
        const std::uint8_t triangle = degree == 1 ? 5 : 22, line = degree == 1 ? 3 : 21;
        EXPECT_EQ(read_array<std::uint8_t>(body, "types", "UInt8", 1),
                  std::vector<std::uint8_t>(32, triangle));
        EXPECT_EQ(read_array<std::uint8_t>(contact, "types", "UInt8", 1), std::vector<std::uint8_t>(4, line));
        const std::size_t facet_points = 4 * (static_cast<std::size_t>(degree) + 1);
        for (const auto& [name, components] : std::vector<std::pair<std::string, int>>{{"gap", 1},
                                                                                       {"pressure", 1},
                                                                                       {"traction", 3},
                                                                                       {"slip_velocity", 3},
                                                                                       {"heat_flow", 1},
                                                                                       {"Points", 3}}) {
            EXPECT_EQ(read_array<double>(contact, name, "Float64", components).size(),
                      facet_points * components)
                << name;
        }
        EXPECT_EQ(read_array<std::int32_t>(contact, "boundary", "Int32", 1), std::vector<std::int32_t>(4, 0));
        // the state follows from gap and slip velocity
        const auto gap = read_array<double>(contact, "gap", "Float64", 1),
                   slip = read_array<double>(contact, "slip_velocity", "Float64", 3);
        const auto states = read_array<std::int32_t>(contact, "state", "Int32", 1);
        ASSERT_EQ(states.size(), facet_points);
        for (std::size_t i = 0; i < facet_points; ++i) {
            EXPECT_EQ(states[i], gap[i] > 0 ? 0 : std::hypot(slip[3 * i], slip[3 * i + 1]) <= 1e-3 ? 1 : 2);
        }
    }
}

/// A gap of zero is closed.
TEST_F(ResultFiles, WhatJustTouchesIsClosed) {
    run("paper", with({"boundary.bottom.contact.gap=0.0", "initial.displacement=[0.0, 0.0]"}));
    const std::string contact = content(folder / "fields/contact_000000.vtu");
    const auto gap = read_array<double>(contact, "gap", "Float64", 1);
    ASSERT_EQ(gap, std::vector<double>(8, 0.0));
    for (const std::int32_t state : read_array<std::int32_t>(contact, "state", "Int32", 1)) {
        EXPECT_NE(state, 0);
    }
}

/// Two contact sides with different laws: what one lacks is 0 there.
TEST_F(ResultFiles, LawsThatASideLacksAreZero) {
    run("anisotropic", {"mesh.cells=[3,2]", "time.step=0.3"});
    const std::string contact = content(folder / "fields/contact_000002.vtu");
    const auto boundary = read_array<std::int32_t>(contact, "boundary", "Int32", 1);
    const auto traction = read_array<double>(contact, "traction", "Float64", 3);
    ASSERT_EQ(boundary, (std::vector<std::int32_t>{0, 0, 0, 1, 1}));
    for (std::size_t i = 3 * 3 * 3; i < traction.size(); ++i) {
        EXPECT_EQ(traction[i], 0.0) << "the right side does not rub";
    }
}

/// Only the fields asked for; none at all with [].
TEST_F(ResultFiles, FieldsAreChosen) {
    run("paper", with({"output.fields=[\"temperature\"]"}));
    const std::string body = content(folder / "fields/body_000005.vtu");
    EXPECT_NE(body.find("temperature"), std::string::npos);
    for (const char* other : {"displacement", "velocity", "stress", "von_mises"}) {
        EXPECT_EQ(body.find(other), std::string::npos) << other;
    }
    EXPECT_FALSE(fs::exists(folder / "fields/contact_000005.vtu"));
    run("paper", with({"output.fields=[]"}));
    EXPECT_FALSE(fs::exists(folder / "fields.pvd"));
    EXPECT_EQ(names(folder).contains("fields") ? names(folder / "fields").size() : 0U, 0U)
        << "those of the earlier run are gone";
}

/// An earlier, longer run leaves nothing behind; files that are not results stay.
TEST_F(ResultFiles, EarlierResultsAreCleared) {
    run("paper", with({"time.steps=7"}));
    put(folder / "notes.txt", "mine");
    run("paper", small);
    EXPECT_FALSE(fs::exists(folder / "fields/body_000007.vtu"));
    EXPECT_EQ(names(folder / "fields").size(), 2U * 6);
    EXPECT_EQ(content(folder / "notes.txt"), "mine");
    EXPECT_EQ(rows(folder / "history.csv").size(), 1U + 5);
}

/// A failed run: its history is on disk, its summary says so, and the last state's fields can be added.
TEST_F(ResultFiles, SummaryOfAFailure) {
    scene = support::repository_scene("paper", with({"output.every=3"}));
    simulation.emplace(scene);
    Results results({folder, simulation->team()}, scene, *simulation);
    simulation->advance();
    results.add_step();
    EXPECT_FALSE(fs::exists(folder / "summary.json"));
    EXPECT_EQ(rows(folder / "history.csv").size(), 2U) << "rows are on disk as they come";
    results.add_fields();
    results.add_fields();
    results.finish("failed", "step 2: because", {}, {});
    const auto summary = nlohmann::json::parse(content(folder / "summary.json"));
    EXPECT_EQ(summary["status"], "failed");
    EXPECT_EQ(summary["reason"], "step 2: because");
    EXPECT_EQ(summary["final"]["time"], 0.2);
    EXPECT_EQ(names(folder / "fields").size(), 4U) << "steps 0 and 1, once";
}

class History : public ResultFiles, public testing::WithParamInterface<std::string> {};

/// Each row has the header's columns, every number is finite and reads back as itself.
TEST_P(History, ColumnsAreTheSameInEveryRow) {
    run(GetParam(), with({}));
    const auto table = rows(folder / "history.csv");
    ASSERT_EQ(table.size(), 1U + 5);
    const std::set<std::string> distinct(table[0].begin(), table[0].end());
    EXPECT_EQ(distinct.size(), table[0].size()) << "a column twice";
    for (const char* column : {"step", "time", "newton_iterations", "retries"}) {
        EXPECT_TRUE(distinct.contains(column)) << column;
    }
    const auto time = std::ranges::find(table[0], "time") - table[0].begin();
    for (std::size_t row = 1; row < table.size(); ++row) {
        ASSERT_EQ(table[row].size(), table[0].size()) << "row " << row;
        for (const std::string& cell : table[row]) {
            EXPECT_TRUE(std::isfinite(std::stod(cell))) << cell;
        }
        EXPECT_EQ(std::stoi(table[row][0]), static_cast<int>(row));
        EXPECT_EQ(std::stod(table[row][time]), scene.time.end * static_cast<double>(row) / 5) << "17 digits";
    }
    const march::Record last = simulation->record();
    for (std::size_t i = 0; i < last.size(); ++i) {
        EXPECT_EQ(last[i].first, table[0][i]);
        EXPECT_EQ(last[i].second, std::stod(table.back()[i])) << last[i].first;
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, History,
                         testing::Values("paper", "isothermal", "no-contact", "frictionless", "elastic",
                                         "quasi-static"),
                         [](const auto& info) {
                             std::string name = info.param;
                             std::ranges::replace(name, '-', '_');
                             return name;
                         });

/// summary.json has at least the keys of the interface, with their types.
TEST_F(ResultFiles, SummaryKeys) {
    const auto summary = run("paper", small);
    using Json = nlohmann::ordered_json;
    const auto keys = [](const Json& table) {
        std::set<std::string> result;
        for (const auto& [key, value] : table.items()) {
            result.insert(key);
        }
        return result;
    };
    const auto expect_keys = [&](const std::string& place, const std::set<std::string>& expected) {
        auto found = keys(summary.at(Json::json_pointer(place)));
        EXPECT_TRUE(std::ranges::includes(found, expected)) << place;
        return found;
    };
    expect_keys("", {"status", "version", "scene", "physics", "mesh", "solver", "final", "newton", "audit",
                     "seconds", "peak_memory_mib"});
    expect_keys("/mesh", {"cells", "vertices", "unknowns"});
    EXPECT_EQ(expect_keys("/mesh/unknowns", {}), (std::set<std::string>{"displacement", "temperature"}));
    expect_keys("/solver", {"strategy", "why", "processes"});
    EXPECT_EQ(expect_keys("/final", {}),
              (std::set<std::string>{"time", "velocity_l2", "displacement_strain_l2", "temperature_l2",
                                     "contact"}));
    EXPECT_EQ(expect_keys("/final/contact/bottom", {}),
              (std::set<std::string>{"normal_force", "tangential_force", "max_penetration",
                                     "contact_fraction", "slip_fraction", "heat_flow"}));
    EXPECT_EQ(expect_keys("/newton", {}),
              (std::set<std::string>{"iterations", "max_iterations_in_a_step", "retries"}));
    EXPECT_EQ(expect_keys("/audit", {}), (std::set<std::string>{"energy", "heat", "force"}));
    expect_keys("/seconds", {"setup", "factor", "steps", "output", "total"});

    EXPECT_EQ(summary["status"], "completed");
    EXPECT_FALSE(summary.contains("reason"));
    EXPECT_EQ(summary["mesh"]["cells"], 32);
    EXPECT_EQ(summary["mesh"]["vertices"], 25);
    EXPECT_EQ(summary["mesh"]["unknowns"]["displacement"], 50);
    EXPECT_EQ(summary["mesh"]["unknowns"]["temperature"], 25);
    EXPECT_EQ(summary["solver"]["strategy"], "condensed");
    EXPECT_EQ(summary["solver"]["processes"], 1);
    EXPECT_EQ(summary["scene"]["mesh"]["cells"], (std::vector<int>{4, 4}));
    EXPECT_EQ(summary["physics"],
              (std::vector<std::string>{"inertia", "elasticity", "viscosity", "thermal_stress", "body_force",
                                        "traction", "compliance", "friction", "heat_capacity", "conduction",
                                        "strain_heating", "heat_source", "conductance"}));
    EXPECT_EQ(summary["final"]["time"], 1.0);
    EXPECT_GT(summary["peak_memory_mib"], 1.0);
    // numbers read back as they were
    for (const auto& [name, number] : simulation->norms()) {
        EXPECT_EQ(summary["final"][name].get<double>(), number);
    }
    EXPECT_EQ(summary["final"]["contact"]["bottom"]["normal_force"].get<double>(),
              simulation->contact_measures().at("bottom").normal_force);
    const double tangential = simulation->contact_measures().at("bottom").tangential_force;
    EXPECT_GT(tangential, 0.0);
    EXPECT_EQ(summary["final"]["contact"]["bottom"]["tangential_force"].get<double>(), tangential);
    const march::Totals& totals = simulation->totals();
    ASSERT_NE(totals.iterations, totals.retries);
    EXPECT_EQ(summary["newton"]["iterations"], totals.iterations);
    EXPECT_EQ(summary["newton"]["retries"], totals.retries);
    ASSERT_NE(totals.heat_residual, totals.force_residual);
    EXPECT_EQ(summary["audit"]["energy"].get<double>(), totals.energy_residual);
    EXPECT_EQ(summary["audit"]["heat"].get<double>(), totals.heat_residual);
    EXPECT_EQ(summary["audit"]["force"].get<double>(), totals.force_residual);
}

TEST_F(ResultFiles, SummaryWithoutContactAndWithoutMechanics) {
    const auto none = run("no-contact", small);
    EXPECT_EQ(none["final"]["contact"], nlohmann::ordered_json::object());
    EXPECT_EQ(none["newton"]["iterations"], 0);
    const auto heat = run("heat-only", {"mesh.cells=[4,4]", "time.steps=2"});
    EXPECT_EQ(heat["mesh"]["unknowns"]["displacement"], 0);
    EXPECT_EQ(heat["final"]["velocity_l2"], 0.0);
    EXPECT_EQ(heat["final"]["contact"]["bottom"]["normal_force"], 0.0);
    const std::string body = content(folder / "fields/body_000002.vtu"),
                      contact = content(folder / "fields/contact_000002.vtu");
    for (const char* absent : {"displacement", "velocity", "stress", "von_mises"}) {
        EXPECT_EQ(body.find(absent), std::string::npos) << absent;
    }
    for (const char* absent : {"slip_velocity", "pressure", "traction"}) {
        EXPECT_EQ(contact.find(absent), std::string::npos) << absent;
    }
}

TEST(ThreeComponents, PadsWithZeros) {
    EXPECT_EQ(three_components({1, 2, 3, 4}, 2), (std::vector<double>{1, 2, 0, 3, 4, 0}));
    EXPECT_EQ(three_components({1, 2, 3}, 3), (std::vector<double>{1, 2, 3}));
    EXPECT_TRUE(three_components({}, 2).empty());
}

}  // namespace
}  // namespace thermocontact::output
