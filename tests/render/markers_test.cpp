// The measured displacement, and the predicted, against where things are in the picture: hills of 1 m, white
// on a black plain, are looked for by their colour alone.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "core/effects/effects.h"
#include "core/measure/ground_error.h"
#include "render/frame/depth_picture.h"
#include "tests/support/gpu_fixture.h"

namespace oro {
namespace {

constexpr int markers = 48;          // of a plain, along each side
constexpr int apart = 6, first = 3;  // posts from one marker to the next; before the first
constexpr int posts = markers * apart;
constexpr float plain_m = 500.0F;

// A plain with its middle at a place, or with the pole on its rim: posts `post_m` apart from north to south,
// about as far from west to east.
HeightField marked_plain(double lat_deg, double lon_deg, double post_m) {
    const double rows_per_deg = std::round(111200.0 / post_m);
    const double columns_per_deg =
        std::max(3.0, std::round(rows_per_deg * std::cos(lat_deg * std::numbers::pi / 180.0)));
    HeightField field;
    const double half = posts / 2;
    const double north = std::min(std::round(lat_deg * rows_per_deg + half), 90.0 * rows_per_deg);
    field.grid.lat = {rows_per_deg, north / rows_per_deg, 0, -1, posts};
    field.grid.lon = {columns_per_deg, std::round(lon_deg * columns_per_deg - half) / columns_per_deg, 0, +1,
                      posts};
    for (int row = 0; row < posts; ++row) {
        for (int column = 0; column < posts; ++column)
            field.H_m.push_back(row % apart == first && column % apart == first ? plain_m + 1.0F : plain_m);
    }
    return field;
}

// Black at the plain's height, white a metre above it; no shade and no haze.
gpu::FrameStyle black_and_white() {
    gpu::FrameStyle style{};
    style.tints[0] = {plain_m, {0.0F, 0.0F, 0.0F}};
    style.tints[1] = {plain_m + 1.0F, {1.0F, 1.0F, 1.0F}};
    style.tint_count = 2;
    style.sun_enu = {0.0F, 0.0F, 1.0F};
    style.ambient = 1.0F;
    style.relief = 1.0F;
    style.haze_distance_m = 1.0e15F;
    style.sky_scale_height_m = 8434.0F;
    return style;
}

double linear(std::uint8_t code) {
    // Source: IEC 61966-2-1:1999, 5.2.
    const double value = code / 255.0;
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

// A plain, what is drawn of it, and its truth.
struct MarkedPlain {
    MarkedPlain(double lat_deg, double lon_deg, double post_m)
        : field(marked_plain(lat_deg, lon_deg, post_m)),
          surface(field, 1.0, 2),
          pages(pages_in_memory(field, 1.0, 2)) {}
    HeightField field;
    TrueSurface surface;
    std::unique_ptr<RegionPages> pages;
};

class Markers : public test::GpuTest {
  protected:
    std::optional<DepthPainter> painter_;
    int compared = 0, loose = 0, broken = 0;
    double farthest_px = 0.0, largest_px = 0.0;

    // White pixels that hang together.
    struct Blob {
        std::vector<glm::ivec2> pixels;
        glm::dvec2 centre_px{0.0};
        double weight{};
        bool cut_off{};  // by the picture's rim
    };
    static std::vector<Blob> blobs_of(const DepthPicture& picture) {
        std::vector<Blob> blobs;
        std::vector<bool> taken(picture.points.size());
        const auto white_at = [&](const glm::ivec2& at) {
            return linear(picture.rgba[4 * pixel_of(picture, at.x, at.y)]);
        };
        for (int y = 0; y < picture.height_px; ++y) {
            for (int x = 0; x < picture.width_px; ++x) {
                if (taken[pixel_of(picture, x, y)] || white_at({x, y}) == 0.0) continue;
                Blob& blob = blobs.emplace_back();
                blob.pixels.emplace_back(x, y);
                taken[pixel_of(picture, x, y)] = true;
                for (std::size_t i = 0; i < blob.pixels.size(); ++i) {
                    const glm::ivec2 at = blob.pixels[i];
                    const double white = white_at(at);
                    blob.centre_px += white * (glm::dvec2(at) + 0.5);
                    blob.weight += white;
                    for (const glm::ivec2& step : {glm::ivec2(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
                        const glm::ivec2 next = at + step;
                        if (next.x < 0 || next.y < 0 || next.x >= picture.width_px ||
                            next.y >= picture.height_px) {
                            blob.cut_off = true;
                            continue;
                        }
                        if (taken[pixel_of(picture, next.x, next.y)] || white_at(next) == 0.0) continue;
                        taken[pixel_of(picture, next.x, next.y)] = true;
                        blob.pixels.push_back(next);
                    }
                }
                blob.centre_px /= blob.weight;
            }
        }
        return blobs;
    }

    // Draws a view of a model of the world; true are the ellipsoid and an air.
    void look(Scene& scene, const MarkedPlain& plain, const Camera& camera, const WorldModel& model,
              const Air& true_air) {
        if (!painter_) painter_.emplace(*gpu_, RasterPath::compute);
        DepthPictureOptions options;
        options.tau_px = 0.0;
        options.model = model;
        options.skyline = false;
        const auto picture = painter_->draw(scene, camera, black_and_white(), options);
        ASSERT_TRUE(picture.ok()) << picture.error().line();
        const Sight sight = sight_from(camera.eye, true_air);
        const GroundErrors errors = ground_errors(plain.surface, sight, camera, picture->points, 2);
        const GroundMeter meter(plain.surface, sight, camera);
        hold_bound(plain, camera, model, true_air, errors.summary_displacement_px.largest);
        const Projection to(camera);
        for (const Blob& blob : blobs_of(*picture)) {
            if (blob.cut_off || blob.weight < 27.0) continue;
            // Which marker it is its triangles tell; where it is, its colour alone.
            const DrawnPoint& shown = picture->points[pixel_of(*picture, blob.pixels[0].x, blob.pixels[0].y)];
            const auto nearest = [](double post) {
                return first + apart * static_cast<int>(std::lround((post - first) / apart));
            };
            const int row = nearest(shown.row), column = nearest(shown.column);
            const auto seen = seen_px(plain.field.grid, to, sight, row, column);
            if (seen && seen->narrow_px > 1.65) compare(*picture, errors, meter, to, blob, seen->centre_px);
        }
    }

    struct Projection {
        explicit Projection(const Camera& camera)
            : view_from_ecef(camera.view_from_ecef()),
              tangent(camera.half_fov_tangent()),
              size_px(camera.width_px, camera.height_px) {}
        glm::dmat3 view_from_ecef;
        glm::dvec2 tangent, size_px;
    };
    // Nothing behind the eye.
    static std::optional<glm::dvec2> project(const Projection& to, const glm::dvec3& view_m) {
        if (view_m.z >= -1.0) return std::nullopt;
        const glm::dvec2 ndc = glm::dvec2(view_m) / -view_m.z / to.tangent * glm::dvec2(1.0, -1.0);
        return (ndc + 1.0) * 0.5 * to.size_px;
    }

    // Where a marker's centre of white truly is on the picture: of the eight triangles around its post, in
    // small pieces, each by its area and its height over the plain.
    struct SeenMarker {
        glm::dvec2 centre_px;
        double narrow_px;  // standard deviation across its narrow side
    };
    static std::optional<SeenMarker> seen_px(const PostGrid& grid, const Projection& to, const Sight& sight,
                                             int row, int column) {
        if (grid.lat.at_deg(row - 1) > 90.0) return std::nullopt;
        const auto view_m = [&](int down, int right, double over_m) {
            const Geodetic place{grid.lat.at_deg(row + down), grid.lon.at_deg(column + right),
                                 static_cast<double>(plain_m) + over_m};
            return to.view_from_ecef * sight.refraction.apparent_m(ecef_from_geodetic(place).m - sight.eye.m);
        };
        // The four cells around it are split by the diagonals that go through the post.
        constexpr std::array<std::pair<int, int>, 8> around{
            {{-1, -1}, {-1, 0}, {-1, 1}, {0, 1}, {1, 1}, {1, 0}, {1, -1}, {0, -1}}};
        const glm::dvec3 top = view_m(0, 0, 1.0);
        glm::dvec2 sum(0.0);
        glm::dvec3 squares(0.0);
        double weight = 0.0;
        for (std::size_t i = 0; i < around.size(); ++i) {
            const auto& [down, right] = around[i];
            const auto& [next_down, next_right] = around[(i + 1) % around.size()];
            const glm::dvec3 one = view_m(down, right, 0.0), other = view_m(next_down, next_right, 0.0);
            constexpr int pieces = 6;
            const auto at = [&](int u, int v) {  // u, v of `pieces` towards one and the other
                return top + (one - top) * (1.0 * u / pieces) + (other - top) * (1.0 * v / pieces);
            };
            const auto add = [&](const std::array<std::pair<int, int>, 3>& corners) {
                std::array<glm::dvec2, 3> px;
                double white = 0.0;
                for (std::size_t k = 0; k < 3; ++k) {
                    const auto projected = project(to, at(corners[k].first, corners[k].second));
                    if (!projected) return false;
                    px[k] = *projected;
                    white += (1.0 - 1.0 * (corners[k].first + corners[k].second) / pieces) / 3.0;
                }
                const glm::dvec2 a = px[1] - px[0], b = px[2] - px[0];
                const double share = white * std::abs(a.x * b.y - a.y * b.x);
                const glm::dvec2 middle = (px[0] + px[1] + px[2]) / 3.0;
                sum += share * middle;
                squares += share * glm::dvec3(middle.x * middle.x, middle.x * middle.y, middle.y * middle.y);
                weight += share;
                return true;
            };
            for (int u = 0; u < pieces; ++u) {
                for (int v = 0; u + v < pieces; ++v) {
                    if (!add({{{u, v}, {u + 1, v}, {u, v + 1}}})) return std::nullopt;
                    if (u + v + 1 < pieces && !add({{{u + 1, v + 1}, {u + 1, v}, {u, v + 1}}}))
                        return std::nullopt;
                }
            }
        }
        const glm::dvec2 centre = sum / weight;
        squares =
            squares / weight - glm::dvec3(centre.x * centre.x, centre.x * centre.y, centre.y * centre.y);
        // Across its narrow side a spread (standard deviation) of a pixel and a half or less is too few samples:
        // the centre of what the pixels show is then off by a tenth of one by chance.
        const double half = 0.5 * (squares.x + squares.z);
        const double narrow = half - std::hypot(0.5 * (squares.x - squares.z), squares.y);
        return SeenMarker{centre, std::sqrt(std::max(0.0, narrow))};
    }

    // The white's own pixels say how far, and which way, they were displaced: their mean must be the way from
    // where the white should be to where it is.
    void compare(const DepthPicture& picture, const GroundErrors& errors, const GroundMeter& meter,
                 const Projection& to, const Blob& blob, const glm::dvec2& true_px) {
        glm::dvec2 measured_px(0.0);
        double weight = 0.0;
        for (const glm::ivec2& at : blob.pixels) {
            const std::size_t pixel = pixel_of(picture, at.x, at.y);
            const DrawnPoint& shown = picture.points[pixel];
            const auto truth = meter.seen_m(glm::dvec2(at) + 0.5, shown);
            const auto seen_at = truth ? project(to, to.view_from_ecef * *truth) : std::nullopt;
            ASSERT_TRUE(seen_at) << "px " << at.x << "," << at.y;
            const glm::dvec2 moved = glm::dvec2(at) + 0.5 - *seen_at;
            ASSERT_NEAR(glm::length(moved), errors.displacement_px[pixel], 1.0e-3);
            const double white = linear(picture.rgba[4 * pixel]);
            measured_px += white * moved;
            weight += white;
        }
        measured_px /= weight;
        const glm::dvec2 moved_px = blob.centre_px - true_px;
        const double off_px = glm::length(measured_px - moved_px);
        ++compared;
        largest_px = std::max(largest_px, glm::length(moved_px));
        farthest_px = std::max(farthest_px, off_px);
        EXPECT_LE(off_px, 0.1) << "px: moved by " << moved_px.x << "," << moved_px.y << ", measured "
                               << measured_px.x << "," << measured_px.y << " at " << true_px.x << ","
                               << true_px.y;
    }
    static std::size_t pixel_of(const DepthPicture& picture, int x, int y) {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width_px) +
               static_cast<std::size_t>(x);
    }

    // What plan promises of such a picture, against the largest displacement in it.
    void hold_bound(const MarkedPlain& plain, const Camera& camera, const WorldModel& model,
                    const Air& true_air, double measured_px) {
        EarthParameters world;
        world.air = true_air;
        const EffectPrediction prediction(plain.surface, *plain.pages, camera, world, 2);
        DrawingModel drawing;
        drawing.world = model;
        drawing.tau_px = 0.0;
        const auto bound = prediction.total(drawing);
        ASSERT_TRUE(bound.ok());
        broken += measured_px > bound->worst_px ? 1 : 0;
        EXPECT_LE(measured_px, bound->worst_px) << "px";
        if (bound->worst_px <= 0.1) return;
        loose += bound->worst_px > 10.0 * measured_px ? 1 : 0;
        EXPECT_LE(bound->worst_px, 10.0 * measured_px) << "px";
    }
};

TEST_F(Markers, AreWhereTheMeasureSaysTheyAre) {
    constexpr unsigned seed = 11;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    constexpr std::array latitudes_deg{0.5, 46.5, -33.5, 71.5, 89.8};
    const std::array models{WorldModel{Earth::ellipsoid, {}, Precision::relative},
                            WorldModel{Earth::sphere, {}, Precision::relative},
                            WorldModel{Earth::flat, {}, Precision::relative},
                            WorldModel{Earth::ellipsoid, {}, Precision::naive},
                            // Straight light where the true air bends it.
                            WorldModel{Earth::ellipsoid, {}, Precision::relative}};
    int views = 0, points = 0;
    for (const double lat_deg : latitudes_deg) {
        // From 60 km straight down and from 3 to 9 km, and from 1,200 to 3,600 m.
        for (const double post_m : {600.0, 60.0}) {
            const MarkedPlain plain(lat_deg, 9.5, post_m);
            auto scene = Scene::create(*gpu_, pages_in_memory(plain.field, 1.0, 2));
            ASSERT_TRUE(scene.ok()) << scene.error().line();
            points += markers * markers;
            for (const WorldModel& model : models) {
                const bool far = post_m > 100.0, nadir = far && views % 2 == 0;
                Camera camera;
                camera.eye = {
                    lat_deg, 9.5,
                    plain_m + (nadir ? 60000.0 : (far ? 3000.0 : 1200.0) * (1.0 + 2.0 * unit(random)))};
                camera.attitude = {360.0 * unit(random), nadir ? -90.0 : -25.0 - 20.0 * unit(random), 0.0};
                camera.vertical_fov_deg = nadir ? 60.0 : 40.0;
                camera.width_px = 960;
                camera.height_px = 600;
                SCOPED_TRACE(testing::Message() << "latitude " << lat_deg << ", h " << camera.eye.h_m
                                                << " m, model " << views % 5);
                look(*scene, plain, camera, model, views % 5 == 4 ? standard_air : Air{});
                ++views;
            }
        }
    }
    std::printf(
        "seed %u, %d views of %d points: %d markers found, moved by up to %.3f px; the measure is off by up "
        "to "
        "%.3f px; bounds broken %d, more than 10 times too large %d\n",
        seed, views, points, compared, largest_px, farthest_px, broken, loose);
    EXPECT_GT(compared, 2000);
    EXPECT_GT(largest_px, 2.0) << "or the test sees little";
}

}  // namespace
}  // namespace oro
