/// What the fuzz targets share: files made from the fuzzer's bytes, and the ends that are allowed.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "error.h"

namespace thermocontact::fuzz {

inline std::string as_text(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

/// A file that holds the bytes, this process's own, used again by every input.
inline std::filesystem::path as_file(const std::string& bytes, const std::string& name) {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("fuzz-" + std::to_string(getpid()) + "-" + name);
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
}

/// Runs `read`: a SceneError of one non-empty line is an answer, as is success; anything else that is thrown
/// ends the process.
template <typename Read>
void answers(Read&& read) {
    try {
        read();
    } catch (const SceneError& error) {
        const std::string text = error.what();
        if (text.empty() || text.find('\n') != std::string::npos) {
            __builtin_trap();
        }
    }
}

}  // namespace thermocontact::fuzz
