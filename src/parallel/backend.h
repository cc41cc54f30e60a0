/// What several processes and large systems need. It is kept out of the program that needs neither: loading
/// MPI and PETSc takes 0.4 s, more than many a whole run.
#pragma once

#include <memory>

#include "error.h"
#include "fem/space.h"
#include "parallel/part.h"
#include "parallel/team.h"
#include "solve/step_problem.h"

namespace thermocontact::parallel {

class Backend {
  public:
    virtual ~Backend() = default;
    virtual const Team& team() const = 0;

    /// Waits a few seconds for all others to call this as well; whether they did. It may be called in an
    /// error, where others may be waiting for this process elsewhere.
    virtual bool all_meet() const = 0;

    /// Ends all processes at once: an error that the others do not know of.
    [[noreturn]] virtual void abort(int code) const = 0;

    /// For Phase.
    virtual void enter_phase(const char* name) const = 0;
    virtual void leave_phase() const = 0;

    /// Strategy "newton-krylov" on this process's part, which must outlive it.
    virtual std::unique_ptr<solve::Strategy> newton_krylov(const Part& part) const = 0;
};

/// Thrown where only a backend can go on and there is none.
struct BackendNeeded : SystemError {
    BackendNeeded() : SystemError("strategy \"newton-krylov\" needs PETSc, which this program has not") {}
};

/// A stage of PETSc's log (-log_view) while it lives; nothing where there is no PETSc. Stages may nest.
class Phase {
  public:
    Phase(const Backend* backend, const char* name) : backend_(backend) {
        if (backend_ != nullptr) {
            backend_->enter_phase(name);
        }
    }
    ~Phase() {
        if (backend_ != nullptr) {
            backend_->leave_phase();
        }
    }
    Phase(const Phase&) = delete;
    Phase& operator=(const Phase&) = delete;

  private:
    const Backend* backend_;
};

/// Without a backend the process is alone.
inline const Team& team_of(const Backend* backend) {
    static const Alone alone;
    return backend != nullptr ? backend->team() : alone;
}

/// Whether this process speaks for all.
inline bool is_first(const Backend* backend) {
    return team_of(backend).rank() == 0;
}

/// In `thermocontact`: nothing, and `thermocontact-petsc` takes over where mpirun started the process. In
/// `thermocontact-petsc`: MPI and PETSc, with the options behind "--".
std::unique_ptr<Backend> open_backend(int argc, char** argv);

/// Replaces the process by `thermocontact-petsc` beside it with the same arguments, as it started. Throws
/// SystemError where it is missing.
[[noreturn]] void continue_with_petsc();

}  // namespace thermocontact::parallel
