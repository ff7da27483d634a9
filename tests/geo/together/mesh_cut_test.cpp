// Terrain cut out under a mesh: each place is covered once, heights beside the mesh stay, and no line of
// sight gets through the rim.
#include "geo/together/mesh_cut.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "core/truth/oracle.h"
#include "geo/together/mesh_detail.h"
#include "geo/together/region_ground.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

constexpr double middle_lat_deg = 46.97, middle_lon_deg = 8.03;

// A pit: a star of some 300 m whose rim is `deep_m` under the ground, and twice as deep in its middle.
PlacedMesh pit(const HeightField& field, double deep_m, int corners) {
    PlacedMesh mesh;
    mesh.path = "pit.xml", mesh.format = "LandXML";
    const double H_m = *field.surface_H_m(middle_lat_deg, middle_lon_deg);
    mesh.vertices.push_back({middle_lat_deg, middle_lon_deg, H_m - 2.0 * deep_m});
    for (int i = 0; i < corners; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / corners, far_deg = i % 2 == 0 ? 0.0027 : 0.0019;
        PlacedVertex at{middle_lat_deg + far_deg * std::sin(angle),
                        middle_lon_deg + 1.4 * far_deg * std::cos(angle), 0.0};
        at.H_m = *field.surface_H_m(at.lat_deg, at.lon_deg) - deep_m;
        mesh.vertices.push_back(at);
    }
    for (int i = 0; i < corners; ++i)
        mesh.triangles.push_back(
            {0, static_cast<std::uint32_t>(1 + i), static_cast<std::uint32_t>(1 + (i + 1) % corners)});
    mesh.in_file = mesh.not_added = mesh.triangles.size();
    return mesh;
}

// How many of a mesh's triangles lie over a place, from above: those of the file, then those added.
std::pair<int, int> over(const PlacedMesh& mesh, double lat_deg, double lon_deg) {
    std::pair<int, int> count{0, 0};
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        int positive = 0, negative = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const PlacedVertex &a = mesh.vertices[mesh.triangles[i][k]],
                               &b = mesh.vertices[mesh.triangles[i][(k + 1) % 3]];
            const double side = (b.lat_deg - a.lat_deg) * (lon_deg - a.lon_deg) -
                                (b.lon_deg - a.lon_deg) * (lat_deg - a.lat_deg);
            ++(side > 0.0 ? positive : negative);
        }
        if (positive == 3 || negative == 3) ++(i < mesh.not_added ? count.first : count.second);
    }
    return count;
}

HeightField made_ground() {
    return test::made_field(47.0, 8.0, 1200.0, 90, 90, [](double lat_deg, double lon_deg) {
        return static_cast<float>(test::Waves{500.0, 60.0, 900.0, 5}.H_m(lat_deg, lon_deg));
    });
}

// The height of a cell that is split from its north-west post to its south-east one, as cut cells are.
double H_of_halves(const HeightField& field, const PlacedVertex& at) {
    const PostNumber post = field.grid.post_at(at.lat_deg, at.lon_deg);
    const double row = std::floor(post.row), column = std::floor(post.column);
    const double down = post.row - row, right = post.column - column;
    const auto H_m = [&](int south, int east) {
        const int r = std::min(static_cast<int>(row) + south, field.grid.rows() - 1),
                  c = std::min(static_cast<int>(column) + east, field.grid.columns() - 1);
        return static_cast<double>(field.H_at_post_m(r, c));
    };
    if (down >= right) return H_m(0, 0) + down * (H_m(1, 0) - H_m(0, 0)) + right * (H_m(1, 1) - H_m(1, 0));
    return H_m(0, 0) + right * (H_m(0, 1) - H_m(0, 0)) + down * (H_m(1, 1) - H_m(0, 1));
}

TEST(MeshCut, EachPlaceIsCoveredOnce) {
    const unsigned seed = 5204;
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> off(-0.0045, 0.0045);
    const HeightField before = made_ground();
    for (const int corners : {3, 8, 41}) {
        HeightField field = before;
        PlacedMesh mesh = pit(before, 20.0, corners);
        const auto cut = cut_under(field, mesh);
        ASSERT_TRUE(cut.ok()) << cut.error().line();
        int in_pit = 0, beside = 0, terrain = 0;
        for (int i = 0; i < 3000; ++i) {
            const double lat_deg = middle_lat_deg + off(random), lon_deg = middle_lon_deg + 1.4 * off(random);
            const bool is_ground = field.surface_H_m(lat_deg, lon_deg).has_value();
            const auto [file, added] = over(mesh, lat_deg, lon_deg);
            ASSERT_EQ((is_ground ? 1 : 0) + file + added, 1) << lat_deg << ", " << lon_deg;
            in_pit += file, beside += added, terrain += is_ground ? 1 : 0;
        }
        EXPECT_GT(in_pit, 100);
        EXPECT_GT(beside, 50);
        EXPECT_GT(terrain, 300);
        // What was added lies on the terrain's posts, or between them.
        for (std::size_t i = mesh.not_added; i < mesh.triangles.size(); ++i)
            for (const std::uint32_t corner : mesh.triangles[i]) {
                const PlacedVertex& at = mesh.vertices[corner];
                EXPECT_NEAR(at.H_m, H_of_halves(before, at), 1.0e-3) << "m";
            }
    }
}

// From above and aslant, on all sides of the pit: without walls some lines get through, with them none, nor
// where the mesh is drawn by its clusters.
TEST(MeshCut, NoLineOfSightGetsThroughTheRim) {
    const unsigned seed = 5205;
    SCOPED_TRACE("seed " + std::to_string(seed));
    for (const auto& [has_walls, by_clusters] : {std::pair(true, false), {true, true}, {false, false}}) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> off(-0.004, 0.004), share(0.0, 1.0);
        Region region{std::vector<RegionGrid>(1)};
        region.grids[0].field = made_ground();
        PlacedMesh mesh = pit(region.grids[0].field, 20.0, 9);
        const auto cut = cut_under(region.grids[0].field, mesh);
        ASSERT_TRUE(cut.ok()) << cut.error().line();
        if (!has_walls) mesh.rim_walls.clear();
        region.meshes = std::make_shared<const std::vector<PlacedMesh>>(1, mesh);
        if (by_clusters) {
            const auto drawn = MeshDetail::of(region, 1.0, 2).cut(Camera{}, 1.0, {}, 0);
            ASSERT_TRUE(drawn.ok()) << drawn.error().line();
            region.meshes = drawn->meshes;
        }
        const auto ground = RegionGround::of(region, 1.0);
        ASSERT_TRUE(ground.ok()) << ground.error().line();
        int through = 0;
        for (int eye = 0; eye < 20; ++eye) {
            const Geodetic from{middle_lat_deg + 2.0 * off(random), middle_lon_deg + 2.0 * off(random),
                                900.0 + 400.0 * share(random)};
            const Oracle oracle((*ground)->ground(), sight_from(from));
            for (int line = 0; line < 200; ++line) {
                const Geodetic to{middle_lat_deg + off(random), middle_lon_deg + 1.4 * off(random), 430.0};
                const glm::dvec3 along = ecef_from_geodetic(to).m - ecef_from_geodetic(from).m;
                if (!oracle.first_hit(glm::normalize(along), 5000.0)) ++through;
            }
        }
        if (has_walls)
            EXPECT_EQ(through, 0);
        else
            EXPECT_GT(through, 5);
    }
}

TEST(MeshCut, RefusesWhatHasNoOutline) {
    HeightField field = made_ground();
    PlacedMesh mesh = pit(field, 5.0, 8);
    PlacedMesh twice = mesh;
    for (const SourceTriangle& triangle : mesh.triangles)
        twice.triangles.push_back({triangle[0], triangle[2], triangle[1]});
    const auto cut = cut_under(field, twice);
    ASSERT_FALSE(cut.ok());
    EXPECT_EQ(cut.error().line(),
              "--cut-under: pit.xml: its triangles lie over each other from above: it has no one outline");
    // Beside the grid nothing is cut.
    for (PlacedVertex& vertex : mesh.vertices) vertex.lat_deg += 5.0;
    const std::vector<float> H_m = field.H_m;
    ASSERT_TRUE(cut_under(field, mesh).ok());
    EXPECT_EQ(field.H_m, H_m);
    EXPECT_TRUE(mesh.rim_walls.empty());
}

}  // namespace
}  // namespace oro
