#include "scene/expression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "error.h"

namespace thermocontact::scene {
namespace {

double at(const std::string& formula, double x, double y = 0, double t = 0) {
    return Expression(formula, 2)({x, y, 0}, t);
}

std::string message(const std::string& formula, int dimension = 2) {
    try {
        const Expression read(formula, dimension);
        return {};
    } catch (const SceneError& error) {
        return error.what();
    }
}

TEST(Expression, Constants) {
    EXPECT_EQ(Expression()({1, 2, 3}, 4), 0.0);
    EXPECT_EQ(Expression(2.5)({1, 2, 3}, 4), 2.5);
    EXPECT_EQ(Expression(0.1).text(), "0.1");
    EXPECT_EQ(at("pi", 0), std::numbers::pi);
    EXPECT_EQ(at("e", 0), std::numbers::e);
    EXPECT_EQ(at("1e-3", 0), 1e-3);
    EXPECT_EQ(at("2*e", 0), 2 * std::numbers::e);
}

TEST(Expression, Variables) {
    EXPECT_EQ(at("x + 10*y + 100*t", 1, 2, 3), 321);
    EXPECT_EQ(Expression("x + z", 3)({1, 2, 3}, 0), 4);
    EXPECT_EQ(Expression(" x\n\t* y ", 2).text(), " x\n\t* y ");
}

TEST(Expression, OperatorsFollowTheirUsualPrecedence) {
    EXPECT_EQ(at("-2^2", 0), -4);
    EXPECT_EQ(at("2^3^2", 0), 512);
    EXPECT_EQ(at("2^-1", 0), 0.5);
    EXPECT_EQ(at("1 - 2*3 + 8/4", 0), -3);
    EXPECT_EQ(at("x > 0.5 && y <= 1 ? 1 : 2", 1, 1), 1);
    EXPECT_EQ(at("x > 0.5 || y != 0 ? 1 : 2", 0, 0), 2);
    EXPECT_EQ(at("x == 1", 1), 1);
    EXPECT_EQ(at("x >= 1", 0), 0);
}

TEST(Expression, Functions) {
    const double v = 0.4;
    EXPECT_DOUBLE_EQ(at("sin(x)", v), std::sin(v));
    EXPECT_DOUBLE_EQ(at("cos(x)", v), std::cos(v));
    EXPECT_DOUBLE_EQ(at("tan(x)", v), std::tan(v));
    EXPECT_DOUBLE_EQ(at("asin(x)", v), std::asin(v));
    EXPECT_DOUBLE_EQ(at("acos(x)", v), std::acos(v));
    EXPECT_DOUBLE_EQ(at("atan(x)", v), std::atan(v));
    EXPECT_DOUBLE_EQ(at("sinh(x)", v), std::sinh(v));
    EXPECT_DOUBLE_EQ(at("cosh(x)", v), std::cosh(v));
    EXPECT_DOUBLE_EQ(at("tanh(x)", v), std::tanh(v));
    EXPECT_DOUBLE_EQ(at("exp(x)", v), std::exp(v));
    EXPECT_DOUBLE_EQ(at("ln(x)", v), std::log(v));
    EXPECT_DOUBLE_EQ(at("log10(x)", v), std::log10(v));
    EXPECT_DOUBLE_EQ(at("sqrt(x)", v), std::sqrt(v));
    EXPECT_DOUBLE_EQ(at("abs(-x)", v), v);
    EXPECT_DOUBLE_EQ(at("min(3, x, 2)", v), v);
    EXPECT_DOUBLE_EQ(at("max(3, x, 2)", v), 3);
    EXPECT_DOUBLE_EQ(at("1.4*min(t/0.1,1)", 0, 0, 0.05), 0.7);
}

TEST(Expression, KnowsItsDependence) {
    EXPECT_TRUE(Expression("t", 2).depends_on_time());
    EXPECT_FALSE(Expression("tan(x)", 2).depends_on_time());
    EXPECT_FALSE(Expression(1.0).depends_on_time());
    EXPECT_TRUE(Expression("0", 2).is_zero());
    EXPECT_TRUE(Expression("1 - 1", 2).is_zero());
    EXPECT_TRUE(Expression(0.0).is_zero());
    EXPECT_FALSE(Expression("0*x", 2).is_zero());
}

TEST(Expression, CopiesAreIndependentInUse) {
    const Expression a("x", 2);
    Expression b("y", 2);
    b = a;
    EXPECT_EQ(a({1, 0, 0}, 0), 1);
    EXPECT_EQ(b({2, 0, 0}, 0), 2);
    EXPECT_EQ(a({3, 0, 0}, 0), 3);
}

TEST(Expression, NonFiniteValuesNameThePoint) {
    const Expression inverse("1/x", 2);
    EXPECT_EQ(inverse({2, 0, 0}, 0), 0.5);
    try {
        inverse({0, 0.5, 0}, 2);
        FAIL();
    } catch (const NumericsError& error) {
        EXPECT_STREQ(
            error.what(),
            "expression \"1/x\" is inf at x = (0, 0.5, 0), t = 2; change it so that it is finite everywhere");
    }
    EXPECT_THROW(at("ln(x)", -1), NumericsError);
    EXPECT_THROW(at("max(sqrt(x), 1)", -1), NumericsError);
    EXPECT_THROW(at("min(1, sqrt(x))", -1), NumericsError);
}

TEST(Expression, NamesAreChecked) {
    EXPECT_EQ(message("2*sinn(x)"),
              "\"2*sinn(x)\": unknown name \"sinn\" at character 3; did you mean \"sin\"?");
    EXPECT_EQ(message("log(x)"), "\"log(x)\": unknown name \"log\" at character 1; did you mean \"ln\"?");
    EXPECT_EQ(message("_pi"), "\"_pi\": unknown name \"_pi\" at character 1; did you mean \"pi\"?");
    EXPECT_EQ(message("z", 3), "");
    EXPECT_EQ(message("velocity").substr(0, 67),
              "\"velocity\": unknown name \"velocity\" at character 1; expected \"x\", \"");
    for (const char* name :
         {"z", "if(x,1,2)", "rint(x)", "sum(x)", "avg(x)", "sign(x)", "pow(x,2)", "X", "_e"}) {
        EXPECT_NE(message(name).find("unknown name"), std::string::npos) << name;
    }
}

TEST(Expression, SyntaxIsChecked) {
    EXPECT_EQ(message(""), "\"\": empty");
    EXPECT_EQ(message(" \t"), "\" \\x09\": empty");
    EXPECT_EQ(message("x=1"),
              "\"x=1\": assignment \"=\" at character 2 is not allowed; did you mean \"==\"?");
    EXPECT_EQ(message("1+*2"), "\"1+*2\": unexpected \"*\" at character 3");
    EXPECT_EQ(message("2x"), "\"2x\": unexpected \"x\" at character 2");
    EXPECT_EQ(message("1+"), "\"1+\": ends too early");
    EXPECT_EQ(message("(x"), "\"(x\": a closing \")\" is missing");
    EXPECT_EQ(message("x)"), "\"x)\": unexpected \")\" at character 2");
    EXPECT_EQ(message("1,2"), "\"1,2\": one value expected, found 2 separated by commas");
    EXPECT_EQ(message("x ? 1"), "\"x ? 1\": \"?\" without its \":\"");
    EXPECT_EQ(message("x : 1"), "\"x : 1\": \":\" without its \"?\" at character 4");
    EXPECT_EQ(message("1/0"), "\"1/0\": its value is inf");
    EXPECT_EQ(message("sqrt(-1)").substr(0, 26), "\"sqrt(-1)\": its value is n");
    EXPECT_EQ(message("x^2$"), "\"x^2$\": unexpected character at character 4");
    EXPECT_EQ(message("'x'"), "\"'x'\": unexpected character at character 1");
    for (const char* bad :
         {"2e",    "1e999", "!x",  "x & y",    "sin", "sin()", "sin(x, y)", "max()", "x y",  "--2",
          "\"a\"", "x; y",  "[x]", "\xc3\xa9", "()",  "1..2",  "x += 1",    "=x",    "x ==", "0x10"}) {
        EXPECT_NE(message(bad), "") << bad;
    }
}

TEST(Expression, HostileInput) {
    EXPECT_EQ(message(std::string("x\0y", 3)), "\"x\\x00y\": unexpected character at character 2");
    const std::string longest(10'001, '1');
    EXPECT_NE(message(longest).find("longer than 10000 characters"), std::string::npos);
    EXPECT_LT(message(longest).size(), 200U);
    EXPECT_EQ(at(std::string(4000, '(') + "x" + std::string(4000, ')'), 2), 2);
    EXPECT_NE(message(std::string(9000, '(')), "");
    EXPECT_NE(message(std::string(9000, 'a')), "");
    std::string sum = "x";
    for (int i = 0; i < 3000; ++i) {
        sum += "+1";
    }
    EXPECT_EQ(at(sum, 1), 3001);
}

}  // namespace
}  // namespace thermocontact::scene
