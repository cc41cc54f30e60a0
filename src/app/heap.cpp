#include "app/heap.h"

#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace thermocontact::app {

void prepare_heap() {
    constexpr int reserve = 256 << 20, keep = 1 << 30, page = 2 << 20;
    mallopt(M_MMAP_THRESHOLD, keep);
    mallopt(M_TRIM_THRESHOLD, keep);
    mallopt(M_TOP_PAD, reserve);
    auto* const begin = static_cast<char*>(sbrk(0));
    auto* volatile first_block = std::malloc(page);  // volatile: else the compiler drops the pair
    std::free(first_block);
    auto* const end = static_cast<char*>(sbrk(0));
    const std::uintptr_t into_page = reinterpret_cast<std::uintptr_t>(begin) % page;
    const std::uintptr_t to_first_page = (page - into_page) % page;
    const auto grown = static_cast<std::uintptr_t>(end - begin);
    if (to_first_page < grown) {  // a hint: without it all works, slower
        madvise(begin + to_first_page, grown - to_first_page, MADV_HUGEPAGE);
    }
#ifdef MADV_POPULATE_WRITE
    madvise(begin, std::min<std::uintptr_t>(to_first_page + page, grown), MADV_POPULATE_WRITE);
#endif
    mallopt(M_TOP_PAD, page);
}

}  // namespace thermocontact::app
