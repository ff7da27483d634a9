// Lines on the ground: on the surface all along, and on the picture where their places project.
#include "apps/overlay/seen_lines.h"
#include "geo/opening/open_region.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <random>

#include "apps/overlay/line_masks.h"
#include "core/base/parallel.h"
#include "geo/region/region.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

struct Ground {
    std::unique_ptr<Region> region;
    std::unique_ptr<TrueSurface> surface;
};

std::optional<Ground> ground(const char* name) {
    const auto tile = test::real_data(name);
    if (!tile) return std::nullopt;
    RegionRequest request;
    request.paths = {tile->string()};
    auto region = open_region(request);
    EXPECT_TRUE(region.ok());
    Ground made{std::make_unique<Region>(std::move(*region)), nullptr};
    made.surface = std::make_unique<TrueSurface>(made.region->grids[0].field, 1.0, thread_count());
    return made;
}

std::vector<std::optional<Geodetic>> followed(const TrueSurface& surface, VectorPlace from, VectorPlace to) {
    std::vector<std::optional<Geodetic>> places;
    follow_ground(surface, from, to, [&](const auto& place) { places.push_back(place); });
    return places;
}

// Half way, and everywhere else, between two places the surface is where the straight piece is.
TEST(GroundLine, LiesOnTheSurfaceAllAlong) {
    const auto alps = ground("alps/N46E007.SRTMGL3.hgt.zip");
    if (!alps) GTEST_SKIP() << "needs alps/N46E007";
    std::mt19937 random(5);  // the seed
    std::uniform_real_distribution<double> lat_deg(46.02, 46.98), lon_deg(7.02, 7.98), share(0.0, 1.0);
    for (int i = 0; i < 40; ++i) {
        const VectorPlace from{lat_deg(random), lon_deg(random)}, to{lat_deg(random), lon_deg(random)};
        const auto places = followed(*alps->surface, from, to);
        ASSERT_GT(places.size(), 10U);
        EXPECT_EQ(places.front()->lat_deg, from.lat_deg);
        EXPECT_NEAR(places.back()->lon_deg, to.lon_deg, 1e-12);
        for (std::size_t k = 0; k + 1 < places.size(); ++k) {
            ASSERT_TRUE(places[k]);
            const double s = share(random);
            const double lat = std::lerp(places[k]->lat_deg, places[k + 1]->lat_deg, s),
                         lon = std::lerp(places[k]->lon_deg, places[k + 1]->lon_deg, s);
            EXPECT_NEAR(*alps->surface->h_m(lat, lon), std::lerp(places[k]->h_m, places[k + 1]->h_m, s),
                        1e-6);
        }
    }
}

TEST(GroundLine, EndsWhereTheGroundEnds) {
    const auto alps = ground("alps/N46E007.SRTMGL3.hgt.zip");
    if (!alps) GTEST_SKIP() << "needs alps/N46E007";
    const auto across = followed(*alps->surface, {46.5, 6.5}, {46.5, 8.5});
    EXPECT_FALSE(across.front());
    EXPECT_FALSE(across.back());
    ASSERT_TRUE(across[1]);
    EXPECT_NEAR(across[1]->lon_deg, 7.0, 1e-9);
    EXPECT_NEAR(across[across.size() - 2]->lon_deg, 8.0, 1e-9);
    const auto outside = followed(*alps->surface, {45.5, 7.0}, {45.6, 8.0});
    ASSERT_EQ(outside.size(), 1U);
    EXPECT_FALSE(outside.front());
}

VectorShape track_over_alps() {
    const auto file = test::real_data("vector/RundwanderungBeimOeschinensee.gpx");
    auto read = file ? read_vectors(file->string()) : read_vectors("");
    EXPECT_TRUE(read.ok());
    return read.ok() ? read->layers.front().shapes.front() : VectorShape();
}

double distance_px(glm::dvec2 place, glm::dvec2 from, glm::dvec2 to) {
    const glm::dvec2 along = to - from;
    const double squared = glm::dot(along, along);
    const double share = squared > 0.0 ? std::clamp(glm::dot(place - from, along) / squared, 0.0, 1.0) : 0.0;
    return glm::length(place - (from + share * along));
}

double distance_px(glm::dvec2 place, const std::vector<SeenLine>& lines) {
    double nearest_px = std::numeric_limits<double>::infinity();
    for (const SeenLine& line : lines) {
        for (std::size_t i = 0; i + 1 < line.places_px.size(); ++i)
            nearest_px = std::min(nearest_px, distance_px(place, line.places_px[i], line.places_px[i + 1]));
    }
    return nearest_px;
}

struct Eye {
    double lat_deg, lon_deg, above_m, heading_deg, pitch_deg;
};

// All that one eye sees of some shapes.
class Look {
  public:
    Look(const Ground& ground, const std::vector<const VectorShape*>& shapes, const Eye& eye)
        : ground_(ground),
          shapes_(shapes),
          camera_(camera_of(ground, eye)),
          in_view_(*ground.surface, camera_, model_),
          oracle_(*ground.surface, sight_of(model_, camera_.eye)),
          lines_(seen_lines(shapes, *ground.surface, in_view_, camera_, 4.0)) {}

    // How far seen vertices are from the lines, at most.
    void hold_vertices() {
        for (const VectorShape* shape : shapes_) {
            for (const auto& path : shape->paths) {
                for (std::size_t i = 0; i<path.size(); i += path.size()> 1000 ? 20 : 1) hold(path[i]);
            }
        }
    }
    // Lines stand where truth passes their distance: within a pixel of the ground there, something that is
    // as near is seen and something that is as far (the sky is).
    void hold_lines() {
        std::vector<std::vector<OnPicture>> on_picture;
        for (const VectorShape* shape : shapes_) on_picture.push_back(of(*shape));
        for (const SeenLine& line : lines_) {
            for (std::size_t i = 0; i < line.places_px.size(); i += 7) {
                ++looked_at;
                if (!is_true(line.places_px[i], on_picture[line.shape])) ++wrong;
            }
        }
    }
    std::size_t looked_at{}, wrong{};
    std::size_t visible{}, hidden{};
    double farthest_px{};

  private:
    static Camera camera_of(const Ground& ground, const Eye& eye) {
        Camera camera;
        camera.eye = {eye.lat_deg, eye.lon_deg, *ground.surface->h_m(eye.lat_deg, eye.lon_deg) + eye.above_m};
        camera.attitude = {eye.heading_deg, eye.pitch_deg, 0.0};
        camera.width_px = 960, camera.height_px = 540;
        return camera;
    }
    void hold(const VectorPlace& vertex) {
        const Geodetic place{vertex.lat_deg, vertex.lon_deg,
                             *ground_.surface->h_m(vertex.lat_deg, vertex.lon_deg)};
        const auto at = in_view_.place_px(place);
        if (!at || at->x < 1.0 || at->y < 1.0 || at->x > 959.0 || at->y > 539.0) return;
        const bool sees = in_view_.sees(place, 0.05);
        ++(sees ? visible : hidden);
        if (sees) farthest_px = std::max(farthest_px, distance_px(*at, lines_));
    }
    struct OnPicture {
        glm::dvec2 at_px;
        double distance_m;
    };
    // A shape's lines on the ground, seen or not, a third of a pixel or less apart.
    [[nodiscard]] std::vector<OnPicture> of(const VectorShape& shape) const {
        std::vector<OnPicture> all;
        for (const auto& path : shape.paths) {
            const std::size_t last = shape.kind == VectorKind::line ? path.size() - 1 : path.size();
            std::optional<glm::dvec3> before;
            const auto take = [&](const std::optional<Geodetic>& next) {
                const glm::dvec3 b = in_view_.view_m(*next), a = before.value_or(b);
                before = b;
                if (a.z > -1.0 || b.z > -1.0) return;
                const double length_px = glm::length(in_view_.projected_px(b) - in_view_.projected_px(a));
                const int steps = 1 + static_cast<int>(std::min(3000.0, 3.0 * length_px));
                for (int i = 0; i <= steps; ++i) {
                    const glm::dvec3 at = glm::mix(a, b, static_cast<double>(i) / steps);
                    all.push_back({in_view_.projected_px(at), glm::length(at)});
                }
            };
            for (std::size_t i = 0; i < last; ++i)
                follow_ground(*ground_.surface, path[i], path[(i + 1) % path.size()], take);
        }
        return all;
    }
    [[nodiscard]] bool is_true(glm::dvec2 at_px, const std::vector<OnPicture>& shape) const {
        double nearest_m = 1e9, farthest_m = 0.0;
        for (int down = -1; down <= 1; ++down) {
            for (int right = -1; right <= 1; ++right) {
                const auto hit =
                    oracle_.first_hit(camera_.ecef_direction_at(at_px + 0.7 * glm::dvec2(right, down)), 1e5);
                nearest_m = std::min(nearest_m, hit ? hit->distance_m : 1e9);
                farthest_m = std::max(farthest_m, hit ? hit->distance_m : 1e9);
            }
        }
        return std::ranges::any_of(shape, [&](const OnPicture& place) {
            return glm::length(place.at_px - at_px) < 1.0 && place.distance_m >= 0.999 * nearest_m &&
                   place.distance_m <= 1.001 * farthest_m;
        });
    }

    const Ground& ground_;
    const std::vector<const VectorShape*>& shapes_;
    WorldModel model_{Earth::ellipsoid, standard_air, {}};
    Camera camera_;
    PointsInView in_view_;
    Oracle oracle_;
    std::vector<SeenLine> lines_;
};

// From three eyes: each vertex of a track and of two polygons that the oracle sees has the line within a
// pixel of it, and no part of a line shows where terrain hides it.
TEST(SeenLines, LieWhereTheirPlacesAreSeenAndNowhereElse) {
    const auto alps = ground("alps/N46E007.SRTMGL3.hgt.zip");
    if (!alps || !test::real_data("vector/RundwanderungBeimOeschinensee.gpx"))
        GTEST_SKIP() << "needs alps/N46E007 and vector/RundwanderungBeimOeschinensee.gpx";
    const VectorShape track = track_over_alps();
    VectorShape lake, ridge;
    lake.kind = ridge.kind = VectorKind::polygon;
    lake.paths = {{{46.502, 7.715}, {46.502, 7.735}, {46.494, 7.738}, {46.493, 7.716}}};
    ridge.paths = {{{46.55, 7.70}, {46.55, 7.80}, {46.48, 7.82}, {46.47, 7.72}},
                   {{46.53, 7.74}, {46.53, 7.77}, {46.51, 7.75}}};
    const std::vector<const VectorShape*> shapes{&track, &lake, &ridge};
    std::size_t visible = 0, hidden = 0;
    for (const Eye& eye : {Eye{46.48, 7.76, 900.0, 320.0, -14.0}, Eye{46.4900, 7.6700, 500.0, 70.0, -5.0},
                           Eye{46.4960, 7.7000, 1200.0, 60.0, -35.0}}) {
        Look look(*alps, shapes, eye);
        look.hold_vertices();
        look.hold_lines();
        std::printf(
            "eye at %.3f, %.3f: %zu vertices seen, %zu hidden; a seen one is at most %.3f px from the line; "
            "of %zu places of lines %zu are not where truth has them\n",
            eye.lat_deg, eye.lon_deg, look.visible, look.hidden, look.farthest_px, look.looked_at,
            look.wrong);
        EXPECT_LT(look.farthest_px, 1.0);
        EXPECT_GT(look.looked_at, 50U);
        EXPECT_EQ(look.wrong, 0U);
        visible += look.visible, hidden += look.hidden;
    }
    EXPECT_GT(visible, 100U);
    EXPECT_GT(hidden, 30U);
}

// Lines that were followed once are seen as those that are followed for each picture; places farther apart
// know to half of that where a line ends.
TEST(SeenLines, OfLinesThatWereFollowedAreTheSame) {
    const auto alps = ground("alps/N46E007.SRTMGL3.hgt.zip");
    if (!alps || !test::real_data("vector/RundwanderungBeimOeschinensee.gpx"))
        GTEST_SKIP() << "needs alps/N46E007 and vector/RundwanderungBeimOeschinensee.gpx";
    const VectorShape track = track_over_alps();
    const std::vector<const VectorShape*> shapes{&track};
    Camera camera;
    camera.eye = {46.49, 7.67, *alps->surface->h_m(46.49, 7.67) + 500.0};
    camera.attitude = {70.0, -5.0, 0.0};
    camera.width_px = 960, camera.height_px = 540;
    const WorldModel model{Earth::ellipsoid, standard_air, {}};
    const PointsInView in_view(*alps->surface, camera, model);
    const auto lines = ground_lines(shapes, *alps->surface, 100'000);
    ASSERT_TRUE(lines);
    EXPECT_FALSE(ground_lines(shapes, *alps->surface, lines->front().places.size() - 1));
    const auto each = seen_lines(shapes, *alps->surface, in_view, camera, 4.0);
    const auto kept = seen_lines(*lines, in_view, camera, 4.0, 1.0);
    ASSERT_EQ(kept.size(), each.size());
    ASSERT_GT(each.size(), 2U);
    for (std::size_t i = 0; i < each.size(); ++i) EXPECT_EQ(kept[i].places_px, each[i].places_px) << i;
    double coarse_px = 0.0, farthest_px = 0.0;
    for (const SeenLine& line : seen_lines(*lines, in_view, camera, 4.0, 6.0)) {
        for (const glm::dvec2& at_px : line.places_px) {
            coarse_px += 1.0;
            farthest_px = std::max(farthest_px, distance_px(at_px, each));
        }
    }
    EXPECT_GT(coarse_px, 20.0);
    EXPECT_LT(farthest_px, 3.5);
}

// Within a tenth, at any angle: pixels are covered by how far their middles are from the line.
TEST(LineMask, CoversAsMuchAsItsWidth) {
    for (const double angle_deg : {0.0, 30.0, 45.0, 77.0, 90.0}) {
        for (const double width_px : {0.5, 1.0, 2.0, 3.7}) {
            LineMask mask(200, 200);
            const double radians = angle_deg * 3.14159265358979 / 180.0;
            const glm::dvec2 along(std::cos(radians), std::sin(radians)), middle(100.3, 99.8);
            std::vector<glm::dvec2> places;
            for (int i = -50; i <= 50; ++i) places.push_back(middle + along * static_cast<double>(i));
            mask.add(places, width_px);
            std::vector<InkedText> inked;
            mask.give({1, 2, 3}, inked);
            double area = 0.0;
            for (const InkedText& text : inked) {
                for (const std::uint8_t ink : text.mask.ink) area += ink / 255.0;
            }
            const double caps = 0.785 * width_px * width_px;
            EXPECT_NEAR(area, 100.0 * width_px + caps, 0.1 * 100.0 * width_px + 1.0)
                << angle_deg << " " << width_px;
        }
    }
}

}  // namespace
}  // namespace oro
