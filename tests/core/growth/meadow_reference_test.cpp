// Grass as pictures draw it, one sample a pixel and thinned so that no blade is narrower than that, against
// the whole field in double at 256 samples a pixel: how much of the ground blades cover, how light it is, and
// whether blades jump as they thin. Level ground; the rule is the one that the GPU runs
// (core/growth/meadow_blades.h), the rasteriser is this file's own.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <vector>

#include "core/growth/meadow_blades.h"

namespace oro {
namespace {

constexpr double pixels_per_tangent = 1304.0;  // 1080 pixels over 45 degrees
constexpr int picture_px = 128;                // a side
constexpr double clump_m = 0.25, eye_m = 1.7;
constexpr std::uint32_t middle_row = 41'000'000, middle_column = 70'000'000;

// A window of a picture whose middle is ground at a distance in the north, level.
struct MeadowView {
    double distance_m{};
    glm::dvec3 forward, up;
    explicit MeadowView(double to_m) : distance_m(to_m) {
        forward = glm::normalize(glm::dvec3(0.0, to_m, -eye_m));
        up = glm::dvec3(0.0, -forward.z, forward.y);
    }
    // x, y in pixels from the north-west corner; z: depth, metres.
    [[nodiscard]] glm::dvec3 pixel_of(const glm::dvec3& place) const {
        const glm::dvec3 from_eye = place - glm::dvec3(0.0, 0.0, eye_m);
        const double depth_m = glm::dot(from_eye, forward);
        return {0.5 * picture_px + pixels_per_tangent * from_eye.x / depth_m,
                0.5 * picture_px - pixels_per_tangent * glm::dot(from_eye, up) / depth_m, depth_m};
    }
    [[nodiscard]] glm::dvec3 ray_of(double x, double y) const {
        return forward + glm::dvec3((x - 0.5 * picture_px) / pixels_per_tangent, 0.0, 0.0) -
               up * ((y - 0.5 * picture_px) / pixels_per_tangent);
    }
};

// How blades are drawn.
struct MeadowDrawing {
    int samples_a_side{1};
    bool thins{true};           // and widens what is left to a pixel
    double thinned_as_at{1.0};  // times the distance that blades stand at
};

// What is seen: light over that of the ground without grass, in green; and whether it is a blade.
struct MeadowPicture {
    std::vector<double> light, blade;  // picture_px a side
};

class MeadowRaster {
  public:
    MeadowRaster(const MeadowView& view, const MeadowDrawing& how)
        : view_(view),
          how_(how),
          side_(picture_px * how.samples_a_side),
          depths_m_(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_), 1e9),
          ids_(depths_m_.size(), 0) {}

    MeadowPicture draw() {
        blades_.clear();
        const double half_m = 0.5 * picture_px / pixels_per_tangent * 62.0 + 1.0;
        for (int row = 0; row < static_cast<int>(61.0 / clump_m); ++row) {
            for (int column = static_cast<int>(-half_m / clump_m); column * clump_m < half_m; ++column)
                draw_clump(middle_row + static_cast<std::uint32_t>(row),
                           middle_column + static_cast<std::uint32_t>(column),
                           {(column + 0.5) * clump_m, (row + 0.5) * clump_m, 0.0});
        }
        return seen();
    }

  private:
    struct Blade {
        MeadowStand stand;
        std::uint32_t number;
        glm::dvec3 foot;
        MeadowCurve curve;
    };
    struct MeadowCut {
        glm::dvec2 left, right, middle;
        double depth_m;
    };

    void draw_clump(std::uint32_t row, std::uint32_t column, const glm::dvec3& foot) {
        const glm::dvec3 on_picture = view_.pixel_of(foot);
        const double slack_px = 1.2 * pixels_per_tangent / std::max(on_picture.z, 0.1);
        if (on_picture.z < 0.5 || on_picture.x < -slack_px || on_picture.x > picture_px + slack_px ||
            on_picture.y < -slack_px || on_picture.y > picture_px + slack_px)
            return;
        const double distance_m = how_.thinned_as_at * std::hypot(foot.x, foot.y, eye_m);
        const double pixel_m = how_.thins ? distance_m / pixels_per_tangent : 0.0;
        const double kept = std::min(meadow_share_at(distance_m) * meadow_blades_kept(pixel_m), 32.0);
        const MeadowStand stand{row, column, 1.0, glm::dvec2(0.0), glm::dvec2(0.0)};
        for (std::uint32_t number = 0; number < kept; ++number) {
            blades_.push_back({stand, number, foot, meadow_curve(stand, number, meadow_grown(kept, number))});
            draw_blade(blades_.back(), static_cast<std::uint32_t>(blades_.size()));
        }
    }

    [[nodiscard]] MeadowCut cut_at(const Blade& blade, double along) const {
        const auto& [foot, middle, tip] = blade.curve.control;
        const double rest = 1.0 - along;
        const glm::dvec3 place =
            blade.foot + foot * (rest * rest) + middle * (2.0 * along * rest) + tip * (along * along);
        const glm::dvec3 way = (middle - foot) * rest + (tip - middle) * along, at = view_.pixel_of(place);
        constexpr double step = 1e-5;
        const glm::dvec2 here(at), ahead(view_.pixel_of(place + step * way)),
            beside(view_.pixel_of(place + step * glm::dvec3(blade.curve.side, 0.0)));
        const glm::dvec2 on_way = glm::normalize(ahead - here), across(-on_way.y, on_way.x);
        const double facing =
            std::max(std::abs(glm::dot(beside - here, across)) / step, 0.45 * pixels_per_tangent / at.z);
        const double half_px = 0.5 * meadow_blade_width_m() * meadow_taper(along) * facing;
        const glm::dvec2 reach = across * (how_.thins ? std::max(half_px, 0.5) : half_px);
        const double scale = how_.samples_a_side;
        return {scale * (here - reach), scale * (here + reach), scale * here, at.z};
    }

    void draw_blade(const Blade& blade, std::uint32_t id) {
        constexpr int cuts = 12;
        MeadowCut low = cut_at(blade, 0.0);
        for (int i = 1; i <= cuts; ++i) {
            // Not at the very tip, where the whole field's blades have no width.
            const MeadowCut high = cut_at(blade, std::min(static_cast<double>(i) / cuts, 1.0 - 1e-9));
            draw_between(low, high, id);
            low = high;
        }
    }

    void draw_between(const MeadowCut& low, const MeadowCut& high, std::uint32_t id) {
        const std::array<glm::dvec2, 4> corners{low.left, low.right, high.right, high.left};
        const auto [least, most] =
            std::ranges::minmax(corners, {}, [](const glm::dvec2& one) { return one.y; });
        const glm::dvec2 way = high.middle - low.middle;
        const int last = std::min(side_ - 1, static_cast<int>(std::floor(most.y - 0.5)));
        for (int y = std::max(0, static_cast<int>(std::ceil(least.y - 0.5))); y <= last; ++y) {
            double begin = 1e9, end = -1e9;
            for (std::size_t i = 0; i < 4; ++i) {
                const glm::dvec2 &from = corners[i], &to = corners[(i + 1) % 4];
                if ((from.y > y + 0.5) == (to.y > y + 0.5)) continue;
                const double x = from.x + (y + 0.5 - from.y) * (to.x - from.x) / (to.y - from.y);
                begin = std::min(begin, x);
                end = std::max(end, x);
            }
            for (int x = std::max(0, static_cast<int>(std::ceil(begin - 0.5))); x + 0.5 < end && x < side_;
                 ++x) {
                const double share = std::clamp(glm::dot(glm::dvec2(x + 0.5, y + 0.5) - low.middle, way) /
                                                    std::max(glm::dot(way, way), 1e-9),
                                                0.0, 1.0);
                const double depth_m = 1.0 / ((1.0 - share) / low.depth_m + share / high.depth_m);
                const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(side_) +
                                static_cast<std::size_t>(x);
                if (depth_m >= depths_m_[at]) continue;
                depths_m_[at] = depth_m;
                ids_[at] = id;
            }
        }
    }

    [[nodiscard]] double light_at(int x, int y, std::uint32_t id) const {
        const double scale = how_.samples_a_side;
        const glm::dvec3 ray = view_.ray_of((x + 0.5) / scale, (y + 0.5) / scale),
                         to_eye = -glm::normalize(ray);
        const double to_ground_m = ray.z < 0.0 ? eye_m / -ray.z * glm::length(ray) : 1e9;
        if (id == 0) return meadow_floor_light(to_ground_m, to_eye.z);
        const Blade& blade = blades_[id - 1];
        const auto& [foot, middle, tip] = blade.curve.control;
        const auto at =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(side_) + static_cast<std::size_t>(x);
        const double up_m = eye_m + ray.z * depths_m_[at] - foot.z, to_middle = middle.z - foot.z,
                     bend = (tip.z - foot.z) - 2.0 * to_middle;
        const double along = std::clamp(
            up_m / (to_middle + std::sqrt(std::max(to_middle * to_middle + bend * up_m, 0.0))), 0.0, 1.0);
        const double sun_rad = 50.0 * std::numbers::pi / 180.0;
        const double pixel_m =
            how_.thins
                ? how_.thinned_as_at * std::hypot(blade.foot.x, blade.foot.y, eye_m) / pixels_per_tangent
                : 0.0;
        return meadow_light(blade.stand, blade.number, along, pixel_m,
                            {0.0, -std::cos(sun_rad), std::sin(sun_rad)}, to_eye)
            .y;
    }

    [[nodiscard]] MeadowPicture seen() const {
        MeadowPicture picture{std::vector<double>(picture_px * picture_px),
                              std::vector<double>(picture_px * picture_px)};
        const double weight = 1.0 / (how_.samples_a_side * how_.samples_a_side);
        for (int y = 0; y < side_; ++y) {
            for (int x = 0; x < side_; ++x) {
                const std::uint32_t id = ids_[static_cast<std::size_t>(y) * static_cast<std::size_t>(side_) +
                                              static_cast<std::size_t>(x)];
                const auto pixel =
                    static_cast<std::size_t>(y / how_.samples_a_side * picture_px + x / how_.samples_a_side);
                picture.light[pixel] += weight * light_at(x, y, id);
                picture.blade[pixel] += id != 0 ? weight : 0.0;
            }
        }
        return picture;
    }

    MeadowView view_;
    MeadowDrawing how_;
    int side_;
    std::vector<double> depths_m_;
    std::vector<std::uint32_t> ids_;
    std::vector<Blade> blades_;
};

std::vector<double> block_means(const std::vector<double>& values, int block_px) {
    std::vector<double> means;
    for (int y = 0; y < picture_px; y += block_px) {
        for (int x = 0; x < picture_px; x += block_px) {
            double sum = 0.0;
            for (int i = 0; i < block_px * block_px; ++i)
                sum += values[static_cast<std::size_t>((y + i / block_px) * picture_px + x + i % block_px)];
            means.push_back(sum / (block_px * block_px));
        }
    }
    return means;
}

double mean_of(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

// The sRGB code of a light over that of a meadow, whose code of green is 110; pictures have a little more
// contrast than light has.
double code_of(double light) {
    const double linear = 0.156 * std::pow(std::max(light, 0.0), 1.15);
    return 255.0 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055);
}

// The differences of blocks, sorted.
template <class Of>
std::vector<double> block_differences(const std::vector<double>& one, const std::vector<double>& other,
                                      int block_px, const Of& of) {
    const std::vector<double> first = block_means(one, block_px), second = block_means(other, block_px);
    std::vector<double> differences;
    for (std::size_t i = 0; i < first.size(); ++i)
        differences.push_back(std::abs(of(first[i]) - of(second[i])));
    std::ranges::sort(differences);
    return differences;
}

TEST(MeadowReference, HoldsShareLightAndThinning) {
    std::printf(
        "| m | share of blades, whole field | drawn | 8 x 8 px off, median, 95 %% | light, whole field | "
        "drawn | 8 x 8 px off, codes, "
        "median, 95 %% | of 8 x 8 px by 16 samples | 1 %% farther, 16 x 16 px, codes, largest "
        "|\n|---|---|---|---|---|---|---|---|---|\n");
    for (const double distance_m : {3.0, 6.0, 12.0, 20.0, 35.0, 50.0}) {
        const MeadowView view(distance_m);
        const MeadowPicture whole = MeadowRaster(view, {16, false}).draw(),
                            drawn = MeadowRaster(view, {1, true}).draw(),
                            smooth = MeadowRaster(view, {4, true}).draw(),
                            farther = MeadowRaster(view, {1, true, 1.01}).draw();
        const auto same = [](double value) { return value; };
        const auto shares = block_differences(whole.blade, drawn.blade, 8, same);
        const auto codes = block_differences(whole.light, drawn.light, 8, code_of),
                   sampled = block_differences(whole.light, smooth.light, 8, code_of);
        const auto jumps = block_differences(drawn.light, farther.light, 16, code_of);
        const auto at = [](const std::vector<double>& sorted, double share) {
            return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
        };
        const double whole_light = mean_of(whole.light), drawn_light = mean_of(drawn.light),
                     whole_share = mean_of(whole.blade), drawn_share = mean_of(drawn.blade);
        std::printf("| %g | %.3f | %.3f | %.3f, %.3f | %.3f | %.3f | %.1f, %.1f | %.1f, %.1f | %.1f |\n",
                    distance_m, whole_share, drawn_share, at(shares, 0.5), at(shares, 0.95), whole_light,
                    drawn_light, at(codes, 0.5), at(codes, 0.95), at(sampled, 0.5), at(sampled, 0.95),
                    jumps.back());
        EXPECT_NEAR(whole_share, drawn_share, 0.05) << distance_m;
        EXPECT_NEAR(code_of(whole_light), code_of(drawn_light), 3.0) << distance_m;
        EXPECT_NEAR(code_of(drawn_light), code_of(1.0), 4.0) << distance_m;
        EXPECT_LT(jumps.back(), 6.0) << distance_m;
    }
}

}  // namespace
}  // namespace oro
