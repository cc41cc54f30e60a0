/// `--set`: each line of the input is one argument, over a scene that is right.
#include <sstream>
#include <vector>

#include "fuzz/input.h"
#include "scene/reader.h"

namespace {

constexpr const char* right = R"(
time = {end = 1.0, steps = 2}
mesh.cells = [2, 2]
material = {density = 1.0, elasticity = {young = 2.0, poisson = 0.1}}
boundary.top.displacement = [0.0, 0.0]
boundary.bottom.contact.compliance.stiffness = 10.0
)";

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace thermocontact;
    static const std::filesystem::path scene = fuzz::as_file(right, "override.toml");
    std::istringstream lines(fuzz::as_text(data, size));
    std::vector<std::string> arguments;
    for (std::string line; std::getline(lines, line);) {
        arguments.push_back(line);
    }
    fuzz::answers([&] { scene::read_scene(scene, arguments); });
    return 0;
}
