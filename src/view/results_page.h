/// A results folder as one page that needs nothing else: the files themselves beside the program that shows
/// them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace thermocontact::view {

/// Text of fields that a page holds unless told otherwise, bytes; browsers take strings of half a gigabyte.
constexpr std::uintmax_t usual_limit = std::uintmax_t{200} << 20U;

struct ResultsPage {
    std::string html;
    std::size_t shown, written;  ///< outputs in the page, and in the folder: more where they exceed the limit
};

/// The page of the results in `folder`: fields.pvd and the files that it names, history.csv, summary.json. Of
/// outputs that take more than `limit` bytes together every 2nd, 3rd, ... is left, and the last one. Throws
/// SceneError if the folder holds no results with fields, SystemError if a file cannot be read, if one output
/// exceeds the limit, or if the program was built without the page.
ResultsPage results_page(const std::filesystem::path& folder, std::uintmax_t limit = usual_limit);

}  // namespace thermocontact::view
