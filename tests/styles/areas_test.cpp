// What polygons tint of a picture: the pixels whose sight line, by the oracle, meets ground in them.
#include <array>
#include <cstdio>
#include <fstream>

#include "apps/labels/labelled_picture.h"
#include "apps/vectors/view_vectors.h"
#include "core/base/parallel.h"
#include "core/truth/oracle.h"
#include "tests/styles/drawn_style.h"
#include "tests/support/drawn/region_scene.h"

namespace oro {
namespace {

double ridges_m(int row, int column) {
    return 1500.0 + 220.0 * std::sin(column / 17.0) * std::cos(row / 21.0) + 90.0 * std::sin(row / 9.0);
}

// A triangle's three sides, by signs of areas: not the program's way.
bool in_triangle(const std::array<std::array<double, 2>, 3>& corners, double lat, double lon) {
    int left = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto &a = corners[i], &b = corners[(i + 1) % 3];
        left += (b[1] - a[1]) * (lat - a[0]) - (b[0] - a[0]) * (lon - a[1]) > 0.0 ? 1 : 0;
    }
    return left == 0 || left == 3;
}

class Areas : public test::StyleTest {
  protected:
    std::vector<std::uint8_t> drawn(const Region& region, const View& view) {
        const auto style = load_style(view, region.grids[0].field);
        EXPECT_TRUE(style.ok()) << style.error().line();
        auto scene = test::create_scene(*gpu_, region);
        EXPECT_TRUE(scene.ok()) << scene.error().line();
        std::vector<std::uint8_t> rgb;
        const auto take = [&](std::span<const std::uint8_t> row) {
            rgb.insert(rgb.end(), row.begin(), row.end());
            return Result<void>();
        };
        const TrueSurface surface(region.grids[0].field, 1.0, thread_count());
        const auto picture =
            render_labelled(*gpu_, *scene, view, surface, *style, RasterPath::compute, take, {});
        EXPECT_TRUE(picture.ok()) << picture.error().line();
        return rgb;
    }

    static View view_of(const std::string& file, const Region& region) {
        View view;
        view.style = "plain";
        view.camera.eye = {46.47, 8.0, 3200.0};
        view.camera.attitude = {0.0, -25.0, 0.0};
        view.camera.vertical_fov_deg = 45.0;
        view.camera.width_px = 240;
        view.camera.height_px = 160;
        view.tau_px = 0.0;
        view.vectors.overlay = {file};
        view.vectors.overlay_width_px = 0.5;
        std::vector<Fingerprints::OfSource> fingerprints;
        auto read = open_vectors(view.vectors, region, fingerprints);
        EXPECT_TRUE(read.ok()) << read.error().line();
        view.vectors_read = *read;
        return view;
    }
};

TEST_F(Areas, AreTintedWhereTheOracleSeesThem) {
    Region region{std::vector<RegionGrid>(1)};
    region.grids[0].field = test::square_field(46.5, 8.0, 30.0, 320, ridges_m);
    const std::string file = (std::filesystem::path(testing::TempDir()) / "areas_test.geojson").string();
    std::ofstream(file)
        << R"({"type": "Polygon", "coordinates": [[[7.97, 46.49], [8.03, 46.5], [8.0, 46.53], [7.97, 46.49]]]})";
    const std::array<std::array<double, 2>, 3> corners{{{46.49, 7.97}, {46.5, 8.03}, {46.53, 8.0}}};
    View view = view_of(file, region);
    view.vectors.overlay_fill = 0.0;
    const std::vector<std::uint8_t> bare = drawn(region, view);
    view.vectors.overlay_fill = 0.5;
    const std::vector<std::uint8_t> tinted = drawn(region, view);
    ASSERT_EQ(bare.size(), tinted.size());

    const TrueSurface surface(region.grids[0].field, 1.0, thread_count());
    const Oracle oracle(surface, sight_from(view.camera.eye));
    const int width = view.camera.width_px, height = view.camera.height_px;
    std::vector<int> inside(static_cast<std::size_t>(width * height), -1);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const auto hit = oracle.first_hit(view.camera.ecef_direction_at({x + 0.5, y + 0.5}), 1e6);
            if (!hit) continue;
            inside[static_cast<std::size_t>(y * width + x)] =
                in_triangle(corners, hit->point.lat_deg, hit->point.lon_deg) ? 1 : 0;
        }
    }
    std::size_t held = 0, wrong = 0, hidden = 0;
    for (int y = 1; y + 1 < height; ++y) {
        for (int x = 1; x + 1 < width; ++x) {
            const auto at = static_cast<std::size_t>(y * width + x);
            bool alike = true;  // with all pixels around: not at an edge, where the outline is
            for (int k = 0; k < 9; ++k)
                alike &=
                    inside[at] == inside[static_cast<std::size_t>((y + k / 3 - 1) * width + x + k % 3 - 1)];
            if (!alike) continue;
            const bool changed = !std::equal(&bare[3 * at], &bare[3 * at] + 3, &tinted[3 * at]);
            held += inside[at] == 1 ? 1U : 0U;
            hidden += inside[at] == 0 ? 1U : 0U;
            wrong += changed != (inside[at] == 1) ? 1U : 0U;
        }
    }
    std::printf("%zu pixels in the area, %zu of other ground, %zu wrong\n", held, hidden, wrong);
    EXPECT_GT(held, 2000U);
    EXPECT_GT(hidden, 5000U);
    EXPECT_EQ(wrong, 0U);
}

// simplestyle's fields win over the options.
TEST_F(Areas, OfAFeatureThatSaysItsFill) {
    Region region{std::vector<RegionGrid>(1)};
    region.grids[0].field = test::square_field(46.5, 8.0, 30.0, 320, [](int, int) { return 1500.0; });
    const std::string file = (std::filesystem::path(testing::TempDir()) / "areas_fill.geojson").string();
    std::ofstream(file) << R"({"type": "Feature", "properties": {"fill": "#0000ff", "fill-opacity": 1.0},
        "geometry": {"type": "Polygon", "coordinates": [[[7.9, 46.4], [8.1, 46.4], [8.1, 46.6], [7.9, 46.6]]]}})";
    View view = view_of(file, region);
    view.vectors.overlay_fill = 0.0;
    view.camera.attitude.pitch_deg = -90.0;
    const std::vector<std::uint8_t> rgb = drawn(region, view);
    const std::size_t middle = 3 * static_cast<std::size_t>(80 * 240 + 120);
    EXPECT_EQ(std::vector<std::uint8_t>(&rgb[middle], &rgb[middle] + 3),
              (std::vector<std::uint8_t>{0, 0, 255}));
}

}  // namespace
}  // namespace oro
