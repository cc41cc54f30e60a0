#include "output/earlier_results.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>

#include "output/checkpoint.h"
#include "output/files.h"

namespace thermocontact::output {
namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path& path) {
    std::ostringstream content;
    content << std::ifstream(path, std::ios::binary).rdbuf();
    return std::move(content).str();
}

/// The number that `text` starts with.
template <typename Number>
std::optional<Number> number_in(std::string_view text) {
    Number number{};
    const auto result = std::from_chars(text.data(), text.data() + text.size(), number);
    return result.ec == std::errc{} ? std::optional(number) : std::nullopt;
}

/// 7 of "body_000007.vtu", "contact_000007_p3.vtu", "body_000007.pvtu.part".
std::optional<int> step_of(const std::string& file) {
    const std::size_t line = file.find('_');
    return line == std::string::npos ? std::nullopt : number_in<int>(std::string_view(file).substr(line + 1));
}

/// VALUE in ` name="VALUE"`.
std::string_view attribute(std::string_view tag, const std::string& name) {
    const std::string start = " " + name + "=\"";
    const std::size_t at = tag.find(start);
    if (at == std::string_view::npos) {
        return {};
    }
    const std::string_view rest = tag.substr(at + start.size());
    return rest.substr(0, rest.find('"'));
}

bool is_field_file(const fs::path& path) {
    const fs::path name = path.extension() == ".part" ? path.stem() : path;
    return name.extension() == ".vtu" || name.extension() == ".pvtu";
}

/// Removes the files of fields whose name `goes` selects.
template <typename Goes>
void remove_fields(const fs::path& folder, Goes goes) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder / "fields", ignored)) {
        if (is_field_file(entry.path()) && goes(entry.path().filename().string())) {
            fs::remove(entry.path(), ignored);
        }
    }
}

}  // namespace

void clear_results(const fs::path& folder) {
    std::error_code ignored;
    for (const std::string file :
         {checkpoint_name, "summary.json", "history.csv", "steps.csv", "fields.pvd"}) {
        fs::remove(folder / file, ignored);
        fs::remove(folder / (file + ".part"), ignored);
    }
    remove_fields(folder, [](const std::string&) { return true; });
}

bool keep_rows(const fs::path& file, int step) {
    std::istringstream lines(content_of(file));
    std::string kept, line;
    std::ptrdiff_t commas = -1;                          // of the header
    while (std::getline(lines, line) && !lines.eof()) {  // at the end of the file: without end of line
        const std::ptrdiff_t here = std::ranges::count(line, ',');
        if (commas < 0) {
            if (!line.starts_with("step,")) {
                break;
            }
            commas = here;
        } else if (here != commas || number_in<int>(line).value_or(step + 1) > step) {
            continue;
        }
        kept += line + '\n';
    }
    write_whole(file, kept);
    return !kept.empty();
}

std::vector<PvdEntry> keep_fields(const fs::path& folder, int step, bool with_last) {
    const auto stays = [&](const std::string& file) {
        const auto number = step_of(file);
        return number && (*number < step || (*number == step && with_last)) && !file.ends_with(".part");
    };
    std::vector<PvdEntry> entries;
    std::istringstream lines(content_of(folder / "fields.pvd"));
    for (std::string line; std::getline(lines, line);) {
        const auto time = number_in<double>(attribute(line, "timestep"));
        const auto part = number_in<int>(attribute(line, "part"));
        const std::string file(attribute(line, "file"));
        if (time && part && stays(fs::path(file).filename()) && fs::exists(folder / file)) {
            entries.push_back({*time, *part, file});
        }
    }
    remove_fields(folder, [&](const std::string& file) { return !stays(file); });
    return entries;
}

}  // namespace thermocontact::output
