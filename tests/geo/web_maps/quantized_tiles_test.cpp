// Tiles of terrain for globes: read by their specification alone, and held against the surface.
#include "geo/web_maps/quantized_tiles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <iterator>
#include <map>
#include <random>
#include <set>

#include "core/earth/ellipsoid.h"
#include "geo/together/region_ground.h"
#include "tests/support/made_terrain.h"
#include "tests/support/test_data.h"
#include "tests/support/three_grids.h"

namespace oro {
namespace {
namespace fs = std::filesystem;

// Source: github.com/CesiumGS/quantized-mesh, README.
struct ReadTerrain {
    glm::dvec3 centre{}, sphere{}, horizon{};
    float lowest_m{}, highest_m{};
    double radius_m{};
    std::array<std::vector<int>, 3> values;  // u, v, height
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::array<std::vector<int>, 4> edges;  // west, south, east, north
    bool all_read{};
};

class ByteReader {
  public:
    explicit ByteReader(std::string bytes) : bytes_(std::move(bytes)) {}
    template <class Value>
    Value next() {
        Value value{};
        if (at_ + sizeof(Value) > bytes_.size()) {
            ADD_FAILURE() << "too short";
            return value;
        }
        std::memcpy(&value, bytes_.data() + at_, sizeof(Value));
        at_ += sizeof(Value);
        return value;
    }
    glm::dvec3 point() {
        const auto x = next<double>(), y = next<double>();
        return {x, y, next<double>()};
    }
    bool at_end() const { return at_ == bytes_.size(); }

  private:
    std::string bytes_;
    std::size_t at_{};
};

ReadTerrain read_terrain(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    ByteReader bytes(std::string(std::istreambuf_iterator<char>(file), {}));
    ReadTerrain read;
    read.centre = bytes.point();
    read.lowest_m = bytes.next<float>();
    read.highest_m = bytes.next<float>();
    read.sphere = bytes.point();
    read.radius_m = bytes.next<double>();
    read.horizon = bytes.point();
    const auto count = bytes.next<std::uint32_t>();
    for (std::vector<int>& of : read.values) {
        int value = 0;
        for (std::uint32_t i = 0; i < count; ++i) {
            const int zigzag = bytes.next<std::uint16_t>();
            of.push_back(value += (zigzag >> 1) ^ -(zigzag & 1));
        }
    }
    const auto triangles = bytes.next<std::uint32_t>();
    std::uint32_t highest = 0;
    for (std::uint32_t i = 0; i < triangles; ++i) {
        auto& triangle = read.triangles.emplace_back();
        for (std::uint32_t& index : triangle) {
            const std::uint32_t code = bytes.next<std::uint16_t>();
            index = highest - code;
            if (code == 0) ++highest;
            EXPECT_LT(index, count);
        }
    }
    for (std::vector<int>& edge : read.edges) {
        const auto posts = bytes.next<std::uint32_t>();
        for (std::uint32_t i = 0; i < posts; ++i) edge.push_back(bytes.next<std::uint16_t>());
    }
    read.all_read = bytes.at_end();
    return read;
}

std::vector<fs::path> terrain_files(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".terrain") files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

struct Corner {
    double lat_deg, lon_deg, h_m;
};
Corner corner_of(const ReadTerrain& read, const fs::path& file, std::size_t i) {
    const double side =
        180.0 / std::pow(2.0, std::stoi(file.parent_path().parent_path().filename().string()));
    const double x = std::stod(file.parent_path().filename().string()), y = std::stod(file.stem().string());
    return {
        -90.0 + side * (y + read.values[1][i] / 32767.0), -180.0 + side * (x + read.values[0][i] / 32767.0),
        read.lowest_m + (static_cast<double>(read.highest_m) - read.lowest_m) * read.values[2][i] / 32767.0};
}

Region one_region(HeightField field) {
    Region region{std::vector<RegionGrid>(1)};
    region.grids[0].field = std::move(field);
    return region;
}

TEST(QuantizedTiles, CornersHaveTheGroundsHeights) {
    const Region region = test::three_grids(160);
    const auto grids = RegionGround::of(region, 1.0);
    ASSERT_TRUE(grids.ok());
    const TrueGround& ground = (*grids)->ground();
    const fs::path folder = test::scratch_folder();
    const auto written = write_quantized_tiles(folder, ground, {11, -300.0, 2}, {});
    ASSERT_TRUE(written.ok()) << written.error().line();
    const auto files = terrain_files(folder);
    EXPECT_EQ(files.size(), written->tiles.size());
    EXPECT_TRUE(fs::exists(folder / "0" / "0" / "0.terrain"));
    EXPECT_TRUE(fs::exists(folder / "0" / "1" / "0.terrain"));
    int on_ground = 0, holes = 0;
    for (const fs::path& file : files) {
        const ReadTerrain read = read_terrain(file);
        EXPECT_TRUE(read.all_read);
        ASSERT_EQ(read.values[0].size(), 65U * 65U);
        ASSERT_EQ(read.triangles.size(), 2U * 64U * 64U);
        const double half_step_m = 0.5 * (static_cast<double>(read.highest_m) - read.lowest_m) / 32767.0;
        for (std::size_t i = 0; i < read.values[0].size(); i += 7) {
            const Corner corner = corner_of(read, file, i);
            const auto h_m = ground.h_m(corner.lat_deg, corner.lon_deg);
            (h_m ? on_ground : holes) += 1;
            const double is_m = h_m ? *h_m : -300.0 + ground.N_m(corner.lat_deg, corner.lon_deg);
            EXPECT_NEAR(corner.h_m, is_m, half_step_m + 1e-6) << file;
            const glm::dvec3 at = ecef_from_geodetic({corner.lat_deg, corner.lon_deg, corner.h_m}).m;
            EXPECT_LE(glm::distance(at, read.sphere), read.radius_m * (1.0 + 1e-9) + 1e-3);
        }
    }
    EXPECT_GT(on_ground, 500);
    EXPECT_GT(holes, 500);
}

// The triangles of a tile turn anticlockwise and are as large as the tile; its edges are those of the square.
TEST(QuantizedTiles, TrianglesCoverTheTile) {
    const Region region = one_region(test::rough_field(47.0, 8.0, 100, 100));
    const auto grids = RegionGround::of(region, 1.0);
    ASSERT_TRUE(grids.ok());
    const fs::path folder = test::scratch_folder();
    ASSERT_TRUE(write_quantized_tiles(folder, (*grids)->ground(), {9, 0.0, 2}, {}).ok());
    const ReadTerrain read = read_terrain(terrain_files(folder).back());
    const auto& [u, v, height] = read.values;
    std::int64_t twice_area = 0;
    for (const auto& [a, b, c] : read.triangles) {
        const std::int64_t one =
            std::int64_t{u[b] - u[a]} * (v[c] - v[a]) - std::int64_t{v[b] - v[a]} * (u[c] - u[a]);
        EXPECT_GT(one, 0);
        twice_area += one;
    }
    EXPECT_EQ(twice_area, std::int64_t{2} * 32767 * 32767);
    for (std::size_t edge = 0; edge < 4; ++edge) {
        EXPECT_EQ(std::set<int>(read.edges[edge].begin(), read.edges[edge].end()).size(), 65U);
        for (const int post : read.edges[edge])
            EXPECT_EQ((edge % 2 == 0 ? u : v)[static_cast<std::size_t>(post)], edge < 2 ? 0 : 32767);
    }
}

// Where the horizon hides a tile's point of occlusion it hides all corners: none of the lines from such an
// eye to a corner passes the ellipsoid by.
TEST(QuantizedTiles, HorizonHidesNothingThatIsSeen) {
    constexpr unsigned seed = 20261128;
    std::printf("seed %u\n", seed);
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    const Region region = one_region(test::rough_field(47.0, 8.0, 100, 100));
    const auto grids = RegionGround::of(region, 1.0);
    ASSERT_TRUE(grids.ok());
    const fs::path folder = test::scratch_folder();
    ASSERT_TRUE(write_quantized_tiles(folder, (*grids)->ground(), {8, 0.0, 2}, {}).ok());
    const glm::dvec3 radii(wgs84_a_m, wgs84_a_m, wgs84_b_m);
    int hidden = 0, seen = 0;
    for (const fs::path& file : terrain_files(folder)) {
        const ReadTerrain read = read_terrain(file);
        for (int i = 0; i < 300; ++i) {
            // In the scaled space, where the ellipsoid is a sphere.
            const glm::dvec3 eye = (1.0005 + std::abs(normal(random)) * 0.3) *
                                   glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
            const auto hides = [&](const glm::dvec3& point) {
                const double to_horizon = glm::dot(eye, eye) - 1.0, along = -glm::dot(point - eye, eye);
                return along > to_horizon && along * along > to_horizon * glm::dot(point - eye, point - eye);
            };
            if (!hides(read.horizon)) {
                ++seen;
                continue;
            }
            ++hidden;
            for (std::size_t j = 0; j < read.values[0].size(); j += 11) {
                const Corner corner = corner_of(read, file, j);
                EXPECT_TRUE(
                    hides(ecef_from_geodetic({corner.lat_deg, corner.lon_deg, corner.h_m}).m / radii));
            }
        }
    }
    EXPECT_GT(hidden, 300);
    EXPECT_GT(seen, 100);
}

// H = 123.44 m everywhere and no geoid: a tile of one height is exact but for float.
TEST(QuantizedTiles, ErrorIsThatOfTheQuads) {
    const Region level =
        one_region(test::made_field(47.0, 8.0, 1200.0, 200, 200, [](double, double) { return 123.44F; }));
    const auto flat = RegionGround::of(level, 1.0);
    ASSERT_TRUE(flat.ok());
    const QuantizedTilesRequest request{12, 0.0, 2};
    const auto tiles = write_quantized_tiles(test::scratch_folder(), (*flat)->ground(), request, {});
    ASSERT_TRUE(tiles.ok());
    const auto none = quantized_tiles_error((*flat)->ground(), *tiles, request, 500);
    ASSERT_TRUE(none.ok());
    EXPECT_LT(none->back().largest_m, 0.01);
    EXPECT_GT(none->back().places, 400U);
    // A ridge of 100 m along a meridian, as narrow as two posts, 126 m: quads of zoom 8 are 840 m wide there.
    const Region ridge = one_region(test::made_field(47.0, 8.0, 1200.0, 200, 200, [](double, double lon) {
        return std::abs(lon - 8.08) < 1.0e-6 ? 100.0F : 0.0F;
    }));
    const auto narrow = RegionGround::of(ridge, 1.0);
    ASSERT_TRUE(narrow.ok());
    const QuantizedTilesRequest deep{14, 0.0, 2};
    const auto ridge_tiles = write_quantized_tiles(test::scratch_folder(), (*narrow)->ground(), deep, {});
    ASSERT_TRUE(ridge_tiles.ok());
    const auto errors = quantized_tiles_error((*narrow)->ground(), *ridge_tiles, deep, 4000);
    ASSERT_TRUE(errors.ok());
    EXPECT_GT((*errors)[8].largest_m, 50.0);
    EXPECT_LT(errors->back().largest_m, 15.0);
    EXPECT_LT(errors->back().rms_m, (*errors)[8].rms_m);
}

TEST(QuantizedTiles, AvailableOnesAreThoseThatAreThere) {
    // Over the antimeridian.
    const Region region =
        one_region(test::made_field(10.0, 179.8, 600.0, 240, 240, [](double lat, double lon) {
            return lat < 9.9 && lon > 180.0 && lon < 180.1 ? void_height_m : 50.0F;
        }));
    const auto grids = RegionGround::of(region, 1.0);
    ASSERT_TRUE(grids.ok());
    const fs::path folder = test::scratch_folder(), again = test::scratch_folder();
    const auto written = write_quantized_tiles(folder, (*grids)->ground(), {11, 0.0, 1}, {});
    ASSERT_TRUE(written.ok());
    std::set<std::string> named, there;
    for (int zoom = 0; zoom <= 11; ++zoom)
        for (const auto& one : written->rectangles(zoom))
            for (std::int64_t x = one.first_x; x <= one.last_x; ++x)
                for (std::int64_t y = one.first_y; y <= one.last_y; ++y) {
                    const auto name =
                        std::to_string(zoom) + "/" + std::to_string(x) + "/" + std::to_string(y) + ".terrain";
                    EXPECT_TRUE(named.insert(name).second) << name;
                }
    for (const fs::path& file : terrain_files(folder)) there.insert(fs::relative(file, folder).string());
    EXPECT_EQ(named, there);
    EXPECT_TRUE(fs::exists(folder / "11" / "0"));
    EXPECT_TRUE(fs::exists(folder / "11" / "4095"));
    ASSERT_TRUE(write_quantized_tiles(again, (*grids)->ground(), {11, 0.0, 5}, {}).ok());
    for (const std::string& name : there) {
        std::ifstream a(folder / name, std::ios::binary), b(again / name, std::ios::binary);
        EXPECT_TRUE(std::equal(std::istreambuf_iterator<char>(a), {}, std::istreambuf_iterator<char>(b), {}));
    }
}

}  // namespace
}  // namespace oro
