#include "solve/workers.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace thermocontact::solve {
namespace {

/// Each task once a round, for more and for fewer tasks than threads.
TEST(Workers, EveryTaskRunsOnce) {
    for (const int threads : {1, 2, 5}) {
        Workers workers(threads);
        for (int round = 0; round < 200; ++round) {
            const int count = round % 8;
            std::vector<int> runs(static_cast<std::size_t>(count), 0);
            workers.run(count, [&](int i) { ++runs[static_cast<std::size_t>(i)]; });
            EXPECT_TRUE(std::ranges::all_of(runs, [](int n) { return n == 1; }));
        }
    }
}

/// Two tasks that wait for each other end only if they run at the same time.
TEST(Workers, TasksRunAtTheSameTime) {
    Workers workers(2);
    std::atomic<int> arrived = 0;
    workers.run(2, [&](int) {
        ++arrived;
        while (arrived < 2) {
            std::this_thread::yield();
        }
    });
    EXPECT_EQ(arrived, 2);
}

TEST(Workers, TheEnvironmentLimitsThem) {
    const char* before = std::getenv("OMP_NUM_THREADS");
    const std::string kept = before == nullptr ? "" : before;
    setenv("OMP_NUM_THREADS", "3", 1);
    EXPECT_EQ(Workers::available(), 3);
    setenv("OMP_NUM_THREADS", "nonsense", 1);
    EXPECT_EQ(Workers::available(), std::max(1, static_cast<int>(std::thread::hardware_concurrency())));
    if (before == nullptr) {
        unsetenv("OMP_NUM_THREADS");
    } else {
        setenv("OMP_NUM_THREADS", kept.c_str(), 1);
    }
}

}  // namespace
}  // namespace thermocontact::solve
