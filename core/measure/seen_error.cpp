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

// How far away on the true picture something is seen like what a pixel shows.
double off_px(const TruthPicture& picture, const GroundMeter& meter, int x, int y, const DrawnPoint& point) {
    const glm::dvec2 centre_px = glm::dvec2(x, y) + 0.5;
    const Nearness drawn =
        point.background() ? 0.0 : 1.0 / (point.z_m * glm::length(meter.ray_view(centre_px)));
    const double between_px = picture.away_px(x, y, drawn);
    if (between_px <= seen_resolution_px) return between_px;
    if (!point.background()) {
        const std::optional<glm::dvec3> seen_m = meter.seen_m(point.row, point.column);
        const double moved_px =
            seen_m ? meter.apart_px(meter.offset_m(centre_px, point.z_m), *seen_m) : between_px;
        if (moved_px >= between_px) return between_px;
        if (picture.shows(*seen_m)) return moved_px;
    }
    return std::min(between_px, picture.circle_px(centre_px, drawn));
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
    in_parallel(camera.height_px, threads, [&](int y) {
        const std::size_t row = static_cast<std::size_t>(y);
        for (int x = 0; x < camera.width_px; ++x) {
            const std::size_t pixel = row * width + static_cast<std::size_t>(x);
            const DrawnPoint& point = points[pixel];
            const Nearness seen = picture.at(x, y);
            if (seen == 0.0 && point.background()) continue;
            errors.px[pixel] = static_cast<float>(off_px(picture, meter, x, y, point));
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
    errors.summary_px = summary_of(errors.px);
    std::vector<float> all_even_m;
    for (const std::vector<float>& some : even_m)
        all_even_m.insert(all_even_m.end(), some.begin(), some.end());
    errors.summary_m = summary_of(std::span<const float>(all_even_m));
    return errors;
}

}  // namespace oro
