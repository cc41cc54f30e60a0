/// The program without PETSc: hands over to the one with it.
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "error.h"
#include "parallel/backend.h"

namespace thermocontact::parallel {
namespace {

/// Whether mpirun started this process (Open MPI, MPICH and their kin say so in the environment) as one of
/// several.
bool one_of_several() {
    for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) {
        if (const char* value = std::getenv(name); value != nullptr) {
            return std::atoi(value) > 1;
        }
    }
    return false;
}

/// Large pages for all of the heap of the program to come. Matrices of hundreds of MiB are read with a third
/// less time by them; the C library offers them in this way only, and prepare_heap() covers the first pages
/// alone.
void ask_for_large_pages() {
    const std::string name = "glibc.malloc.hugetlb";
    const char* given = std::getenv("GLIBC_TUNABLES");
    std::string tunables = given == nullptr ? "" : given;
    if (tunables.find(name) == std::string::npos) {
        tunables += (tunables.empty() ? "" : ":") + name + "=1";  // a hint: without it all works, slower
        setenv("GLIBC_TUNABLES", tunables.c_str(), 1);
    }
}

}  // namespace

std::unique_ptr<Backend> open_backend(int argc, char** argv) {
    const bool options =
        std::any_of(argv, argv + argc, [](const char* word) { return std::strcmp(word, "--") == 0; });
    if (one_of_several() || options) {
        continue_with_petsc();
    }
    return nullptr;
}

void continue_with_petsc() {
    std::ifstream file("/proc/self/cmdline", std::ios::binary);
    std::vector<std::string> words;
    for (std::string word; std::getline(file, word, '\0');) {
        words.push_back(word);
    }
    std::vector<char*> argv;
    argv.reserve(words.size() + 1);
    for (std::string& word : words) {
        argv.push_back(word.data());
    }
    argv.push_back(nullptr);
    const std::filesystem::path program =
        std::filesystem::read_symlink("/proc/self/exe").parent_path() / "thermocontact-petsc";
    ask_for_large_pages();
    execv(program.c_str(), argv.data());
    throw SystemError("several processes and strategy \"newton-krylov\" need " + program.string() + ": " +
                      std::strerror(errno));
}

}  // namespace thermocontact::parallel
