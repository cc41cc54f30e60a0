#include "output/vtu.h"

#include <gtest/gtest.h>

#include <limits>

#include "base64.h"
#include "support/dense.h"

namespace thermocontact::output {
namespace {

TEST(Base64, TestDecoderKnowsTheStandardsExamples) {  // RFC 4648, section 10
    for (const auto& [text, code] :
         std::vector<std::pair<std::string, std::string>>{{"", ""},
                                                          {"f", "Zg=="},
                                                          {"fo", "Zm8="},
                                                          {"foo", "Zm9v"},
                                                          {"foob", "Zm9vYg=="},
                                                          {"foobar", "Zm9vYmFy"}}) {
        const auto bytes = decode_base64(code);
        EXPECT_EQ(std::string(bytes.begin(), bytes.end()), text);
    }
}

VtuGrid grid_of(std::size_t cells) {
    VtuGrid grid{{}, 5, 3, {}, {}, {}, {}, {}};
    grid.points = support::random_numbers(3 * (cells + 2));
    for (std::size_t i = 0; i < cells; ++i) {
        const auto first = static_cast<std::int64_t>(i);
        grid.connectivity.insert(grid.connectivity.end(), {first, first + 1, first + 2});
    }
    return grid;
}

/// Every number comes back bit by bit, for sizes that leave all three paddings.
TEST(Vtu, RoundTrip) {
    for (std::size_t cells = 0; cells < 7; ++cells) {
        VtuGrid grid = grid_of(cells);
        grid.point_data.push_back({"displacement", 3, support::random_numbers(grid.points.size(), 2)});
        grid.point_data.push_back({"temperature", 1, support::random_numbers(cells + 2, 3)});
        grid.cell_data.push_back({"stress", 6, support::random_numbers(6 * cells, 4)});
        grid.point_integers.push_back({"state", std::vector<std::int32_t>(cells + 2, -7)});
        grid.cell_integers.push_back({"boundary", std::vector<std::int32_t>(cells, 3)});
        grid.point_data[1].values[0] = std::numeric_limits<double>::denorm_min();
        grid.point_data[1].values[1] = -0.0;
        const std::string text = to_vtu(grid);
        EXPECT_EQ(read_array<double>(text, "Points", "Float64", 3), grid.points);
        EXPECT_EQ(read_array<std::int64_t>(text, "connectivity", "Int64", 1), grid.connectivity);
        EXPECT_EQ(read_array<double>(text, "displacement", "Float64", 3), grid.point_data[0].values);
        EXPECT_EQ(read_array<double>(text, "temperature", "Float64", 1), grid.point_data[1].values);
        EXPECT_EQ(read_array<double>(text, "stress", "Float64", 6), grid.cell_data[0].values);
        EXPECT_EQ(read_array<std::int32_t>(text, "state", "Int32", 1), grid.point_integers[0].values);
        EXPECT_EQ(read_array<std::int32_t>(text, "boundary", "Int32", 1), grid.cell_integers[0].values);
        EXPECT_EQ(read_array<std::uint8_t>(text, "types", "UInt8", 1), std::vector<std::uint8_t>(cells, 5));
        const auto offsets = read_array<std::int64_t>(text, "offsets", "Int64", 1);
        ASSERT_EQ(offsets.size(), cells);
        for (std::size_t i = 0; i < cells; ++i) {
            EXPECT_EQ(offsets[i], static_cast<std::int64_t>(3 * (i + 1)));
        }
        EXPECT_EQ(between(text, "NumberOfPoints=\"", "\""), std::to_string(cells + 2));
        EXPECT_EQ(between(text, "NumberOfCells=\"", "\""), std::to_string(cells));
    }
}

TEST(Vtu, SaysHowItIsWritten) {
    const std::string text = to_vtu(grid_of(1));
    for (const char* attribute :
         {"type=\"UnstructuredGrid\"", "byte_order=\"LittleEndian\"", "header_type=\"UInt64\""}) {
        EXPECT_NE(text.substr(0, text.find("<Piece")).find(attribute), std::string::npos) << attribute;
    }
    EXPECT_EQ(text.find("compressor"), std::string::npos);
}

/// Point data stands in PointData, cell data in CellData.
TEST(Vtu, DataStandsInItsSection) {
    VtuGrid grid = grid_of(1);
    grid.point_data.push_back({"of_points", 1, {1, 2, 3}});
    grid.cell_data.push_back({"of_cells", 1, {4}});
    const std::string text = to_vtu(grid);
    const std::string points = between(text, "<PointData>", "</PointData>"),
                      cells = between(text, "<CellData>", "</CellData>");
    EXPECT_NE(points.find("of_points"), std::string::npos);
    EXPECT_EQ(points.find("of_cells"), std::string::npos);
    EXPECT_NE(cells.find("of_cells"), std::string::npos);
}

TEST(Pvd, ListsFilesInOrderWithExactTimes) {
    const double third = 1.0 / 3.0;
    const std::string text = to_pvd({{0.0, 0, "fields/body_000000.vtu"},
                                     {0.0, 1, "fields/contact_000000.vtu"},
                                     {third, 0, "fields/body_000001.vtu"}});
    EXPECT_NE(text.find("type=\"Collection\""), std::string::npos);
    std::vector<std::string> sets;
    for (std::size_t at = text.find("<DataSet "); at != std::string::npos;
         at = text.find("<DataSet ", at + 1)) {
        sets.push_back(text.substr(at, text.find("/>", at) - at));
    }
    ASSERT_EQ(sets.size(), 3U);
    EXPECT_EQ(between(sets[1], "part=\"", "\""), "1");
    EXPECT_EQ(between(sets[1], "file=\"", "\""), "fields/contact_000000.vtu");
    EXPECT_EQ(between(sets[2], "part=\"", "\""), "0");
    EXPECT_EQ(std::stod(between(sets[2], "timestep=\"", "\"")), third);
}

}  // namespace
}  // namespace thermocontact::output
