#include "laws/law_file.h"

#include <dlfcn.h>

#include <fstream>
#include <sstream>

#include "error.h"
#include "laws/cache.h"
#include "laws/generator.h"
#include "laws/sha256.h"

namespace thermocontact::laws {
namespace {

constexpr std::size_t largest_file = 1 << 20;  // bytes

std::string content(const std::filesystem::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

/// By everything that what is made depends on.
std::string key(const std::vector<LawFile>& files, const std::string& what) {
    std::string all = tools() + "\n" + generator_identity() + "\n" + what;
    for (const LawFile& file : files) {
        all += "\n" + file.kind + " " + file.digest;
    }
    return sha256(all);
}

const void* symbol(void* library, const char* name, const std::filesystem::path& file) {
    const void* address = dlsym(library, name);
    if (address == nullptr) {
        throw SystemError(file.string() + ": has no " + name + "; delete it");
    }
    return address;
}

}  // namespace

LawFile read_law_file(const std::string& kind, const std::filesystem::path& path) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) {
        throw SceneError(path.string() +
                         (std::filesystem::exists(path, ignored) ? ": is no file" : ": no such file"));
    }
    if (std::filesystem::file_size(path, ignored) > largest_file) {
        throw SceneError(path.string() + ": larger than 1 MiB, hence no law file");
    }
    std::string text = content(path);
    if (text.empty() || text.find('\0') != std::string::npos) {
        throw SceneError(path.string() + (text.empty() ? ": is empty, or cannot be read" : ": is no text"));
    }
    std::string digest = sha256(text);
    return {kind, path, std::move(text), std::move(digest)};
}

Description describe(const LawFile& file) {
    return parse_description(
        content(cached(key({file}, "describe") + ".json",
                       [&](const std::filesystem::path& folder) { return make_description(file, folder); })));
}

std::span<const thermocontact_kernel> kernels(const std::vector<LawFile>& files, const Target& target) {
    const std::string name =
        target.cell + " " + std::to_string(target.degree) + (target.plane_strain ? " strain" : " stress");
    const std::filesystem::path file =
        cached(key(files, name) + ".so",
               [&](const std::filesystem::path& folder) { return make_library(files, target, folder); });
    void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) {
        throw SystemError(file.string() + ": cannot be loaded: " + dlerror() + "; delete it");
    }
    const auto* table = static_cast<const thermocontact_kernel*>(symbol(library, "laws_kernels", file));
    const auto count = *static_cast<const int*>(symbol(library, "laws_kernel_count", file));
    const std::string made =
        std::string(*static_cast<const char* const*>(symbol(library, "laws_kernel_versions", file))) +
        "; forms " + *static_cast<const char* const*>(symbol(library, "laws_forms_digest", file));
    if (made != tools()) {
        throw SystemError("compiled laws come from " + made + ", this program from " + tools() +
                          ": build it again, or name the Python that has these in THERMOCONTACT_PYTHON");
    }
    return {table, static_cast<std::size_t>(count)};
}

}  // namespace thermocontact::laws
