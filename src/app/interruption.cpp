#include "app/interruption.h"

#include <unistd.h>

#include <csignal>
#include <ctime>

#include "app/exit_code.h"

namespace thermocontact::app {
namespace {

constexpr std::time_t patience = 2;  ///< s; `timeout` and mpirun may send a signal twice in a row

volatile std::sig_atomic_t caught = 0;
volatile std::time_t caught_at = 0;

void note(int signal) {
    const std::time_t now = std::time(nullptr);
    if (caught == 0) {
        caught = signal;
        caught_at = now;
    } else if (now - caught_at >= patience) {
        _exit(exit_of_signal(caught));
    }
}

}  // namespace

void catch_interruptions() {
    struct sigaction action {};
    action.sa_handler = note;
    action.sa_flags = SA_RESTART;  // a write to a file is not to be cut short
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

int caught_signal() {
    return caught;
}

void throw_if_interrupted() {
    if (const int signal = caught_signal(); signal != 0) {
        throw Interrupted{signal};
    }
}

}  // namespace thermocontact::app
