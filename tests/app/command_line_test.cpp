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

TEST(CommandLine, View) {
    const auto view = as<ViewCommand>({"view", "results"});
    EXPECT_EQ(view.results, "results");
    EXPECT_EQ(view.page, "results/view.html");
    EXPECT_TRUE(view.opens);
    const auto kept = as<ViewCommand>({"view", "results", "--output=a.html", "--no-open"});
    EXPECT_EQ(kept.page, "a.html");
    EXPECT_FALSE(kept.opens);
    EXPECT_EQ(message({"view"}), "view: no folder of results given; usage: thermocontact view DIR");
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
    EXPECT_EQ(message({}),
              "no command given; expected \"run\", \"plan\", \"check\", \"view\", \"schema\" or \"forms\", "
              "or --help");
    EXPECT_EQ(message({"rnu", "a.toml"}), "unknown command \"rnu\"; did you mean \"run\"?");
    EXPECT_EQ(message({"simulate"}),
              "unknown command \"simulate\"; expected \"run\", \"plan\", \"check\", \"view\", \"schema\" or "
              "\"forms\"");
    EXPECT_EQ(message({"--verison"}),
              "unknown option \"--verison\" before the command; did you mean \"--version\"?");
    EXPECT_EQ(message({"--quiet", "run", "a.toml"}),
              "unknown option \"--quiet\" before the command; the options of a command follow it");
}

TEST(CommandLine, MistakesInOptions) {
    EXPECT_EQ(message({"run", "a.toml", "--outptu", "d"}),
              "run: unknown option \"--outptu\"; did you mean \"--output\"?");
    EXPECT_EQ(message({"run", "a.toml", "--begin=c"}),
              "run: unknown option \"--begin\"; expected \"--help\", \"--set\", \"--output\", \"--restart\", "
              "\"--quiet\", \"--accuracy\", \"--budget\" or \"--of\"");
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

TEST(CommandLine, Plan) {
    const auto plan = as<PlanCommand>({"plan", "a.toml", "--accuracy", "1e-3", "--set", "time.end=2"});
    EXPECT_EQ(plan.scene, "a.toml");
    EXPECT_EQ(plan.overrides, (std::vector<std::string>{"time.end=2"}));
    EXPECT_EQ(plan.request.accuracy, 1e-3);
    EXPECT_FALSE(plan.request.budget);
    EXPECT_EQ(plan.request.of, plan::Quantity::norms);
    const auto timed = as<PlanCommand>({"plan", "a.toml", "--budget=5m", "--of", "contact_force"});
    EXPECT_FALSE(timed.request.accuracy);
    EXPECT_EQ(timed.request.budget, 300);
    EXPECT_EQ(timed.request.of, plan::Quantity::contact_force);
}

TEST(CommandLine, RunAsAskedFor) {
    EXPECT_FALSE(as<RunCommand>({"run", "a.toml"}).request);
    const auto run = as<RunCommand>({"run", "a.toml", "--accuracy", "0.1", "--budget", "30s"});
    ASSERT_TRUE(run.request);
    EXPECT_EQ(run.request->accuracy, 0.1);
    EXPECT_EQ(run.request->budget, 30);
}

TEST(CommandLine, MistakesInWhatIsAskedFor) {
    EXPECT_EQ(message({"plan", "a.toml"}),
              "plan: nothing asked for; expected --accuracy, as 1e-3, or --budget, as 30s");
    for (const char* bad : {"0", "-1e-3", "1", "2", "x", "1e-3x", "", "nan", "inf"}) {
        EXPECT_EQ(message({"plan", "a.toml", "--accuracy", bad}),
                  "plan: --accuracy: expected a number above 0 and below 1, as 1e-3, found \"" +
                      std::string(bad) + '"');
    }
    EXPECT_EQ(message({"run", "a.toml", "--budget", "30x"}),
              "run: --budget: expected a time above 0, as 30s, 5m or 2h, found \"30x\"");
    EXPECT_NE(message({"plan", "a.toml", "--accuracy", "1e-2", "--of", "peak_presure"})
                  .find("did you mean \"peak_pressure\"?"),
              std::string::npos);
    EXPECT_EQ(message({"run", "a.toml", "--of", "norms"}), "run: --of needs --accuracy or --budget");
    EXPECT_NE(message({"plan", "a.toml", "--acuracy", "1"}).find("did you mean \"--accuracy\"?"),
              std::string::npos);
    EXPECT_NE(message({"run", "a.toml", "--accuracy", "0.1", "--restart", "c"}).find("--restart"),
              std::string::npos);
}

TEST(CommandLine, MistakesInArguments) {
    EXPECT_EQ(message({"run"}), "run: no scene file given; usage: thermocontact run SCENE.toml");
    EXPECT_EQ(message({"check", ""}), "check: no scene file given; usage: thermocontact check SCENE.toml");
    EXPECT_EQ(message({"run", "a.toml", "b.toml"}), "run: unexpected argument \"b.toml\"");
    EXPECT_EQ(message({"run", "a.toml", "check"}), "run: unexpected argument \"check\"");
    EXPECT_EQ(message({"forms", "frction"}),
              "forms: expected \"elasticity\", \"viscosity\", \"source\", \"body_force\", \"compliance\", "
              "\"friction\" or \"conductance\", found \"frction\"; did you mean \"friction\"?");
    EXPECT_EQ(message({"schema", "json"}), "schema: unexpected argument \"json\"");
}

TEST(CommandLine, WordsBehindTheDashesArePetscs) {
    EXPECT_EQ(message({"run", "a.toml", "--", "-ksp_view"}), "");
    EXPECT_EQ(message({"--", "run"}), message({}));
}

/// "NAME VALUE" of each option of a command, with "..." where it may be repeated.
std::vector<std::string> described(const CommandHelp& command) {
    std::vector<std::string> result;
    for (const OptionHelp& option : command.options) {
        result.push_back(option.name + (option.value.empty() ? "" : " " + option.value) +
                         (option.repeatable ? "..." : ""));
    }
    return result;
}

TEST(CommandLine, DescribesItself) {
    const std::vector<CommandHelp> commands = describe_commands();
    using Words = std::vector<std::string>;
    ASSERT_EQ(commands.size(), 7u);
    EXPECT_EQ(commands[0].name, "");
    EXPECT_EQ(described(commands[0]), (Words{"-h,--help", "--version"}));
    EXPECT_EQ(commands[1].name, "run");
    EXPECT_EQ(described(commands[1]),
              (Words{"-h,--help", "SCENE FILE", "--set KEY=VALUE...", "--output DIR", "--restart CHECKPOINT",
                     "--quiet", "--accuracy NUMBER", "--budget TIME", "--of QUANTITY"}));
    EXPECT_EQ(commands[1].options.back().choices.front(), "norms");
    EXPECT_EQ(commands[5].options.back().choices, (Words{"toml", "json", "markdown"}));
    for (const std::string& format : commands[5].options.back().choices) {
        EXPECT_EQ(as<SchemaCommand>({"schema", "--format", format.c_str()}).format, format);
    }
}

}  // namespace
}  // namespace thermocontact::app
