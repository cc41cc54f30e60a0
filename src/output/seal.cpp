#include "output/seal.h"

#include <zlib.h>

#include <array>
#include <cstdio>

#include "error.h"

namespace thermocontact::output {
namespace {

constexpr std::size_t block_size = 512;  ///< the least that HDF5 looks behind for its signature
constexpr std::string_view title = "thermocontact checkpoint, format ";

std::string block_of(std::string_view bytes) {
    const auto sum = crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
    std::array<char, 9> digits{};
    std::snprintf(digits.data(), digits.size(), "%08lx", static_cast<unsigned long>(sum));
    std::string block = std::string(title) + std::to_string(checkpoint_format) + "\n" +
                        std::to_string(bytes.size()) + " bytes of HDF5 follow this block of " +
                        std::to_string(block_size) + ", their CRC-32 is " + digits.data() + "\n";
    block.resize(block_size, '\0');
    return block;
}

}  // namespace

std::string seal(std::string_view bytes) {
    std::string sealed = block_of(bytes);
    sealed += bytes;
    return sealed;
}

std::string_view unseal(std::string_view sealed) {
    if (!sealed.starts_with(title.substr(0, sealed.size())) || sealed.empty()) {
        throw SceneError("this is not a checkpoint of thermocontact");
    }
    if (sealed.size() < block_size) {
        throw SceneError("the file is cut short or damaged");
    }
    // "2" in "format 2\n1234 bytes"
    const std::string_view format = sealed.substr(title.size(), sealed.find('\n') - title.size());
    if (format != std::to_string(checkpoint_format)) {
        throw SceneError("its format is " + std::string(format.substr(0, 8)) +
                         ", this program reads format " + std::to_string(checkpoint_format));
    }
    const std::string_view bytes = sealed.substr(block_size);
    if (sealed.substr(0, block_size) != block_of(bytes)) {
        throw SceneError("the file is cut short or damaged: its length or checksum is not what it states");
    }
    return bytes;
}

}  // namespace thermocontact::output
