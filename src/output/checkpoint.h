/// The file checkpoint.h5: all that a restart needs, and what it may be a restart of.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "march/snapshot.h"
#include "scene/scene.h"

namespace thermocontact::output {

inline constexpr const char* checkpoint_name = "checkpoint.h5";  ///< in the folder of the results

struct Checkpoint {
    std::string run;  ///< identifies a run and its restarts: they may continue each other's results
    march::Snapshot snapshot;
};

/// The bytes of the file.
std::string to_bytes(const Checkpoint& checkpoint, const scene::Scene& scene);

/// Reads what can be gone on with under `scene`. Throws SceneError, naming the file, where it cannot be read,
/// is a folder, is damaged, of another version, of another scene (which keys) or beyond the scene's last
/// step.
Checkpoint read_checkpoint(const std::filesystem::path& file, const scene::Scene& scene);

/// The run of a checkpoint file, if there is one that can be read, of whatever scene.
std::optional<std::string> run_of(const std::filesystem::path& file);

/// A name that no other run has.
std::string new_run();

}  // namespace thermocontact::output
