/// Scenes of the tests: texts written to files, and the messages they provoke.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "error.h"
#include "laws/description.h"
#include "scene/reader.h"

namespace thermocontact::scene {

/// A mesh beside each scene: the unit square with its sides named as a rectangle's, in the regions "left" and
/// "right".
inline const char* const part = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
6
1 1 "bottom"
1 2 "right"
1 3 "top"
1 4 "left"
2 1 "left"
2 2 "right"
$EndPhysicalNames
$Nodes
4
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
$EndNodes
$Elements
6
1 1 2 1 1 1 2
2 1 2 2 2 2 3
3 1 2 3 3 3 4
4 1 2 4 4 4 1
5 2 2 2 2 1 2 3
6 2 2 1 1 1 3 4
$EndElements
)";

/// A file of the running test's own, removed with it; beside it a mesh, and a copy of each built-in law.
class SceneFile {
  public:
    explicit SceneFile(const std::string& text) {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        std::string name = std::string(test->test_suite_name()) + "-" + test->name();
        for (char& c : name) {
            c = c == '/' ? '_' : c;
        }
        directory_ = std::filesystem::path(testing::TempDir()) /
                     ("thermocontact-" + std::to_string(getpid()) + "-" + name);
        std::filesystem::create_directories(directory_);
        std::ofstream(path(), std::ios::binary) << text;
        std::ofstream(directory_ / "part.msh", std::ios::binary) << part;
        for (const laws::BuiltIn& law : laws::built_in_laws()) {
            std::ofstream(directory_ / ("my_" + law.description.kind + ".py"), std::ios::binary) << law.text;
        }
    }
    ~SceneFile() { std::filesystem::remove_all(directory_); }
    SceneFile(const SceneFile&) = delete;
    SceneFile& operator=(const SceneFile&) = delete;

    std::filesystem::path path() const { return directory_ / "scene.toml"; }
    std::filesystem::path directory() const { return directory_; }

  private:
    std::filesystem::path directory_;
};

inline Scene read(const std::string& text, const std::vector<std::string>& overrides = {}) {
    return read_scene(SceneFile(text).path(), overrides);
}

/// The message of the SceneError, with the scene's directory left out; "" when the scene is accepted.
inline std::string message(const std::string& text, const std::vector<std::string>& overrides = {}) {
    const SceneFile file(text);
    try {
        read_scene(file.path(), overrides);
        return {};
    } catch (const SceneError& error) {
        std::string what = error.what();
        const std::string directory = file.directory().string() + "/";
        for (auto at = what.find(directory); at != std::string::npos; at = what.find(directory)) {
            what.erase(at, directory.size());
        }
        return what;
    }
}

/// A small scene with all physics; line numbers are part of the tests' expectations.
inline const std::string base = R"([mesh]
cells = [4, 4]
[time]
end = 1.0
steps = 4
[material]
density = 1.0
[material.elasticity]
young = 2.0
poisson = 0.1
[heat]
capacity = 1.0
conductivity = 1.0
[boundary.top]
displacement = [0, 0]
temperature = 0
[boundary.bottom.contact.compliance]
stiffness = 1e4
[boundary.bottom.contact.friction]
coefficient = 0.2
regularisation = 1e-3
[boundary.bottom.contact.conductance]
coefficient = 1
onset = 1e-5
foundation_temperature = 10
)";

/// `base` with its line `line` (from 1) replaced; `replacement` may hold several lines.
inline std::string with_line(int line, const std::string& replacement) {
    std::string text;
    std::size_t begin = 0;
    for (int i = 1; begin < base.size(); ++i) {
        const std::size_t end = base.find('\n', begin);
        text += (i == line ? replacement : base.substr(begin, end - begin)) + "\n";
        begin = end + 1;
    }
    return text;
}

}  // namespace thermocontact::scene
