// Must hold: meshes cast their shadows on the ground and on each other, and the ground on them, as they do in
// truth: each pixel against the sight line from what it shows to the sun's middle.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <utility>
#include <vector>

#include "geo/meshes/placed_mesh.h"
#include "geo/together/mesh_cut.h"
#include "tests/scenes/shadows_of_pictures.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

constexpr double middle_lat_deg = 46.97, middle_lon_deg = 8.03;
constexpr double north_deg_per_m = 1.0 / 111160.0, east_deg_per_m = 1.0 / 76000.0;

// A box of so many metres around a place, from one height to another, without a floor.
void add_box(PlacedMesh& mesh, double east_m, double north_m, double wide_m, double low_H_m,
             double high_H_m) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const double H_m : {low_H_m, high_H_m})
        for (const auto& [x, y] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
            mesh.vertices.push_back({middle_lat_deg + (north_m + y * wide_m) * north_deg_per_m,
                                     middle_lon_deg + (east_m + x * wide_m) * east_deg_per_m, H_m});
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        mesh.triangles.push_back({first + a, first + b, first + c});
    };
    add(4, 5, 6), add(4, 6, 7);
    for (std::uint32_t i = 0; i < 4; ++i) {
        const std::uint32_t next = (i + 1) % 4;
        add(i, next, i + 4), add(next, next + 4, i + 4);
    }
}

struct Town {
    Region region{std::vector<RegionGrid>(1)};
    double ground_H_m{};
    std::vector<double> roofs_H_m;
    double pit_reach_m{};  // half a side of a pit, whose sides lie along the axes; 0: there is none
};

// A house, a tower beside it, and a slab that floats: what is below it lies in its shadow, too.
Town made_town() {
    Town town;
    town.region.grids[0].field =
        test::made_field(47.0, 8.0, 1200.0, 90, 90, [](double lat_deg, double lon_deg) {
            const double off = (lon_deg - middle_lon_deg + 0.0035) / 0.0012;  // a ridge in the west
            return static_cast<float>(test::Waves{500.0, 8.0, 900.0, 5}.H_m(lat_deg, lon_deg) +
                                      90.0 * std::exp(-off * off));
        });
    const HeightField& field = town.region.grids[0].field;
    town.ground_H_m = *field.surface_H_m(middle_lat_deg, middle_lon_deg);
    PlacedMesh mesh;
    mesh.path = "town.obj";
    const double low_m = town.ground_H_m - 60.0;
    for (const auto& [east_m, north_m, wide_m, roof_m] :
         {std::array{0.0, 0.0, 50.0, 25.0}, std::array{45.0, 10.0, 16.0, 70.0},
          std::array{-70.0, 40.0, 30.0, 32.0}}) {
        town.roofs_H_m.push_back(town.ground_H_m + roof_m);
        add_box(mesh, east_m, north_m, wide_m, low_m, town.roofs_H_m.back());
    }
    town.roofs_H_m.push_back(town.ground_H_m + 55.0);
    add_box(mesh, -20.0, -70.0, 40.0, town.ground_H_m + 53.0, town.roofs_H_m.back());
    town.region.meshes = std::make_shared<const std::vector<PlacedMesh>>(1, mesh);
    return town;
}

// A pit with upright walls beside the ridge, which the terrain is cut out under.
Town made_pit() {
    Town town = made_town();
    town.pit_reach_m = 110.0;
    const double floor_H_m = town.ground_H_m - 30.0;
    PlacedMesh mesh;
    mesh.path = "pit.obj";
    for (const auto& [x, y] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}})
        mesh.vertices.push_back({middle_lat_deg + y * town.pit_reach_m * north_deg_per_m,
                                 middle_lon_deg + x * town.pit_reach_m * east_deg_per_m, floor_H_m});
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.in_file = mesh.not_added = mesh.triangles.size();
    const auto cut = cut_under(town.region.grids[0].field, mesh);
    EXPECT_TRUE(cut.ok()) << cut.error().line();
    town.region.meshes = std::make_shared<const std::vector<PlacedMesh>>(1, mesh);
    return town;
}

// What a line of sight meets: 1 terrain, 2 a mesh from above, 8 its walls.
int shown_at(const Town& town, const Geodetic& at, bool is_mesh, double H_m) {
    if (!is_mesh) return 1;
    if (town.pit_reach_m > 0.0) {
        const double east_m = std::abs(at.lon_deg - middle_lon_deg) / east_deg_per_m,
                     north_m = std::abs(at.lat_deg - middle_lat_deg) / north_deg_per_m;
        const double beyond_m = std::max(east_m, north_m) - town.pit_reach_m;
        return std::abs(beyond_m) < 0.01 ? 8 : 2;
    }
    for (const double roof_H_m : town.roofs_H_m)
        if (std::abs(H_m - roof_H_m) < 0.02) return 2;
    return 8;
}

class MeshShadows : public test::ShadowsOfPictures {
  protected:
    std::uint64_t by_meshes{}, on_roofs{};

    void look_at_town(const Town& town, const Camera& camera, double azimuth_deg, double elevation_deg,
                      RasterPath path) {
        const auto cuts = cut_regions(town.region);
        ASSERT_TRUE(cuts.ok()) << cuts.error().line();
        const auto grounds = RegionGround::of(town.region, *cuts, 1.0);
        ASSERT_TRUE(grounds.ok()) << grounds.error().line();
        Scene scene = test::scene_of_grids(*gpu_, town.region, *cuts, seam_between(town.region, *cuts, 1.0));
        DepthPainter painter(*gpu_, path);
        const SineCosine a = sine_cosine_deg(azimuth_deg), e = sine_cosine_deg(elevation_deg);
        const glm::dvec3 sun_enu{e.cosine * a.sine, e.cosine * a.cosine, e.sine};
        const glm::dvec3 sun = ecef_from_enu(camera.eye.lat_deg, camera.eye.lon_deg) * sun_enu;
        DepthPictureOptions options;
        options.skyline = false;
        auto picture = painter.draw(scene, camera, test::shares_alone(sun_enu), options);
        ASSERT_TRUE(picture.ok()) << picture.error().line();
        const Oracle oracle((*grounds)->ground(), sight_from(camera.eye));
        // By pixel: 0 nothing that is asked, else what is shown (terrain 1, a roof 2) and 4 more in shadow.
        std::vector<int> truth(picture->points.size());
        std::uint64_t met_meshes = 0, roofs = 0;
        for (int y = 0; y < camera.height_px; ++y)
            for (int x = 0; x < camera.width_px; ++x) {
                const auto hit = oracle.first_hit(camera.ecef_direction_at({x + 0.5, y + 0.5}), 1.0e6);
                if (!hit) continue;
                int& here = truth[static_cast<std::size_t>(y * camera.width_px + x)];
                const double N_m = (*grounds)->ground().N_m(hit->point.lat_deg, hit->point.lon_deg);
                here = shown_at(town, hit->point, hit->mesh > 0, hit->point.h_m - N_m);
                if (here == 8) continue;  // a wall: the side that is turned away has no share
                const Ecef from =
                    ecef_from_geodetic({hit->point.lat_deg, hit->point.lon_deg, hit->point.h_m + 0.02});
                const auto shade = oracle.first_hit_from(from, sun, 1.0e6);
                if (!shade) continue;
                here += 4;
                met_meshes += shade->mesh > 0 ? 1U : 0U;
                roofs += here == 6 ? 1U : 0U;
            }
        width_px = camera.width_px, height_px = camera.height_px;
        const test::Tally tally = tally_of(truth, picture->rgba);
        std::printf(
            "sun %3.0f,%2.0f: %llu px, %llu dark, %llu by meshes, %llu on roofs, %llu differ, %llu not at an "
            "edge\n",
            azimuth_deg, elevation_deg, static_cast<unsigned long long>(tally.asked),
            static_cast<unsigned long long>(tally.dark), static_cast<unsigned long long>(met_meshes),
            static_cast<unsigned long long>(roofs), static_cast<unsigned long long>(tally.differ),
            static_cast<unsigned long long>(tally.far));
        all.asked += tally.asked, all.dark += tally.dark, all.differ += tally.differ, all.far += tally.far;
        by_meshes += met_meshes, on_roofs += roofs;
    }

    // What is drawn against what is true, but for walls and the picture's rim.
    [[nodiscard]] test::Tally tally_of(const std::vector<int>& truth,
                                       const std::vector<std::uint8_t>& rgba) const {
        test::Tally tally;
        for (int y = 2; y + 2 < height_px; ++y)
            for (int x = 2; x + 2 < width_px; ++x) {
                const auto i = static_cast<std::size_t>(y * width_px + x);
                if (truth[i] == 0 || truth[i] == 8) continue;
                const bool is_dark = truth[i] >= 4, drawn_dark = rgba[4 * i] < 188;
                ++tally.asked;
                tally.dark += is_dark ? 1U : 0U;
                if (is_dark == drawn_dark) continue;
                ++tally.differ;
                bool by_an_edge = false;
                for (int j = y - 2; j <= y + 2; ++j)
                    for (int k = x - 2; k <= x + 2; ++k)
                        by_an_edge |= truth[static_cast<std::size_t>(j * width_px + k)] != truth[i];
                tally.far += by_an_edge ? 0U : 1U;
            }
        return tally;
    }
};

TEST_F(MeshShadows, AreTheOracles) {
    const Town town = made_town();
    const auto eye = [&](double south_m, double up_m, double heading_deg, double pitch_deg) {
        const double heading = heading_deg * 3.14159265358979 / 180.0;
        return Camera{{middle_lat_deg - south_m * std::cos(heading) * north_deg_per_m,
                       middle_lon_deg - south_m * std::sin(heading) * east_deg_per_m, town.ground_H_m + up_m},
                      {heading_deg, pitch_deg, 0.0},
                      40.0,
                      160,
                      96};
    };
    look_at_town(town, eye(350.0, 160.0, 10.0, -24.0), 120.0, 25.0, RasterPath::compute);
    look_at_town(town, eye(350.0, 160.0, 10.0, -24.0), 255.0, 12.0, RasterPath::mesh);
    look_at_town(town, eye(420.0, 220.0, 200.0, -28.0), 95.0, 40.0, RasterPath::compute);
    EXPECT_GT(by_meshes, 600U) << "px in the shadow of meshes";
    EXPECT_GT(on_roofs, 40U) << "px of roofs in shadow";
    EXPECT_GT(all.asked, 20000U);
    EXPECT_EQ(all.far, 0U) << "px differ that are not within 2 px of an edge";
    EXPECT_LE(static_cast<double>(all.differ), 0.01 * static_cast<double>(all.asked));
}

// Light does not come through the walls of a cut's rim, and out between what is left of cut triangles and the
// terrain.
TEST_F(MeshShadows, DoNotLeakThroughTheRimOfACut) {
    const Town town = made_pit();
    const Camera from_south{
        {middle_lat_deg - 380.0 * north_deg_per_m, middle_lon_deg, town.ground_H_m + 330.0},
        {0.0, -42.0, 0.0},
        40.0,
        192,
        160};
    look_at_town(town, from_south, 120.0, 10.0, RasterPath::compute);
    look_at_town(town, from_south, 40.0, 8.0, RasterPath::mesh);
    look_at_town(town, from_south, 215.0, 14.0, RasterPath::compute);
    EXPECT_GT(by_meshes, 2000U) << "px in the shadow of the rim";
    EXPECT_EQ(all.far, 0U) << "px differ that are not within 2 px of an edge";
    EXPECT_LE(static_cast<double>(all.differ), 0.01 * static_cast<double>(all.asked));
}

// A frame without meshes has no map of the ground near them, and no casters. With meshes it has casters, and
// each grid the map where the style has materials.
TEST_F(MeshShadows, WithoutMeshesNothingIsAsked) {
    const Town town = made_town();
    const Camera camera{{middle_lat_deg - 350.0 * north_deg_per_m, middle_lon_deg, town.ground_H_m + 160.0},
                        {0.0, -24.0, 0.0},
                        40.0,
                        160,
                        96};
    for (const auto& [has_meshes, has_materials] :
         {std::pair{false, true}, std::pair{true, false}, std::pair{true, true}}) {
        Region region = town.region;
        if (!has_meshes) region.meshes.reset();
        const auto cuts = cut_regions(region);
        ASSERT_TRUE(cuts.ok()) << cuts.error().line();
        Scene scene = test::scene_of_grids(*gpu_, region, *cuts, seam_between(region, *cuts, 1.0));
        gpu::FrameStyle style{};
        style.materials.on = has_materials ? 1 : 0;
        scene.require_fields(style);
        const auto plan = scene.settled_plan({camera, {0, 0, 160, 96, {0.5, 0.5}}, 1.0});
        ASSERT_TRUE(plan.ok()) << plan.error().line();
        EXPECT_EQ(plan->grids.size(), has_meshes ? 2U : 1U);
        std::size_t with_casters = 0;
        for (const GridPlan& grid : plan->grids) {
            EXPECT_EQ(grid.constants.cleared.cells != gpu::uvec2(0U), has_meshes && has_materials);
            EXPECT_EQ(grid.constants.cleared.side != gpu::uvec2(0U), has_meshes && has_materials);
            with_casters += grid.mesh_casters != 0 && grid.mesh_nodes > 0 ? 1U : 0U;
        }
        EXPECT_EQ(with_casters, has_meshes ? 1U : 0U);
    }
}

}  // namespace
}  // namespace oro
