/// The scene reader: any bytes as a scene file.
#include "fuzz/input.h"
#include "scene/reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace thermocontact;
    fuzz::answers([&] { scene::read_scene(fuzz::as_file(fuzz::as_text(data, size), "scene.toml")); });
    return 0;
}
