#include "app/command_line.h"

#include <gtest/gtest.h>

#include "error.h"

namespace thermocontact::app {
namespace {

Command parse(std::vector<const char*> words) {
    words.insert(words.begin(), "thermocontact");
    return parse_command_line(static_cast<int>(words.size()), words.data());
}

template <class T>
T as(const std::vector<const char*>& words) {
    return std::get<T>(parse(words));
}

std::string message(const std::vector<const char*>& words) {
    try {
        parse(words);
        return {};
    } catch (const SceneError& error) {
        return error.what();
    }
}

TEST(CommandLine, Run) {
    const auto run = as<RunCommand>({"run", "scenes/paper.toml"});
    EXPECT_EQ(run.scene, "scenes/paper.toml");
    EXPECT_EQ(run.output, "paper-results");
    EXPECT_TRUE(run.overrides.empty());
    EXPECT_FALSE(run.quiet);
}

TEST(CommandLine, RunWithOptions) {
    const auto run =
        as<RunCommand>({"run", "--set", "mesh.cells=[32,32]", "a.toml", "--quiet", "--output", "out/x",
                        "--set=time.scheme=\"backward-euler\"", "--set", "title='a b'"});
    EXPECT_EQ(run.scene, "a.toml");
    EXPECT_EQ(run.output, "out/x");
    EXPECT_TRUE(run.quiet);
    EXPECT_EQ(run.overrides, (std::vector<std::string>{"mesh.cells=[32,32]", "time.scheme=\"backward-euler\"",
                                                       "title='a b'"}));
}

TEST(CommandLine, Check) {
    const auto check = as<CheckCommand>({"check", "a.toml", "--set", "time.steps=3"});
    EXPECT_EQ(check.scene, "a.toml");
    EXPECT_EQ(check.overrides, (std::vector<std::string>{"time.steps=3"}));
}

TEST(CommandLine, Schema) {
    EXPECT_EQ(as<SchemaCommand>({"schema"}).format, "toml");
    EXPECT_EQ(as<SchemaCommand>({"schema", "--format", "json"}).format, "json");
    EXPECT_EQ(as<SchemaCommand>({"schema", "--format=markdown"}).format, "markdown");
}

TEST(CommandLine, VersionAndHelp) {
    EXPECT_TRUE(std::holds_alternative<VersionCommand>(parse({"--version"})));
    const auto help = as<HelpCommand>({"--help"}).text;
    for (const char* name : {"run", "check", "schema", "--version"}) {
        EXPECT_NE(help.find(name), std::string::npos) << name;
    }
    const auto of_run = as<HelpCommand>({"run", "--help"}).text;
    for (const char* name : {"SCENE", "--output DIR", "--set KEY=VALUE", "--quiet"}) {
        EXPECT_NE(of_run.find(name), std::string::npos) << name;
    }
}

TEST(CommandLine, MistakesInTheCommand) {
    EXPECT_EQ(message({}), "no command given; expected \"run\", \"check\" or \"schema\", or --help");
    EXPECT_EQ(message({"rnu", "a.toml"}), "unknown command \"rnu\"; did you mean \"run\"?");
    EXPECT_EQ(message({"simulate"}),
              "unknown command \"simulate\"; expected \"run\", \"check\" or \"schema\"");
    EXPECT_EQ(message({"--verison"}),
              "unknown option \"--verison\" before the command; did you mean \"--version\"?");
    EXPECT_EQ(message({"--quiet", "run", "a.toml"}),
              "unknown option \"--quiet\" before the command; the options of a command follow it");
}

TEST(CommandLine, MistakesInOptions) {
    EXPECT_EQ(message({"run", "a.toml", "--outptu", "d"}),
              "run: unknown option \"--outptu\"; did you mean \"--output\"?");
    EXPECT_EQ(
        message({"run", "a.toml", "--begin=c"}),
        "run: unknown option \"--begin\"; expected \"--help\", \"--set\", \"--output\", \"--restart\" or "
        "\"--quiet\"");
    EXPECT_EQ(message({"run", "a.toml", "--restart", ""}),
              "run: --restart: expected a checkpoint file, found an empty name");
    EXPECT_EQ(message({"check", "a.toml", "--quiet"}),
              "check: unknown option \"--quiet\"; expected \"--help\" or \"--set\"");
    EXPECT_EQ(message({"schema", "--format", "tmol"}),
              "schema: --format: expected \"toml\", \"json\" or \"markdown\", found \"tmol\"; did you mean "
              "\"toml\"?");
    EXPECT_NE(message({"run", "a.toml", "--set"}).find("--set"), std::string::npos);
    EXPECT_NE(message({"run", "a.toml", "--output", "a", "--output", "b"}).find("--output"),
              std::string::npos);
    EXPECT_EQ(message({"run", "a.toml", "--output", ""}),
              "run: --output: expected a directory, found an empty name");
}

TEST(CommandLine, MistakesInArguments) {
    EXPECT_EQ(message({"run"}), "run: no scene file given; usage: thermocontact run SCENE.toml");
    EXPECT_EQ(message({"check", ""}), "check: no scene file given; usage: thermocontact check SCENE.toml");
    EXPECT_EQ(message({"run", "a.toml", "b.toml"}), "run: unexpected argument \"b.toml\"");
    EXPECT_EQ(message({"run", "a.toml", "check"}), "run: unexpected argument \"check\"");
    EXPECT_EQ(message({"schema", "json"}), "schema: unexpected argument \"json\"");
}

TEST(CommandLine, WordsBehindTheDashesArePetscs) {
    EXPECT_EQ(message({"run", "a.toml", "--", "-ksp_view"}), "");
    EXPECT_EQ(message({"--", "run"}), message({}));
}

}  // namespace
}  // namespace thermocontact::app
