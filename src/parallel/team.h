/// The processes that share a run.
#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace thermocontact::parallel {

/// Bytes for a process, or from it.
struct Message {
    int rank;
    std::vector<std::byte> bytes;
};

/// What goes to a process and what comes from it, both of known length.
struct Exchange {
    int rank;
    std::span<const std::byte> send;
    std::span<std::byte> receive;
};

class Team {
  public:
    virtual ~Team() = default;
    virtual int rank() const = 0;
    virtual int size() const = 0;

    /// Sends the messages, at most one to a process, and returns those that came, in order of their ranks.
    /// Every process must call.
    virtual std::vector<Message> deliver(const std::vector<Message>& messages) const = 0;

    /// Exchanges with some other processes, each of which calls for its side of it.
    virtual void exchange(std::span<const Exchange> exchanges) const = 0;

    /// Replaces each number by its sum, or its largest value, over all processes. Every process must call.
    virtual void sum(std::span<double> numbers) const = 0;
    virtual void max(std::span<double> numbers) const = 0;

    double sum(double number) const {
        sum(std::span(&number, 1));
        return number;
    }
    double max(double number) const {
        max(std::span(&number, 1));
        return number;
    }

    /// Whether some process says so.
    bool any(bool here) const { return max(here ? 1.0 : 0.0) > 0; }

    /// Sums every member of a structure that holds doubles only.
    template <typename Sums>
    Sums summed(const Sums& here) const {
        static_assert(std::is_trivially_copyable_v<Sums> && sizeof(Sums) % sizeof(double) == 0);
        std::vector<double> numbers(sizeof(Sums) / sizeof(double));
        std::memcpy(numbers.data(), &here, sizeof(Sums));
        sum(numbers);
        Sums result = here;
        std::memcpy(static_cast<void*>(&result), numbers.data(), sizeof(Sums));
        return result;
    }
};

/// One process.
class Alone final : public Team {
  public:
    using Team::max;
    using Team::sum;
    int rank() const override { return 0; }
    int size() const override { return 1; }
    std::vector<Message> deliver(const std::vector<Message>& messages) const override { return messages; }
    void exchange(std::span<const Exchange>) const override {}
    void sum(std::span<double>) const override {}
    void max(std::span<double>) const override {}
};

}  // namespace thermocontact::parallel
