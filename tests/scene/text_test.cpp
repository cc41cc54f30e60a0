#include "scene/text.h"

#include <gtest/gtest.h>

#include <cmath>

namespace thermocontact::scene {
namespace {

TEST(Text, EditDistance) {
    EXPECT_EQ(edit_distance("", "abc"), 3U);
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
    EXPECT_EQ(edit_distance("rnu", "run"), 1U);
    EXPECT_EQ(edit_distance("same", "same"), 0U);
}

TEST(Text, NearestNames) {
    const std::vector<std::string> names = {"stiffness", "exponent", "gap"};
    EXPECT_EQ(nearest("stifness", names), "stiffness");
    EXPECT_EQ(nearest("gpa", names), "gap");
    EXPECT_EQ(nearest("xyz", names), "");
    EXPECT_EQ(nearest("", names), "");
    EXPECT_EQ(nearest("g", {"h"}), "");
    EXPECT_EQ(nearest(std::string(1'000'000, 'g'), names), "");
    EXPECT_EQ(did_you_mean("exponant", names), "; did you mean \"exponent\"?");
    EXPECT_EQ(did_you_mean("foo", names), "");
}

TEST(Text, Lists) {
    EXPECT_EQ(one_of({"a"}), "\"a\"");
    EXPECT_EQ(one_of({"a", "b"}), "\"a\" or \"b\"");
    EXPECT_EQ(one_of({"a", "b", "c"}), "\"a\", \"b\" or \"c\"");
}

TEST(Text, ValuesOnOneLine) {
    EXPECT_EQ(show(1), "1");
    EXPECT_EQ(show(1.0), "1.0");
    EXPECT_EQ(show(1e300), "1e+300");
    EXPECT_EQ(show(-INFINITY), "-inf");
    EXPECT_EQ(show("a\nb"), "\"a\\nb\"");
    EXPECT_EQ(show({1, 2.5, "x"}), "[1, 2.5, \"x\"]");
    EXPECT_EQ(show(std::string(500, 'a')).size(), 83U);
    EXPECT_EQ(one_line("a\nb\x1b"), "a\\nb\\x1b");
    EXPECT_EQ(one_line("aaa\xc3\xa9", 4), "aaa...");
}

TEST(Text, Numbers) {
    EXPECT_EQ(number_text(0.1), "0.1");
    EXPECT_EQ(number_text(100000000), "100000000");
    EXPECT_EQ(number_text(1e100), "1e+100");
    EXPECT_EQ(number_text(-0.5), "-0.5");
}

TEST(Text, Paths) {
    EXPECT_EQ(split("a.b.c"), (std::vector<std::string>{"a", "b", "c"}));
    EXPECT_EQ(split(""), (std::vector<std::string>{""}));
    EXPECT_EQ(join({"a", "b", "c"}, 2), "a.b");
    EXPECT_EQ(join({"a"}, 0), "");
}

}  // namespace
}  // namespace thermocontact::scene
