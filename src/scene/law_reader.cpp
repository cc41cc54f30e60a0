#include "scene/law_reader.h"

#include <limits>

namespace thermocontact::scene {

Law read_law(const Settings& s, const std::string& kind, const std::string& at, const Law& general) {
    const OwnLaw* own = s.law(kind);
    const laws::Description description =
        own != nullptr ? own->description : laws::built_in_law(kind).description;
    Law law = general;
    law.file = own != nullptr ? own->file.path.string() : "";
    law.line = description.line;
    for (const laws::Parameter& parameter : description.parameters) {
        std::string key = at;
        key.append(".").append(kind).append(".").append(parameter.key);
        const std::string name = own != nullptr ? kind + "." + parameter.name : parameter.name;
        if (parameter.width) {
            law.width = name;
            law.width_key = parameter.key;
        }
        if (s.has(key)) {
            law.constants[name] = s.value(key).get<double>();
        } else {
            law.constants.emplace(name, std::numeric_limits<double>::infinity());
        }
    }
    return law;
}

}  // namespace thermocontact::scene
