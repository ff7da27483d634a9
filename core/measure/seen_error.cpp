#include "core/measure/seen_error.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "core/base/parallel.h"

namespace oro {
namespace {

// Distances are compared as their inverses: 0 is the sky, and over a plane they are linear on the picture.
using Nearness = double;
// Nearness that differs by less is the same: what doubles and the GPU's floats leave.
constexpr double same_share = 1.0e-6;
// Neighbours whose distances differ by more lie across an edge.
constexpr double across_edge = 1.2;

bool same(Nearness a, Nearness b) {
    return std::abs(a - b) <= same_share * std::max(a, b);
}

bool is_edge(Nearness a, Nearness b) {
    return std::max(a, b) > across_edge * std::min(a, b);
}

// A picture of the truth, and how far on it something lies.
class TruthPicture {
  public:
    TruthPicture(const Oracle& oracle, std::span<const std::optional<SightHit>> truth, const Camera& camera)
        : oracle_(oracle), camera_(camera), reach_m_(sight_reach_m(camera.eye.h_m)) {
        nearness_.reserve(truth.size());
        for (const std::optional<SightHit>& hit : truth)
            nearness_.push_back(hit ? 1.0 / std::max(hit->distance_m, 1.0e-6) : 0.0);
    }

    // What a ray through a place of the picture meets.
    [[nodiscard]] Nearness through(const glm::dvec2& point_px) const {
        const auto hit = oracle_.first_hit(camera_.ecef_direction_at(point_px), reach_m_);
        return hit ? 1.0 / std::max(hit->distance_m, 1.0e-6) : 0.0;
    }
    // Whether ground that is truly seen in that direction and at that distance is not hidden there.
    [[nodiscard]] bool shows(const glm::dvec3& seen_m) const {
        const double distance_m = glm::length(seen_m);
        constexpr double slack_m = 1.0e-3;  // the ground itself
        const double until_m = distance_m * (1.0 - 1.0e-5) - slack_m;
        return until_m <= 0.0 || !oracle_.first_hit(seen_m / distance_m, until_m);
    }
    // The smallest circle around a place, of some, on which a ray passes `drawn`.
    [[nodiscard]] double circle_px(const glm::dvec2& point_px, Nearness drawn) const {
        const bool nearer = through(point_px) > drawn;
        for (const double radius_px : {1.0 / 64.0, 1.0 / 32.0, 1.0 / 16.0, 0.125, 0.25, 0.5, 0.75}) {
            constexpr int directions = 16;
            for (int i = 0; i < directions; ++i) {
                const double turn = 2.0 * std::acos(-1.0) * i / directions;
                const Nearness here =
                    through(point_px + radius_px * glm::dvec2(std::cos(turn), std::sin(turn)));
                if (same(here, drawn) || (here > drawn) != nearer) return radius_px;
            }
        }
        return seen_reach_px;
    }

    // The same on many circles, up to `at_most_px`, each with many rays: what shows in narrow gaps. An edge
    // counts, too, where most of what is in the way of `drawn` ends at once: beside it may lie ground that is
    // a little nearer or farther.
    [[nodiscard]] double fine_circle_px(const glm::dvec2& point_px, Nearness drawn, double at_most_px) const {
        const Nearness seen = through(point_px);
        const bool nearer = seen > drawn;
        const double most = 0.5 * std::abs(seen - drawn);
        constexpr double growth = 1.1, arc_px = 0.125;
        constexpr int least_directions = 32;
        // From far below the resolution on: a gap may be narrower than that, and a pixel's centre in it.
        constexpr double finest_px = seen_resolution_px / 32.0, fine_growth = 1.25;
        const auto next_px = [](double radius_px) {
            return radius_px < seen_resolution_px ? fine_growth * radius_px : growth * radius_px;
        };
        for (double radius_px = finest_px; radius_px < at_most_px; radius_px = next_px(radius_px)) {
            const double round_px = 2.0 * std::acos(-1.0) * radius_px;
            const int directions = std::max(least_directions, static_cast<int>(round_px / arc_px));
            for (int i = 0; i < directions; ++i) {
                const double turn = 2.0 * std::acos(-1.0) * i / directions;
                const glm::dvec2 towards(std::cos(turn), std::sin(turn));
                const Nearness here = through(point_px + radius_px * towards);
                if (same(here, drawn) || (here > drawn) != nearer) return radius_px;
                if (std::abs(here - drawn) > most) continue;
                const Nearness before = through(point_px + radius_px / growth * towards);
                if (std::abs(here - before) > most) return radius_px;
            }
        }
        return at_most_px;
    }

    [[nodiscard]] Nearness at(int x, int y) const {
        return nearness_[static_cast<std::size_t>(y) * static_cast<std::size_t>(camera_.width_px) +
                         static_cast<std::size_t>(x)];
    }

    // From the centre of a pixel to where the truth has `drawn`, or passes it at an edge.
    [[nodiscard]] double away_px(int x, int y, Nearness drawn) const {
        if (same(at(x, y), drawn)) return 0.0;
        double nearest = seen_reach_px;
        for (int ring = 1; ring <= seen_reach_px && ring - 1 < nearest; ++ring) {
            for (int i = -ring; i <= ring; ++i) {
                for (const glm::ivec2 step :
                     {glm::ivec2(i, -ring), glm::ivec2(i, ring), glm::ivec2(-ring, i), glm::ivec2(ring, i)})
                    look({x, y}, step, ring, drawn, nearest);
            }
        }
        return nearest;
    }

  private:
    // Along a step from a pixel: where the truth passes `drawn` in the last of its `ring` parts.
    void look(const glm::ivec2& pixel, const glm::ivec2& step, int ring, Nearness drawn,
              double& nearest) const {
        const glm::ivec2 there = pixel + step;
        if (there.x < 0 || there.y < 0 || there.x >= camera_.width_px || there.y >= camera_.height_px) return;
        const double length = glm::length(glm::dvec2(step)), part = length / ring;
        if (length - part >= nearest) return;
        const bool nearer = at(pixel.x, pixel.y) > drawn;
        const Nearness end = at(there.x, there.y);
        if (!same(end, drawn) && (end > drawn) == nearer) return;
        const glm::ivec2 before = pixel + glm::ivec2(glm::round(glm::dvec2(step) * ((ring - 1.0) / ring)));
        const Nearness begin = at(before.x, before.y);
        if (is_edge(begin, end)) {
            nearest = std::min(nearest, length - part + edge_share({before, there}, drawn, nearer) * part);
            return;
        }
        const double share = begin == end ? 0.0 : (drawn - begin) / (end - begin);
        nearest = std::min(nearest, length - part + std::clamp(share, 0.0, 1.0) * part);
    }

    // Between two pixels with an edge between them: the share of the way at which `drawn` is passed.
    struct Between {
        glm::dvec2 from, to;
    };
    [[nodiscard]] double edge_share(const Between& way, Nearness drawn, bool nearer) const {
        double low = 0.0, high = 1.0;
        for (int halving = 0; halving < 6; ++halving) {
            const double middle = 0.5 * (low + high);
            const glm::dvec2 point_px = way.from + middle * (way.to - way.from) + 0.5;
            const Nearness here = through(point_px);
            (!same(here, drawn) && (here > drawn) == nearer ? low : high) = middle;
        }
        return 0.5 * (low + high);
    }

    const Oracle& oracle_;
    const Camera& camera_;
    double reach_m_;
    std::vector<Nearness> nearness_;
};

Nearness drawn_nearness(const GroundMeter& meter, const glm::dvec2& centre_px, const DrawnPoint& point) {
    return point.background() ? 0.0 : 1.0 / (point.z_m * glm::length(meter.ray_view(centre_px)));
}

// How far away on the true picture something is seen like what a pixel shows.
struct Away {
    double px;
    bool searched;  // its own ground is truly hidden: by some rays around, which may miss what is nearer
};
Away away_from(const TruthPicture& picture, const GroundMeter& meter, int x, int y, const DrawnPoint& point) {
    const glm::dvec2 centre_px = glm::dvec2(x, y) + 0.5;
    const Nearness drawn = drawn_nearness(meter, centre_px, point);
    const double between_px = picture.away_px(x, y, drawn);
    if (between_px <= seen_resolution_px) return {between_px, false};
    if (!point.background()) {
        const std::optional<glm::dvec3> seen_m = meter.seen_m(centre_px, point);
        const double moved_px =
            seen_m ? meter.apart_px(meter.offset_m(centre_px, point.z_m), *seen_m) : between_px;
        if (moved_px >= between_px) return {between_px, true};
        if (picture.shows(*seen_m)) return {moved_px, false};
    }
    return {std::min(between_px, picture.circle_px(centre_px, drawn)), true};
}

// By many rays around a pixel, or around where its ground truly is: what hides it there may end beside it.
double fine_px(const TruthPicture& picture, const GroundMeter& meter, const glm::dvec2& centre_px,
               const DrawnPoint& point, double at_most_px) {
    const Nearness drawn = drawn_nearness(meter, centre_px, point);
    const double found_px = picture.fine_circle_px(centre_px, drawn, at_most_px);
    const auto seen_m = point.background() ? std::nullopt : meter.seen_m(centre_px, point);
    const auto true_px = seen_m ? meter.place_px(*seen_m) : std::nullopt;
    if (!true_px) return found_px;
    const double moved_px = glm::length(*true_px - centre_px);
    if (moved_px >= found_px) return found_px;
    return moved_px + picture.fine_circle_px(*true_px, 1.0 / glm::length(*seen_m), found_px - moved_px);
}

// Looks more closely at the largest of the errors that few rays have told, until the largest is found: gaps
// of less than a pixel show what is drawn, too.
void look_closely(const TruthPicture& picture, const GroundMeter& meter, const Camera& camera,
                  std::span<const DrawnPoint> points, std::vector<std::size_t> searched,
                  std::vector<float>& errors_px) {
    constexpr std::size_t most_pixels = 64;
    constexpr double farthest_px = 4.0;
    const std::size_t count = std::min(searched.size(), most_pixels);
    std::partial_sort(searched.begin(), searched.begin() + static_cast<std::ptrdiff_t>(count), searched.end(),
                      [&](std::size_t a, std::size_t b) { return errors_px[a] > errors_px[b]; });
    float largest_px = 0.0F;
    for (std::size_t i = 0; i < count && errors_px[searched[i]] > largest_px; ++i) {
        const std::size_t pixel = searched[i], width = static_cast<std::size_t>(camera.width_px);
        const glm::dvec2 centre_px = glm::dvec2(pixel % width, pixel / width) + 0.5;
        const double known_px = static_cast<double>(errors_px[pixel]);
        const double within_px = std::min(known_px, farthest_px);
        const double found_px = fine_px(picture, meter, centre_px, points[pixel], within_px);
        if (found_px < within_px) errors_px[pixel] = static_cast<float>(found_px);
        largest_px = std::max(largest_px, errors_px[pixel]);
    }
}

}  // namespace

SeenErrors seen_errors(const Oracle& oracle, const GroundMeter& meter,
                       std::span<const std::optional<SightHit>> truth, const Camera& camera,
                       std::span<const DrawnPoint> points, int threads) {
    const std::size_t width = static_cast<std::size_t>(camera.width_px);
    assert(truth.size() == points.size());
    SeenErrors errors;
    errors.px.assign(points.size(), not_measured);
    errors.m.assign(points.size(), not_measured);
    const TruthPicture picture(oracle, truth, camera);
    std::vector<std::uint64_t> other_in_row(static_cast<std::size_t>(camera.height_px));
    std::vector<std::vector<float>> even_m(other_in_row.size());
    std::vector<std::vector<std::size_t>> searched_in_row(other_in_row.size());
    in_parallel(camera.height_px, threads, [&](int y) {
        const std::size_t row = static_cast<std::size_t>(y);
        for (int x = 0; x < camera.width_px; ++x) {
            const std::size_t pixel = row * width + static_cast<std::size_t>(x);
            const DrawnPoint& point = points[pixel];
            const Nearness seen = picture.at(x, y);
            if (seen == 0.0 && point.background()) continue;
            if (truth[pixel] && truth[pixel]->from_below) continue;
            const Away away = away_from(picture, meter, x, y, point);
            errors.px[pixel] = static_cast<float>(away.px);
            if (away.searched) searched_in_row[row].push_back(pixel);
            const double drawn_m =
                point.background() ? 0.0 : point.z_m * glm::length(meter.ray_view(glm::dvec2(x, y) + 0.5));
            const bool edge = point.background() || is_edge(seen, 1.0 / drawn_m);
            if (edge) ++other_in_row[row];
            if (seen == 0.0 || point.background()) continue;
            errors.m[pixel] = static_cast<float>(std::abs(1.0 / seen - drawn_m));
            if (!edge) even_m[row].push_back(errors.m[pixel]);
        }
    });
    errors.other = std::accumulate(other_in_row.begin(), other_in_row.end(), std::uint64_t{0});
    std::vector<std::size_t> searched;
    for (const std::vector<std::size_t>& some : searched_in_row)
        searched.insert(searched.end(), some.begin(), some.end());
    look_closely(picture, meter, camera, points, std::move(searched), errors.px);
    std::vector<std::uint8_t> at_least(errors.px.size());
    std::ranges::transform(errors.px, at_least.begin(), [](float px) {
        return static_cast<std::uint8_t>(px >= static_cast<float>(seen_reach_px) ? 1 : 0);
    });
    errors.summary_px = summary_of(errors.px, at_least);
    std::vector<float> all_even_m;
    for (const std::vector<float>& some : even_m)
        all_even_m.insert(all_even_m.end(), some.begin(), some.end());
    errors.summary_m = summary_of(std::span<const float>(all_even_m));
    return errors;
}

}  // namespace oro
