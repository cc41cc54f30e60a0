#include "mesh/child.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <new>
#include <stdexcept>

#include "error.h"

namespace thermocontact::mesh {
namespace {

#if defined(__SANITIZE_ADDRESS__)
constexpr bool reserves_address_space = true;
#elif defined(__has_feature)
constexpr bool reserves_address_space = __has_feature(address_sanitizer);
#else
constexpr bool reserves_address_space = false;
#endif

// first byte of what the child says
constexpr char result = 'R', system_error = 'S', other_error = 'E';

void set_limits(const ChildLimits& limits) {
    for (const int fatal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU, SIGINT, SIGTERM}) {
        std::signal(fatal, SIG_DFL);
    }
    const rlimit none{0, 0}, time{limits.time, limits.time + 1}, memory{limits.memory, limits.memory};
    setrlimit(RLIMIT_CORE, &none);
    setrlimit(RLIMIT_CPU, &time);
    if (!reserves_address_space) {  // the sanitizer's shadow would count
        setrlimit(RLIMIT_DATA, &memory);
    }
}

std::string outcome(const std::function<std::string()>& work) {
    try {
        return result + work();
    } catch (const SystemError& error) {
        return system_error + std::string(error.what());
    } catch (const std::bad_alloc&) {
        return other_error + std::string("it takes more memory than a mesh of this size can need");
    } catch (const std::exception& error) {
        return other_error + std::string(error.what());
    }
}

void write_all(int pipe, const std::string& bytes) {
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t count = write(pipe, bytes.data() + done, bytes.size() - done);
        if (count < 0 && errno != EINTR) {
            return;  // the parent is gone
        }
        done += count > 0 ? static_cast<std::size_t>(count) : 0;
    }
}

std::string read_all(int pipe) {
    std::string bytes;
    std::array<char, 1 << 16> buffer{};
    while (true) {
        const ssize_t count = read(pipe, buffer.data(), buffer.size());
        if (count == 0 || (count < 0 && errno != EINTR)) {
            return bytes;
        }
        bytes.append(buffer.data(), count > 0 ? static_cast<std::size_t>(count) : 0);
    }
}

int wait_for(pid_t child) {
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
}

std::string describe(int status, const ChildLimits& limits) {
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) {
        return "it takes more than " + std::to_string(limits.time) + " s";
    }
    return WIFSIGNALED(status) ? "it crashed (signal " + std::to_string(WTERMSIG(status)) + ")"
                               : "it ended with exit code " + std::to_string(WEXITSTATUS(status));
}

}  // namespace

std::string run_in_child(const std::function<std::string()>& work, const ChildLimits& limits) {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) {
        throw SystemError(std::string("no pipe to a child process: ") + std::strerror(errno));
    }
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        set_limits(limits);
        write_all(ends[1], outcome(work));
        _exit(0);
    }
    const int error = errno;
    close(ends[1]);
    const std::string said = child > 0 ? read_all(ends[0]) : "";
    close(ends[0]);
    if (child < 0) {
        throw SystemError(std::string("no child process: ") + std::strerror(error));
    }
    const int status = wait_for(child);
    if (said.empty() || status != 0) {
        throw std::runtime_error(describe(status, limits));
    }
    if (said[0] == system_error) {
        throw SystemError(said.substr(1));
    }
    if (said[0] == other_error) {
        throw std::runtime_error(said.substr(1));
    }
    return said.substr(1);
}

}  // namespace thermocontact::mesh
