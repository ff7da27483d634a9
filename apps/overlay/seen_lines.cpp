#include "apps/overlay/seen_lines.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

#include "core/base/parallel.h"

namespace oro {
namespace {

constexpr double usual_apart_px = 1.0;
constexpr double nearest_share =
    0.35;  // of that: those nearer to the last place stand for nothing of their own
constexpr double seen_above_px = 1.0 / 3.0;
constexpr double least_above_m = 0.05;
constexpr int asked_at_once = 256;

// A place of a line on the picture.
struct Sample {
    Geodetic place;
    glm::dvec2 at_px;
    double depth_m;
    std::size_t shape;
    bool begins;  // a new line: nothing goes from the last sample to this one
};

// In view coordinates, x right, y up, z backwards.
struct ViewPlace {
    Geodetic place;
    glm::dvec3 view_m;
};

Geodetic between(const Geodetic& a, const Geodetic& b, double share) {
    return {std::lerp(a.lat_deg, b.lat_deg, share),
            a.lon_deg + share * std::remainder(b.lon_deg - a.lon_deg, 360.0), std::lerp(a.h_m, b.h_m, share)};
}

// Turns the straight pieces of lines on the ground into samples.
class Sampler {
  public:
    Sampler(const PointsInView& in_view, const Camera& camera, double margin_px, double apart_px)
        : in_view_(in_view),
          apart_px_(apart_px),
          low_(-margin_px),
          high_(camera.width_px + margin_px, camera.height_px + margin_px) {}

    void start(std::size_t shape) {
        shape_ = shape;
        last_.reset();
        begins_ = true;
    }
    void take(const std::optional<Geodetic>& place) {
        if (!place) {
            last_.reset();
            begins_ = true;
            return;
        }
        const ViewPlace next{*place, in_view_.view_m(*place)};
        if (last_)
            add_piece(*last_, next);
        else
            begins_ = true;
        last_ = next;
    }
    std::vector<Sample> samples;

  private:
    void add_piece(ViewPlace a, ViewPlace b) {
        if (!clip_to_front(a, b)) return;
        const glm::dvec2 from = in_view_.projected_px(a.view_m), to = in_view_.projected_px(b.view_m);
        const auto [first, last] = part_in_picture(from, to);
        if (first > last) {
            begins_ = true;
            return;
        }
        if (first > 0.0) begins_ = true;
        const double length_px = (last - first) * glm::length(to - from);
        const int steps = std::max(1, static_cast<int>(std::ceil(length_px / apart_px_)));
        for (int i = begins_ ? 0 : 1; i <= steps; ++i)
            add(a, b, std::lerp(first, last, static_cast<double>(i) / steps));
        if (last < 1.0) begins_ = true;
    }
    // `share`: of the piece on the picture, not in space.
    void add(const ViewPlace& a, const ViewPlace& b, double share) {
        const double near_m = -a.view_m.z, far_m = -b.view_m.z;
        const double in_space = share * near_m / ((1.0 - share) * far_m + share * near_m);
        const glm::dvec3 view_m = glm::mix(a.view_m, b.view_m, in_space);
        const glm::dvec2 at_px = in_view_.projected_px(view_m);
        if (!begins_ && glm::length(at_px - samples.back().at_px) < nearest_share * apart_px_) return;
        samples.push_back({between(a.place, b.place, in_space), at_px, -view_m.z, shape_, begins_});
        begins_ = false;
    }
    // The part before the eye; false where there is none.
    bool clip_to_front(ViewPlace& a, ViewPlace& b) {
        const double nearest_z = -near_plane_m;
        if (a.view_m.z > nearest_z && b.view_m.z > nearest_z) return begins_ = true, false;
        const auto cut = [&](ViewPlace& behind, const ViewPlace& before) {
            const double share = (nearest_z - behind.view_m.z) / (before.view_m.z - behind.view_m.z);
            behind = {between(behind.place, before.place, share),
                      glm::mix(behind.view_m, before.view_m, share)};
        };
        if (a.view_m.z > nearest_z) {
            cut(a, b);
            begins_ = true;
        }
        if (b.view_m.z > nearest_z) cut(b, a);
        return true;
    }
    [[nodiscard]] std::pair<double, double> part_in_picture(glm::dvec2 from, glm::dvec2 to) const {
        double first = 0.0, last = 1.0;
        for (int axis = 0; axis < 2; ++axis) {
            const double step = to[axis] - from[axis];
            if (step == 0.0) {
                if (from[axis] < low_[axis] || from[axis] > high_[axis]) return {1.0, 0.0};
                continue;
            }
            const double one = (low_[axis] - from[axis]) / step, other = (high_[axis] - from[axis]) / step;
            first = std::max(first, std::min(one, other));
            last = std::min(last, std::max(one, other));
        }
        return {first, last};
    }

    const PointsInView& in_view_;
    double apart_px_;
    glm::dvec2 low_, high_;
    std::size_t shape_{};
    std::optional<ViewPlace> last_;
    bool begins_{true};
};

// The samples that are seen, as lines. Where one of two is, the line ends half way between them.
std::vector<SeenLine> joined(const std::vector<Sample>& samples, const std::vector<char>& is_seen) {
    std::vector<SeenLine> lines;
    SeenLine line;
    const auto finish = [&] {
        if (line.places_px.size() > 1) lines.push_back(std::move(line));
        line = {};
    };
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const Sample& sample = samples[i];
        if (sample.begins) finish();
        const bool was_seen = !sample.begins && is_seen[i - 1] != 0;
        const auto half_way = [&] { return 0.5 * (samples[i - 1].at_px + sample.at_px); };
        if (is_seen[i] != 0) {
            line.shape = sample.shape;
            if (!sample.begins && !was_seen) line.places_px.push_back(half_way());
            line.places_px.push_back(sample.at_px);
        } else {
            if (was_seen) line.places_px.push_back(half_way());
            finish();
        }
    }
    finish();
    return lines;
}

// Follows what is not a point of a shape: start() is asked before each line or ring.
template <class Start>
void follow(const VectorShape& shape, const TrueGround& ground, const Start& start, const PlaceSink& take) {
    if (shape.kind == VectorKind::point) return;
    for (const auto& path : shape.paths) {
        start();
        for (std::size_t at = 0; at + 1 < path.size(); ++at)
            follow_ground(ground, path[at], path[at + 1], take);
        if (shape.kind == VectorKind::polygon) follow_ground(ground, path.back(), path.front(), take);
    }
}

std::vector<SeenLine> seen_of(const std::vector<Sample>& samples, const PointsInView& in_view,
                              const Camera& camera) {
    const double metres_per_px_m = 2.0 * camera.half_fov_tangent().y / camera.height_px;
    std::vector<char> is_seen(samples.size());
    const auto parts = static_cast<int>((samples.size() + asked_at_once - 1) / asked_at_once);
    in_parallel(parts, thread_count(), [&](int part) {
        const auto begin = static_cast<std::size_t>(part) * asked_at_once;
        for (std::size_t i = begin; i < std::min(begin + asked_at_once, samples.size()); ++i) {
            const double above_m =
                std::max(least_above_m, seen_above_px * metres_per_px_m * samples[i].depth_m);
            is_seen[i] = in_view.sees(samples[i].place, above_m) ? 1 : 0;
        }
    });
    return joined(samples, is_seen);
}

}  // namespace

std::vector<SeenLine> seen_lines(const std::vector<const VectorShape*>& shapes, const TrueGround& ground,
                                 const PointsInView& in_view, const Camera& camera, double margin_px) {
    Sampler sampler(in_view, camera, margin_px, usual_apart_px);
    const PlaceSink take = [&](const std::optional<Geodetic>& place) { sampler.take(place); };
    for (std::size_t i = 0; i < shapes.size(); ++i)
        follow(
            *shapes[i], ground, [&] { sampler.start(i); }, take);
    return seen_of(sampler.samples, in_view, camera);
}

std::optional<std::vector<GroundLine>> ground_lines(const std::vector<const VectorShape*>& shapes,
                                                    const TrueGround& ground, std::size_t most) {
    std::vector<GroundLine> lines;
    std::size_t places = 0;
    const PlaceSink take = [&](const std::optional<Geodetic>& place) {
        if (++places <= most) lines.back().places.push_back(place);
    };
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        follow(
            *shapes[i], ground,
            [&] {
                lines.push_back({{}, i});
            },
            take);
        if (places > most) return std::nullopt;
    }
    return lines;
}

std::vector<SeenLine> seen_lines(const std::vector<GroundLine>& lines, const PointsInView& in_view,
                                 const Camera& camera, double margin_px, double apart_px) {
    Sampler sampler(in_view, camera, margin_px, apart_px);
    for (const GroundLine& line : lines) {
        sampler.start(line.shape);
        for (const auto& place : line.places) sampler.take(place);
    }
    return seen_of(sampler.samples, in_view, camera);
}

}  // namespace oro
