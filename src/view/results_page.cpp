#include "view/results_page.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <numeric>
#include <string_view>
#include <vector>

#include "error.h"
#include "view/page_parts.h"

namespace thermocontact::view {
namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (!stream) {
        throw SystemError(file.string() + ": cannot be read: " + std::strerror(errno));
    }
    return text;
}

/// Values of `attribute` in the elements that start with `opening`.
std::vector<std::string> attributes(std::string_view xml, std::string_view opening,
                                    std::string_view attribute) {
    const std::string start = std::string(attribute) + "=\"";
    std::vector<std::string> values;
    for (auto at = xml.find(opening); at != std::string_view::npos; at = xml.find(opening, at + 1)) {
        const auto end = xml.find('>', at), begin = xml.find(start, at);
        if (begin < end) {
            const auto first = begin + start.size();
            values.emplace_back(xml.substr(first, xml.find('"', first) - first));
        }
    }
    return values;
}

/// What one time has: the lines of fields.pvd, and all files behind them.
struct Output {
    std::string time;
    std::vector<std::string> lines, files;
    std::uintmax_t size = 0;  ///< bytes
};

/// A file named in fields.pvd with those that it names in turn, relative to `folder`.
std::vector<std::string> with_pieces(const fs::path& folder, const std::string& file) {
    std::vector<std::string> files{file};
    if (file.ends_with(".pvtu")) {
        const fs::path beside = fs::path(file).parent_path();
        for (const std::string& piece : attributes(content_of(folder / file), "<Piece", "Source")) {
            files.push_back((beside / piece).string());
        }
    }
    return files;
}

std::vector<Output> outputs_of(const fs::path& folder, std::string_view collection) {
    const auto times = attributes(collection, "<DataSet", "timestep");
    const auto names = attributes(collection, "<DataSet", "file");
    const auto parts = attributes(collection, "<DataSet", "part");
    std::vector<Output> outputs;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (outputs.empty() || outputs.back().time != times[i]) {
            outputs.push_back({times[i], {}, {}});
        }
        Output& output = outputs.back();
        output.lines.push_back("<DataSet timestep=\"" + times[i] + "\" part=\"" + parts[i] + "\" file=\"" +
                               names[i] + "\"/>\n");
        for (const std::string& file : with_pieces(folder, names[i])) {
            std::error_code failure;
            const auto size = fs::file_size(folder / file, failure);
            if (failure) {
                throw SystemError((folder / file).string() + ": cannot be read: " + failure.message());
            }
            output.files.push_back(file);
            output.size += size;
        }
    }
    return outputs;
}

/// Every n-th output and the last one, with the smallest n that keeps within `limit`.
std::vector<Output> within(const std::vector<Output>& all, std::uintmax_t limit) {
    for (std::size_t n = 1; n <= all.size(); ++n) {
        std::vector<Output> chosen;
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (i % n == 0 || i + 1 == all.size()) {
                chosen.push_back(all[i]);
            }
        }
        const auto size = std::accumulate(chosen.begin(), chosen.end(), std::uintmax_t{0},
                                          [](auto sum, const Output& output) { return sum + output.size; });
        if (size <= limit) {
            return chosen;
        }
    }
    throw SystemError(
        "view: the fields are too large for a page (" + std::to_string(all.back().size >> 20U) +
        " MiB at one time, " + std::to_string(limit >> 20U) +
        " MiB are taken); open fields.pvd with ParaView, or write fewer fields (output.fields)");
}

/// As the content of a <script>: no text of a scene ends it.
std::string embedded(const std::string& file, std::string text) {
    for (auto at = text.find("</"); at != std::string::npos && file.ends_with(".json");
         at = text.find("</", at)) {
        text.replace(at, 2, "<\\/");
    }
    return "<script type=\"text/plain\" data-file=\"" + file + "\">" + text + "</script>\n";
}

/// `text` in the place of the mark.
void fill(std::string& page, std::string_view mark, std::string_view text) {
    page.replace(page.find(mark), mark.size(), text);
}

std::string embedded_results(const fs::path& folder, const std::vector<Output>& outputs) {
    std::string collection = "<VTKFile type=\"Collection\"><Collection>\n";
    for (const Output& output : outputs) {
        for (const std::string& line : output.lines) {
            collection += line;
        }
    }
    std::string results = embedded("fields.pvd", collection + "</Collection></VTKFile>");
    for (const char* file : {"history.csv", "summary.json"}) {
        results += embedded(file, content_of(folder / file));
    }
    for (const Output& output : outputs) {
        for (const std::string& file : output.files) {
            results += embedded(file, content_of(folder / file));
        }
    }
    return results;
}

}  // namespace

ResultsPage results_page(const fs::path& folder, std::uintmax_t limit) {
    if (thermocontact_view_built == 0) {
        throw SystemError("view: this program was built without the page: npm or its packages were missing");
    }
    if (!fs::exists(folder / "fields.pvd") || !fs::exists(folder / "summary.json")) {
        throw SceneError("view: " + folder.string() +
                         ": expected a folder of results, with fields.pvd and summary.json, as `run` writes");
    }
    const std::vector<Output> all = outputs_of(folder, content_of(folder / "fields.pvd"));
    if (all.empty()) {
        throw SceneError("view: " + folder.string() + ": its fields.pvd names no output");
    }
    const std::vector<Output> chosen = within(all, limit);
    std::string page = thermocontact_view_page;
    // the last mark first: what is put in holds none that counts
    fill(page, "@PROGRAM@", thermocontact_view_program);
    fill(page, "@RESULTS@", embedded_results(folder, chosen));
    fill(page, "@STYLE@", thermocontact_view_style);
    return {std::move(page), chosen.size(), all.size()};
}

}  // namespace thermocontact::view
