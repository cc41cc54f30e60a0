/// What became of one adaptive step.
#pragma once

namespace thermocontact::march {

struct Attempt {
    enum class Outcome {
        accepted,
        trial,             ///< the first of all, to see how large the fields become; not taken
        rejected,          ///< it errs by more than the tolerance
        beyond_tolerance,  ///< accepted all the same: there is no shorter step
        failed             ///< no solution was found
    };

    double end, size;     ///< s
    double error = 0;     ///< the estimate (step_control.h), relative; 0 of a step that failed
    const char* of = "";  ///< what errs most (step_control.h); empty where nothing is known to err
    Outcome outcome = Outcome::accepted;
};

inline bool is_taken(const Attempt& attempt) {
    return attempt.outcome == Attempt::Outcome::accepted ||
           attempt.outcome == Attempt::Outcome::beyond_tolerance;
}

inline const char* name(Attempt::Outcome outcome) {
    switch (outcome) {
        case Attempt::Outcome::accepted:
            return "accepted";
        case Attempt::Outcome::trial:
            return "trial";
        case Attempt::Outcome::rejected:
            return "rejected";
        case Attempt::Outcome::beyond_tolerance:
            return "beyond-tolerance";
        case Attempt::Outcome::failed:
            break;
    }
    return "failed";
}

}  // namespace thermocontact::march
