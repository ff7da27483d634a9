// Contour lines of drawn pictures against GDAL's, and how far apart they stand.
#include <gdal_alg.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "apps/styles/contour_interval.h"
#include "tests/styles/drawn_style.h"

namespace oro {
namespace {

constexpr double post_m = 30.0;
constexpr int posts = 180;

double hills_m(int row, int column) {
    const double x = column / 9.0, y = row / 11.0;
    return 1500.3 + 120.0 * std::sin(x + 0.4 * y) + 90.0 * std::cos(y - 0.3 * x) +
           15.0 * std::sin(3.1 * x + y);
}

// As (row, column) of posts.
using Line = std::vector<glm::dvec2>;

CPLErr take_line(double, int count, double* columns, double* rows, void* lines) {
    Line line;
    for (int i = 0; i < count; ++i)
        line.emplace_back(rows[i] - 0.5, columns[i] - 0.5);  // GDAL counts from corners
    static_cast<std::vector<Line>*>(lines)->push_back(std::move(line));
    return CE_None;
}

std::vector<Line> gdal_contours(const HeightField& field, double interval_m) {
    std::vector<Line> lines;
    const GDALContourGeneratorH generator = GDAL_CG_Create(field.grid.columns(), field.grid.rows(), FALSE,
                                                           0.0, interval_m, 0.0, take_line, &lines);
    std::vector<double> row(static_cast<std::size_t>(field.grid.columns()));
    for (int r = 0; r < field.grid.rows(); ++r) {
        for (int c = 0; c < field.grid.columns(); ++c)
            row[static_cast<std::size_t>(c)] = field.H_at_post_m(r, c);
        EXPECT_EQ(GDAL_CG_FeedLine(generator, row.data()), CE_None);
    }
    GDAL_CG_Destroy(generator);
    return lines;
}

// Points at most 0.1 posts apart, in squares of a post.
class Points {
  public:
    void add(const glm::dvec2& at) {
        if (inside(at)) squares_[square_of(at.x, at.y)].push_back(at);
    }
    void add(const Line& line) {
        for (std::size_t i = 0; i + 1 < line.size(); ++i) {
            const int steps = 1 + static_cast<int>(10.0 * glm::length(line[i + 1] - line[i]));
            for (int k = 0; k <= steps; ++k)
                add(line[i] + (line[i + 1] - line[i]) * (static_cast<double>(k) / steps));
        }
    }
    // Posts to the nearest, 2 where it is farther.
    [[nodiscard]] double to(const glm::dvec2& at) const {
        double nearest = 2.0;
        for (int down = -1; down <= 1; ++down) {
            for (int right = -1; right <= 1; ++right) {
                const glm::dvec2 in(at.x + down, at.y + right);
                if (!inside(in)) continue;
                for (const glm::dvec2& point : squares_[square_of(in.x, in.y)])
                    nearest = std::min(nearest, glm::length(point - at));
            }
        }
        return nearest;
    }
    template <class Take>
    void each(const Take& take) const {
        for (const auto& square : squares_) std::ranges::for_each(square, take);
    }

  private:
    static bool inside(const glm::dvec2& at) {
        return at.x >= 0.0 && at.y >= 0.0 && at.x < posts && at.y < posts;
    }
    static std::size_t square_of(double row, double column) {
        return static_cast<std::size_t>(row) * posts + static_cast<std::size_t>(column);
    }
    std::vector<Line> squares_ = std::vector<Line>(static_cast<std::size_t>(posts) * posts);
};

std::string black_lines(const std::string& interval) {
    return R"({"tints": [{"H_m": 0, "colour": "#ffffff"}], "light": "none", "background": "#ffffff",
               "contours": {"colour": "#000000", "width_px": 1)" +
           interval + "}}";
}

class Contours : public test::StyleTest {
  protected:
    void SetUp() override {
        test::StyleTest::SetUp();
        region_.grids[0].field = test::square_field(46.5, 8.0, post_m, posts, hills_m);
    }
    Region region_{std::vector<RegionGrid>(1)};
};

TEST_F(Contours, AreThoseOfGdal) {
    constexpr double interval_m = 20.0;
    Points truth, found;
    const std::vector<Line> lines = gdal_contours(region_.grids[0].field, interval_m);
    for (const Line& line : lines) truth.add(line);
    const Camera camera = test::straight_down(region_.grids[0].field, post_m, 150.0, 1400);
    const auto style =
        style_of(black_lines(R"(, "interval_m": 20)"), ".json", camera, region_.grids[0].field);
    ASSERT_TRUE(style.ok()) << style.error().line();
    const auto picture = drawn(region_, camera, *style);
    ASSERT_TRUE(picture);
    int black = 0, pixels = 0;
    double farthest = 0.0;
    for (std::size_t pixel = 0; pixel < picture->points.size(); ++pixel) {
        const DrawnPoint& point = picture->points[pixel];
        if (point.background()) continue;
        ++pixels;
        if (picture->rgba[4 * pixel] > 187) continue;  // less than half of the pixel, in linear light
        ++black;
        const glm::dvec2 at(point.row, point.column);
        found.add(at);
        farthest = std::max(farthest, truth.to(at));
    }
    // All of GDAL's lines are drawn, and nothing else; the picture holds the posts from 15 to 165.
    double missed = 0.0;
    int of_truth = 0;
    truth.each([&](const glm::dvec2& at) {
        if (glm::any(glm::lessThan(at, glm::dvec2(18.0))) ||
            glm::any(glm::greaterThan(at, glm::dvec2(161.0))))
            return;
        ++of_truth;
        missed = std::max(missed, found.to(at));
    });
    std::printf(
        "%zu lines of GDAL, %d points of them; %d of %d pixels black, at most %.3f posts from a line; a "
        "line's "
        "point is at most %.3f posts from a black pixel\n",
        lines.size(), of_truth, black, pixels, farthest, missed);
    EXPECT_GT(of_truth, 1000);
    EXPECT_LT(black, pixels / 2);
    EXPECT_LE(farthest, 0.5) << "posts";
    EXPECT_LE(missed, 0.5) << "posts";
}

// From the pixels' own heights: how far apart lines are, at the median.
double apart_px(const DepthPicture& picture, const HeightField& field, double interval_m) {
    std::vector<double> apart;
    const auto H_m = [&](int x, int y) -> std::optional<double> {
        const DrawnPoint& point =
            picture.points[static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width_px) +
                           static_cast<std::size_t>(x)];
        if (point.background()) return std::nullopt;
        return field.surface_H_m(field.grid.north_deg() - point.row * field.grid.lat.spacing_deg(),
                                 field.grid.west_deg() + point.column * field.grid.lon.spacing_deg());
    };
    for (int y = 1; y < picture.height_px; y += 3) {
        for (int x = 1; x < picture.width_px; x += 3) {
            const auto here = H_m(x, y), left = H_m(x - 1, y), above = H_m(x, y - 1);
            if (here && left && above && *here != *left)
                apart.push_back(interval_m / std::hypot(*here - *left, *here - *above));
        }
    }
    if (apart.empty()) return 0.0;
    const auto middle = apart.begin() + static_cast<std::ptrdiff_t>(apart.size() / 2);
    std::ranges::nth_element(apart, middle);
    return *middle;
}

TEST_F(Contours, StandFiveToFortyPixelsApart) {
    struct Look {
        const char* what;
        double altitude_m, pitch_deg, fov_deg;
        double south_deg;
    };
    constexpr std::array looks{Look{"straight down from 100 km", 101500.0, -90.0, 2.5, 0.0},
                               Look{"straight down from 8 km", 8000.0, -90.0, 25.0, 0.0},
                               Look{"obliquely", 4000.0, -35.0, 45.0, 0.03},
                               Look{"from a summit's height", 1950.0, -10.0, 45.0, 0.022},
                               Look{"a narrow view", 1800.0, -30.0, 6.0, 0.01}};
    for (const Look& look : looks) {
        SCOPED_TRACE(look.what);
        Camera camera;
        camera.eye = {46.5 - look.south_deg, 8.0, look.altitude_m};
        camera.attitude = {0.0, look.pitch_deg, 0.0};
        camera.vertical_fov_deg = look.fov_deg;
        camera.width_px = 480;
        camera.height_px = 320;
        const auto style = style_of(black_lines(""), ".json", camera, region_.grids[0].field);
        ASSERT_TRUE(style.ok()) << style.error().line();
        const auto again = style_of(black_lines(""), ".json", camera, region_.grids[0].field);
        EXPECT_EQ(style->frame.contours.interval_m, again->frame.contours.interval_m);
        const auto picture = drawn(region_, camera, *style);
        ASSERT_TRUE(picture);
        const double apart = apart_px(*picture, region_.grids[0].field, style->frame.contours.interval_m);
        std::printf("%s: each %g m, %.1f px apart at the median\n", look.what,
                    static_cast<double>(style->frame.contours.interval_m), apart);
        EXPECT_GE(apart, 5.0);
        EXPECT_LE(apart, 40.0);
    }
}

// A lake at a height of the lines is no line.
TEST_F(Contours, LevelGroundIsNoLine) {
    Region region{std::vector<RegionGrid>(1)};
    region.grids[0].field = test::square_field(46.5, 8.0, post_m, 60, [](int, int) { return 1500.0; });
    const Camera camera = test::straight_down(region.grids[0].field, post_m, 40.0, 64);
    const auto style =
        style_of(black_lines(R"(, "interval_m": 100)"), ".json", camera, region.grids[0].field);
    ASSERT_TRUE(style.ok()) << style.error().line();
    const auto picture = drawn(region, camera, *style);
    ASSERT_TRUE(picture);
    for (std::size_t i = 0; i < picture->rgba.size(); ++i) ASSERT_EQ(picture->rgba[i], 255) << i;
}

}  // namespace
}  // namespace oro
