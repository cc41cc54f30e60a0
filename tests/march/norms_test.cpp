#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "march/simulation.h"
#include "support/scenes.h"

namespace thermocontact::march {
namespace {

double value(const Record& record, const std::string& name) {
    const auto entry = std::ranges::find(record, name, &Record::value_type::first);
    return entry == record.end() ? std::nan("") : entry->second;
}

/// Norms are of the fields alone, in the history as in the summary, whatever density and capacity.
TEST(Norms, DoNotCountDensityAndCapacity) {
    const scene::Scene scene = scene::read(
        "mesh = {cells = [3, 2], upper = [2, 1]}\ntime = {end = 1, steps = 1}\n"
        "material = {density = 7, viscosity = {trace = 1, shear = 1}}\n"
        "initial = {velocity = [3, 4], temperature = 5}\nheat = {capacity = 3, conductivity = 1}\n");
    Simulation simulation(scene);
    simulation.advance();
    for (const Record& norms : {simulation.record(), simulation.norms()}) {
        EXPECT_NEAR(value(norms, "velocity_l2"), std::sqrt(2.0) * 5, 1e-12);  // |w| = 5, area 2
        EXPECT_NEAR(value(norms, "temperature_l2"), std::sqrt(2.0) * 5, 1e-12);
    }
}

}  // namespace
}  // namespace thermocontact::march
