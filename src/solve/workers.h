/// Threads that share the tasks of a loop.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace thermocontact::solve {

class Workers {
  public:
    /// At most `threads` at work at a time, the calling one among them; started when first needed. Threads
    /// that have nothing to do look out for more for a moment before they sleep: waking one takes longer than
    /// many a loop.
    explicit Workers(int threads) : threads_(threads) {}
    ~Workers();
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    /// As many as OMP_NUM_THREADS says, or else as this process has cores.
    static int available();

    /// Calls task(0) to task(count - 1), each once, in whatever order and on whichever thread; returns when
    /// all are done. Tasks must not throw.
    void run(int count, const std::function<void(int)>& task);

  private:
    void start(int others);
    void wait_for_rounds(int seen);
    void take_tasks();

    int threads_;
    std::vector<std::thread> others_;
    std::mutex mutex_;
    std::condition_variable begins_, ends_;
    std::atomic<int> round_ = 0;    ///< calls of run() so far
    std::atomic<int> at_work_ = 0;  ///< of the other threads
    std::atomic<bool> over_ = false;
    const std::function<void(int)>* task_ = nullptr;
    int count_ = 0;
    std::atomic<int> next_ = 0;
};

}  // namespace thermocontact::solve
