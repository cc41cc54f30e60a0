/// The command line as plain data.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "plan/request.h"

namespace thermocontact::app {

struct RunCommand {
    std::filesystem::path scene;
    std::filesystem::path
        output;  ///< default: the scene file's stem with "-results", in the current directory
    std::vector<std::string> overrides;  ///< "KEY=VALUE", in the order given
    bool quiet = false;
    std::optional<std::filesystem::path> restart = {};  ///< a checkpoint to go on from
    std::optional<plan::Request> request = {};          ///< the discretisation is planned for it
};

struct PlanCommand {
    std::filesystem::path scene;
    std::vector<std::string> overrides;
    plan::Request request;
};

struct CheckCommand {
    std::filesystem::path scene;
    std::vector<std::string> overrides;
};

struct SchemaCommand {
    std::string format;                               ///< "toml" | "json" | "markdown"
    std::optional<std::filesystem::path> scene = {};  ///< whose law files' keys are among them
    std::vector<std::string> overrides = {};
};

struct FormsCommand {
    std::string law;  ///< whose file is printed; empty: a list of all
};

struct VersionCommand {};

struct HelpCommand {
    std::string text;
};

using Command = std::variant<RunCommand, PlanCommand, CheckCommand, SchemaCommand, FormsCommand,
                             VersionCommand, HelpCommand>;

/// Throws SceneError with one line that says what is wrong and names the nearest command or option.
Command parse_command_line(int argc, const char* const* argv);

}  // namespace thermocontact::app
