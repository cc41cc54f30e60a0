#include "mesh/gmsh_bytes.h"

#include <cstring>
#include <type_traits>

namespace thermocontact::mesh {
namespace {

class Writer {
  public:
    template <typename Number>
    void number(Number value) {
        static_assert(std::is_trivially_copyable_v<Number>);
        bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
    }
    template <typename List>
    void list(const List& values) {
        number(values.size());
        bytes.append(reinterpret_cast<const char*>(values.data()),
                     values.size() * sizeof(typename List::value_type));
    }

    std::string bytes;
};

class Reader {
  public:
    explicit Reader(const std::string& bytes) : next_(bytes.data()) {}

    template <typename Number>
    Number number() {
        Number value;
        std::memcpy(&value, next_, sizeof(value));
        next_ += sizeof(value);
        return value;
    }
    template <typename List>
    void list(List& values) {
        values.resize(number<std::size_t>());
        const std::size_t size = values.size() * sizeof(typename List::value_type);
        if (size > 0) {
            std::memcpy(values.data(), next_, size);
        }
        next_ += size;
    }

  private:
    const char* next_;
};

}  // namespace

std::string to_bytes(const GmshContents& contents) {
    Writer writer;
    writer.list(contents.node_tags);
    writer.list(contents.points);
    writer.number(contents.groups.size());
    for (const GmshGroup& group : contents.groups) {
        writer.number(group.dimension);
        writer.number(group.tag);
        writer.list(group.name);
        writer.list(group.entities);
    }
    writer.number(contents.elements.size());
    for (const GmshElements& elements : contents.elements) {
        writer.number(elements.dimension);
        writer.number(elements.entity);
        writer.number(elements.type);
        writer.list(elements.type_name);
        writer.list(elements.tags);
        writer.list(elements.nodes);
    }
    return std::move(writer.bytes);
}

GmshContents from_bytes(const std::string& bytes) {
    Reader reader(bytes);
    GmshContents contents;
    reader.list(contents.node_tags);
    reader.list(contents.points);
    contents.groups.resize(reader.number<std::size_t>());
    for (GmshGroup& group : contents.groups) {
        group.dimension = reader.number<int>();
        group.tag = reader.number<int>();
        reader.list(group.name);
        reader.list(group.entities);
    }
    contents.elements.resize(reader.number<std::size_t>());
    for (GmshElements& elements : contents.elements) {
        elements.dimension = reader.number<int>();
        elements.entity = reader.number<int>();
        elements.type = reader.number<int>();
        reader.list(elements.type_name);
        reader.list(elements.tags);
        reader.list(elements.nodes);
    }
    return contents;
}

}  // namespace thermocontact::mesh
