#include "plan/study.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "march/kept_factors.h"
#include "solve/available_memory.h"

namespace thermocontact::plan {
namespace {

constexpr double share_of_pilot = 0.015;   ///< of the budget
constexpr double share_of_pilots = 0.35;   ///< of the budget, for all of them
constexpr double seconds_of_pilot = 0.5;   ///< where there is no budget
constexpr double share_of_run = 0.5;       ///< of the memory: pilots, other factors, and the run that
                                           ///< that tells what this one errs by have theirs
constexpr double bytes_an_unknown = 2100;  ///< of newton-krylov, the leaner strategy (solve/forecast.h)

}  // namespace

Study begin_study(Bench& bench, const Request& request, double goal) {
    const scene::Scene& scene = bench.scene();
    Study study{&bench, Comparison(scene, request.of), request, {}, {}, goal * request.accuracy.value_or(0)};
    study.models.sum = request.of == Quantity::norms ? Sum::squares : Sum::plain;
    study.models.writing = bench.writing();
    study.models.memory = (1 - march::share_left) * solve::available_memory();
    study.models.refinable = !scene.mesh.file;
    study.models.frames = scene.output.fields.empty() ? 0 : frames_of(scene);
    if (scene.mesh.file) {
        study.remarks.emplace_back(
            "the mesh is a file's and stays as it is: the error of space is not controlled");
    } else if (std::ranges::count(scene.mesh.cells, 1) > 0) {
        study.remarks.emplace_back("axes with one cell keep it: the error across is not controlled");
    }
    if (steepest(scene.mesh.grading) > 1 && scene.mesh.cell == "simplex") {
        study.remarks.emplace_back(
            "graded triangles and tetrahedra are not nested: differences are those of "
            "interpolated solutions");
    }
    return study;
}

double pilot_allowance(const Request& request) {
    return request.budget ? std::min(share_of_pilot * *request.budget, 20 * seconds_of_pilot)
                          : seconds_of_pilot;
}

double seconds_for_pilots(const Study& study) {
    return study.request.budget ? share_of_pilots * *study.request.budget - study.bench->seconds()
                                : std::numeric_limits<double>::infinity();
}

double price_of(const Study& study, std::vector<SpaceModel> spaces) {
    constexpr double any = 1e12;
    Models models = study.models;
    models.spaces = std::move(spaces);
    models.memory = std::numeric_limits<double>::infinity();
    const Request& request = study.request;
    const auto option = request.accuracy ? cheapest(models, aim_of_accuracy * *request.accuracy, {any, any})
                                         : most_accurate(models, {*request.budget, any});
    return !option            ? std::numeric_limits<double>::infinity()
           : request.accuracy ? option->seconds
                              : option->error;
}

double most_unknowns() {
    return share_of_run * solve::available_memory() / bytes_an_unknown;
}

}  // namespace thermocontact::plan
