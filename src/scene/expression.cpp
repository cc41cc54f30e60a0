#include "scene/expression.h"

#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>
#include <vector>

#include "error.h"
#include "scene/text.h"

namespace thermocontact::scene {

struct Expression::Formula {
    mu::Parser parser;
    double x = 0, y = 0, z = 0, t = 0;  // bound to the parser's variables
    bool depends_on_time = false;       // kept, since muParser parses anew to find its variables
};

namespace {

constexpr std::size_t longest_formula = 10'000;

struct Function {
    const char* name;
    double (*value)(double);
};

constexpr std::array<Function, 14> functions = {{
    {"sin", [](double v) { return std::sin(v); }},
    {"cos", [](double v) { return std::cos(v); }},
    {"tan", [](double v) { return std::tan(v); }},
    {"asin", [](double v) { return std::asin(v); }},
    {"acos", [](double v) { return std::acos(v); }},
    {"atan", [](double v) { return std::atan(v); }},
    {"sinh", [](double v) { return std::sinh(v); }},
    {"cosh", [](double v) { return std::cosh(v); }},
    {"tanh", [](double v) { return std::tanh(v); }},
    {"exp", [](double v) { return std::exp(v); }},
    {"ln", [](double v) { return std::log(v); }},
    {"log10", [](double v) { return std::log10(v); }},
    {"sqrt", [](double v) { return std::sqrt(v); }},
    {"abs", [](double v) { return std::abs(v); }},
}};

// A NaN among the arguments must not vanish in the comparison.
template <class Better>
double extreme(const double* values, int count, Better better) {
    double best = values[0];
    for (int i = 1; i < count; ++i) {
        if (std::isnan(values[i]) || better(values[i], best)) {
            best = values[i];
        }
    }
    return best;
}

double least(const double* values, int count) {
    return extreme(values, count, [](double a, double b) { return a < b; });
}

double greatest(const double* values, int count) {
    return extreme(values, count, [](double a, double b) { return a > b; });
}

std::vector<std::string> variables(int dimension) {
    return dimension == 3 ? std::vector<std::string>{"x", "y", "z", "t"}
                          : std::vector<std::string>{"x", "y", "t"};
}

std::vector<std::string> known_names(int dimension) {
    std::vector<std::string> names = variables(dimension);
    for (const Function& function : functions) {
        names.emplace_back(function.name);
    }
    for (const char* name : {"min", "max", "pi", "e"}) {
        names.emplace_back(name);
    }
    return names;
}

[[noreturn]] void fail(const std::string& formula, const std::string& what) {
    throw SceneError('"' + one_line(formula, 60) + "\": " + what);
}

std::string at(std::size_t offset) {
    return " at character " + std::to_string(offset + 1);
}

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

/// Offset just behind the number that begins at `i`.
std::size_t skip_number(const std::string& s, std::size_t i) {
    while (i < s.size() && (is_digit(s[i]) || s[i] == '.')) {
        ++i;
    }
    if (i < s.size() && (s[i] == 'e' || s[i] == 'E')) {
        std::size_t digits = i + 1;
        if (digits < s.size() && (s[digits] == '+' || s[digits] == '-')) {
            ++digits;
        }
        if (digits < s.size() && is_digit(s[digits])) {
            i = digits;
            while (i < s.size() && is_digit(s[i])) {
                ++i;
            }
        }
    }
    return i;
}

std::string suggestion(const std::string& name, const std::vector<std::string>& names) {
    if (name == "log") {
        return "; did you mean \"ln\"?";
    }
    const std::string near = did_you_mean(name, names);
    return near.empty() ? "; expected " + one_of(names) : near;
}

/// Offset just behind the name that begins at `i`, which must be a known one.
std::size_t check_name(const std::string& s, std::size_t i, const std::vector<std::string>& names) {
    std::size_t end = i;
    while (end < s.size() && (is_letter(s[end]) || is_digit(s[end]))) {
        ++end;
    }
    const std::string name = s.substr(i, end - i);
    if (std::find(names.begin(), names.end(), name) == names.end()) {
        fail(s, "unknown name \"" + one_line(name, 40) + '"' + at(i) + suggestion(name, names));
    }
    return end;
}

/// Refuses what muParser would take beyond the promised syntax: assignments, strings, other names.
void check_characters(const std::string& s, int dimension) {
    const std::vector<std::string> names = known_names(dimension);
    constexpr std::string_view symbols = " \t\n+-*/^<>=!&|?:(),";
    std::size_t i = 0;
    while (i < s.size()) {
        if (is_digit(s[i]) || s[i] == '.') {
            i = skip_number(s, i);
        } else if (is_letter(s[i])) {
            i = check_name(s, i, names);
        } else if (symbols.find(s[i]) == std::string_view::npos) {
            fail(s, "unexpected character" + at(i));
        } else if (s.compare(i, 2, "<=") == 0 || s.compare(i, 2, ">=") == 0 || s.compare(i, 2, "==") == 0 ||
                   s.compare(i, 2, "!=") == 0) {
            i += 2;
        } else if (s[i] == '=') {
            fail(s, "assignment \"=\"" + at(i) + " is not allowed; did you mean \"==\"?");
        } else {
            ++i;
        }
    }
}

std::string trimmed(std::string text) {
    text.erase(text.find_last_not_of(" \t\n") + 1);
    return text;
}

std::string explanation(const mu::Parser::exception_type& error, std::size_t length) {
    const std::string token = trimmed(error.GetToken());
    const int raw = error.GetPos();
    const std::string where = raw < 0 ? "" : at(std::min(static_cast<std::size_t>(raw), length));
    switch (error.GetCode()) {
        case mu::ecUNEXPECTED_EOF:
            return "ends too early";
        case mu::ecMISSING_PARENS:
            return "a closing \")\" is missing";
        case mu::ecTOO_MANY_PARAMS:
            return "too many arguments of \"" + token + '"' + where;
        case mu::ecTOO_FEW_PARAMS:
            return "too few arguments of \"" + token + '"' + where;
        case mu::ecMISSING_ELSE_CLAUSE:
            return "\"?\" without its \":\"";
        case mu::ecMISPLACED_COLON:
            return "\":\" without its \"?\"" + where;
        default:
            return (token.empty() ? "syntax error" : "unexpected \"" + one_line(token, 20) + '"') + where;
    }
}

void define_language(mu::Parser& parser) {
    parser.ClearFun();
    parser.ClearConst();
    for (const Function& function : functions) {
        parser.DefineFun(function.name, function.value);
    }
    parser.DefineFun("min", least);
    parser.DefineFun("max", greatest);
    parser.DefineConst("pi", std::numbers::pi);
    parser.DefineConst("e", std::numbers::e);
}

}  // namespace

Expression::Expression(double value) : value_(value), text_(number_text(value)) {}

Expression::Expression(const std::string& formula, int dimension) : text_(formula) {
    if (formula.size() > longest_formula) {
        fail(formula, "longer than " + std::to_string(longest_formula) + " characters");
    }
    if (formula.find_first_not_of(" \t\n") == std::string::npos) {
        fail(formula, "empty");
    }
    check_characters(formula, dimension);
    formula_ = std::make_shared<Formula>();
    try {
        mu::Parser& parser = formula_->parser;
        define_language(parser);
        for (const std::string& name : variables(dimension)) {
            parser.DefineVar(name, name == "x"   ? &formula_->x
                                   : name == "y" ? &formula_->y
                                   : name == "z" ? &formula_->z
                                                 : &formula_->t);
        }
        parser.SetExpr(formula);
        int results = 0;
        const double* values = parser.Eval(results);
        if (results != 1) {
            fail(formula, "one value expected, found " + std::to_string(results) + " separated by commas");
        }
        const double value = values[0];
        const auto used = parser.GetUsedVar();
        formula_->depends_on_time = used.contains("t");
        if (used.empty()) {
            value_ = value;
            formula_.reset();
        }
    } catch (const mu::Parser::exception_type& error) {
        fail(formula, explanation(error, formula.size()));
    }
    if (!formula_ && !std::isfinite(value_)) {
        fail(formula, "its value is " + number_text(value_));
    }
}

double Expression::operator()(const std::array<double, 3>& x, double t) const {
    if (!formula_) {
        return value_;
    }
    Formula& f = *formula_;
    f.x = x[0];
    f.y = x[1];
    f.z = x[2];
    f.t = t;
    double value = std::numeric_limits<double>::quiet_NaN();
    try {
        value = f.parser.Eval();
    } catch (const mu::Parser::exception_type& error) {
        throw NumericsError("expression \"" + one_line(text_) + "\": " + error.GetMsg());
    }
    if (!std::isfinite(value)) {
        throw NumericsError("expression \"" + one_line(text_) + "\" is " + number_text(value) + " at x = (" +
                            number_text(x[0]) + ", " + number_text(x[1]) + ", " + number_text(x[2]) +
                            "), t = " + number_text(t) + "; change it so that it is finite everywhere");
    }
    return value;
}

bool Expression::depends_on_time() const {
    return formula_ && formula_->depends_on_time;
}

bool Expression::is_zero() const {
    return !formula_ && value_ == 0.0;
}

const std::string& Expression::text() const {
    return text_;
}

}  // namespace thermocontact::scene
