/// Small text helpers of messages: nearest names, lists of choices, values on one line.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace thermocontact::scene {

/// Smallest number of insertions, deletions, replacements and swaps of neighbours that turns `a` into `b`.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate nearest to `word` (the first of several), or "" when none is close enough to be meant.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

/// `; did you mean "NEAREST"?`, or "" without a near candidate.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

/// `"a", "b" or "c"`.
std::string one_of(const std::vector<std::string>& names);

/// A value as a message shows it: one line, shortened, non-finite numbers by name.
std::string show(const nlohmann::json& value);

/// `text` on one line of at most `length` characters, control characters escaped.
std::string one_line(std::string_view text, std::size_t length = 80);

/// The parts of `text` between dots.
std::vector<std::string> split(std::string_view text);

/// The first `count` parts with dots between them.
std::string join(const std::vector<std::string>& parts, std::size_t count);

/// Shortest decimal form that reads back as the same number.
std::string number_text(double value);

}  // namespace thermocontact::scene
