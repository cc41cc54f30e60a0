/// HDF5 files as bytes in memory: text, numbers and arrays by path. Groups on the way are made.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace thermocontact::output {

/// An object of the HDF5 library, closed at the end.
class Hdf5Object {
  public:
    using Close = int (*)(std::int64_t);
    /// Throws SystemError where the library refused (`id` < 0), naming what was attempted.
    Hdf5Object(std::int64_t id, Close close, std::string_view what);
    ~Hdf5Object() { close_(id_); }
    Hdf5Object(const Hdf5Object&) = delete;
    Hdf5Object& operator=(const Hdf5Object&) = delete;
    operator std::int64_t() const { return id_; }

  private:
    std::int64_t id_;
    Close close_;
};

/// Every function throws SystemError where the library fails: no memory.
class Hdf5Writer {
  public:
    Hdf5Writer();
    void write(const std::string& path, const std::string& text);
    void write(const std::string& path, double number);
    void write(const std::string& path, std::int64_t number);
    void write(const std::string& path, const std::vector<double>& numbers);
    void write(const std::string& path, const std::vector<std::int64_t>& numbers);

    /// The file; nothing can be written after.
    std::string bytes();

  private:
    void write_array(const std::string& path, std::int64_t file_type, std::int64_t memory_type,
                     std::size_t size, const void* values);

    Hdf5Object file_;
    Hdf5Object links_;  ///< how all are made
};

/// Every reading function throws SystemError where there is no such object of that kind at `path`.
class Hdf5Reader {
  public:
    /// Throws SystemError where the bytes are no HDF5 file.
    explicit Hdf5Reader(std::string_view bytes);
    bool has(const std::string& path) const;
    void read(const std::string& path, std::string& text) const;
    void read(const std::string& path, double& number) const;
    void read(const std::string& path, int& number) const;
    void read(const std::string& path, std::int64_t& number) const;
    void read(const std::string& path, std::vector<double>& numbers) const;
    void read(const std::string& path, std::vector<std::int64_t>& numbers) const;

  private:
    template <typename Number>
    void read_array(const std::string& path, std::int64_t memory_type, std::vector<Number>& values) const;

    Hdf5Object file_;
};

}  // namespace thermocontact::output
