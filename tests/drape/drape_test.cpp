// Images over the ground in pictures: where they lie, held against PROJ; that both ways of drawing and two
// runs give the same; that memory is kept to.
#include <proj.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <random>

#include "core/terrain/ground.h"
#include "geo/drape/images_over_ground.h"
#include "render/frame/picture_renderer.h"
#include "tests/drape/written_image.h"
#include "tests/support/drawn/drawn_scene.h"
#include "tests/support/net_terrain.h"
#include "tests/support/rough_terrain.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

constexpr int width_px = 320, height_px = 200;

// A checkerboard in a CRS.
struct Board {
    const char* name;
    const char* crs;
    double x, y;        // of its north-west corner
    double pixel;       // a pixel's side, in the CRS's units
    double turned_deg;  // clockwise
    int cell_px;        // a cell's side
    std::vector<int> overviews;

    static constexpr int side_px = 1600;
    [[nodiscard]] std::array<double, 6> map() const {
        const double a = turned_deg * M_PI / 180.0;
        return {x, pixel * std::cos(a), -pixel * std::sin(a), y, -pixel * std::sin(a), -pixel * std::cos(a)};
    }
    [[nodiscard]] static int value(int row_cell, int column_cell) {
        return ((row_cell + column_cell) & 1) != 0 ? 230 : 20;
    }
    [[nodiscard]] std::string write(const std::filesystem::path& folder) const {
        test::WrittenImage image{side_px, side_px, map(), crs};
        image.overviews = overviews;
        return test::write_image(folder / (std::string(name) + ".tif"), image, [&](int, int row, int column) {
            return value(row / cell_px, column / cell_px);
        });
    }
};

// All over the terrain of the test, 46.75 to 46.9 N, 8.1 to 8.35 E. Cells of some 150 m.
const std::vector<Board> boards{
    {"degrees", "EPSG:4326", 8.08, 46.91, 0.00019, 0.0, 10, {2, 4, 8}},
    {"utm", "EPSG:32632", 430000.0, 5196000.0, 14.0, 0.0, 12, {}},
    {"swiss", "EPSG:2056", 2648000.0, 1196000.0, 16.0, 0.0, 10, {2, 4}},
    {"turned", "EPSG:3857", 895000.0, 5935000.0, 25.0, 27.0, 8, {}},
    {"lambert", "EPSG:3034", 3855000.0, 2262000.0, 20.0, 11.0, 9, {2}},
};

struct FreeContext {
    void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
};
struct FreeOperation {
    void operator()(PJ* operation) const { proj_destroy(operation); }
};

// Where PROJ puts a place of the Earth on a board, in cells.
class BoardTruth {
  public:
    explicit BoardTruth(const Board& board) : board_(board), context_(proj_context_create()) {
        proj_context_set_enable_network(context_.get(), 0);
        const std::unique_ptr<PJ, FreeOperation> as_stated(
            proj_create_crs_to_crs(context_.get(), "EPSG:4326", board.crs, nullptr));
        operation_.reset(proj_normalize_for_visualization(context_.get(), as_stated.get()));
    }
    [[nodiscard]] glm::dvec2 cell(const Geodetic& place) const {
        const PJ_COORD at =
            proj_trans(operation_.get(), PJ_FWD, proj_coord(place.lon_deg, place.lat_deg, 0.0, 0.0));
        const auto m = board_.map();
        const double dx = at.xy.x - m[0], dy = at.xy.y - m[3], area = m[1] * m[5] - m[2] * m[4];
        return glm::dvec2((m[5] * dx - m[2] * dy) / area, (m[1] * dy - m[4] * dx) / area) /
               static_cast<double>(board_.cell_px);
    }

  private:
    const Board& board_;
    std::unique_ptr<PJ_CONTEXT, FreeContext> context_;
    std::unique_ptr<PJ, FreeOperation> operation_;
};

// The tints' codes, 128 everywhere, without light: what is seen is the image's codes.
gpu::FrameStyle flat_style() {
    gpu::FrameStyle style{};
    style.tint_count = 1;
    style.tints[0].colour = gpu::vec3(128.0F / 255.0F);
    style.tints_as_codes = 1;
    style.light = gpu::light_none;
    style.is_map = 1;
    style.relief = 1.0F;
    return style;
}

// Of pixels that are misplaced, how many are found with the right places, and with places that are 1 px
// beside them.
struct Control {
    std::size_t right{}, moved{};
};

struct Picture {
    std::vector<std::uint8_t> rgba;
    std::vector<float> depths;
    FrameReport report;
};

class Drape : public test::GpuTest {
  protected:
    void SetUp() override {
        GpuTest::SetUp();
        field_ = test::rough_field(46.9, 8.1, 181, 301);
        folder_ = test::scratch_folder();
    }

    test::DrawnScene stage(RasterPath path, const std::vector<std::string>& files,
                           std::uint64_t bytes = std::uint64_t{256} << 20U, float opacity = 1.0F) {
        test::DrawnScene drawn(*gpu_, pages_in_memory(field_, 1.0, 2), path, width_px, height_px);
        std::vector<ImageSource> images;
        for (const std::string& file : files) {
            auto image = open_image(file);
            EXPECT_TRUE(image.ok()) << image.error().line();
            images.push_back(std::move(image).value());
        }
        std::vector<std::string> outside;
        auto over = images_over(field_.grid, std::move(images), outside);
        EXPECT_TRUE(over.ok() && outside.empty());
        auto store = DrapeStore::create(*gpu_, std::move(over).value(), {opacity, 1.0F}, bytes);
        EXPECT_TRUE(store.ok()) << store.error().line();
        drawn.scene().set_drape(std::make_unique<DrapeStore>(std::move(store).value()), 0);
        return drawn;
    }

    Picture draw(test::DrawnScene& drawn, const Camera& camera, const gpu::FrameStyle& style) {
        auto plan = drawn.scene().settled_plan({camera, test::whole_picture(camera), 1.0});
        EXPECT_TRUE(plan.ok());
        auto report = drawn.renderer().draw(std::move(plan).value(), style, 0, 1, drawn.scene().drapes());
        EXPECT_TRUE(report.ok()) << report.error().line();
        Picture picture;
        picture.report = *report;
        picture.rgba = *drawn.renderer().read_picture(width_px, height_px);
        picture.depths = *drawn.renderer().read_depths(width_px, height_px);
        return picture;
    }

    void expect_where_proj_puts_it(std::initializer_list<std::size_t> which, int views);
    Control expect_board_where_proj_puts_it(const Board& board, std::mt19937& random, int views);

    Camera eye(std::mt19937& random) const {
        const auto between = [&](double low, double high) {
            return std::uniform_real_distribution<double>(low, high)(random);
        };
        Camera camera;
        camera.width_px = width_px;
        camera.height_px = height_px;
        camera.vertical_fov_deg = between(15.0, 60.0);
        camera.eye = {between(46.79, 46.86), between(8.15, 8.3), 0.0};
        camera.eye.h_m = ground_h_m(field_, camera.eye.lat_deg, camera.eye.lon_deg).value_or(0.0) +
                         std::exp(between(std::log(150.0), std::log(6000.0)));
        camera.attitude = {between(0.0, 360.0), between(-70.0, -10.0), between(-20.0, 20.0)};
        return camera;
    }

    HeightField field_;
    std::filesystem::path folder_;
};

// What each pixel shows, in cells of a board; no number where it is no ground.
std::vector<glm::dvec2> cells_of(const Picture& picture, const Camera& camera, const BoardTruth& truth,
                                 const glm::dvec2& moved_px) {
    const Projection projection = projection_of_tile(camera, test::whole_picture(camera));
    const glm::dmat3 ecef_from_view = glm::transpose(camera.view_from_ecef());
    const Ecef eye = camera.eye_ecef();
    std::vector<glm::dvec2> cells(picture.depths.size(), glm::dvec2(NAN));
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const double depth = static_cast<double>(picture.depths[i]);
        if (depth <= 0.0) continue;
        const glm::dvec2 px(static_cast<double>(i % width_px) + 0.5 + moved_px.x,
                            static_cast<double>(i / width_px) + 0.5 + moved_px.y);
        const glm::dvec2 clip = 2.0 * px / glm::dvec2(width_px, height_px) - 1.0;
        const glm::dvec3 ray((clip - projection.shift) / projection.scale, -1.0);
        const glm::dvec3 at = ecef_from_view * (ray * (projection.near_m / depth));
        cells[i] = truth.cell(geodetic_from_ecef(Ecef{eye.m + at}));
    }
    return cells;
}

struct Misplaced {
    std::size_t looked_at{};
    std::size_t wrong{};      // pixels of the other colour,
    std::size_t far{};        // ... of these, those farther from the edge than an image can tell
    double worst_clear_px{};  // how far the farthest is whose colour is clearly the other
};

// From one pixel to the next, whichever way is longer: at a crease of the ground the two differ.
double longer(double to, double from) {
    return std::max(std::abs(to), std::abs(from));
}

// Pixels whose cell is at least 5 px wide both ways: their colour must be that of their cell, but for those
// that are half a pixel from its edge. From near by the image's own pixels are larger than the picture's, and
// its colours go over into each other: there it is a quarter of one of these. A colour is clear that is 40
// codes or more from the middle between the two.
Misplaced misplaced(const Picture& picture, const Board& board, const std::vector<glm::dvec2>& cells) {
    constexpr double least_cell_px = 5.0;
    const double last = static_cast<double>(Board::side_px) / board.cell_px;
    Misplaced found;
    for (int y = 1; y + 1 < height_px; ++y) {
        for (int x = 1; x + 1 < width_px; ++x) {
            const auto i = static_cast<std::size_t>(y * width_px + x);
            const glm::dvec2 here = cells[i], right = cells[i + 1] - here, left = here - cells[i - 1],
                             down = cells[i + width_px] - here, up = here - cells[i - width_px];
            const glm::dvec2 per_px(std::hypot(longer(right.x, left.x), longer(down.x, up.x)),
                                    std::hypot(longer(right.y, left.y), longer(down.y, up.y)));
            const bool inside = here.x > 0.0 && here.y > 0.0 && here.x < last && here.y < last;
            if (!inside || !(std::max(per_px.x, per_px.y) < 1.0 / least_cell_px)) continue;
            ++found.looked_at;
            const int wanted =
                Board::value(static_cast<int>(std::floor(here.y)), static_cast<int>(std::floor(here.x)));
            const int code = picture.rgba[4 * i];
            if ((code > 125) == (wanted > 125)) continue;
            ++found.wrong;
            const glm::dvec2 off = glm::abs(here - glm::round(here)) / per_px;
            const double to_edge = std::min(off.x * per_px.x, off.y * per_px.y);
            const double off_px = std::min(off.x, off.y);
            found.far += std::min(off_px, 2.0 * to_edge * board.cell_px) > 0.5;
            if (std::abs(code - 125) >= 40) found.worst_clear_px = std::max(found.worst_clear_px, off_px);
        }
    }
    return found;
}

// Texels against the image's own values: a slope of 4 codes a pixel, up and down, so that places show as
// codes.
TEST_F(Drape, TilesHoldTheImageWhereItLies) {
    const auto wave = [](double pixel) {
        const double in_wave = pixel - 100.0 * std::floor(pixel / 100.0);
        return 20.0 + 4.0 * std::min(in_wave, 100.0 - in_wave);
    };
    const Board& board = boards[0];
    for (const bool by_column : {true, false}) {
        test::WrittenImage image{Board::side_px, Board::side_px, board.map(), board.crs};
        image.bands = 1;
        const std::string file = test::write_image(
            folder_ / (by_column ? "columns.tif" : "rows.tif"), image,
            [&](int, int row, int column) { return wave((by_column ? column : row) + 0.5); });
        auto source = open_image(file);
        ASSERT_TRUE(source.ok());
        std::vector<std::string> outside;
        auto over = images_over(field_.grid, {*source}, outside);
        ASSERT_TRUE(over.ok());
        double worst = 0.0;
        for (int level = (*over)->finest_level(); level <= 1; ++level) {
            const int tile = level < 0 ? 1 << -level : 0;
            std::vector<std::uint32_t> texels(gpu::drape_words);
            const auto has_image = (*over)->load({level, tile, tile}, texels);
            ASSERT_TRUE(has_image.ok() && *has_image) << level;
            for (int i = -1; i <= 256; ++i) {
                const double post = post_of_texel(level, tile, i);
                const double pixel = by_column ? (8.1 + post / 1200.0 - board.x) / board.pixel
                                               : (board.y - 46.9 + post / 1200.0) / board.pixel;
                const double turn = std::abs(std::remainder(pixel, 50.0));
                const double span = std::exp2(level - 1) / 1200.0 / board.pixel;
                if (turn < 1.0 + 2.0 * span || pixel < 10.0 || pixel > Board::side_px - 10.0) continue;
                const auto at = static_cast<std::size_t>(by_column ? 100 * gpu::drape_stride + i + 1
                                                                   : (i + 1) * gpu::drape_stride + 100);
                worst = std::max(worst, std::abs(static_cast<double>(texels[at] & 255U) - wave(pixel)));
            }
        }
        EXPECT_LE(worst, 0.8);  // half a code, and a rest
    }
}

std::mt19937 seeded() {
    const char* const given = std::getenv("OROGRAPH_SEED");
    const unsigned seed = given ? static_cast<unsigned>(std::stoul(given)) : std::random_device{}();
    std::printf("seed %u\n", seed);
    return std::mt19937(seed);
}

TEST_F(Drape, LiesWhereProjPutsIt) {
    expect_where_proj_puts_it({0, 1, 2, 3, 4}, 6);
}

// Posts in a CRS of their own, turned by 33 degrees: the same.
TEST_F(Drape, LiesWhereProjPutsItOverANet) {
    field_ = test::net_field({200, 230, {46.825, 8.225}, 92.0, 33.0}, test::patchy_H_m, 47.5F);
    expect_where_proj_puts_it({0, 2, 3}, 4);
}

void Drape::expect_where_proj_puts_it(std::initializer_list<std::size_t> which, int views) {
    std::mt19937 random = seeded();
    Control all;
    for (const std::size_t board : which) {
        const Control one = expect_board_where_proj_puts_it(boards[board], random, views);
        all.right += one.right;
        all.moved += one.moved;
    }
    // How many lie near an edge of a board is a matter of the eyes: one board may show few.
    EXPECT_GT(all.moved, 100 * std::max<std::size_t>(all.right, 1)) << "the measure sees nothing";
}

Control Drape::expect_board_where_proj_puts_it(const Board& board, std::mt19937& random, int views) {
    const BoardTruth truth(board);
    test::DrawnScene drawn = stage(RasterPath::compute, {board.write(folder_)});
    Misplaced all, moved;
    for (int view = 0; view < views; ++view) {
        const Camera camera = eye(random);
        const Picture picture = draw(drawn, camera, flat_style());
        EXPECT_TRUE(picture.report.images_settled);
        for (const bool is_moved : {false, true}) {
            // The control: the same picture held against a truth that is 1 px beside it.
            const glm::dvec2 by_px(is_moved ? 1.0 : 0.0, 0.0);
            const Misplaced one = misplaced(picture, board, cells_of(picture, camera, truth, by_px));
            Misplaced& sum = is_moved ? moved : all;
            sum.looked_at += one.looked_at;
            sum.wrong += one.wrong;
            sum.far += one.far;
            sum.worst_clear_px = std::max(sum.worst_clear_px, one.worst_clear_px);
        }
    }
    std::printf(
        "%-8s %7zu pixels, %5zu of the other colour, %zu of them far from the edge, "
        "at most %.3f px where they are clear (moved by 1 px: %zu, %zu, %.3f)\n",
        board.name, all.looked_at, all.wrong, all.far, all.worst_clear_px, moved.wrong, moved.far,
        moved.worst_clear_px);
    EXPECT_GT(all.looked_at, 20000U) << board.name;
    EXPECT_LE(all.worst_clear_px, 0.5) << board.name;
    // 21 runs of three boards each had none.
    EXPECT_LE(static_cast<double>(all.far), 2e-5 * static_cast<double>(all.looked_at)) << board.name;
    return {all.far, moved.far};
}

TEST_F(Drape, IsTheSameByBothWaysOfDrawingAndTwice) {
    std::mt19937 random(5);
    const std::string file = boards[2].write(folder_);
    test::DrawnScene compute = stage(RasterPath::compute, {file});
    for (int view = 0; view < 4; ++view) {
        const Camera camera = eye(random);
        gpu::FrameStyle style = flat_style();
        if (view % 2 == 1) style.light = gpu::light_hillshade;
        const Picture first = draw(compute, camera, style);
        EXPECT_EQ(first.rgba, draw(compute, camera, style).rgba) << view;
        test::DrawnScene again = stage(RasterPath::compute, {file});
        EXPECT_EQ(first.rgba, draw(again, camera, style).rgba) << view;
        if (!gpu_->report().mesh_shader) continue;
        test::DrawnScene mesh = stage(RasterPath::mesh, {file});
        EXPECT_EQ(first.rgba, draw(mesh, camera, style).rgba) << view;
    }
}

TEST_F(Drape, OpacityMixesAndLaterImagesLieOnTop) {
    const auto plain = [&](const char* name, double value) {
        const test::WrittenImage image{40, 40, {8.0, 0.01, 0.0, 47.0, 0.0, -0.01}};
        return test::write_image(folder_ / name, image, [=](int, int, int) { return value; });
    };
    const std::string dark = plain("dark.tif", 40.0), light = plain("light.tif", 200.0);
    Camera camera;
    camera.width_px = width_px;
    camera.height_px = height_px;
    camera.eye = {46.83, 8.2, 8000.0};
    camera.attitude = {0.0, -90.0, 0.0};
    const auto middle = [&](const std::vector<std::string>& files, float opacity) {
        test::DrawnScene drawn = stage(RasterPath::compute, files, std::uint64_t{64} << 20U, opacity);
        return static_cast<int>(
            draw(drawn, camera, flat_style()).rgba[4 * (height_px / 2 * width_px + width_px / 2)]);
    };
    EXPECT_NEAR(middle({dark}, 1.0F), 40, 1);
    EXPECT_NEAR(middle({dark, light}, 1.0F), 200, 1);
    EXPECT_NEAR(middle({light, dark}, 1.0F), 40, 1);
    EXPECT_NEAR(middle({light}, 0.5F), (200 + 128) / 2, 1);
    EXPECT_NEAR(middle({light}, 0.0F), 128, 0);
}

TEST_F(Drape, KeepsToItsMemoryAndSaysWhereThatIsTooLittle) {
    std::mt19937 random(7);
    const std::string file = boards[1].write(folder_);
    constexpr std::uint64_t tile_bytes = gpu::drape_words * 4;
    test::DrawnScene all = stage(RasterPath::compute, {file});
    test::DrawnScene few = stage(RasterPath::compute, {file}, 40 * tile_bytes);
    test::DrawnScene one = stage(RasterPath::compute, {file}, tile_bytes);
    std::size_t most = 0;
    for (int view = 0; view < 6; ++view) {
        const Camera camera = eye(random);
        const Picture free = draw(all, camera, flat_style()), bound = draw(few, camera, flat_style());
        EXPECT_TRUE(bound.report.images_settled) << view;
        EXPECT_EQ(free.rgba, bound.rgba) << view;
        EXPECT_LE(few.scene().grids()[0].drape()->bytes(), 40 * tile_bytes);
        most = std::max(most, all.scene().grids()[0].drape()->size());
        EXPECT_FALSE(draw(one, camera, flat_style()).report.images_settled) << view;
    }
    EXPECT_GT(most, 40U) << "nothing had to make room";
}

}  // namespace
}  // namespace oro
