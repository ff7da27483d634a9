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
            const auto hit = oracle_.first_hit(camera_.ecef_direction_at(point_px), reach_m_);
            const Nearness here = hit ? 1.0 / std::max(hit->distance_m, 1.0e-6) : 0.0;
            (!same(here, drawn) && (here > drawn) == nearer ? low : high) = middle;
        }
        return 0.5 * (low + high);
    }

    const Oracle& oracle_;
    const Camera& camera_;
    double reach_m_;
    std::vector<Nearness> nearness_;
};

}  // namespace

SeenErrors seen_errors(const Oracle& oracle, std::span<const std::optional<SightHit>> truth,
                       const Camera& camera, std::span<const DrawnPoint> points, int threads) {
    const std::size_t width = static_cast<std::size_t>(camera.width_px);
    assert(truth.size() == points.size());
    SeenErrors errors;
    errors.px.assign(points.size(), not_measured);
    errors.m.assign(points.size(), not_measured);
    const TruthPicture picture(oracle, truth, camera);
    const glm::dvec2 tangent = camera.half_fov_tangent();
    std::vector<std::uint64_t> other_in_row(static_cast<std::size_t>(camera.height_px));
    std::vector<std::vector<float>> even_m(other_in_row.size());
    in_parallel(camera.height_px, threads, [&](int y) {
        const std::size_t row = static_cast<std::size_t>(y);
        for (int x = 0; x < camera.width_px; ++x) {
            const std::size_t pixel = row * width + static_cast<std::size_t>(x);
            const Nearness seen = picture.at(x, y);
            Nearness drawn = 0.0;
            if (!points[pixel].background()) {
                const glm::dvec2 at =
                    (2.0 * (glm::dvec2(x, y) + 0.5) / glm::dvec2(camera.width_px, camera.height_px) - 1.0) *
                    tangent;
                drawn = 1.0 / (points[pixel].z_m * glm::length(glm::dvec3(at, 1.0)));
            }
            if (seen == 0.0 && drawn == 0.0) continue;
            errors.px[pixel] = static_cast<float>(picture.away_px(x, y, drawn));
            if (is_edge(seen, drawn)) ++other_in_row[row];
            if (seen == 0.0 || drawn == 0.0) continue;
            errors.m[pixel] = static_cast<float>(std::abs(1.0 / seen - 1.0 / drawn));
            if (!is_edge(seen, drawn)) even_m[row].push_back(errors.m[pixel]);
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
