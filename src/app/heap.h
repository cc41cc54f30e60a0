/// How the process asks the system for memory.
#pragma once

namespace thermocontact::app {

/// Keeps the pages of vectors that come and go instead of returning them to the system each time, and asks
/// for large pages for the first 256 MiB of the heap, which are reserved, not used. A first touch of a page
/// costs microseconds: at 16 thousand nodes this halves the time before the first step.
void prepare_heap();

}  // namespace thermocontact::app
