#include "solve/workers.h"

#include <algorithm>
#include <cstdlib>
#include <system_error>

namespace thermocontact::solve {

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
            others_.emplace_back([this] { wait_for_rounds(); });
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
    std::unique_lock lock(mutex_);
    ends_.wait(lock, [this] { return at_work_ == 0; });
}

void Workers::wait_for_rounds() {
    int seen = 0;  // a thread started in a round takes part in it
    std::unique_lock lock(mutex_);
    for (;;) {
        begins_.wait(lock, [&] { return over_ || round_ != seen; });
        if (over_) {
            return;
        }
        seen = round_;
        lock.unlock();
        take_tasks();
        lock.lock();
        if (--at_work_ == 0) {
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
