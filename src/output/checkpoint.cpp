#include "output/checkpoint.h"

#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iomanip>
#include <random>
#include <sstream>

#include "error.h"
#include "mesh/mesh.h"
#include "output/hdf5.h"
#include "output/same_scene.h"
#include "output/seal.h"
#include "output/summary.h"

namespace thermocontact::output {
namespace {

constexpr std::size_t most_named = 5;  ///< differences that a message tells

template <typename Number>
uLong add_to(uLong sum, const std::vector<Number>& values) {
    return crc32_z(sum, reinterpret_cast<const Bytef*>(values.data()), values.size() * sizeof(Number));
}

/// Of all that a mesh file says; 0 for shapes, which the scene's keys say all about.
std::int64_t mesh_digest(const scene::Scene& scene) {
    if (!scene.mesh.file) {
        return 0;
    }
    const mesh::Mesh& mesh = *scene.mesh.file;
    std::vector<char> names;
    for (const auto* list : {&mesh.boundary_names, &mesh.region_names}) {
        for (const std::string& name : *list) {
            names.insert(names.end(), name.c_str(), name.c_str() + name.size() + 1);
        }
    }
    uLong sum = add_to(add_to(0, mesh.points), mesh.cells);
    sum = add_to(add_to(add_to(sum, mesh.facets), mesh.cell_regions), names);
    return static_cast<std::int64_t>(sum);
}

std::string path_of_kept(const std::string& balance, std::size_t number) {
    return "/kept/" + balance + "/" + std::to_string(number);
}

void write_kept(Hdf5Writer& file, const std::string& at, const march::KeptSystem& kept) {
    file.write(at + "/tau", kept.tau);
    file.write(at + "/unknowns", kept.derivative.unknowns);
    file.write(at + "/entries", kept.derivative.entries);
    file.write(at + "/values", kept.derivative.values);
    file.write(at + "/first_iterations", std::int64_t{kept.derivative.age.first_iterations});
    file.write(at + "/more_iterations", std::int64_t{kept.derivative.age.more_iterations});
    file.write(at + "/in_doubles", std::int64_t{kept.derivative.in_doubles ? 1 : 0});
}

march::KeptSystem read_kept(const Hdf5Reader& file, const std::string& at) {
    march::KeptSystem kept{};
    solve::KeptDerivative& derivative = kept.derivative;
    file.read(at + "/tau", kept.tau);
    file.read(at + "/unknowns", derivative.unknowns);
    file.read(at + "/entries", derivative.entries);
    file.read(at + "/values", derivative.values);
    file.read(at + "/first_iterations", derivative.age.first_iterations);
    file.read(at + "/more_iterations", derivative.age.more_iterations);
    int in_doubles = 0;
    file.read(at + "/in_doubles", in_doubles);
    derivative.in_doubles = in_doubles != 0;
    const std::int64_t size = derivative.unknowns * derivative.unknowns;
    const auto outside = [&](std::int64_t entry) { return entry < 0 || entry >= size; };
    if (derivative.entries.size() != derivative.values.size() ||
        std::ranges::any_of(derivative.entries, outside)) {
        throw SceneError(at + " holds no matrix");
    }
    return kept;
}

/// Throws SceneError with the reason; the state is read only if the file may be gone on with.
Checkpoint take(const std::string& sealed, const scene::Scene& scene) {
    const Hdf5Reader file(unseal(sealed));
    std::string version, resolved;
    file.read("/version", version);
    if (version != version_text()) {
        throw SceneError("it was written by thermocontact " + version + ", this is " + version_text());
    }
    file.read("/scene", resolved);
    std::vector<std::string> found = differences(scene.resolved, nlohmann::ordered_json::parse(resolved));
    std::int64_t digest = 0;
    file.read("/mesh_digest", digest);
    if (digest != mesh_digest(scene)) {
        found.emplace_back("the mesh file has other vertices, cells or names");
    }
    std::string laws;
    file.read("/laws", laws);
    const auto there = nlohmann::json::parse(laws);
    for (const auto& [kind, law] : there.items()) {
        const auto own = scene.laws.find(kind);
        if (own != scene.laws.end() && own->second != law.get<std::string>()) {
            found.push_back("the file of forms." + kind + " says something else than it did");
        }
    }
    if (!found.empty()) {
        std::string text = "it is of another scene: ";
        for (std::size_t i = 0; i < std::min(found.size(), most_named); ++i) {
            text += (i == 0 ? "" : "; ") + found[i];
        }
        const std::size_t more = found.size() - std::min(found.size(), most_named);
        throw SceneError(text + (more > 0 ? "; and " + std::to_string(more) + " more" : ""));
    }
    Checkpoint checkpoint;
    file.read("/run", checkpoint.run);
    march::Snapshot& snapshot = checkpoint.snapshot;
    march::visit_members(snapshot.state,
                         [&](const std::string& name, auto& member) { file.read("/state/" + name, member); });
    march::visit_members(snapshot.totals, [&](const std::string& name, auto& member) {
        file.read("/totals/" + name, member);
    });
    if (scene.mesh.refinement) {
        file.read("/bisections", snapshot.bisections);
    }
    for (const char* name : {"momentum", "heat"}) {
        for (std::size_t i = 0; file.has(path_of_kept(name, i)); ++i) {
            snapshot.kept[name].push_back(read_kept(file, path_of_kept(name, i)));
        }
    }
    if (snapshot.state.step > scene.time.steps) {
        throw SceneError("it is at step " + std::to_string(snapshot.state.step) +
                         ", beyond the scene's last step " + std::to_string(scene.time.steps));
    }
    return checkpoint;
}

/// Of a folder, what may have been meant.
std::string found_folder(const std::filesystem::path& folder) {
    const std::filesystem::path inside = folder / checkpoint_name;
    std::error_code none;
    return "expected a checkpoint file, found a folder" +
           (std::filesystem::is_regular_file(inside, none)
                ? "; did you mean " + inside.string() + "?"
                : " without a " + std::string(checkpoint_name) + " in it");
}

std::string content_of(const std::filesystem::path& path) {
    if (std::error_code none; std::filesystem::is_directory(path, none)) {
        throw SceneError(found_folder(path));
    }
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    std::ostringstream content;
    content << file.rdbuf();
    if (!file || (content.view().empty() && errno != 0)) {
        throw SceneError(std::string("cannot read it: ") + std::strerror(errno != 0 ? errno : EIO));
    }
    return std::move(content).str();
}

}  // namespace

std::string to_bytes(const Checkpoint& checkpoint, const scene::Scene& scene) {
    Hdf5Writer file;
    file.write("/version", version_text());
    file.write("/scene", scene.resolved.dump(2));
    file.write("/mesh_digest", mesh_digest(scene));
    file.write("/laws", nlohmann::json(scene.laws).dump());
    file.write("/run", checkpoint.run);
    const auto group = [&](const std::string& at) {
        return [&file, at](const std::string& name, const auto& member) {
            if constexpr (std::is_same_v<decltype(member), const int&>) {
                file.write(at + name, std::int64_t{member});
            } else {
                file.write(at + name, member);
            }
        };
    };
    march::visit_members(checkpoint.snapshot.state, group("/state/"));
    march::visit_members(checkpoint.snapshot.totals, group("/totals/"));
    if (scene.mesh.refinement) {
        file.write("/bisections", checkpoint.snapshot.bisections);
    }
    for (const auto& [name, systems] : checkpoint.snapshot.kept) {
        for (std::size_t i = 0; i < systems.size(); ++i) {
            write_kept(file, path_of_kept(name, i), systems[i]);
        }
    }
    return seal(file.bytes());
}

Checkpoint read_checkpoint(const std::filesystem::path& file, const scene::Scene& scene) {
    const auto refuse = [&](const std::string& reason) {
        return SceneError("--restart " + file.string() + ": " + reason);
    };
    try {
        return take(content_of(file), scene);
    } catch (const SceneError& error) {
        throw refuse(error.what());
    } catch (const SystemError& error) {  // a format that is not as it says it is
        throw refuse(error.what());
    } catch (const nlohmann::json::exception& error) {
        throw refuse(error.what());
    }
}

std::optional<std::string> run_of(const std::filesystem::path& file) {
    try {
        const std::string sealed = content_of(file);
        std::string run;
        Hdf5Reader(unseal(sealed)).read("/run", run);
        return run;
    } catch (const std::runtime_error&) {
        return std::nullopt;
    }
}

std::string new_run() {
    std::random_device device;
    std::ostringstream text;
    for (int word = 0; word < 4; ++word) {
        text << std::hex << std::setw(8) << std::setfill('0') << device();
    }
    return std::move(text).str();
}

}  // namespace thermocontact::output
