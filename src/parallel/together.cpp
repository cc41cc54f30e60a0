#include "parallel/together.h"

#include <new>
#include <string>
#include <vector>

#include "error.h"

namespace thermocontact::parallel {
namespace {

enum class Kind { none, scene, numerics, system };

struct Failure {
    Kind kind = Kind::none;
    std::string reason;
};

Failure attempt(const std::function<void()>& work) {
    try {
        work();
        return {};
    } catch (const SceneError& error) {
        return {Kind::scene, error.what()};
    } catch (const NumericsError& error) {
        return {Kind::numerics, error.what()};
    } catch (const std::bad_alloc&) {
        return {Kind::system, out_of_memory};
    } catch (const std::exception& error) {
        return {Kind::system, error.what()};
    }
}

[[noreturn]] void raise(const Failure& failure) {
    switch (failure.kind) {
        case Kind::scene:
            throw SceneError(failure.reason);
        case Kind::numerics:
            throw NumericsError(failure.reason);
        default:
            throw SystemError(failure.reason);
    }
}

/// What `speaker` says, on every process. A team adds numbers up only: the others add nothing.
Failure heard_from(const Team& team, int speaker, const Failure& here) {
    const bool speaks = team.rank() == speaker;
    std::vector<double> size{speaks ? static_cast<double>(here.kind) : 0.0,
                             speaks ? static_cast<double>(here.reason.size()) : 0.0};
    team.sum(size);
    std::vector<double> letters(static_cast<std::size_t>(size[1]), 0.0);
    for (std::size_t i = 0; speaks && i < letters.size(); ++i) {
        letters[i] = static_cast<unsigned char>(here.reason[i]);
    }
    team.sum(letters);
    Failure heard{static_cast<Kind>(static_cast<int>(size[0])), {}};
    for (const double letter : letters) {
        heard.reason += static_cast<char>(static_cast<unsigned char>(letter));
    }
    return heard;
}

}  // namespace

void try_together(const Team& team, const std::function<void()>& work) {
    if (team.size() == 1) {
        work();
        return;
    }
    const Failure here = attempt(work);
    const int nobody = team.size();
    const int first = -static_cast<int>(team.max(here.kind == Kind::none ? -nobody : -team.rank()));
    if (first != nobody) {
        raise(heard_from(team, first, here));
    }
}

}  // namespace thermocontact::parallel
