/// Names in PETSc's log (-log_view) for what the strategy does beside PETSc's own solvers.
#pragma once

#include <petsclog.h>

#include "petsc/check.h"

namespace thermocontact::petsc {

/// Events of all problems; registered once a process.
struct Events {
    PetscLogEvent contact = 0;    ///< F and dF/dx on the contact facets
    PetscLogEvent product = 0;    ///< the tangent times a vector, and A times a vector
    PetscLogEvent hierarchy = 0;  ///< multigrid's set-up
    PetscLogEvent cycle = 0;      ///< its V-cycles
    PetscLogEvent linear = 0;     ///< linear solves, hierarchy included

    static const Events& all() {
        static const Events events;
        return events;
    }

  private:
    Events() {
        PetscClassId group = 0;
        check(PetscClassIdRegister("thermocontact", &group));
        check(PetscLogEventRegister("TCContact", group, &contact));
        check(PetscLogEventRegister("TCProduct", group, &product));
        check(PetscLogEventRegister("TCHierarchy", group, &hierarchy));
        check(PetscLogEventRegister("TCCycle", group, &cycle));
        check(PetscLogEventRegister("TCLinearSolve", group, &linear));
    }
};

/// Counts the time of its life for one event.
class Timed {
  public:
    explicit Timed(PetscLogEvent event) : event_(event) { begin(); }
    ~Timed() { end(); }
    Timed(const Timed&) = delete;
    Timed& operator=(const Timed&) = delete;

  private:
    // PETSc's macros return codes that only a broken log makes other than zero
    void begin() const { PetscLogEventBegin(event_, 0, 0, 0, 0); }
    void end() const { PetscLogEventEnd(event_, 0, 0, 0, 0); }

    PetscLogEvent event_;
};

}  // namespace thermocontact::petsc
