"""The library as other programs drive it."""

from .mutation import Mutation

MUTATIONS = (
    Mutation(
        "embed-beyond-the-end",
        "src/embed/scene_run.cpp",
        "if (closed || simulation.finished()) {",
        "if (closed) {",
        "missing",
        "no step beyond the last one of the scene",
    ),
    Mutation(
        "embed-failure-completed",
        "src/embed/scene_run.cpp",
        'close("failed", error.what());',
        'close("completed", error.what());',
        "state",
        "results of a run that failed say so",
    ),
    Mutation(
        "embed-fields-of-the-end",
        "src/embed/scene_run.cpp",
        "        results->add_fields();\n",
        "",
        "missing",
        "a run that is ended early leaves the fields of its last step",
    ),
    Mutation(
        "dictionary-any-entry",
        "src/output/dictionary.cpp",
        'return expected == "NAME" || expected == "BALANCE" || expected == found;',
        'return expected == "NAME" || expected == "BALANCE" || !found.empty();',
        "range",
        "an entry of the summary that is not declared is noticed",
    ),
    Mutation(
        "dictionary-column-missing",
        "src/output/dictionary_tables.cpp",
        '{"heat_storage_rate", "W",',
        '{"heat_storage", "W",',
        "missing",
        "a column of the history that is not declared ends the run",
    ),
    Mutation(
        "command-line-repeated",
        "src/app/command_line.cpp",
        "CLI::MultiOptionPolicy::TakeAll}",
        "CLI::MultiOptionPolicy::Throw}",
        "index",
        "--set may be repeated, says the manual",
    ),
)
