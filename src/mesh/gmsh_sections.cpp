#include "mesh/gmsh_sections.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>
#include <system_error>

#include "error.h"

namespace thermocontact::mesh {
namespace {

/// Those that readers know. Binary data between them may hold any bytes, also a line break and a dollar.
constexpr std::array<std::string_view, 9> known{"MeshFormat", "PhysicalNames", "Entities",
                                                "Nodes",      "Elements",      "Periodic",
                                                "NodeData",   "GhostElements", "PartitionedEntities"};

std::string read_all(const std::filesystem::path& path) {
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) {
        throw SceneError(path.string() + ": no such file");
    }
    std::ifstream file(path, std::ios::binary);
    if (!file.is_open() || std::filesystem::is_directory(path, ignored)) {
        throw SceneError(path.string() + ": cannot be read");
    }
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// The name of the section that a line opens ("Nodes") or closes ("EndNodes"); "" for other lines.
std::string_view section_of(std::string_view line) {
    if (!line.starts_with('$')) {
        return {};
    }
    line.remove_prefix(1);
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) {
        line.remove_suffix(1);
    }
    const auto name = line.starts_with("End") ? line.substr(3) : line;
    return std::ranges::find(known, name) != known.end() ? line : std::string_view{};
}

[[noreturn]] void fail(const std::filesystem::path& path, int line, const std::string& message) {
    throw SceneError(path.string() + ":" + std::to_string(line) + ": " + message);
}

}  // namespace

std::vector<GmshSection> check_sections(const std::filesystem::path& path) {
    const std::string text = read_all(path);
    if (!text.starts_with("$MeshFormat")) {
        fail(path, 1, "expected a Gmsh mesh, which begins with $MeshFormat");
    }
    std::vector<GmshSection> sections;
    bool open = false;
    int line = 0;
    for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end + 1) {
        ++line;
        end = std::min(text.find('\n', begin), text.size());
        const std::string name(section_of(std::string_view(text).substr(begin, end - begin)));
        if (name.empty()) {
            continue;
        }
        const bool closes = name.starts_with("End");
        if (closes != open || (closes && name.substr(3) != sections.back().name)) {
            break;  // an end without its beginning, or a beginning before the end: as if the rest were
                    // missing
        }
        if (!closes) {
            sections.push_back({name, line});
        }
        open = !closes;
    }
    if (open) {
        fail(path, sections.back().line,
             "the section $" + sections.back().name + " that begins here has no $End" + sections.back().name +
                 "; the file is truncated or damaged");
    }
    for (const char* needed : {"Nodes", "Elements"}) {
        if (std::ranges::find(sections, needed, &GmshSection::name) == sections.end()) {
            throw SceneError(path.string() + ": has no section $" + needed +
                             "; the file is truncated, or was saved without a mesh");
        }
    }
    return sections;
}

}  // namespace thermocontact::mesh
