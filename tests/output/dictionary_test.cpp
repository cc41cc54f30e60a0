#include "output/dictionary.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>

#include "march/adaptive_march.h"
#include "output/results.h"
#include "output/summary.h"
#include "support/scenes.h"

namespace thermocontact::output {
namespace {

constexpr std::array places{Place::history, Place::steps,   Place::body,
                            Place::contact, Place::summary, Place::summary_opened};

/// Scenes that between them have every physics, and adaptive steps.
const std::vector<std::pair<std::string, support::Overrides>>& scenes() {
    static const std::vector<std::pair<std::string, support::Overrides>> all = {
        {"paper", {"mesh.cells=[4,4]", "time.steps=2"}},
        {"paper-isotropic", {"mesh.cells=[4,4]", "time.steps=2", "time.tolerance=1e-2"}},
        {"anisotropic", {"mesh.cells=[4,4]", "time.end=0.05"}},
        {"heat-only", {"mesh.cells=[4,4]", "time.steps=1"}},
        {"box", {"mesh.cells=[2,2,2]", "time.steps=1"}},
        {"quasi-static", {"mesh.cells=[4,4]", "time.steps=1"}},
        {"paper-isotropic",
         {"mesh.cells=[2,2]", "time.steps=1", "mesh.refinement.tolerance=0.5", "mesh.refinement.every=1"}}};
    return all;
}

TEST(Dictionary, EveryDeclarationSaysWhatItMeansOnce) {
    for (const Place place : places) {
        std::set<std::string> names;
        for (const Quantity& quantity : quantities(place)) {
            EXPECT_TRUE(names.insert(quantity.name).second) << quantity.name;
            EXPECT_TRUE(quantity.meaning.ends_with(".")) << quantity.name;
        }
        EXPECT_FALSE(names.empty());
    }
}

TEST(Dictionary, WhatIsNotDeclaredIsRefusedByName) {
    EXPECT_EQ(declared(Place::history, "kinetic_energy").unit, "J");
    try {
        declared(Place::history, "enthalpy");
        FAIL();
    } catch (const std::logic_error& error) {
        EXPECT_NE(std::string(error.what()).find("\"enthalpy\""), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("dictionary_tables.cpp"), std::string::npos);
    }
}

TEST(Dictionary, SummariesAreWalkedToTheirLeaves) {
    EXPECT_EQ(
        undeclared(R"({"status": "completed", "scene": {"any": {"thing": 1}}, "final": {"contact": {}}})"),
        std::vector<std::string>{});
    EXPECT_EQ(undeclared(R"({"final": {"contact": {"left": {"heat_flow": 1, "wear": 2}}}, "plan": 1})"),
              (std::vector<std::string>{"final.contact.left.wear", "plan"}));
    EXPECT_EQ(undeclared(R"({"conditioning": {"heat": null, "momentum": {"digits": 12, "colour": "red"}}})"),
              std::vector<std::string>{"conditioning.momentum.colour"});
}

TEST(Dictionary, NothingIsWrittenThatIsNotDeclared) {
    const auto folder = std::filesystem::temp_directory_path() / "thermocontact-dictionary";
    for (const auto& [name, overrides] : scenes()) {
        const scene::Scene scene = support::repository_scene(name, overrides);
        march::AdaptiveMarch march(scene);
        {
            Results results({folder, march.simulation().team()}, scene, march.simulation());
            while (!march.simulation().finished()) {
                march.advance();
                results.follow(march.simulation(), march.mesh_number());
                EXPECT_NO_THROW(results.add_step()) << name;
            }
            results.finish("completed", "", {}, conditions(march.simulation()));
        }
        std::ostringstream text;
        text << std::ifstream(folder / "summary.json").rdbuf();
        EXPECT_EQ(undeclared(text.str()), std::vector<std::string>{}) << name;
        std::filesystem::remove_all(folder);
    }
}

/// The other way round: the reference promises no column that no scene writes.
TEST(Dictionary, EveryColumnOfTheHistoryIsWrittenBySomeScene) {
    std::set<std::string> written;
    for (const auto& [name, overrides] : scenes()) {
        const scene::Scene scene = support::repository_scene(name, overrides);
        march::AdaptiveMarch march(scene);
        march.advance();
        for (const auto& [column, value] : march.simulation().record()) {
            written.insert(column);
        }
    }
    for (const Quantity& column : quantities(Place::history)) {
        EXPECT_TRUE(written.contains(column.name)) << column.name;
    }
}

}  // namespace
}  // namespace thermocontact::output
