#include "solve/huge_pages.h"

#include <sys/mman.h>

#include <cstdlib>

namespace thermocontact::solve {
namespace {

constexpr std::size_t page = std::size_t{2} << 20U;

}  // namespace

void* allocate_huge(std::size_t bytes) {
    if (bytes < page) {
        return std::malloc(bytes);
    }
    const std::size_t rounded = (bytes + page - 1) / page * page;
    void* memory = std::aligned_alloc(page, rounded);
    if (memory != nullptr) {
        madvise(memory, rounded, MADV_HUGEPAGE);  // a hint: without it all works, slower
    }
    return memory;
}

void release(void* memory) {
    std::free(memory);
}

}  // namespace thermocontact::solve
