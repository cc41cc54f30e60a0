/// Prints, as JSON, what the program declares of itself: commands, exit codes, scene keys, results. Manual,
/// completions and reference are made from it (reference.py).

#include <iostream>
#include <nlohmann/json.hpp>

#include "app/command_line.h"
#include "app/exit_code.h"
#include "output/dictionary.h"
#include "scene/schema.h"

namespace {

using namespace thermocontact;
using Json = nlohmann::ordered_json;

Json commands() {
    Json result = Json::array();
    for (const app::CommandHelp& command : app::describe_commands()) {
        Json options = Json::array();
        for (const app::OptionHelp& option : command.options) {
            options.push_back({{"name", option.name},
                               {"value", option.value},
                               {"help", option.help},
                               {"choices", option.choices},
                               {"repeatable", option.repeatable}});
        }
        result.push_back({{"name", command.name}, {"help", command.help}, {"options", options}});
    }
    return result;
}

Json exit_codes() {
    Json result = Json::array();
    for (const app::ExitCode& code : app::exit_codes) {
        result.push_back({{"code", code.code}, {"meaning", code.meaning}, {"left", code.left}});
    }
    return result;
}

Json results(output::Place place) {
    Json result = Json::array();
    for (const output::Quantity& quantity : output::quantities(place)) {
        result.push_back({{"name", quantity.name},
                          {"unit", quantity.unit},
                          {"meaning", quantity.meaning},
                          {"components", quantity.components}});
    }
    return result;
}

}  // namespace

int main() {
    const Json declarations{{"version", THERMOCONTACT_VERSION},
                            {"commands", commands()},
                            {"exit_codes", exit_codes()},
                            {"keys", Json::parse(scene::print_schema("json"))},
                            {"scene_keys_markdown", scene::print_schema("markdown")},
                            {"results",
                             {{"history", results(output::Place::history)},
                              {"steps", results(output::Place::steps)},
                              {"body", results(output::Place::body)},
                              {"contact", results(output::Place::contact)},
                              {"summary", results(output::Place::summary)},
                              {"summary_opened", results(output::Place::summary_opened)}}}};
    std::cout << declarations.dump(2) << "\n";
}
