"""Adaptive steps: the estimate, the rule, and what a rejection must leave alone."""

from .mutation import Mutation

CONTROL, ERROR, STEPS = "src/march/step_control.h", "src/march/step_error.cpp", "src/march/adaptive_steps.cpp"

MUTATIONS = (
    Mutation(
        "adaptive-first-order-factor",
        ERROR,
        "(centre(rule) + curvature_lag) : k * k / 2;",
        "(centre(rule) + curvature_lag) : k * k;",
        "factor",
        "backward Euler errs by k^2/2 y''",
    ),
    Mutation(
        "adaptive-curvature-place",
        ERROR,
        "return (rule.step / 2 - rule.lag) / 2;",
        "return (rule.step / 2 + rule.lag) / 2;",
        "sign",
        "y'' holds in the middle between the times of the two rates",
    ),
    Mutation(
        "adaptive-accepts-all",
        CONTROL,
        "bool accepts(double error) const { return error <= tolerance; }",
        "bool accepts(double error) const { return error <= 1e9 * tolerance; }",
        "range",
        "a step that errs too much is rejected",
    ),
    Mutation(
        "adaptive-order",
        CONTROL,
        "const double exact = std::log2(error / (safety * tolerance)) / (order + 1);",
        "const double exact = std::log2(error / (safety * tolerance)) / order;",
        "index",
        "a halved step errs 2^-(order + 1) of it",
    ),
    Mutation(
        "adaptive-patience",
        STEPS,
        "    if (parts.halvings() != size) {\n        state_.since_change = 0;\n    }",
        "    (void)size;",
        "missing",
        "steps are counted from the last change of size",
    ),
    Mutation(
        "adaptive-accept-rejected",
        STEPS,
        "            attempt.outcome = Attempt::Outcome::rejected;",
        "            attempt.outcome = Attempt::Outcome::rejected;\n            state_.time = rule.end;",
        "state",
        "a rejected step leaves the state alone",
    ),
    Mutation(
        "adaptive-count-rejected",
        STEPS,
        "            state_.since_change = std::min(state_.since_change, 0);",
        "            state_.since_change = std::min(state_.since_change, 0);\n            counts.parts += 1;",
        "state",
        "only steps that are taken count as such",
    ),
    Mutation(
        "adaptive-scale",
        STEPS,
        "state_.*scale = std::max(state_.*scale, field.size);",
        "state_.*scale = field.size;",
        "missing",
        "errors are relative to the largest size so far",
    ),
    Mutation(
        "adaptive-memory",
        "src/march/simulation.cpp",
        "state_.halvings = control_ ? parts.halvings() : 0;",
        "state_.halvings = 0;",
        "state",
        "a step of the scene begins with the size that the last one ended with",
    ),
    Mutation(
        "adaptive-steps-cut",
        "src/output/results.cpp",
        'scene_->time.tolerance && keep_rows(folder() / "steps.csv", step);',
        'scene_->time.tolerance && keep_rows(folder() / "steps.csv", step + 1);',
        "index",
        "a restart cuts steps.csv back to the checkpoint",
    ),
)
