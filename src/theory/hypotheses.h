/// What the paper's theorem of existence and uniqueness asks of the data, judged on a scene: (H1)-(H8),
/// (2.23), and the parts of Problem 2.1 that a scene may leave out.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"
#include "theory/constants.h"
#include "theory/pieces.h"
#include "theory/samples.h"

namespace thermocontact::theory {

enum class Verdict { holds, fails, not_applicable };

struct Number {
    std::string name;
    double value;
    std::string where = {};  ///< " in bush": the region that decides
};

struct Condition {
    std::string label;  ///< the paper's: "(H3 ii)"
    Verdict verdict;
    std::string statement;        ///< what it asks for, or why it does not apply
    std::vector<Number> numbers;  ///< that decide; of an inequality its left side, then its right side
};

/// In the order of the paper. With several materials each bound is that of the worst.
std::vector<Condition> judge(const scene::Scene& scene, const std::vector<Piece>& pieces,
                             const Constants& constants, const Samples& samples);

}  // namespace thermocontact::theory
