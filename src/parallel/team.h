/// The processes that share a run.
#pragma once

#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace thermocontact::parallel {

class Team {
  public:
    virtual ~Team() = default;
    virtual int rank() const = 0;
    virtual int size() const = 0;

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
    void sum(std::span<double>) const override {}
    void max(std::span<double>) const override {}
};

}  // namespace thermocontact::parallel
