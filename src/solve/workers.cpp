#include "solve/workers.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <system_error>

namespace thermocontact::solve {
namespace {

/// About what waking a thread takes.
constexpr auto patience = std::chrono::microseconds(50);

/// Whether the condition came true soon.
template <typename Condition>
bool soon(Condition&& condition) {
    constexpr int looks = 64;  // between two looks at the clock
    const auto end = std::chrono::steady_clock::now() + patience;
    do {
        for (int i = 0; i < looks; ++i) {
            if (condition()) {
                return true;
            }
        }
    } while (std::chrono::steady_clock::now() < end);
    return false;
}

}  // namespace

int Workers::available() {
    const char* given = std::getenv("OMP_NUM_THREADS");
    const int wanted = given == nullptr ? 0 : std::atoi(given);
    return std::max(1, wanted > 0 ? wanted : static_cast<int>(std::thread::hardware_concurrency()));
}

Workers::~Workers() {
    {
        const std::lock_guard lock(mutex_);
        over_ = true;
    }
    begins_.notify_all();
    for (std::thread& thread : others_) {
        thread.join();
    }
}

/// Where the system gives no more threads, those there are do the work.
void Workers::start(int others) {
    try {
        while (static_cast<int>(others_.size()) < others) {
            others_.emplace_back([this, seen = round_.load()] { wait_for_rounds(seen); });
        }
    } catch (const std::system_error&) {
        threads_ = static_cast<int>(others_.size()) + 1;
    }
}

void Workers::run(int count, const std::function<void(int)>& task) {
    const int others = std::min(threads_, count) - 1;
    if (others < 1) {
        for (int i = 0; i < count; ++i) {
            task(i);
        }
        return;
    }
    {
        const std::lock_guard lock(mutex_);
        start(others);
        task_ = &task;
        count_ = count;
        next_ = 0;
        at_work_ = static_cast<int>(others_.size());
        ++round_;
    }
    begins_.notify_all();
    take_tasks();
    const auto done = [this] { return at_work_ == 0; };
    if (!soon(done)) {
        std::unique_lock lock(mutex_);
        ends_.wait(lock, done);
    }
}

/// A thread started in a round has not seen it, and takes part.
void Workers::wait_for_rounds(int seen) {
    const auto called = [&] { return over_ || round_ != seen; };
    for (;;) {
        if (!soon(called)) {
            std::unique_lock lock(mutex_);
            begins_.wait(lock, called);
        }
        if (over_) {
            return;
        }
        seen = round_;
        take_tasks();
        if (--at_work_ == 0) {
            const std::lock_guard lock(mutex_);  // run() is asleep, or has not looked yet
            ends_.notify_one();
        }
    }
}

void Workers::take_tasks() {
    for (int i = next_++; i < count_; i = next_++) {
        (*task_)(i);
    }
}

}  // namespace thermocontact::solve
