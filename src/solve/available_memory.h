/// Memory that the system can still give.
#pragma once

namespace thermocontact::solve {

/// Bytes that processes may still take without swapping: MemAvailable of /proc/meminfo, or less where a
/// control group limits them. Infinity where the system does not tell.
double available_memory();

}  // namespace thermocontact::solve
