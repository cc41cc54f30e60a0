/// What a law says of itself: its constants, which are keys of the scene, and what it depends on.
#pragma once

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace thermocontact::laws {

/// A constant of a law (forms/law.py).
struct Parameter {
    std::string name;  ///< in the law file
    std::string key;   ///< below the law's table
    std::string unit, meaning;
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool low_open = false, high_open = false;
    bool infinite = false;           ///< inf is a value, and the default
    bool required = false;           ///< there is no default
    std::optional<double> fallback;  ///< finite default
    double example = 1;
    bool width = false;  ///< of a conductance, K: what continuation widens
};

struct Description {
    std::string kind;                   ///< "compliance"
    std::string title;                  ///< first line of the file's text: what the law says
    std::string function;               ///< that the file defines: "pressure"
    std::vector<std::string> possible;  ///< arguments that it may have
    std::vector<std::string> takes;     ///< arguments of its function: "r", "p_n"
    std::vector<Parameter> parameters;
    int line = 0;                                ///< of the function in the file
    std::map<std::string, std::string> refused;  ///< "plane stress" | "plane strain" | "space": bodies that
                                                 ///< it cannot be of, with "LINE: why"

    bool depends_on(const std::string& argument) const;
};

/// From the JSON that forms/describe.py writes.
Description parse_description(const std::string& json);

struct BuiltIn {
    Description description;
    std::string text;  ///< of the law file
};

/// The laws of forms/laws, in alphabetical order.
std::vector<BuiltIn> built_in_laws();

/// The one of that kind; throws std::logic_error where there is none.
BuiltIn built_in_law(const std::string& kind);

/// "FFCx 0.5.0, UFL 2022.2.0; forms 0123456789abcdef": what this program's kernels were made with and from.
std::string tools();

}  // namespace thermocontact::laws
