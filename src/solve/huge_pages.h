/// Memory for the factors in large pages: fewer page faults when they are made, fewer TLB misses when they
/// are read.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace thermocontact::solve {

/// As std::malloc, to be released by std::free; large blocks ask the system for large pages.
void* allocate_huge(std::size_t bytes);

void release(void* memory);

template <typename T>
struct HugePageAllocator {
    using value_type = T;
    HugePageAllocator() = default;
    template <typename U>
    HugePageAllocator(const HugePageAllocator<U>&) {}

    T* allocate(std::size_t count) {
        void* memory = allocate_huge(count * sizeof(T));
        if (memory == nullptr) {
            throw std::bad_alloc();
        }
        return static_cast<T*>(memory);
    }
    /// A vector that grows does not write what it gains: pages come to be where they are first written.
    template <typename U>
    void construct(U* place) {
        ::new (static_cast<void*>(place)) U;
    }
    void deallocate(T* memory, std::size_t) { release(memory); }
    bool operator==(const HugePageAllocator&) const = default;
};

template <typename T>
using HugeVector = std::vector<T, HugePageAllocator<T>>;

}  // namespace thermocontact::solve
