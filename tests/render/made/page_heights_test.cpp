// Must hold: what the GPU makes of pages of made terrain is what the CPU would send, to the bit, in each
// slot; and pages of other ground have none of it.
#include "render/made/page_heights.h"

#include <algorithm>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "core/made_pages/made_pages.h"
#include "tests/support/drawn/drawn_scene.h"
#include "tests/support/made_posts.h"

namespace oro {
namespace {

PostGrid grid_of_posts(const MadeTerrain& made) {
    const auto per_deg = static_cast<double>(made.posts_per_deg);
    const int round = made.is_full_circle() ? 1 : 0;  // the first column once more
    PostGrid grid;
    grid.lat = {per_deg, 0.0, made.north, -1, made.rows()};
    grid.lon = {per_deg, 0.0, made.west, 1, made.columns() + round};
    return grid;
}

// Posts in memory, and N that no two nodes share.
HeightField field_of(const MadeTerrain& made) {
    HeightField field;
    field.grid = grid_of_posts(made);
    const std::vector<std::int32_t> steps = test::heights_of(made);
    for (int row = 0; row < field.grid.rows(); ++row)
        for (int column = 0; column < field.grid.columns(); ++column) {
            const int step = steps[static_cast<std::size_t>(row) * static_cast<std::size_t>(made.columns()) +
                                   static_cast<std::size_t>(column % made.columns())];
            field.H_m.push_back(static_cast<float>(step * made_step_m));
        }
    return field;
}
UndulationField some_undulation(double nodes_per_deg, const PostGrid& grid) {
    const auto node = [&](double angle_deg) {
        return static_cast<std::int64_t>(std::floor(angle_deg * nodes_per_deg));
    };
    UndulationField undulation;
    const std::int64_t north = node(grid.north_deg()) + 1, west = node(grid.west_deg());
    undulation.lat = {nodes_per_deg, 0.0, north, -1, static_cast<int>(north - node(grid.south_deg()) + 1)};
    undulation.lon = {nodes_per_deg, 0.0, west, 1, static_cast<int>(node(grid.east_deg()) - west + 2)};
    std::uint32_t number = 7;
    for (int i = 0; i < undulation.lat.count * undulation.lon.count; ++i) {
        number = number * 1664525U + 1013904223U;
        undulation.N_m.push_back(static_cast<float>(number >> 8U) / 200000.0F - 40.0F);
    }
    return undulation;
}

// All of a made terrain round the Earth, poles and 180 degrees.
MadeTerrain whole_world(MadeKind kind) {
    MadeTerrain made = test::made_example(kind);
    made.posts_per_deg = 2;
    made.west = -360;
    made.east = 360;
    made.south = -180;
    made.north = 180;
    made.cell_shift = 28;
    made.radius_m = 1000000;
    return made;
}

class PageHeightsOnGpu : public test::GpuTest {
  protected:
    struct Ways {
        double exaggeration{1.0};
        HeightStorage heights{HeightStorage::f32};
        bool means{false};
    };
    using Blocks = std::map<PageIndex, std::vector<std::byte>>;

    static std::unique_ptr<RegionPages> pages_of(const MadeTerrain& made, const HeightField& field,
                                                 double exaggeration = 1.0) {
        auto pages = pages_in_memory(field, exaggeration, 2);
        pages->set_made_ground(std::make_shared<const MadeGround>(
            MadeGround{made_rule(made), made.posts_per_deg, made.north, made.west}));
        return pages;
    }
    // Straight down on the middle, the middles of the north and of the south, and the north-west corner.
    static std::vector<Camera> eyes_over(const PostGrid& grid) {
        Camera eye;
        eye.width_px = eye.height_px = 64;
        eye.attitude = {0.0, -90.0, 0.0};
        eye.vertical_fov_deg = 120.0;
        const double north = 0.999 * grid.north_deg() + 0.001 * grid.south_deg(),
                     south = 0.001 * grid.north_deg() + 0.999 * grid.south_deg();
        const double middle = 0.5 * (grid.west_deg() + grid.east_deg());
        const double above_m = std::min(3.0e6, 111000.0 * (north - south));
        std::vector<Camera> eyes;
        for (const auto& [lat_deg, lon_deg] : {std::pair{0.5 * (north + south), middle},
                                               {north, middle},
                                               {south, middle},
                                               {0.5 * north, grid.west_deg()}}) {
            eye.eye = {lat_deg, lon_deg, above_m};
            eyes.push_back(eye);
        }
        return eyes;
    }
    // Of a scene once it has been seen from these.
    Blocks blocks(std::unique_ptr<RegionPages> pages, HeightMaker maker, const Ways& ways) {
        auto scene = Scene::create(*gpu_, std::move(pages), {}, ways.heights, ways.means, maker);
        EXPECT_TRUE(scene.ok()) << scene.error().line();
        for (const Camera& eye : eyes_over(scene->grids()[0].pages().facts().grid))
            EXPECT_TRUE(scene->settled_plan({eye, test::whole_picture(eye), 0.0}).ok());
        const PageStore& store = scene->grids()[0].store();
        made_ = store.pages_made();
        sent_ = store.bytes_sent();
        auto read = store.read_blocks(*gpu_);
        EXPECT_TRUE(read.ok()) << read.error().line();
        Blocks found;
        for (PageStore::KeptBlock& block : *read) found.emplace(block.index, std::move(block.bytes));
        return found;
    }
    // Pages that differ, of both ways; a page that one has and the other has not is one that does.
    std::size_t pages_that_differ(const MadeTerrain& made, const HeightField& field, const Ways& ways) {
        const Blocks sent = blocks(pages_of(made, field, ways.exaggeration), HeightMaker::processor, ways);
        EXPECT_EQ(made_, 0U);
        const Blocks by_gpu = blocks(pages_of(made, field, ways.exaggeration), HeightMaker::gpu, ways);
        EXPECT_GE(made_, by_gpu.size());
        EXPECT_GE(by_gpu.size(), 12U);
        std::size_t differ = sent.size() == by_gpu.size() ? 0 : 1;
        for (const auto& [page, bytes] : by_gpu)
            differ += sent.contains(page) && sent.at(page) == bytes ? 0 : 1;
        return differ;
    }

    std::uint64_t made_{}, sent_{};  // by the last blocks()
};

TEST_F(PageHeightsOnGpu, OfEachKindAreThoseThatWouldBeSent) {
    for (int kind = 0; kind < 8; ++kind) {
        MadeTerrain made = test::made_example(static_cast<MadeKind>(kind));
        made.east = made.west + 520;
        made.north = made.south + 610;
        HeightField field = field_of(made);
        EXPECT_EQ(pages_that_differ(made, field, {}), 0U) << "kind " << kind;
        field.undulation = some_undulation(17.0, field.grid);
        EXPECT_EQ(pages_that_differ(made, field, {2.3}), 0U) << "kind " << kind;
    }
}

// Levels of 2 degrees to 32, round the Earth and at both poles.
TEST_F(PageHeightsOnGpu, OfAWholeWorldAreThoseThatWouldBeSent) {
    for (const MadeKind kind : {MadeKind::fbm, MadeKind::checker}) {
        const MadeTerrain made = whole_world(kind);
        HeightField field = field_of(made);
        field.undulation = some_undulation(1.0, field.grid);
        EXPECT_EQ(pages_that_differ(made, field, {}), 0U);
    }
}

TEST_F(PageHeightsOnGpu, In16BitsAndBesideMeansAreThoseThatWouldBeSent) {
    MadeTerrain made = test::made_example(MadeKind::ridged);
    made.east = made.west + 520;
    made.north = made.south + 610;
    HeightField field = field_of(made);
    field.undulation = some_undulation(9.0, field.grid);
    EXPECT_EQ(pages_that_differ(made, field, {1.0, HeightStorage::i16}), 0U);
    EXPECT_EQ(pages_that_differ(made, field, {1.0, HeightStorage::f32, true}), 0U);
    EXPECT_EQ(pages_that_differ(made, field, {1.0, HeightStorage::i16, true}), 0U);
}

// Terrain whose pages are made when they are asked for.
TEST_F(PageHeightsOnGpu, OfPagesOnDemandAreThoseThatWouldBeSent) {
    MadeTerrain made = test::made_example(MadeKind::fbm);
    made.east = made.west + 520;
    made.north = made.south + 610;
    const PostGrid grid = grid_of_posts(made);
    const HeightField field = oro::made_field(made, grid, some_undulation(17.0, grid));
    const auto pages = [&] {
        auto all = made_posts_of(field)->pages(field);
        EXPECT_NE(all->made_ground(), nullptr);
        return all;
    };
    const Blocks sent = blocks(pages(), HeightMaker::processor, {}),
                 by_gpu = blocks(pages(), HeightMaker::gpu, {});
    EXPECT_GT(made_, 12U);
    EXPECT_EQ(sent, by_gpu);
}

// Without a rule, or with packed heights, all is sent as before.
TEST_F(PageHeightsOnGpu, AreMadeWhereARuleIsKnownAlone) {
    MadeTerrain made = test::made_example(MadeKind::fbm);
    made.east = made.west + 520;
    made.north = made.south + 610;
    const HeightField field = field_of(made);
    const Blocks plain = blocks(pages_in_memory(field, 1.0, 2), HeightMaker::gpu, {});
    EXPECT_EQ(made_, 0U);
    EXPECT_EQ(sent_, plain.size() * sizeof(gpu::PageBlock));
    const Blocks packed = blocks(pages_of(made, field), HeightMaker::gpu, {1.0, HeightStorage::packed});
    EXPECT_EQ(made_, 0U);
    const Blocks by_gpu = blocks(pages_of(made, field), HeightMaker::gpu, {});
    EXPECT_EQ(by_gpu, plain);
    // 13,340 bytes before heights and 6,312 of what these are made from, each a multiple of 16.
    EXPECT_EQ(sent_, made_ * (13344 + 6320));
}

TEST_F(PageHeightsOnGpu, MakeTheSamePicture) {
    MadeTerrain made = test::made_example(MadeKind::fbm);
    HeightField field = field_of(made);
    field.undulation = some_undulation(17.0, field.grid);
    Camera eye;
    eye.width_px = 160;
    eye.height_px = 120;
    eye.eye = {46.02, 8.13, 5200.0};
    eye.attitude = {10.0, -14.0, 0.0};
    eye.vertical_fov_deg = 50.0;
    FrameRendererOptions options;
    options.extent = {160, 120};
    options.path = RasterPath::compute;
    std::vector<std::vector<std::uint32_t>> ids;
    for (const HeightMaker maker : {HeightMaker::processor, HeightMaker::gpu}) {
        auto scene = Scene::create(*gpu_, pages_of(made, field), {}, HeightStorage::f32, false, maker);
        ASSERT_TRUE(scene.ok()) << scene.error().line();
        FrameRenderer renderer = test::made_renderer(*gpu_, options);
        auto plan = scene->settled_plan({eye, test::whole_picture(eye), 0.7});
        ASSERT_TRUE(plan.ok());
        ASSERT_TRUE(renderer.draw(std::move(plan).value(), {}).ok());
        auto drawn = renderer.read_ids(160, 120);
        ASSERT_TRUE(drawn.ok());
        ids.push_back(std::move(drawn).value());
        EXPECT_EQ(scene->grids()[0].store().pages_made() > 0, maker == HeightMaker::gpu);
    }
    EXPECT_GT(std::ranges::count_if(ids[0], [](std::uint32_t id) { return id != 0; }), 10000);
    EXPECT_EQ(ids[0], ids[1]);
}

}  // namespace
}  // namespace oro
