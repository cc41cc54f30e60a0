#include "app/forms.h"

#include <iomanip>
#include <iostream>
#include <utility>

#include "app/exit_code.h"
#include "laws/description.h"
#include "scene/schema.h"

namespace thermocontact::app {
namespace {

void print(const laws::Description& law) {
    std::cout << law.kind << "\n  " << law.title << "\n  def " << law.function << "(";
    const char* separator = "";
    for (const std::string& argument : law.possible) {
        std::cout << std::exchange(separator, ", ") << argument;
    }
    std::cout << ")\n  [" << scene::table_of_law(law.kind) << "]\n";
    for (const laws::Parameter& parameter : law.parameters) {
        const std::string unit = parameter.unit.empty() ? "" : " (" + parameter.unit + ")";
        std::cout << "    " << std::left << std::setw(14) << parameter.key << parameter.meaning << unit
                  << "\n";
    }
}

}  // namespace

int forms(const FormsCommand& command) {
    if (!command.law.empty()) {
        std::cout << laws::built_in_law(command.law).text;
        return exit_completed;
    }
    std::cout << "Laws that a scene may replace by a file of its own, their formula, their function with all "
                 "that it "
                 "may take, and their keys.\n";
    for (const std::string& kind : scene::law_kinds()) {
        std::cout << "\n";
        print(laws::built_in_law(kind).description);
    }
    std::cout << "\nTo change one:\n"
                 "  thermocontact forms friction > my_friction.py\n"
                 "and in the scene\n"
                 "  [forms]\n"
                 "  friction = \"my_friction.py\"\n"
                 "Keys of a scene with such files: thermocontact schema --scene SCENE.toml\n";
    return exit_completed;
}

}  // namespace thermocontact::app
