#include "output/summary.h"

#include <sys/resource.h>

#include "fem/kernel.h"
#include "model/physics.h"

namespace thermocontact::output {
namespace {

using Json = nlohmann::ordered_json;

double peak_memory_mib() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

Json final_state(march::Simulation& simulation) {
    Json result{{"time", simulation.state().time}};
    for (const auto& [name, value] : simulation.norms()) {
        result[name] = value;
    }
    result["contact"] = Json::object();
    for (const auto& [name, measures] : simulation.contact_measures()) {
        Json& values = result["contact"][name];
        for (const auto& [quantity, value] : contact_values(measures)) {
            values[quantity] = value;
        }
    }
    return result;
}

/// Of each balance that has one.
Json factors(march::Simulation& simulation) {
    Json result = Json::object();
    for (const march::Balance* balance : simulation.balances()) {
        if (balance->factor_size().entries > 0) {
            const solve::FactorUse use = balance->factor_use();
            result[balance->name()] = {{"numbers", use.single ? "single" : "double"},
                                       {"why", use.too_coarse ? "single was too coarse" : ""},
                                       {"corrections", use.corrections}};
        }
    }
    return result;
}

}  // namespace

march::Record contact_values(const model::ContactMeasures& measures) {
    return {{"normal_force", measures.normal_force},       {"tangential_force", measures.tangential_force},
            {"max_penetration", measures.max_penetration}, {"contact_fraction", measures.contact_fraction},
            {"slip_fraction", measures.slip_fraction},     {"heat_flow", measures.heat_flow}};
}

std::string version_text() {
    return std::string(THERMOCONTACT_VERSION) + " (" + fem::kernel_provenance() + ")";
}

Json summary(const scene::Scene& scene, march::Simulation& simulation, const std::string& status,
             const std::string& reason, const Seconds& seconds,
             const std::vector<BalanceCondition>& conditions) {
    const march::Totals& totals = simulation.totals();
    Json result{{"status", status}, {"version", version_text()}};
    if (!reason.empty()) {
        result["reason"] = reason;
    }
    result["scene"] = scene.resolved;
    result["physics"] = model::physics_of(scene);
    const parallel::Part& part = simulation.part();
    result["mesh"] = {{"cells", part.cells},
                      {"vertices", part.vertices},
                      {"unknowns",
                       {{"displacement", simulation.displacement_unknowns()},
                        {"temperature", simulation.temperature_unknowns()}}}};
    if (scene.mesh.refinement) {
        result["mesh"]["refinement"] = {{"looks", totals.looks},
                                        {"repeated_steps", totals.repeated_steps},
                                        {"coarser_meshes", totals.coarser_meshes},
                                        {"beyond_tolerance", totals.beyond_mesh_tolerance},
                                        {"largest_error", totals.error_in_space},
                                        {"last_error", totals.last_error_in_space},
                                        {"fewest_cells", totals.fewest_cells},
                                        {"most_cells", totals.most_cells}};
    }
    result["solver"] = {{"strategy", simulation.strategy().name()},
                        {"why", simulation.why_strategy()},
                        {"processes", simulation.team().size()},
                        {"factor_entries", simulation.factor_size().entries},
                        {"factor_bytes", simulation.factor_size().bytes},
                        {"contact_unknowns", simulation.contact_unknowns()}};
    result["solver"]["factors"] = factors(simulation);
    result["steps"] = simulation.state().step;
    if (simulation.first_step() > 0) {
        result["restarted_after_step"] = simulation.first_step();
    }
    result["final"] = final_state(simulation);
    result["newton"] = {{"iterations", totals.iterations},
                        {"max_iterations_in_a_step", totals.max_iterations_in_a_step},
                        {"retries", totals.retries}};
    result["recovery"] = {{"continuation_solves", totals.retries},
                          {"solves_at_round_off", totals.at_round_off},
                          {"largest_residual_of_these", totals.round_off_residual},
                          {"cycles", totals.cycles},
                          {"failed_attempts", totals.failed_attempts},
                          {"divided_steps", totals.divided_steps},
                          {"substeps_of_these", totals.parts},
                          {"smallest_step", totals.smallest_step}};
    if (scene.time.tolerance) {
        result["adaptive"] = {{"accepted", totals.accepted},
                              {"rejected", totals.rejected},
                              {"beyond_tolerance", totals.beyond_tolerance},
                              {"sum_of_estimates", totals.error_sum},
                              {"factorisations", simulation.factorisations()}};
    }
    result["audit"] = {
        {"energy", totals.energy_residual}, {"heat", totals.heat_residual}, {"force", totals.force_residual}};
    result["conditioning"] = to_json(conditions);
    if (const std::string text = warning(conditions, totals); !text.empty()) {
        result["warning"] = text;
    }
    const march::StepSeconds parts = simulation.step_seconds();
    result["seconds"] = {{"start", seconds.start},
                         {"setup", seconds.setup},
                         {"factor", seconds.factor},
                         {"steps", seconds.steps},
                         {"output", seconds.output},
                         {"total", seconds.total},
                         {"parts",
                          {{"triangular_solves", parts.triangular_solves},
                           {"newton", parts.newton},
                           {"audit", parts.audit},
                           {"other", seconds.steps - parts.triangular_solves - parts.newton - parts.audit}}}};
    result["peak_memory_mib"] = simulation.team().sum(peak_memory_mib());  // of all processes
    return result;
}

}  // namespace thermocontact::output
