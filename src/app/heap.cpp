#include "app/heap.h"

#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>

namespace thermocontact::app {

void prepare_heap() {
    constexpr int reserve = 256 << 20, keep = 1 << 30, page = 2 << 20;
    mallopt(M_MMAP_THRESHOLD, keep);
    mallopt(M_TRIM_THRESHOLD, keep);
    mallopt(M_TOP_PAD, reserve);
    const auto begin = reinterpret_cast<std::uintptr_t>(sbrk(0));
    auto* volatile first_block = std::malloc(page);  // volatile: else the compiler drops the pair
    std::free(first_block);
    const auto end = reinterpret_cast<std::uintptr_t>(sbrk(0));
    const std::uintptr_t first = (begin + page - 1) / page * page;
    if (first < end) {
        madvise(reinterpret_cast<void*>(first), end - first,
                MADV_HUGEPAGE);  // a hint: without it all works, slower
    }
    mallopt(M_TOP_PAD, page);
}

}  // namespace thermocontact::app
