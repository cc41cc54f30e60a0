#include "solve/available_memory.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace thermocontact::solve {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

double of_system() {
    std::ifstream file("/proc/meminfo");
    std::string name, unit;
    double kibibytes = 0;
    while (file >> name >> kibibytes) {
        std::getline(file, unit);
        if (name == "MemAvailable:") {
            return 1024 * kibibytes;
        }
    }
    return unlimited;
}

/// Version 2 of control groups; "max" is no number, and no limit.
double of_control_group() {
    std::ifstream limit_file("/sys/fs/cgroup/memory.max"), used_file("/sys/fs/cgroup/memory.current");
    double limit = 0, used = 0;
    if (limit_file >> limit && used_file >> used) {
        return std::max(0.0, limit - used);
    }
    return unlimited;
}

}  // namespace

double available_memory() {
    return std::min(of_system(), of_control_group());
}

}  // namespace thermocontact::solve
