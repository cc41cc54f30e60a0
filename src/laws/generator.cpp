#include "laws/generator.h"

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "error.h"
#include "laws/process.h"

namespace thermocontact::laws {
namespace {

namespace fs = std::filesystem;

constexpr int law_is_wrong = 2;  // exit code of generate.py

std::string from_environment(const char* variable, const char* fallback) {
    const char* value = std::getenv(variable);  // NOLINT(concurrency-mt-unsafe): before any thread starts
    return value != nullptr && *value != '\0' ? value : fallback;
}

/// The one that had FFCx when this program was built, unless the user names another.
std::string python() {
    return from_environment("THERMOCONTACT_PYTHON", THERMOCONTACT_PYTHON);
}

/// Beside the installed program, else where it was built.
fs::path forms() {
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    const fs::path installed = program.parent_path().parent_path() / "share/thermocontact/forms";
    return fs::exists(installed / "generate.py", error) ? installed : fs::path(THERMOCONTACT_FORMS);
}

std::string last_line(const fs::path& file) {
    std::ifstream stream(file);
    std::string line, last;
    while (std::getline(stream, line)) {
        last = line.empty() ? last : line;
    }
    return last;
}

/// `text` with the name of the copy that was worked on replaced by the user's own.
std::string in_terms_of(const LawFile& file, const fs::path& copy, std::string text) {
    for (std::size_t at = 0; (at = text.find(copy.string(), at)) != std::string::npos;) {
        text.replace(at, copy.string().size(), file.path.string());
        at += file.path.string().size();
    }
    return text;
}

struct Copies {
    std::vector<const LawFile*> files;
    std::vector<fs::path> paths;

    /// What was read is what is worked on, whatever becomes of the user's file meanwhile.
    void add(const LawFile& file, const fs::path& folder) {
        files.push_back(&file);
        paths.push_back(folder / file.kind / file.path.filename());
        fs::create_directories(paths.back().parent_path());
        std::ofstream(paths.back(), std::ios::binary) << file.text;
    }
    std::string in_terms_of_the_user(std::string text) const {
        for (std::size_t i = 0; i < files.size(); ++i) {
            text = in_terms_of(*files[i], paths[i], std::move(text));
        }
        return text;
    }
};

/// Runs generate.py with its output in the folder's "output".
void generate(std::vector<std::string> words, const std::vector<LawFile>& laws, const fs::path& folder) {
    Copies copies;
    for (const LawFile& law : laws) {
        copies.add(law, folder);
        words.push_back(law.kind + "=" + copies.paths.back().string());
    }
    const fs::path script = forms() / "generate.py";
    if (!fs::exists(script)) {
        throw SystemError("law files need " + script.string() + ", which is missing");
    }
    words.insert(words.begin(), {python(), "-B", script.string()});
    int code = 0;
    try {
        code = run_program(words, folder / "output", folder / "errors");
    } catch (const SystemError& error) {
        throw SystemError("law files need a Python with FFCx: " + std::string(error.what()) +
                          "; THERMOCONTACT_PYTHON names another");
    }
    if (code == 0) {
        return;
    }
    const std::string said = copies.in_terms_of_the_user(last_line(folder / "errors"));
    if (code == law_is_wrong) {
        throw SceneError(said);
    }
    throw SystemError("law files need a Python with FFCx and a C compiler (" + python() +
                      " ended with exit code " + std::to_string(code) + ": " + said +
                      "); THERMOCONTACT_PYTHON and CC name others");
}

}  // namespace

std::string generator_identity() {
    return python() + " " + from_environment("CC", "cc");
}

fs::path make_description(const LawFile& file, const fs::path& folder) {
    generate({"describe", file.kind}, {file}, folder);
    return folder / "output";
}

fs::path make_library(const std::vector<LawFile>& files, const Target& target, const fs::path& folder) {
    generate({"laws", target.cell, std::to_string(target.degree), target.plane_strain ? "strain" : "stress",
              folder.string()},
             files, folder);
    return folder / "laws.so";
}

}  // namespace thermocontact::laws
