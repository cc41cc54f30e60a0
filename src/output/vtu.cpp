#include "output/vtu.h"

#include <cstring>

#include "number.h"

namespace thermocontact::output {
namespace {

constexpr char alphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::string base64(const std::vector<std::uint8_t>& bytes) {
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t left = bytes.size() - i;
        const std::uint32_t word = static_cast<std::uint32_t>(bytes[i]) << 16U |
                                   (left > 1 ? static_cast<std::uint32_t>(bytes[i + 1]) << 8U : 0U) |
                                   (left > 2 ? static_cast<std::uint32_t>(bytes[i + 2]) : 0U);
        text += alphabet[word >> 18U & 63U];
        text += alphabet[word >> 12U & 63U];
        text += left > 1 ? alphabet[word >> 6U & 63U] : '=';
        text += left > 2 ? alphabet[word & 63U] : '=';
    }
    return text;
}

/// VTK's inline binary: the number of bytes, then the bytes, encoded together.
template <typename Number>
std::string encode(const std::vector<Number>& values) {
    const std::uint64_t size = values.size() * sizeof(Number);
    std::vector<std::uint8_t> bytes(sizeof size + size);
    std::memcpy(bytes.data(), &size, sizeof size);
    if (size > 0) {
        std::memcpy(bytes.data() + sizeof size, values.data(), size);
    }
    return base64(bytes);
}

template <typename Number>
std::string data_array(const std::string& name, const char* type, int components,
                       const std::vector<Number>& values) {
    return "<DataArray type=\"" + std::string(type) + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
           std::to_string(components) + "\" format=\"binary\">" + encode(values) + "</DataArray>\n";
}

std::string data_section(const char* tag, const std::vector<VtuArray>& arrays,
                         const std::vector<VtuIntegers>& integers) {
    std::string text = std::string("<") + tag + ">\n";
    for (const VtuArray& array : arrays) {
        text += data_array(array.name, "Float64", array.components, array.values);
    }
    for (const VtuIntegers& array : integers) {
        text += data_array(array.name, "Int32", 1, array.values);
    }
    return text + "</" + tag + ">\n";
}

std::string declared(const char* type, const std::string& name, int components) {
    return "<PDataArray type=\"" + std::string(type) + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
           std::to_string(components) + "\"/>\n";
}

std::string declared_section(const char* tag, const std::vector<VtuArray>& arrays,
                             const std::vector<VtuIntegers>& integers) {
    std::string text = std::string("<") + tag + ">\n";
    for (const VtuArray& array : arrays) {
        text += declared("Float64", array.name, array.components);
    }
    for (const VtuIntegers& array : integers) {
        text += declared("Int32", array.name, 1);
    }
    return text + "</" + tag + ">\n";
}

}  // namespace

std::string to_pvtu(const VtuGrid& shape, const std::vector<std::string>& files) {
    std::string pieces;
    for (const std::string& file : files) {
        pieces += "<Piece Source=\"" + file + "\"/>\n";
    }
    return "<?xml version=\"1.0\"?>\n"
           "<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
           "header_type=\"UInt64\">\n<PUnstructuredGrid GhostLevel=\"0\">\n<PPoints>\n" +
           declared("Float64", "Points", 3) + "</PPoints>\n" +
           declared_section("PPointData", shape.point_data, shape.point_integers) +
           declared_section("PCellData", shape.cell_data, shape.cell_integers) + pieces +
           "</PUnstructuredGrid>\n</VTKFile>\n";
}

std::string to_vtu(const VtuGrid& grid) {
    const std::size_t cells = grid.connectivity.size() / static_cast<std::size_t>(grid.nodes_per_cell);
    std::vector<std::int64_t> offsets(cells);
    for (std::size_t i = 0; i < cells; ++i) {
        offsets[i] = static_cast<std::int64_t>(i + 1) * grid.nodes_per_cell;
    }
    return "<?xml version=\"1.0\"?>\n"
           "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
           "header_type=\"UInt64\">\n"
           "<UnstructuredGrid>\n<Piece NumberOfPoints=\"" +
           std::to_string(grid.points.size() / 3) + "\" NumberOfCells=\"" + std::to_string(cells) +
           "\">\n<Points>\n" + data_array("Points", "Float64", 3, grid.points) + "</Points>\n<Cells>\n" +
           data_array("connectivity", "Int64", 1, grid.connectivity) +
           data_array("offsets", "Int64", 1, offsets) +
           data_array("types", "UInt8", 1, std::vector<std::uint8_t>(cells, grid.cell_type)) + "</Cells>\n" +
           data_section("PointData", grid.point_data, grid.point_integers) +
           data_section("CellData", grid.cell_data, grid.cell_integers) +
           "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

std::string to_pvd(const std::vector<PvdEntry>& entries) {
    std::string text =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
        "<Collection>\n";
    for (const PvdEntry& entry : entries) {
        text += "<DataSet timestep=\"" + exact_text(entry.time) + "\" group=\"\" part=\"" +
                std::to_string(entry.part) + "\" file=\"" + entry.file + "\"/>\n";
    }
    return text + "</Collection>\n</VTKFile>\n";
}

}  // namespace thermocontact::output
