"""The program: exit codes, the command line, what is left where it fails."""

from .mutation import Mutation

MUTATIONS = (
    Mutation(
        "exit-bad-input",
        "src/main.cpp",
        "fail(backend.get(), app::exit_bad_input, error.what());",
        "fail(backend.get(), app::exit_system_failed, error.what());",
        "index",
        "2: the scene or the command line is wrong",
    ),
    Mutation(
        "exit-numerics",
        "src/main.cpp",
        "fail(backend.get(), app::exit_numerics_failed, error.what());",
        "fail(backend.get(), app::exit_bad_input, error.what());",
        "index",
        "3: the numerics failed",
    ),
    Mutation(
        "exit-system",
        "src/main.cpp",
        "fail(backend.get(), app::exit_system_failed, error.what());",
        "fail(backend.get(), app::exit_completed, error.what());",
        "index",
        "1: the system failed",
    ),
    Mutation(
        "exit-signal",
        "src/app/exit_code.h",
        "return 128 + signal;",
        "return 127 + signal;",
        "index",
        "130 and 143: interrupted",
    ),
    Mutation(
        "failure-completed",
        "src/app/run.cpp",
        'finish("failed", error.what());',
        'finish("completed", error.what());',
        "state",
        "a run that failed says so in its summary",
    ),
    Mutation(
        "failure-swallowed",
        "src/app/run.cpp",
        'finish("failed", error.what());\n        throw;',
        'finish("failed", error.what());\n        return exit_completed;',
        "state",
        "a run that failed has exit code 3",
    ),
    Mutation(
        "failure-unwritten",
        "src/app/run.cpp",
        "output::write_setup_failure(command.output, scene, error.what());",
        "static_cast<void>(error);",
        "missing",
        "a scene that cannot be factored leaves a summary that says so",
    ),
    Mutation(
        "folder-late",
        "src/app/run.cpp",
        "    output::FolderClaim folder(command.output, parallel::team_of(backend));\n"
        "    const auto march = prepare(scene, command, earlier, backend);\n",
        "    const auto march = prepare(scene, command, earlier, backend);\n"
        "    output::FolderClaim folder(command.output, parallel::team_of(backend));\n",
        "index",
        "a folder that cannot be written to is met before the work",
    ),
    Mutation(
        "default-folder",
        "src/app/command_line.cpp",
        '.stem().string() + "-results";',
        '.stem().string() + "-result";',
        "index",
        "where results go by default",
    ),
    Mutation(
        "quiet",
        "src/output/progress.cpp",
        "    if (!quiet_) {\n        std::cerr << text",
        "    {\n        std::cerr << text",
        "missing",
        "--quiet prints errors only",
    ),
)
