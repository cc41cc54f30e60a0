#include "march/momentum_audit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/dense.h"

namespace thermocontact::march {
namespace {

using support::vector;

struct Forces {
    Eigen::VectorXd inertia, viscous, elastic, thermal, compliance, friction, load, reaction, spring;
};

/// One node with two components, numbers chosen to balance.
Forces balanced() {
    Forces forces;
    forces.inertia = vector({1, -2});
    forces.viscous = vector({0.5, 0.25});
    forces.elastic = vector({2, 3});
    forces.thermal = vector({0.25, -1});
    forces.compliance = vector({0, 4});
    forces.friction = vector({0.75, 0});
    forces.load = vector({3, 1});
    forces.spring = vector({-1, 0.5});
    forces.reaction = forces.inertia + forces.viscous + forces.elastic - forces.thermal + forces.compliance +
                      forces.friction + forces.spring - forces.load;
    return forces;
}

constexpr double step = 0.5;
const Eigen::VectorXd velocity = vector({2, -1});

MomentumSums sums_of(const Forces& forces, const Eigen::VectorXd& w = velocity) {
    const auto of = [&](const Eigen::VectorXd& force) {
        return sum_up(force.data(), w.data(), 2, {0, static_cast<std::int32_t>(w.size()) / 2});
    };
    return {of(forces.inertia),  of(forces.viscous), of(forces.thermal),  of(forces.compliance),
            of(forces.friction), of(forces.load),    of(forces.reaction), of(forces.spring)};
}

/// Energies whose change is the work of inertia and elasticity over the step.
Energies energies_of(const Forces& forces) {
    Energies energies;
    energies.kinetic_old = 3;
    energies.strain_old = 2;
    energies.kinetic_numerical = 0.125;
    energies.strain_numerical = 0.25;
    energies.kinetic = 3 - 0.125 + step * velocity.dot(forces.inertia);
    energies.strain = 2 - 0.25 + step * velocity.dot(forces.elastic);
    energies.spring_old = 1;
    energies.spring_numerical = 0.375;
    energies.anchors = -0.5;
    energies.spring = 1 - 0.375 - 0.5 + step * velocity.dot(forces.spring);
    return energies;
}

TEST(EnergyAudit, VanishesWhereTheForcesBalance) {
    const Forces forces = balanced();
    EXPECT_LE(audit_energy(energies_of(forces), sums_of(forces), step).residual(), 1e-15);
}

TEST(EnergyAudit, SeesEveryTerm) {
    const Forces forces = balanced();
    const Energies energies = energies_of(forces);
    for (double Energies::*term :
         {&Energies::kinetic_old, &Energies::kinetic, &Energies::kinetic_numerical, &Energies::strain_old,
          &Energies::strain, &Energies::strain_numerical, &Energies::spring_old, &Energies::spring,
          &Energies::spring_numerical, &Energies::anchors}) {
        Energies wrong = energies;
        wrong.*term += 0.01;
        EXPECT_GT(audit_energy(wrong, sums_of(forces), step).residual(), 1e-4);
    }
    for (Eigen::VectorXd Forces::*term : {&Forces::viscous, &Forces::thermal, &Forces::compliance,
                                          &Forces::friction, &Forces::load, &Forces::reaction}) {
        Forces wrong = forces;
        (wrong.*term)[0] += 0.01;
        EXPECT_GT(audit_energy(energies, sums_of(wrong), step).residual(), 1e-4);
    }
}

/// Of as many nodes as there are not side by side, and of some of them.
TEST(ForceSums, AreThoseOfOneNodeAfterTheOther) {
    for (const int components : {2, 3}) {
        const std::int32_t nodes = 11;
        const auto count = static_cast<std::size_t>(nodes * components);
        const std::vector<double> force = support::random_numbers(count, 1),
                                  w = support::random_numbers(count, 2);
        const auto sums_over = [&](const std::vector<std::int32_t>& some) {
            ForceSums sums;
            for (const std::int32_t node : some) {
                for (int c = 0; c < components; ++c) {
                    const auto i = static_cast<std::size_t>(node * components + c);
                    sums.power += force[i] * w[i];
                    sums.magnitude += std::abs(force[i]);
                    sums.resultant[static_cast<std::size_t>(c)] += force[i];
                }
            }
            return sums;
        };
        // of as many numbers of size 1, in another order
        const double rounding = static_cast<double>(count * count) * std::numeric_limits<double>::epsilon();
        const auto expect_equal = [&](const ForceSums& found, const ForceSums& expected) {
            EXPECT_NEAR(found.power, expected.power, rounding);
            EXPECT_NEAR(found.magnitude, expected.magnitude, rounding);
            for (std::size_t c = 0; c < 3; ++c) {
                EXPECT_NEAR(found.resultant[c], expected.resultant[c], rounding);
            }
        };
        expect_equal(sum_up(force.data(), w.data(), components, fem::NodeRange{1, nodes}),
                     sums_over({1, 2, 3, 4, 5, 6, 7, 8, 9, 10}));
        const std::vector<std::int32_t> some{0, 4, 10};
        expect_equal(sum_up(force.data(), w.data(), components, some), sums_over(some));
    }
}

TEST(ForceAudit, SumsEachComponent) {
    const Eigen::VectorXd rest = vector({0, 0, 0, 0});
    Forces forces;
    for (Eigen::VectorXd Forces::*term : {&Forces::viscous, &Forces::elastic, &Forces::thermal}) {
        forces.*term = vector({1, 2, -1, -2});  // internal forces sum to zero
    }
    forces.inertia = vector({1, 2, 3, 4});
    forces.compliance = vector({0, 5, 0, 5});
    forces.friction = vector({-2, 0, -2, 0});
    forces.spring = vector({0, 1, 0.5, -3});
    forces.load = vector({4.5, 0, 0, 4});
    forces.reaction = vector({0, 0, -4, 10});
    const Audit audit = audit_forces(sums_of(forces, rest), 2);
    EXPECT_EQ(audit.residual(), 0.0);
    const Record expected{{"inertia_force_x", 4},  {"contact_force_x", -4},  {"spring_force_x", 0.5},
                          {"load_force_x", 4.5},   {"reaction_force_x", -4}, {"inertia_force_y", 6},
                          {"contact_force_y", 10}, {"spring_force_y", -2},   {"load_force_y", 4},
                          {"reaction_force_y", 10}};
    EXPECT_EQ(audit.terms, expected);
    // of nodal magnitudes 10 + 10 + 4 + 4.5 + 8.5 + 14.5, and what 12 of inner forces are worth
    forces.reaction[3] += 0.5;
    EXPECT_DOUBLE_EQ(audit_forces(sums_of(forces, rest), 2).residual(),
                     0.5 / (51.5 + worth_of_round_off(12)));
    for (Eigen::VectorXd Forces::*term :
         {&Forces::inertia, &Forces::viscous, &Forces::thermal, &Forces::compliance, &Forces::friction,
          &Forces::spring, &Forces::load, &Forces::reaction}) {
        forces.*term = rest;
    }
    EXPECT_EQ(audit_forces(sums_of(forces, rest), 2).residual(), 0.0) << "nothing happens";
}

/// Energy that comes in one part and goes in the next is no term of the row, but what its parts were solved
/// to.
TEST(EnergyAudit, IsRelativeToAllParts) {
    MomentumAudit audit;
    audit.add(0.5, {}, {}, 2.0);
    audit.add(0.25, {}, {}, 3.0);
    EXPECT_EQ(audit.energy_scale, 5.0);
    EXPECT_EQ(audit.duration, 0.75);
}

}  // namespace
}  // namespace thermocontact::march
