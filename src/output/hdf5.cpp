#include "output/hdf5.h"

#include <hdf5.h>

#include <limits>

#include "error.h"

namespace thermocontact::output {
namespace {

static_assert(std::is_same_v<hid_t, std::int64_t> && std::is_same_v<herr_t, int>);

constexpr std::size_t growth = 1 << 20;  ///< bytes by which a file in memory grows

[[noreturn]] void fail(std::string_view what) {
    throw SystemError("HDF5 cannot " + std::string(what));
}

void check(herr_t result, std::string_view what) {
    if (result < 0) {
        fail(what);
    }
}

/// Files live in memory and never reach the disk by themselves; errors are told by exceptions.
Hdf5Object in_memory() {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    return {H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "set up a file"};
}

hid_t create() {
    const Hdf5Object access = in_memory();
    check(H5Pset_fapl_core(access, growth, false), "set up a file in memory");
    return H5Fcreate("checkpoint", H5F_ACC_TRUNC, H5P_DEFAULT, access);
}

hid_t open(std::string_view bytes) {
    const Hdf5Object access = in_memory();
    check(H5Pset_fapl_core(access, growth, false), "set up a file in memory");
    // the library copies the image and leaves the original as it is
    check(H5Pset_file_image(access, const_cast<char*>(bytes.data()), bytes.size()), "take in a file");
    return H5Fopen("checkpoint", H5F_ACC_RDONLY, access);
}

}  // namespace

Hdf5Object::Hdf5Object(std::int64_t id, Close close, std::string_view what) : id_(id), close_(close) {
    if (id < 0) {
        fail(what);
    }
}

Hdf5Writer::Hdf5Writer()
    : file_(create(), H5Fclose, "make a file in memory"),
      links_(H5Pcreate(H5P_LINK_CREATE), H5Pclose, "set up links") {
    check(H5Pset_create_intermediate_group(links_, 1), "set up links");
}

void Hdf5Writer::write_array(const std::string& path, std::int64_t file_type, std::int64_t memory_type,
                             std::size_t size, const void* values) {
    const std::string what = "write " + path;
    const hsize_t extent = size;
    const Hdf5Object space(H5Screate_simple(1, &extent, nullptr), H5Sclose, what);
    const Hdf5Object set(H5Dcreate2(file_, path.c_str(), file_type, space, links_, H5P_DEFAULT, H5P_DEFAULT),
                         H5Dclose, what);
    check(H5Dwrite(set, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), what);
}

void Hdf5Writer::write(const std::string& path, const std::string& text) {
    write_array(path, H5T_STD_U8LE, H5T_NATIVE_UCHAR, text.size(), text.data());
}

void Hdf5Writer::write(const std::string& path, double number) {
    write(path, std::vector<double>{number});
}

void Hdf5Writer::write(const std::string& path, std::int64_t number) {
    write(path, std::vector<std::int64_t>{number});
}

void Hdf5Writer::write(const std::string& path, const std::vector<double>& numbers) {
    write_array(path, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, numbers.size(), numbers.data());
}

void Hdf5Writer::write(const std::string& path, const std::vector<std::int64_t>& numbers) {
    write_array(path, H5T_STD_I64LE, H5T_NATIVE_INT64, numbers.size(), numbers.data());
}

std::string Hdf5Writer::bytes() {
    check(H5Fflush(file_, H5F_SCOPE_GLOBAL), "complete a file");
    const ssize_t size = H5Fget_file_image(file_, nullptr, 0);
    if (size < 0) {
        fail("complete a file");
    }
    std::string image(static_cast<std::size_t>(size), '\0');
    if (H5Fget_file_image(file_, image.data(), image.size()) != size) {
        fail("complete a file");
    }
    return image;
}

Hdf5Reader::Hdf5Reader(std::string_view bytes)
    : file_(open(bytes), H5Fclose, "read this as one of its files") {}

bool Hdf5Reader::has(const std::string& path) const {
    for (std::size_t end = 0; end != std::string::npos;) {  // a path may be asked for step by step only
        end = path.find('/', end + 1);
        if (H5Lexists(file_, path.substr(0, end).c_str(), H5P_DEFAULT) <= 0) {
            return false;
        }
    }
    return true;
}

template <typename Number>
void Hdf5Reader::read_array(const std::string& path, std::int64_t memory_type,
                            std::vector<Number>& values) const {
    const std::string what = "find " + path;
    const Hdf5Object set(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose, what);
    const Hdf5Object space(H5Dget_space(set), H5Sclose, what);
    const hssize_t size = H5Sget_simple_extent_npoints(space);
    if (size < 0) {
        fail(what);
    }
    values.resize(static_cast<std::size_t>(size));
    check(H5Dread(set, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), what);
}

void Hdf5Reader::read(const std::string& path, std::string& text) const {
    std::vector<char> characters;
    read_array(path, H5T_NATIVE_UCHAR, characters);
    text.assign(characters.begin(), characters.end());
}

void Hdf5Reader::read(const std::string& path, std::vector<double>& numbers) const {
    read_array(path, H5T_NATIVE_DOUBLE, numbers);
}

void Hdf5Reader::read(const std::string& path, std::vector<std::int64_t>& numbers) const {
    read_array(path, H5T_NATIVE_INT64, numbers);
}

void Hdf5Reader::read(const std::string& path, double& number) const {
    std::vector<double> numbers;
    read(path, numbers);
    if (numbers.size() != 1) {
        fail("find one number in " + path);
    }
    number = numbers.front();
}

void Hdf5Reader::read(const std::string& path, std::int64_t& number) const {
    std::vector<std::int64_t> numbers;
    read(path, numbers);
    if (numbers.size() != 1) {
        fail("find one number in " + path);
    }
    number = numbers.front();
}

void Hdf5Reader::read(const std::string& path, int& number) const {
    std::int64_t wide = 0;
    read(path, wide);
    if (wide < std::numeric_limits<int>::min() || wide > std::numeric_limits<int>::max()) {
        fail("find a whole number of 32 bits in " + path);
    }
    number = static_cast<int>(wide);
}

}  // namespace thermocontact::output
