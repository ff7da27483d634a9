// Meshes that are read and placed in scratch files: the same ones, and what is said where there is no room.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "geo/meshes/mesh_file.h"
#include "geo/meshes/placed_mesh.h"
#include "geo/opening/open_region.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

namespace fs = std::filesystem;

// A sheet of 401 x 401 vertices in the bundled data: 320,000 triangles, one without an area, one given twice.
constexpr int across = 401;
constexpr std::size_t triangles_given = 320'000;
std::string sheet_text(bool is_ply) {
    std::string text;
    char line[120];
    if (is_ply)
        text +=
            "ply\nformat ascii 1.0\nelement vertex 160801\nproperty double x\nproperty double y\n"
            "property double z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
            "element face 320002\nproperty list uchar int vertex_indices\nend_header\n";
    for (int row = 0; row < across; ++row)
        for (int column = 0; column < across; ++column) {
            const double x = -84.18 + 2.0e-5 * column, y = 36.60 + 2.0e-5 * row,
                         z = 500.0 + (row * column) % 7;
            std::snprintf(line, sizeof line, is_ply ? "%.5f %.5f %.1f %d 20 30\n" : "v %.5f %.5f %.1f\n", x,
                          y, z, column % 256);
            text += line;
        }
    const int first = is_ply ? 0 : 1;
    const auto add = [&](int a, int b, int c) {
        std::snprintf(line, sizeof line, is_ply ? "3 %d %d %d\n" : "f %d %d %d\n", first + a, first + b,
                      first + c);
        text += line;
    };
    for (int row = 0; row + 1 < across; ++row)
        for (int column = 0; column + 1 < across; ++column) {
            const int at = across * row + column;
            add(at, at + 1, at + across), add(at + 1, at + across + 1, at + across);
        }
    add(0, 1, across), add(5, 5, 9);
    return text;
}

MeshRequest request_of(const fs::path& path, bool is_ply) {
    std::ofstream(path, std::ios::binary) << sheet_text(is_ply);
    MeshRequest request;
    request.files = {path.string()}, request.crs = "EPSG:4326";
    return request;
}

bool operator==(const PlacedVertex& a, const PlacedVertex& b) {
    return a.lat_deg == b.lat_deg && a.lon_deg == b.lon_deg && a.H_m == b.H_m;
}

TEST(ScratchMeshes, AreThoseThatAreInMemory) {
    for (const bool is_ply : {true, false}) {
        const fs::path folder = test::scratch_folder();
        const MeshRequest request =
            request_of(test::scratch_folder() / (is_ply ? "sheet.ply" : "sheet.obj"), is_ply);
        const auto scratch = std::make_shared<ScratchMemory>(folder.string());
        const auto in_memory = open_meshes(request, false, {});
        ASSERT_TRUE(in_memory.ok()) << in_memory.error().line();
        {
            const auto in_files = open_meshes(request, false, {}, {}, scratch);
            ASSERT_TRUE(in_files.ok()) << in_files.error().line();
            const PlacedMesh &one = (*in_memory)->front(), &other = (*in_files)->front();
            ASSERT_EQ(other.triangles.size(), triangles_given);
            EXPECT_TRUE(std::ranges::equal(one.vertices, other.vertices,
                                           [](const auto& a, const auto& b) { return a == b; }));
            EXPECT_EQ(one.triangles, other.triangles);
            EXPECT_EQ(one.colours, other.colours);
            EXPECT_EQ(one.colours.size(), is_ply ? 160'801U : 0U);
            EXPECT_EQ(one.fingerprint, other.fingerprint);
            EXPECT_EQ(note_of_mesh(one), note_of_mesh(other));
            // What is left: vertices of 24 bytes and room for 320,002 triangles of 12, in files.
            EXPECT_EQ(scratch->bytes().in_files, 24U * 160'801 + 12U * 320'002);
            EXPECT_TRUE(fs::is_empty(folder));
        }
        EXPECT_EQ(scratch->bytes().in_files, 0U);
    }
}

// The file's own line is the same, wherever its bytes lie.
TEST(ScratchMeshes, AreRefusedAsInMemory) {
    const fs::path path = test::scratch_folder() / "cut.ply";
    const std::string text = sheet_text(true);
    std::ofstream(path, std::ios::binary) << text.substr(0, text.size() - 8);
    const auto scratch = std::make_shared<ScratchMemory>(test::scratch_folder().string());
    const auto in_files = read_mesh(path.string(), "", scratch), in_memory = read_mesh(path.string());
    ASSERT_FALSE(in_files.ok());
    ASSERT_FALSE(in_memory.ok());
    EXPECT_EQ(in_files.error().line(), in_memory.error().line());
    EXPECT_EQ(scratch->bytes().in_files, 0U);
}

TEST(ScratchMeshes, WithoutRoomSayWhereAndWhy) {
    RegionRequest request;
    request.paths = {(test::bundled_data() / "jacksboro.tif").string()};
    request.meshes = request_of(test::scratch_folder() / "sheet.ply", true);
    const auto region = open_region_in_scratch(request, {}, "/nowhere/at/all");
    ASSERT_FALSE(region.ok());
    EXPECT_TRUE(region.error().line().starts_with("/nowhere/at/all: no room for a scratch file of "))
        << region.error().line();
    EXPECT_TRUE(region.error().line().ends_with(": No such file or directory")) << region.error().line();
    const fs::path folder = test::scratch_folder();
    const auto with_room = open_region_in_scratch(request, {}, folder.string());
    ASSERT_TRUE(with_room.ok()) << with_room.error().line();
    EXPECT_EQ(with_room->meshes->front().triangles.size(), triangles_given);
    EXPECT_TRUE(fs::is_empty(folder));
}

}  // namespace
}  // namespace oro
