#include "plan/report.h"

#include <algorithm>

#include "plan/duration.h"

namespace thermocontact::plan {
namespace {

using Json = nlohmann::ordered_json;

std::string asked(const Request& request) {
    std::string result;
    if (request.accuracy) {
        result = "accuracy " + about(*request.accuracy);
    }
    if (request.budget) {
        result += (result.empty() ? "budget " : " within ") + duration_text(*request.budget);
    }
    return result;
}

std::string line(const std::string& name, const std::string& value) {
    return name + std::string(10 - name.size(), ' ') + value + "\n";
}

std::string stepping_text(const Discretisation& choice) {
    const std::string steps = std::to_string(choice.steps) + " steps";
    return choice.stepping.adaptive
               ? choice.stepping.scheme + " adaptive to " + about(choice.tolerance) + " in " + steps
               : choice.stepping.scheme + ", " + steps;
}

std::string offer(const Option& option) {
    return "error " + about(option.error) + " in " + duration_text(option.seconds) + ": " +
           about(option.unknowns) + " unknowns of " + kind_of_mesh(option.discretisation) + ", " +
           stepping_text(option.discretisation);
}

std::string errors(const Plan& plan, const Option& option) {
    std::string result;
    for (std::size_t c = 0; c < plan.components.size(); ++c) {
        result += (c == 0 ? "" : "; ") + plan.components[c] + " " + about(option.space[c]) + " in space, " +
                  about(option.time[c]) + " in time";
    }
    return result;
}

std::string orders(const Plan& plan, const Option& option) {
    std::string result;
    const std::vector<double>&space = space_of(plan.models, option.discretisation).error.orders(),
          &time = time_of(plan.models, option.discretisation).error.orders();
    for (std::size_t c = 0; c < plan.components.size(); ++c) {
        result += (c == 0 ? "" : "; ") + plan.components[c] + " " +
                  (plan.models.refinable ? about(space[c]) + " in h, " : "") + about(time[c]) + " in " +
                  (option.discretisation.stepping.adaptive ? "the tolerance" : "k");
    }
    return result;
}

std::string words(const std::vector<std::string>& settings) {
    std::string result;
    for (const std::string& setting : settings) {
        const bool needs_quotes = setting.find('"') != std::string::npos;
        result += " --set " + (needs_quotes ? "'" + setting + "'" : setting);
    }
    return result;
}

Json to_json(const Option& option) {
    return {{"error", option.error},
            {"seconds", option.seconds},
            {"unknowns", option.unknowns},
            {"degree", option.discretisation.degree},
            {"mesh", kind_of_mesh(option.discretisation)},
            {"scale", option.discretisation.scale},
            {"stepping", describe(option.discretisation.stepping)},
            {"steps", option.discretisation.steps},
            {"error_in_space", option.space},
            {"error_in_time", option.time}};
}

}  // namespace

std::string list(const std::vector<std::string>& words) {
    std::string result;
    for (const std::string& word : words) {
        result += (result.empty() ? "" : ", ") + word;
    }
    return result;
}

std::string largest_source(const std::vector<std::string>& components, const Option& option) {
    std::size_t worst = 0;
    for (std::size_t c = 1; c < components.size(); ++c) {
        if (option.space[c] + option.time[c] > option.space[worst] + option.time[worst]) {
            worst = c;
        }
    }
    return components[worst] + (option.space[worst] > option.time[worst] ? " in space" : " in time");
}

std::string text(const Plan& plan, const std::string& scene) {
    std::string result = line("asked", asked(plan.request) + ", of " + name(plan.request.of) + " (" +
                                           list(plan.components) + ") at T/8, T/4, ..., T");
    result += line("pilots", std::to_string(plan.pilots) + " in " + duration_text(plan.pilot_seconds));
    if (plan.chosen) {
        result += line("chosen", offer(*plan.chosen));
        result += line("errors", errors(plan, *plan.chosen));
        result += line("orders", orders(plan, *plan.chosen));
    } else {
        result += line("refused", plan.refusal);
    }
    if (plan.best) {
        result += line("best", offer(*plan.best));
        result += line("errors", errors(plan, *plan.best));
        result += line("orders", orders(plan, *plan.best));
    }
    if (plan.cheaper) {
        result += line("cheaper", offer(*plan.cheaper));
    }
    if (plan.better) {
        result += line("better", offer(*plan.better));
    }
    for (const std::string& remark : plan.remarks) {
        result += line("note", remark);
    }
    return plan.settings.empty() ? result
                                 : result + line("run", "thermocontact run " + scene + words(plan.settings));
}

std::string text(const Plan& plan, double seconds, const std::optional<Achieved>& achieved) {
    std::string error = "error predicted " + about(plan.chosen->error) + ", achieved ";
    if (achieved) {
        error += about(achieved->error) + " (estimated from a run of " +
                 (achieved->halved ? "half" : "twice") + " the cells and steps)";
        if (plan.request.accuracy && achieved->error > *plan.request.accuracy) {
            error += ", more than was asked for";
        }
    } else {
        error += "unknown: the pilot that tells was not completed";
    }
    const std::string time = line(
        "time", "predicted " + duration_text(plan.chosen->seconds) + ", achieved " + duration_text(seconds));
    const bool offers = achieved && achieved->instead;
    return line("achieved", error) + time +
           (offers ? line("instead", offer(*achieved->instead) + ":" + words(achieved->settings)) : "");
}

Json to_json(const Plan& plan, double seconds, const std::optional<Achieved>& achieved) {
    Json result{{"of", name(plan.request.of)}, {"components", plan.components}};
    if (plan.request.accuracy) {
        result["accuracy"] = *plan.request.accuracy;
    }
    if (plan.request.budget) {
        result["budget"] = *plan.request.budget;
    }
    if (plan.chosen) {
        result["predicted"] = to_json(*plan.chosen);
    }
    result["achieved"] = {{"seconds", seconds}};
    if (achieved) {
        result["achieved"]["error"] = achieved->error;
        result["achieved"]["errors"] = achieved->errors;
        if (achieved->instead) {
            const Option& instead = *achieved->instead;
            result["instead"] = {
                {"error", instead.error}, {"seconds", instead.seconds}, {"settings", achieved->settings}};
        }
    }
    result["settings"] = plan.settings;
    result["pilots"] = {{"runs", plan.pilots}, {"seconds", plan.pilot_seconds}};
    result["remarks"] = plan.remarks;
    return result;
}

}  // namespace thermocontact::plan
