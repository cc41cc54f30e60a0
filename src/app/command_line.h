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
    std::string format;  ///< "toml" | "json" | "markdown"
};

struct ViewCommand {
    std::filesystem::path results;  ///< folder of a run
    std::filesystem::path page;     ///< default: view.html in it
    bool opens = true;              ///< in the browser, where there is a screen
};

struct VersionCommand {};

struct HelpCommand {
    std::string text;
};

using Command = std::variant<RunCommand, PlanCommand, CheckCommand, ViewCommand, SchemaCommand,
                             VersionCommand, HelpCommand>;

/// An option or an argument as its help says.
struct OptionHelp {
    std::string name;                  ///< "--output"; "SCENE" of an argument
    std::string value;                 ///< what follows it: "DIR"; empty: nothing
    std::string help;                  ///< without a full stop
    std::vector<std::string> choices;  ///< of the value; empty: any
    bool repeatable;
};

struct CommandHelp {
    std::string name;  ///< empty: what stands before any command
    std::string help;
    std::vector<OptionHelp> options;
};

/// What parse_command_line() understands, for the manual and the shells; the program itself first.
std::vector<CommandHelp> describe_commands();

/// Throws SceneError with one line that says what is wrong and names the nearest command or option.
Command parse_command_line(int argc, const char* const* argv);

}  // namespace thermocontact::app
