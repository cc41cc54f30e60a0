/// What results hold, declared once: the name, unit and meaning of every column, field and entry of the
/// summary. What writes them asks here, so that nothing is written that is not declared; the reference of
/// results is made from it.
#pragma once

#include <string>
#include <vector>

namespace thermocontact::output {

struct Quantity {
    std::string name;
    std::string unit;     ///< "" of counts, shares and texts
    std::string meaning;  ///< also when it is there, unless always
    int components = 1;   ///< of fields
};

enum class Place {
    history,         ///< columns of history.csv
    steps,           ///< columns of steps.csv
    body,            ///< fields of the body
    contact,         ///< fields of the contact surfaces
    summary,         ///< dotted names in summary.json: NAME stands for a boundary's, BALANCE for a balance's
    summary_opened,  ///< objects in summary.json whose entries are somebody else's: the scene's keys
};

/// In the order of the reference.
const std::vector<Quantity>& quantities(Place place);

/// The declaration of `name`, without placeholders. Throws std::logic_error, which says where to declare it.
const Quantity& declared(Place place, const std::string& name);

/// Names in `json` of entries (its leaves; lists and null are such) that neither summary nor summary_opened
/// declares: a summary has none.
std::vector<std::string> undeclared(const std::string& json);

}  // namespace thermocontact::output
