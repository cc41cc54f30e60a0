/// A scene that another program drives step by step: with error.h, the interface of the installed library. It
/// stands on the standard library alone, whatever the library itself was compiled with.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace thermocontact::embed {

/// Numbers by name, in the units of the scene.
using Values = std::map<std::string, double>;

/// On one process and, where the scene leaves it to the program, by the condensed strategy. It is not to be
/// used by two threads at once.
class SceneRun {
  public:
    /// Reads and validates the scene file, each of `overrides` being "KEY=VALUE" as behind `--set`, and
    /// prepares the first step. With `results` that folder receives what `thermocontact run` writes; those of
    /// an earlier run there are replaced. Throws SceneError where the scene is wrong, NumericsError where it
    /// has no unique solution, SystemError where the folder cannot be written to, the scene asks for
    /// strategy "newton-krylov" or is too large to be condensed, std::bad_alloc.
    explicit SceneRun(const std::filesystem::path& scene, const std::vector<std::string>& overrides = {},
                      const std::optional<std::filesystem::path>& results = {});
    ~SceneRun();
    SceneRun(SceneRun&&) noexcept;
    SceneRun& operator=(SceneRun&&) noexcept;

    /// One step of the scene. Throws NumericsError where it has no solution: the state is then the one
    /// before, and results have been closed with status "failed"; SystemError as above; std::logic_error once
    /// results are closed or the run is finished.
    void advance();

    /// Whether the last step of the scene is done.
    bool finished() const;

    /// Writes the last fields, a checkpoint to go on from and summary.json: status "completed" where the run
    /// is finished, else "interrupted" with `reason`. Nothing without results, or if they are closed already.
    /// Without it the folder has all completed steps and no summary, as after a kill.
    void close(const std::string& reason = "ended by the program that drives it");

    int step() const;
    double time() const;    ///< s
    int dimension() const;  ///< 2, 3

    /// The row that history.csv has of the current state: its columns and their meaning are in the reference
    /// of results.
    Values history();

    /// What summary.json has in final.contact of one boundary: normal_force, heat_flow, ... Throws
    /// std::out_of_range where the scene has no contact on it.
    Values contact(const std::string& boundary);

    /// Where the nodes are that the fields belong to, [nodes], m.
    const std::vector<std::array<double, 3>>& nodes() const;
    /// Values at the nodes, [nodes][components]; empty for absent physics. Valid until the next step.
    const std::vector<double>& displacement() const;  ///< m
    const std::vector<double>& velocity() const;      ///< m/s
    const std::vector<double>& temperature() const;   ///< K

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace thermocontact::embed
