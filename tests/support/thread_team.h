/// Several processes played by threads of one.
#pragma once

#include <algorithm>
#include <barrier>
#include <memory>
#include <thread>
#include <vector>

#include "parallel/team.h"

namespace thermocontact::support {

class ThreadTeam final : public parallel::Team {
  public:
    using Team::max;
    using Team::sum;

    /// Calls work(team) in `size` threads at a time, and waits for their end.
    template <typename Work>
    static void run(int size, Work&& work) {
        Hub hub(size);
        std::vector<std::jthread> threads;
        for (int rank = 0; rank < size; ++rank) {
            threads.emplace_back([&hub, &work, rank] { work(ThreadTeam(hub, rank)); });
        }
    }

    int rank() const override { return rank_; }
    int size() const override { return static_cast<int>(hub_->numbers.size()); }
    void sum(std::span<double> numbers) const override {
        reduce(numbers, [](double a, double b) { return a + b; });
    }
    void max(std::span<double> numbers) const override {
        reduce(numbers, [](double a, double b) { return std::max(a, b); });
    }

    std::vector<parallel::Message> deliver(const std::vector<parallel::Message>& messages) const override {
        std::vector<parallel::Message> result;
        meet(hub_->messages, messages, [&](int from, const std::vector<parallel::Message>& theirs) {
            for (const parallel::Message& message : theirs) {
                if (message.rank == rank_) {
                    result.push_back({from, message.bytes});
                }
            }
        });
        return result;
    }

    void exchange(std::span<const parallel::Exchange> exchanges) const override {
        meet(hub_->exchanges, exchanges, [&](int from, std::span<const parallel::Exchange> theirs) {
            for (const parallel::Exchange& sent : theirs) {
                for (const parallel::Exchange& wanted : exchanges) {
                    if (sent.rank == rank_ && wanted.rank == from) {
                        std::ranges::copy(sent.send, wanted.receive.begin());
                    }
                }
            }
        });
    }

  private:
    struct Hub {
        explicit Hub(int size)
            : barrier(size),
              numbers(static_cast<std::size_t>(size)),
              messages(numbers.size()),
              exchanges(numbers.size()) {}
        std::barrier<> barrier;
        std::vector<std::vector<double>> numbers;
        std::vector<std::vector<parallel::Message>> messages;
        std::vector<std::span<const parallel::Exchange>> exchanges;
    };

    ThreadTeam(Hub& hub, int rank) : hub_(&hub), rank_(rank) {}

    /// Shows what is `mine` to all and looks at what each shows, in order of their ranks.
    template <typename T, typename Look>
    void meet(std::vector<T>& table, const T& mine, Look&& look) const {
        table[static_cast<std::size_t>(rank_)] = mine;
        hub_->barrier.arrive_and_wait();
        for (std::size_t from = 0; from < table.size(); ++from) {
            look(static_cast<int>(from), table[from]);
        }
        hub_->barrier.arrive_and_wait();
    }

    template <typename Operation>
    void reduce(std::span<double> numbers, Operation operation) const {
        const std::vector<double> mine(numbers.begin(), numbers.end());
        meet(hub_->numbers, mine, [&](int from, const std::vector<double>& theirs) {
            std::ranges::transform(numbers, theirs, numbers.begin(),
                                   [&](double a, double b) { return from == 0 ? b : operation(a, b); });
        });
    }

    Hub* hub_;
    int rank_;
};

}  // namespace thermocontact::support
