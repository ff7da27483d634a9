// Must hold: a height written on a picture is the height of the ground there. Labels against sight lines of
// the oracle, which know nothing of the picture.
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <numbers>

#include "apps/labels/labelled_picture.h"
#include "core/base/parallel.h"
#include "core/truth/oracle.h"
#include "geo/region/region.h"
#include "tests/styles/drawn_style.h"
#include "tests/support/drawn/region_scene.h"

namespace oro {
namespace {

constexpr double size_px = 11.0;

double rolling_m(int row, int column) {
    const double x = column / 19.0, y = row / 23.0;
    return 1500.3 + 160.0 * std::sin(x + 0.4 * y) + 130.0 * std::cos(y - 0.3 * x) +
           4.0 * std::sin(3.1 * x + y);
}

struct Worst {
    double H_px{}, angle_deg{};
    std::size_t labels{}, turned{};
};

// What the oracle sees around a label.
class Truth {
  public:
    Truth(const HeightField& field, const Camera& camera)
        : field_(field),
          surface_(field, 1.0, thread_count()),
          oracle_(surface_, sight_from(camera.eye)),
          camera_(camera) {}

    [[nodiscard]] std::optional<double> H_m(const glm::dvec2& place_px, double* far_m = nullptr) const {
        const auto hit = oracle_.first_hit(camera_.ecef_direction_at(place_px), 1e6);
        if (!hit) return std::nullopt;
        if (far_m != nullptr) *far_m = hit->distance_m;
        return field_.surface_H_m(hit->point.lat_deg, hit->point.lon_deg);
    }

  private:
    const HeightField& field_;
    TrueSurface surface_;
    Oracle oracle_;
    const Camera& camera_;
};

// Where H rises to on the picture, metres per pixel, by least squares over what a label covers.
glm::dvec2 rise_at(const Truth& truth, const LineLabel& label, const glm::dvec2& along) {
    const glm::dvec2 across(-along.y, along.x);
    glm::dvec2 rise(0.0), spread(0.0);
    for (int i = -8; i <= 8; ++i) {
        for (int k = -2; k <= 2; ++k) {
            const glm::dvec2 off(i / 16.0 * label.length_px, k / 4.0 * 0.7 * size_px);
            const auto H_m = truth.H_m(label.middle_px + off.x * along + off.y * across);
            if (!H_m) continue;
            rise += *H_m * off;
            spread += off * off;
        }
    }
    rise /= spread;
    return rise.x * along + rise.y * across;
}

bool overlap(const LineLabel& one, const LineLabel& other) {
    for (const LineLabel* label : {&one, &other}) {
        const double radians = label->angle_deg * std::numbers::pi / 180.0;
        const glm::dvec2 along(std::cos(radians), std::sin(radians));
        for (const glm::dvec2& axis : {along, glm::dvec2(-along.y, along.x)}) {
            double reach = 0.0;
            for (const LineLabel* box : {&one, &other}) {
                const double turn = box->angle_deg * std::numbers::pi / 180.0;
                const glm::dvec2 its(std::cos(turn), std::sin(turn));
                reach += 0.5 * box->length_px * std::abs(glm::dot(its, axis)) +
                         0.5 * size_px * std::abs(glm::dot(glm::dvec2(-its.y, its.x), axis));
            }
            if (std::abs(glm::dot(one.middle_px - other.middle_px, axis)) > reach) return false;
        }
    }
    return true;
}

class Labels : public test::StyleTest {
  protected:
    // What a view's picture has written on it, and its bytes.
    std::optional<LabelledPicture> labelled(const Region& region, const View& view, RasterPath path,
                                            std::vector<std::uint8_t>& bytes) {
        auto style = load_style(view, region.grids[0].field);
        EXPECT_TRUE(style.ok()) << style.error().line();
        auto scene = test::create_scene(*gpu_, region, {.means = true});
        EXPECT_TRUE(scene.ok()) << scene.error().line();
        if (!scene.ok() || !style.ok()) return std::nullopt;
        const auto take = [&](std::span<const std::uint8_t> row) {
            bytes.insert(bytes.end(), row.begin(), row.end());
            return Result<void>();
        };
        const TrueSurface surface(region.grids[0].field, 1.0, thread_count());
        auto picture = render_labelled(*gpu_, *scene, view, surface, *style, path, take, {});
        EXPECT_TRUE(picture.ok()) << picture.error().line();
        if (!picture.ok()) return std::nullopt;
        interval_m_ = static_cast<double>(style->frame.contours.interval_m);
        return std::move(*picture);
    }

    static void hold(const LineLabel& label, const Truth& truth, double tau_px, Worst& worst) {
        const double radians = label.angle_deg * std::numbers::pi / 180.0;
        const glm::dvec2 along(std::cos(radians), std::sin(radians)), up(along.y, -along.x);
        const auto H_m = truth.H_m(label.middle_px);
        ASSERT_TRUE(H_m) << label.text;
        const glm::dvec2 rise = rise_at(truth, label, along);
        const double off_px = std::abs(*H_m - label.H_m) / glm::length(rise);
        EXPECT_LE(off_px, 0.5 + tau_px) << label.text << ": " << *H_m << " m there";
        const double askew_deg =
            std::asin(std::abs(glm::dot(rise, along)) / glm::length(rise)) * 180.0 / std::numbers::pi;
        EXPECT_LE(askew_deg, 5.0) << label.text;
        EXPECT_EQ(glm::dot(rise, up) > 0.0, label.top_is_uphill) << label.text;
        EXPECT_LE(std::abs(label.angle_deg), 90.0);
        // One piece of ground, from end to end.
        double last_m = 0.0;
        for (double at = -0.5 * label.length_px; at <= 0.5 * label.length_px; at += 1.0) {
            double far_m = 0.0;
            ASSERT_TRUE(truth.H_m(label.middle_px + at * along, &far_m));
            const double step_m = last_m > 0.0 ? std::abs(far_m - last_m) : 0.0;
            EXPECT_LT(step_m, 0.03 * far_m) << label.text;
            last_m = far_m;
        }
        worst.H_px = std::max(worst.H_px, off_px);
        worst.angle_deg = std::max(worst.angle_deg, askew_deg);
        ++worst.labels;
        worst.turned += label.top_is_uphill ? 0U : 1U;
    }

    void hold_all(const char* what, const Region& region, const View& view, std::size_t least) {
        SCOPED_TRACE(what);
        std::array<std::vector<std::uint8_t>, 2> bytes;
        const auto picture = labelled(region, view, RasterPath::mesh, bytes[0]);
        const auto again = labelled(region, view, RasterPath::mesh, bytes[1]);
        ASSERT_TRUE(picture && again);
        EXPECT_EQ(bytes[0], bytes[1]) << "the same view, the same bytes";
        const Truth truth(region.grids[0].field, view.camera);
        Worst worst;
        for (const LineLabel& label : picture->labels) hold(label, truth, view.tau_px, worst);
        for (std::size_t i = 0; i < picture->labels.size(); ++i) {
            for (std::size_t k = i + 1; k < picture->labels.size(); ++k)
                EXPECT_FALSE(overlap(picture->labels[i], picture->labels[k])) << i << ", " << k;
        }
        for (const LineLabel& label : picture->labels)
            EXPECT_NEAR(std::remainder(label.H_m, 5.0 * interval_m_), 0.0, 1e-6) << label.text;
        EXPECT_GE(picture->labels.size(), least);
        std::printf("%s: %zu labels (%zu turned), H off by %.2f px at most, %.1f degrees askew at most\n",
                    what, worst.labels, worst.turned, worst.H_px, worst.angle_deg);
        std::vector<std::uint8_t> other;
        const auto compute = labelled(region, view, RasterPath::compute, other);
        ASSERT_TRUE(compute);
        ASSERT_EQ(compute->labels.size(), picture->labels.size());
        for (std::size_t i = 0; i < picture->labels.size(); ++i)
            EXPECT_EQ(compute->labels[i].middle_px, picture->labels[i].middle_px) << i;
    }

    static View view_at(double lat_deg, double lon_deg, double h_m, double pitch_deg, double tau_px) {
        View view;
        view.style = "contours";
        view.camera.eye = {lat_deg, lon_deg, h_m};
        view.camera.attitude = {0.0, pitch_deg, 0.0};
        view.camera.vertical_fov_deg = 40.0;
        view.camera.width_px = 480;
        view.camera.height_px = 360;
        view.tau_px = tau_px;
        return view;
    }

    double interval_m_{};
};

TEST_F(Labels, TellTheHeightOfTheGroundBelowThem) {
    Region region{std::vector<RegionGrid>(1)};
    region.grids[0].field = test::square_field(46.5, 8.0, 30.0, 320, rolling_m);
    hold_all("straight down", region, view_at(46.5, 8.0, 12000.0, -90.0, 0.0), 3);
    hold_all("straight down, tau 1", region, view_at(46.5, 8.0, 12000.0, -90.0, 1.0), 3);
    hold_all("obliquely", region, view_at(46.455, 8.0, 5000.0, -32.0, 0.0), 4);
    hold_all("from low down", region, view_at(46.46, 8.0, 2100.0, -8.0, 0.0), 1);
}

TEST_F(Labels, TellTheHeightOfRealGround) {
    const auto alps = test::real_data("alps");
    if (!alps) GTEST_SKIP() << "needs alps";
    RegionRequest request;
    request.paths = {alps->string()};
    request.box = BoundingBox{7.8, 46.4, 8.3, 46.75};
    const auto region = open_region(request);
    ASSERT_TRUE(region.ok()) << region.error().line();
    View map = view_at(46.577, 8.005, 16000.0, -90.0, 1.0);
    map.camera.vertical_fov_deg = 30.0;
    hold_all("the Eiger, straight down", *region, map, 4);
    View view = view_at(46.5, 8.0, 9000.0, -40.0, 1.0);
    view.camera.width_px = 640;
    hold_all("the Eiger, obliquely", *region, view, 4);
}

// Tiles, and styles without labels.
TEST_F(Labels, AreTheSameInTilesAndNoneWhereTheyAreOff) {
    Region region{std::vector<RegionGrid>(1)};
    region.grids[0].field = test::square_field(46.5, 8.0, 30.0, 320, rolling_m);
    View view = view_at(46.5, 8.0, 12000.0, -90.0, 1.0);
    auto scene = test::create_scene(*gpu_, region);
    ASSERT_TRUE(scene.ok());
    PictureOptions options = picture_options(view, RasterPath::compute);
    const TrueSurface surface(region.grids[0].field, 1.0, thread_count());
    const auto whole = seen_heights(*gpu_, *scene, view.camera, options, surface);
    options.largest_tile_px = 100;
    const auto tiles = seen_heights(*gpu_, *scene, view.camera, options, surface);
    ASSERT_TRUE(whole.ok() && tiles.ok());
    std::size_t differ = 0;
    for (std::size_t i = 0; i < whole->H_m.size(); ++i)
        differ += std::abs(whole->H_m[i] - tiles->H_m[i]) > 0.01F ? 1U : 0U;
    EXPECT_EQ(differ, 0U) << "pixels of tiles have other heights";

    std::vector<std::uint8_t> with, without, plain;
    ASSERT_TRUE(labelled(region, view, RasterPath::compute, with));
    view.labels = false;
    const auto bare = labelled(region, view, RasterPath::compute, without);
    ASSERT_TRUE(bare);
    EXPECT_TRUE(bare->labels.empty());
    EXPECT_NE(with, without);
    view.labels = true;
    view.style = "plain";
    const auto refused_style = load_style(view, region.grids[0].field);
    ASSERT_FALSE(refused_style.ok());
    EXPECT_NE(refused_style.error().line().find("has no contour lines"), std::string::npos);
    EXPECT_EQ(refused_style.error().kind, ErrorKind::usage);
}

}  // namespace
}  // namespace oro
