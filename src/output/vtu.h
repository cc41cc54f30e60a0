/// VTK's unstructured grids in XML, numbers inline in base64.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace thermocontact::output {

struct VtuArray {
    std::string name;
    int components;
    std::vector<double> values;
};

struct VtuIntegers {
    std::string name;
    std::vector<std::int32_t> values;
};

/// One grid of cells of one type.
struct VtuGrid {
    std::vector<double> points;  ///< [points][3]
    std::uint8_t cell_type;      ///< VTK's number
    int nodes_per_cell;
    std::vector<std::int64_t> connectivity;  ///< [cells][nodes_per_cell], VTK's order of nodes
    std::vector<VtuArray> point_data, cell_data;
    std::vector<VtuIntegers> point_integers, cell_integers;
};

std::string to_vtu(const VtuGrid& grid);

/// A grid whose pieces, each a VTU with the arrays of `shape`, lie in `files` beside the PVTU.
std::string to_pvtu(const VtuGrid& shape, const std::vector<std::string>& files);

/// A time series: the files of each time, one part after another.
struct PvdEntry {
    double time;
    int part;
    std::string file;  ///< relative to the collection
};

std::string to_pvd(const std::vector<PvdEntry>& entries);

}  // namespace thermocontact::output
