#include "app/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>

#include "error.h"
#include "plan/duration.h"
#include "scene/schema.h"
#include "scene/text.h"

namespace thermocontact::app {

namespace {

using scene::did_you_mean;
using scene::one_line;
using scene::one_of;

const std::vector<std::string> formats = {"toml", "json", "markdown"};

struct Words {
    std::string scene;
    std::string output;
    std::string restart;
    std::string accuracy, budget, of = "norms";
    std::vector<std::string> overrides;
    std::string format = "toml";
    std::string results, page, law;
    bool quiet = false;
    bool keeps_closed = false;
    bool version = false;
};

struct Parser {
    CLI::App app{"Dynamic contact with friction and heat in a thermo-viscoelastic body.", "thermocontact"};
    CLI::App* run = nullptr;
    CLI::App* plan = nullptr;
    CLI::App* check = nullptr;
    CLI::App* view = nullptr;
    CLI::App* schema = nullptr;
    CLI::App* forms = nullptr;
    Words words;

    Parser();
    void add_scene(CLI::App& command);
    void add_overrides(CLI::App& command);
    void add_request(CLI::App& command);
};

Parser::Parser() {
    app.allow_extras();
    app.require_subcommand(0, 1);
    app.set_help_flag("-h,--help", "Print this help");
    app.add_flag("--version", words.version, "Print the version");

    run = app.add_subcommand("run", "Run a scene and write its results");
    add_scene(*run);
    run->add_option("--output", words.output, "Directory of the results; default: SCENE's name with -results")
        ->type_name("DIR");
    run->add_option("--restart", words.restart, "Checkpoint of this scene to go on from")
        ->type_name("CHECKPOINT");
    run->add_flag("--quiet", words.quiet, "Print errors only");
    add_request(*run);

    plan = app.add_subcommand("plan", "Choose mesh, degree, scheme and steps for an accuracy or a time");
    add_scene(*plan);
    add_request(*plan);

    check = app.add_subcommand("check", "Validate a scene and print the physics found");
    add_scene(*check);

    view = app.add_subcommand("view", "Make a page of a run's results and open it in the browser");
    view->allow_extras();
    view->add_option("DIR", words.results, "Folder of the results")->type_name("DIR");
    view->add_option("--output", words.page, "File of the page; default: view.html in DIR")
        ->type_name("FILE");
    view->add_flag("--no-open", words.keeps_closed, "Only write the page");

    schema = app.add_subcommand("schema", "Print every scene key: type, unit, default, range, meaning");
    schema->allow_extras();
    schema->add_option("--scene", words.scene, "Scene whose law files' keys are among them")
        ->type_name("FILE");
    add_overrides(*schema);
    schema->add_option("--format", words.format, "toml (default), json or markdown")->type_name("FORMAT");

    forms = app.add_subcommand("forms", "List the laws that a scene may replace, or print the file of one");
    forms->allow_extras();
    forms->add_option("LAW", words.law, "Law whose file is printed, to start one's own from")
        ->type_name("LAW");
}

void Parser::add_scene(CLI::App& command) {
    command.allow_extras();
    command.add_option("SCENE", words.scene, "Scene file (TOML)")->type_name("FILE");
    add_overrides(command);
}

void Parser::add_overrides(CLI::App& command) {
    command.add_option("--set", words.overrides, "Value that beats the scene file; repeatable")
        ->type_name("KEY=VALUE")
        ->expected(1)
        ->take_all()
        ->allow_extra_args(false);
}

void Parser::add_request(CLI::App& command) {
    command.add_option("--accuracy", words.accuracy, "Relative error to keep to, between 0 and 1")
        ->type_name("NUMBER");
    command.add_option("--budget", words.budget, "Time to keep to, as 30s, 5m or 2h")->type_name("TIME");
    command.add_option("--of", words.of, "What is to be accurate: " + one_of(plan::quantity_names()))
        ->type_name("QUANTITY");
}

std::vector<std::string> option_names(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& name : option->get_lnames()) {
            names.push_back("--" + name);
        }
    }
    return names;
}

/// `word` without the value of "--option=value".
std::string bare_option(const std::string& word) {
    return word.substr(0, word.find('='));
}

std::vector<std::string> command_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
        names.push_back(command->get_name());
    }
    return names;
}

[[noreturn]] void fail_unknown_command(const CLI::App& app, const std::string& word) {
    const std::vector<std::string> names = command_names(app);
    if (word.starts_with("-")) {
        const std::string near = did_you_mean(bare_option(word), option_names(app));
        throw SceneError("unknown option \"" + one_line(bare_option(word)) + "\" before the command" +
                         (near.empty() ? "; the options of a command follow it" : near));
    }
    const std::string near = did_you_mean(word, names);
    throw SceneError("unknown command \"" + one_line(word) + '"' +
                     (near.empty() ? "; expected " + one_of(names) : near));
}

[[noreturn]] void fail_extra(const CLI::App& command, const std::string& word) {
    const std::string of = command.get_name() + ": ";
    if (!word.starts_with("-")) {
        throw SceneError(of + "unexpected argument \"" + one_line(word) + '"');
    }
    const std::string option = bare_option(word);
    const auto names = option_names(command);
    const std::string near = did_you_mean(option, names);
    throw SceneError(of + "unknown option \"" + one_line(option) + '"' +
                     (near.empty() ? "; expected " + one_of(names) : near));
}

std::string first_line(const std::string& text) {
    return one_line(text.substr(0, text.find('\n')), 200);
}

std::filesystem::path scene_of(const CLI::App& command, const Words& words) {
    if (words.scene.empty()) {
        throw SceneError(command.get_name() + ": no scene file given; usage: thermocontact " +
                         command.get_name() + " SCENE.toml");
    }
    return words.scene;
}

std::filesystem::path output_of(const CLI::App& run, const Words& words) {
    if (!words.output.empty()) {
        return words.output;
    }
    if (run.get_option("--output")->count() > 0) {
        throw SceneError("run: --output: expected a directory, found an empty name");
    }
    return std::filesystem::path(words.scene).stem().string() + "-results";
}

std::optional<std::filesystem::path> restart_of(const CLI::App& run, const Words& words) {
    if (words.restart.empty() && run.get_option("--restart")->count() > 0) {
        throw SceneError("run: --restart: expected a checkpoint file, found an empty name");
    }
    return words.restart.empty() ? std::nullopt : std::optional<std::filesystem::path>(words.restart);
}

double accuracy_of(const std::string& word, const std::string& of) {
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size() || !(value > 0 && value < 1)) {
        throw SceneError(of + ": --accuracy: expected a number above 0 and below 1, as 1e-3, found \"" +
                         one_line(word) + '"');
    }
    return value;
}

/// Nothing where nothing is asked for.
std::optional<plan::Request> request_of(const CLI::App& command, const Words& words) {
    const std::string& of = command.get_name();
    const auto given = [&](const char* option) { return command.get_option(option)->count() > 0; };
    plan::Request request{{}, {}, plan::quantity_of(words.of)};
    if (given("--accuracy")) {
        request.accuracy = accuracy_of(words.accuracy, of);
    }
    if (given("--budget")) {
        request.budget = plan::parse_duration(words.budget);
        if (!request.budget) {
            throw SceneError(of + ": --budget: expected a time above 0, as 30s, 5m or 2h, found \"" +
                             one_line(words.budget) + '"');
        }
    }
    if (request.accuracy || request.budget) {
        return request;
    }
    if (given("--of")) {
        throw SceneError(of + ": --of needs --accuracy or --budget");
    }
    return std::nullopt;
}

PlanCommand plan_command(const CLI::App& command, const Words& words) {
    const auto scene = scene_of(command, words);
    const std::optional<plan::Request> request = request_of(command, words);
    if (!request) {
        throw SceneError("plan: nothing asked for; expected --accuracy, as 1e-3, or --budget, as 30s");
    }
    return {scene, words.overrides, *request};
}

ViewCommand view_command(const Words& words) {
    if (words.results.empty()) {
        throw SceneError("view: no folder of results given; usage: thermocontact view DIR");
    }
    const std::filesystem::path results = words.results;
    return {results, words.page.empty() ? results / "view.html" : std::filesystem::path(words.page),
            !words.keeps_closed};
}

RunCommand run_command(const CLI::App& command, const Words& words) {
    const auto scene = scene_of(command, words);
    RunCommand run{scene,       output_of(command, words),  words.overrides,
                   words.quiet, restart_of(command, words), request_of(command, words)};
    if (run.request && run.restart) {
        throw SceneError(
            "run: --restart goes on with the discretisation of its checkpoint; leave out --accuracy "
            "and --budget");
    }
    return run;
}

FormsCommand forms_command(const CLI::App& command, const Words& words) {
    const std::vector<std::string> laws = scene::law_kinds();
    if (command.get_option("LAW")->count() > 0 &&
        std::find(laws.begin(), laws.end(), words.law) == laws.end()) {
        throw SceneError("forms: expected " + one_of(laws) + ", found \"" + one_line(words.law) + '"' +
                         did_you_mean(words.law, laws));
    }
    return {words.law};
}

Command command_of(const Parser& parser) {
    const Words& words = parser.words;
    const auto commands = parser.app.get_subcommands();
    if (const auto extras = parser.app.remaining(); !extras.empty()) {
        fail_unknown_command(parser.app, extras.front());
    }
    if (words.version) {
        return VersionCommand{};
    }
    if (commands.empty()) {
        throw SceneError("no command given; expected " + one_of(command_names(parser.app)) + ", or --help");
    }
    const CLI::App& command = *commands.front();
    if (const auto extras = parser.app.remaining(true); !extras.empty()) {
        fail_extra(command, extras.front());
    }
    if (&command == parser.run) {
        return run_command(command, words);
    }
    if (&command == parser.plan) {
        return plan_command(command, words);
    }
    if (&command == parser.check) {
        return CheckCommand{scene_of(command, words), words.overrides};
    }
    if (&command == parser.view) {
        return view_command(words);
    }
    if (&command == parser.forms) {
        return forms_command(command, words);
    }
    if (std::find(formats.begin(), formats.end(), words.format) == formats.end()) {
        throw SceneError("schema: --format: expected " + one_of(formats) + ", found \"" +
                         one_line(words.format) + '"' + did_you_mean(words.format, formats));
    }
    if (words.scene.empty()) {
        return SchemaCommand{words.format};
    }
    return SchemaCommand{words.format, words.scene, words.overrides};
}

/// Of an option or an argument, by what its help calls it.
std::vector<std::string> choices_of(const std::string& value) {
    if (value == "FORMAT") {
        return formats;
    }
    if (value == "LAW") {
        return scene::law_kinds();
    }
    return value == "QUANTITY" ? plan::quantity_names() : std::vector<std::string>{};
}

CommandHelp describe(const CLI::App& command) {
    CommandHelp result{
        command.get_parent() == nullptr ? "" : command.get_name(), command.get_description(), {}};
    for (const CLI::Option* option : command.get_options()) {
        const bool is_argument = option->get_positional();
        const std::string value = option->get_expected_max() > 0 ? option->get_type_name() : "";
        result.options.push_back({is_argument ? option->get_name(true) : option->get_name(false, true), value,
                                  option->get_description(), choices_of(value),
                                  option->get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll});
    }
    return result;
}

}  // namespace

std::vector<CommandHelp> describe_commands() {
    const Parser parser;
    std::vector<CommandHelp> result{describe(parser.app)};
    for (const CLI::App* command : parser.app.get_subcommands([](const CLI::App*) { return true; })) {
        result.push_back(describe(*command));
    }
    return result;
}

Command parse_command_line(int argc, const char* const* argv) {
    // what follows "--" is PETSc's
    argc = static_cast<int>(std::find(argv, argv + argc, std::string_view("--")) - argv);
    Parser parser;
    try {
        parser.app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        return HelpCommand{parser.app.help()};
    } catch (const CLI::ParseError& error) {
        throw SceneError(first_line(error.what()));
    }
    return command_of(parser);
}

}  // namespace thermocontact::app
