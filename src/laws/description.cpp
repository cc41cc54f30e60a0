#include "laws/description.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "laws/law_table.h"

namespace thermocontact::laws {
namespace {

using nlohmann::json;

void take(const json& value, double& number) {
    if (!value.is_null()) {
        number = value.get<double>();
    }
}

Parameter parse_parameter(const json& facts) {
    Parameter parameter;
    parameter.name = facts.at("name");
    parameter.key = facts.at("key");
    parameter.unit = facts.at("unit");
    parameter.meaning = facts.at("meaning");
    take(facts.at("low"), parameter.low);
    take(facts.at("high"), parameter.high);
    parameter.low_open = facts.at("low_open");
    parameter.high_open = facts.at("high_open");
    parameter.infinite = facts.at("infinite");
    parameter.required = facts.at("required");
    if (!facts.at("default").is_null()) {
        parameter.fallback = facts.at("default").get<double>();
    }
    parameter.example = facts.at("example");
    parameter.width = facts.at("width");
    return parameter;
}

}  // namespace

bool Description::depends_on(const std::string& argument) const {
    return std::ranges::find(takes, argument) != takes.end();
}

Description parse_description(const std::string& text) {
    const json facts = json::parse(text);
    Description description{facts.at("kind"),     facts.at("title"),  facts.at("function"),
                            facts.at("possible"), facts.at("takes"),  {},
                            facts.at("line"),     facts.at("refused")};
    std::ranges::transform(facts.at("parameters"), std::back_inserter(description.parameters),
                           parse_parameter);
    return description;
}

std::vector<BuiltIn> built_in_laws() {
    std::vector<BuiltIn> laws;
    for (int i = 0; i < thermocontact_law_count; ++i) {
        const thermocontact_law& law = thermocontact_laws[i];
        laws.push_back({parse_description(law.description), law.text});
    }
    return laws;
}

BuiltIn built_in_law(const std::string& kind) {
    for (int i = 0; i < thermocontact_law_count; ++i) {
        if (const thermocontact_law& law = thermocontact_laws[i]; law.kind == kind) {
            return {parse_description(law.description), law.text};
        }
    }
    throw std::logic_error("no law " + kind);
}

std::string tools() {
    return thermocontact_law_tools;
}

}  // namespace thermocontact::laws
