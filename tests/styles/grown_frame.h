// Frames with trees or grass whose ground is all of one kind by a map of land cover, and what their pixels
// show.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/terrain/ground.h"
#include "geo/cover/cover_over_ground.h"
#include "geo/opening/open_region.h"
#include "shaders/shared_meadow.h"
#include "tests/drape/written_image.h"
#include "tests/styles/drawn_style.h"
#include "tests/support/drawn/made_renderer.h"

namespace oro::test {

// A class of land cover that all of the ground has, and what the rule of sites makes of it (grow_sites.comp).
struct GrownCover {
    unsigned number;
    Material material;
    bool is_needle;  // trees are
    bool is_alone;   // in open ground
    double stands;   // the share of stocked sites that hold one
};
inline constexpr GrownCover needle_cover{0, Material::needle_forest, true, false, 1.0},
    broad_cover{1, Material::broad_forest, false, false, 1.0},
    shrub_cover{2, Material::shrub, false, true, static_cast<double>(0.07F)},
    meadow_cover{3, Material::meadow, false, true, 0.0};

struct GrownEyes {
    int count;  // of each cover
    unsigned seed;
    VkExtent2D size_px;
    double least_fov_deg, most_fov_deg;
    double least_up_m{1.7}, most_up_m{300.0};  // over the ground
};
struct GrownEye {
    Camera camera;
    unsigned seed, number;
    RasterPath path;
    [[nodiscard]] std::string words() const {
        return "seed " + std::to_string(seed) + ", eye " + std::to_string(number) +
               (path == RasterPath::mesh ? ", mesh" : ", compute");
    }
};

struct GrownFrame {
    FramePlan plan;
    std::vector<std::uint32_t> ids;
    std::vector<double> ground_m;  // depth in each pixel's middle; infinity where there is none

    // The row and column in its whole lattice of the tree's site, and of a blade's clump, that an id is of.
    [[nodiscard]] std::optional<std::pair<std::uint32_t, std::uint32_t>> tree_of(std::uint32_t id) const {
        const GridPlan& grid = plan.grids[0];
        return site_of(id, grid.growth.tiles, grid.pages.size() + grid.meadow.tiles.size(),
                       gpu::sites_per_side, gpu::ids_per_site);
    }
    [[nodiscard]] std::optional<std::pair<std::uint32_t, std::uint32_t>> clump_of(std::uint32_t id) const {
        const GridPlan& grid = plan.grids[0];
        return site_of(id, grid.meadow.tiles, grid.pages.size(), gpu::clumps_per_side, gpu::blades_per_clump);
    }
    [[nodiscard]] static std::uint32_t blade_of(std::uint32_t id) {
        return (id - 1U) % gpu::blades_per_clump;
    }

  private:
    static std::optional<std::pair<std::uint32_t, std::uint32_t>> site_of(
        std::uint32_t id, const std::vector<gpu::GrowthTile>& tiles, std::size_t first_tile,
        std::uint32_t side, std::uint32_t ids_each) {
        constexpr std::uint32_t ids_a_tile = gpu::meshlets_per_page * gpu::meshlet_triangles;
        if (id == 0 || (id - 1U) / ids_a_tile < first_tile) return {};
        const std::size_t tile = (id - 1U) / ids_a_tile - first_tile;
        if (tile >= tiles.size()) return {};
        const std::uint32_t site = (id - 1U) % ids_a_tile / ids_each;
        return std::pair(tiles[tile].row * side + site / side, tiles[tile].column * side + site % side);
    }
};

// One suite in two files, so that programs of the device are made once.
class CulledGrowth : public StyleTest {
  public:
    void TearDown() override {
        renderers_.clear();
        StyleTest::TearDown();
    }

    // Hills whose crests hide others, of posts 30 m apart.
    static HeightField made_hills() {
        return square_field(46.5, 8.0, 30.0, 257, [](int row, int column) {
            return 1100.0 + 90.0 * std::sin(row * 0.35) * std::cos(column * 0.28) + 2.0 * (128.0 - row);
        });
    }

    // A valley and its mountains at posts 3 seconds apart; nothing where the data are not there.
    static std::optional<HeightField> real_mountains() {
        if (!real_data("alps")) return std::nullopt;
        RegionRequest request;
        request.paths = {real_data("alps")->string()};
        request.box = BoundingBox{7.95, 46.52, 8.2, 46.74};
        const auto region = open_region(request);
        EXPECT_TRUE(region.ok()) << region.error().line();
        return region.ok() ? std::optional(region->grids[0].field) : std::nullopt;
    }

    // `natural` without shadows and water, whose trees and grass are grown at any height.
    static gpu::FrameStyle natural_style(const HeightField& field, gpu::uint grows) {
        View view;
        view.style = (bundled_data() / "styles" / "natural.json").string();
        view.sun = SunDirection{180.0, 50.0};
        const auto style = load_style(view, field);
        EXPECT_TRUE(style.ok()) << style.error().line();
        gpu::FrameStyle frame = style->frame;
        frame.shadows = frame.sky_openness = frame.smooth_edges = 0;
        frame.water.on = 0;
        frame.cover.forest_m = 6000.0F;
        frame.materials.on = 1U | grows;
        return frame;
    }

    std::optional<Scene> grown_scene(const HeightField& field, const GrownCover& cover, gpu::uint grows,
                                     double exaggeration) {
        auto scene =
            Scene::create(*gpu_, pages_in_memory(field, exaggeration, 2), {std::uint64_t{256} << 20U, 0});
        EXPECT_TRUE(scene.ok()) << scene.error().line();
        if (!scene.ok()) return std::nullopt;
        scene->set_trees((grows & gpu::materials_with_trees) != 0);
        scene->set_grass((grows & gpu::materials_with_grass) != 0);
        auto tiles = cover_over_all(field.grid, cover);
        if (!tiles) return std::nullopt;
        auto store =
            DrapeStore::create(*gpu_, nullptr, DrapeLook{}, std::uint64_t{64} << 20U, std::move(tiles));
        EXPECT_TRUE(store.ok()) << store.error().line();
        if (!store.ok()) return std::nullopt;
        scene->set_drape(std::make_unique<DrapeStore>(std::move(store).value()), 0);
        return std::move(scene).value();
    }

    // Over the middle half of a field.
    static std::vector<GrownEye> random_eyes(const HeightField& field, const GrownEyes& eyes, unsigned cover,
                                             double exaggeration) {
        std::mt19937 random(eyes.seed + cover);
        const auto number = [&](double low, double high) {
            return std::uniform_real_distribution<double>(low, high)(random);
        };
        std::vector<GrownEye> all;
        const PostGrid& grid = field.grid;
        for (int i = 0; i < eyes.count; ++i) {
            Camera camera;
            const double lat_deg =
                             grid.south_deg() + (grid.north_deg() - grid.south_deg()) * number(0.3, 0.7),
                         lon_deg = grid.west_deg() + (grid.east_deg() - grid.west_deg()) * number(0.3, 0.7);
            const double ground_m = ground_h_m(field, lat_deg, lon_deg, exaggeration).value_or(0.0);
            camera.eye = {lat_deg, lon_deg,
                          ground_m + std::exp(number(std::log(eyes.least_up_m), std::log(eyes.most_up_m)))};
            camera.attitude = {number(0.0, 360.0), number(-35.0, 10.0), number(-15.0, 15.0)};
            camera.vertical_fov_deg = number(eyes.least_fov_deg, eyes.most_fov_deg);
            camera.width_px = static_cast<int>(eyes.size_px.width);
            camera.height_px = static_cast<int>(eyes.size_px.height);
            all.push_back({camera, eyes.seed + cover, static_cast<unsigned>(i),
                           i % 4 == 3 ? RasterPath::mesh : RasterPath::compute});
        }
        return all;
    }

    // change: what the plan is made into before it is drawn; null: nothing.
    std::optional<GrownFrame> draw(Scene& scene, const GrownEye& eye, const gpu::FrameStyle& style,
                                   const std::function<void(FramePlan&)>& change = {}, double tau_px = 1.0) {
        const Tile whole{0, 0, eye.camera.width_px, eye.camera.height_px, {0.5, 0.5}};
        auto plan = scene.settled_plan({eye.camera, whole, tau_px});
        EXPECT_TRUE(plan.ok()) << plan.error().line();
        if (!plan.ok()) return std::nullopt;
        GrownFrame frame;
        const auto width = static_cast<std::uint32_t>(whole.width_px),
                   height = static_cast<std::uint32_t>(whole.height_px);
        FrameRenderer& ground = renderer(eye, true);
        EXPECT_TRUE(ground.draw(*plan, gpu::FrameStyle{}).ok());
        const auto depths = ground.read_depths(width, height);
        if (change) change(*plan);
        frame.plan = *plan;
        FrameRenderer& grown = renderer(eye, false);
        const auto report = grown.draw(std::move(plan).value(), style, 0, 1, scene.drapes());
        EXPECT_TRUE(report.ok()) << report.error().line();
        auto ids = grown.read_ids(width, height);
        EXPECT_TRUE(depths.ok() && ids.ok());
        if (!report.ok() || !depths.ok() || !ids.ok()) return std::nullopt;
        for (const float depth : *depths)
            frame.ground_m.push_back(depth > 0.0F ? near_plane_m / static_cast<double>(depth)
                                                  : std::numeric_limits<double>::infinity());
        frame.ids = std::move(ids).value();
        return frame;
    }

  private:
    static std::unique_ptr<CoverTiles> cover_over_all(const PostGrid& grid, const GrownCover& cover) {
        constexpr int cells = 64;
        constexpr double beyond_deg = 0.05;
        WrittenImage image;
        image.columns = image.rows = cells;
        image.bands = 1;
        const double width_deg = grid.east_deg() - grid.west_deg() + 2.0 * beyond_deg,
                     height_deg = grid.north_deg() - grid.south_deg() + 2.0 * beyond_deg;
        image.crs_from_pixel = {
            grid.west_deg() - beyond_deg, width_deg / cells, 0.0, grid.north_deg() + beyond_deg, 0.0,
            -height_deg / cells};
        const std::string file =
            write_image(scratch_folder() / ("cover" + std::to_string(cover.number) + ".tif"), image,
                        [](int, int, int) { return 1.0; });
        auto source = open_cover_source(file);
        EXPECT_TRUE(source.ok()) << source.error().line();
        const CoverTable table{
            "one",
            "one",
            {},
            {CoverClass{.codes = {1}, .name = "one", .colour = {70, 93, 55}, .materials = {cover.material}}}};
        std::vector<CoverSource> sources;
        if (source.ok()) sources.push_back(std::move(source).value());
        auto map = CoverMap::of(std::move(sources), {}, &table);
        EXPECT_TRUE(map.ok()) << map.error().line();
        if (!map.ok()) return nullptr;
        std::vector<std::string> outside;
        auto tiles = cover_over(grid, *map, outside);
        EXPECT_TRUE(tiles.ok() && outside.empty());
        return tiles.ok() ? std::move(tiles).value() : nullptr;
    }

    FrameRenderer& renderer(const GrownEye& eye, bool of_ground) {
        for (Kept& one : renderers_)
            if (one.path == eye.path && one.of_ground == of_ground) return one.renderer;
        FrameRendererOptions options;
        options.extent = {static_cast<std::uint32_t>(eye.camera.width_px),
                          static_cast<std::uint32_t>(eye.camera.height_px)};
        options.path = eye.path;
        options.keep_depths = of_ground;
        options.occlusion = of_ground ? OcclusionUse::off : OcclusionUse::on;
        renderers_.push_back({eye.path, of_ground, made_renderer(*gpu_, options)});
        return renderers_.back().renderer;
    }
    struct Kept {
        RasterPath path;
        bool of_ground;
        FrameRenderer renderer;
    };
    std::vector<Kept> renderers_;
};

}  // namespace oro::test
