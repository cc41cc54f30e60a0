#include "output/same_scene.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

namespace thermocontact::output {
namespace {

using Json = nlohmann::ordered_json;
using Leaves = std::map<std::string, Json>;

constexpr double round_off = 1e-12;  ///< relative, of a step that was chosen twice

void collect(const Json& table, const std::string& prefix, Leaves& leaves) {
    for (const auto& [name, value] : table.items()) {
        if (value.is_object()) {
            collect(value, prefix + name + ".", leaves);
        } else {
            leaves.emplace(prefix + name, value);
        }
    }
}

Leaves leaves_of(const Json& scene) {
    Leaves leaves;
    collect(scene, "", leaves);
    return leaves;
}

bool may_differ(const std::string& key) {
    static const std::set<std::string> keys = {"title", "mesh.file", "time.end", "time.steps", "time.step"};
    return keys.contains(key) || key.starts_with("output.") || key.starts_with("solver.");
}

/// Empty where the steps are not uniform.
std::optional<double> step_of(const Leaves& leaves) {
    if (const auto step = leaves.find("time.step"); step != leaves.end()) {
        return step->second.get<double>();
    }
    const auto end = leaves.find("time.end"), steps = leaves.find("time.steps");
    return end != leaves.end() && steps != leaves.end()
               ? std::optional(end->second.get<double>() / steps->second.get<double>())
               : std::nullopt;
}

std::string said(const Leaves& leaves, const std::string& key) {
    const auto found = leaves.find(key);
    return found == leaves.end() ? "absent" : found->second.dump();
}

}  // namespace

std::vector<std::string> differences(const Json& here, const Json& there) {
    const Leaves mine = leaves_of(here), theirs = leaves_of(there);
    Leaves all = mine;
    all.insert(theirs.begin(), theirs.end());
    std::vector<std::string> found;
    for (const auto& [key, value] : all) {
        const std::string a = said(mine, key), b = said(theirs, key);
        if (a != b && !may_differ(key)) {
            found.push_back(key);
            found.back().append(" is ").append(a).append(" here and ").append(b).append(" there");
        }
    }
    const auto step = step_of(mine), other = step_of(theirs);
    if (step.has_value() != other.has_value() || (step && std::abs(*step - *other) > round_off * *other)) {
        const auto text = [](const std::optional<double>& k) { return k ? Json(*k).dump() : "not uniform"; };
        found.push_back("the time step is " + text(step) + " here and " + text(other) + " there");
    }
    return found;
}

}  // namespace thermocontact::output
