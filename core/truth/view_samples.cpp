#include "core/truth/view_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/base/parallel.h"

namespace oro {
namespace {

constexpr int samples_across = 160;
// Distances that differ by more are of ground on both sides of an edge.
constexpr double across_edge = 1.2;

// Pixels that are spread evenly over `size` of them, first and last included.
std::vector<int> spread(int count, int size) {
    std::vector<int> pixels;
    for (int i = 0; i < count; ++i)
        pixels.push_back(
            count > 1 ? static_cast<int>(std::lround(static_cast<double>(i) * (size - 1) / (count - 1)))
                      : (size - 1) / 2);
    return pixels;
}

class ViewSampler {
  public:
    ViewSampler(const TrueGround& ground, const Sight& sight, const Camera& camera)
        : ground_(ground),
          camera_(camera),
          oracle_(ground, sight),
          reach_m_(picture_reach_m(ground, sight, camera.eye.h_m)) {}

    using Seen = std::optional<ViewSample>;
    [[nodiscard]] Seen at(int x, int y, bool even) const { return at(glm::dvec2(x, y) + 0.5, even); }
    [[nodiscard]] Seen at(const glm::dvec2& point_px, bool even) const {
        const glm::dvec3 direction = camera_.ecef_direction_at(point_px);
        const auto hit = oracle_.first_hit(direction, reach_m_);
        if (!hit) return std::nullopt;
        const TrueSurface& surface = ground_.surface(hit->grid);
        const PostNumber post = surface.field().grid.post_at(hit->point.lat_deg, hit->point.lon_deg);
        const auto slope = surface.slope_at(post.row, post.column);
        return ViewSample{hit->point,
                          hit->distance_m * direction,
                          hit->distance_m,
                          slope ? slope->steepness() : 0.0,
                          hit->row,
                          hit->column,
                          hit->west,
                          even,
                          0.0,
                          hit->grid,
                          hit->between_grids};
    }

    // The corners of a rectangle of pixels, and what is seen there: (0, 0), (1, 0), (0, 1), (1, 1).
    struct Quad {
        int left, top, right, bottom;
        std::array<Seen, 4> seen;
    };
    static bool has_edge(const Quad& quad) {
        double nearest_m = 0.0, farthest_m = 0.0;
        int ground = 0;
        for (const Seen& seen : quad.seen) {
            if (!seen) continue;
            nearest_m = ground == 0 ? seen->distance_m : std::min(nearest_m, seen->distance_m);
            farthest_m = std::max(farthest_m, seen->distance_m);
            ++ground;
        }
        return ground > 0 && (ground < 4 || farthest_m > across_edge * nearest_m);
    }
    // Looks between the corners as long as there is an edge between them.
    struct Found {
        std::vector<ViewSample> samples;
        std::vector<PictureEdge> edges;  // between neighbours
    };
    void look_between(const Quad& quad, Found& all) const {
        if (!has_edge(quad)) return;
        if (quad.right - quad.left <= 1 && quad.bottom - quad.top <= 1) {
            all.edges.push_back(edge_of(quad.seen));
            return;
        }
        std::vector<ViewSample>& found = all.samples;
        const int x = (quad.left + quad.right) / 2, y = (quad.top + quad.bottom) / 2;
        const bool wide = quad.right - quad.left > 1, tall = quad.bottom - quad.top > 1;
        const auto look = [&](int at_x, int at_y) {
            Seen seen = at(at_x, at_y, false);
            if (seen) found.push_back(*seen);
            return seen;
        };
        const auto& [nw, ne, sw, se] = quad.seen;
        if (!tall) {
            const Seen north = look(x, quad.top), south = look(x, quad.bottom);
            look_between({quad.left, quad.top, x, quad.bottom, {nw, north, sw, south}}, all);
            look_between({x, quad.top, quad.right, quad.bottom, {north, ne, south, se}}, all);
            return;
        }
        if (!wide) {
            const Seen west = look(quad.left, y), east = look(quad.right, y);
            look_between({quad.left, quad.top, quad.right, y, {nw, ne, west, east}}, all);
            look_between({quad.left, y, quad.right, quad.bottom, {west, east, sw, se}}, all);
            return;
        }
        const Seen north = look(x, quad.top), south = look(x, quad.bottom), west = look(quad.left, y),
                   east = look(quad.right, y), middle = look(x, y);
        look_between({quad.left, quad.top, x, y, {nw, north, west, middle}}, all);
        look_between({x, quad.top, quad.right, y, {north, ne, middle, east}}, all);
        look_between({quad.left, y, x, quad.bottom, {west, middle, sw, south}}, all);
        look_between({x, y, quad.right, quad.bottom, {middle, east, south, se}}, all);
    }

    // Between a pixel and the rim of the picture beside it: nothing but the skyline is asked for there.
    void look_at_rim(const Seen& inside, const glm::dvec2& rim_px, Found& all) const {
        const Seen rim = at(rim_px, false);
        if (rim.has_value() == inside.has_value()) return;
        const PictureEdge edge = edge_of({inside, rim, inside, rim});
        if (rim) {
            all.samples.push_back(*rim);
            all.samples.back().from_seen_px = 0.5;
        }
        all.edges.push_back(edge);
    }

  private:
    // From the nearest ground to the farthest, or to the sky.
    static PictureEdge edge_of(const std::array<Seen, 4>& around) {
        std::optional<ViewSample> near;
        double until_m = 0.0;
        for (const Seen& seen : around) {
            until_m = std::max(until_m, seen ? seen->distance_m : std::numeric_limits<double>::infinity());
            if (seen && (!near || seen->distance_m < near->distance_m)) near = seen;
        }
        return {*near, until_m};
    }

    const TrueGround& ground_;
    const Camera& camera_;
    Oracle oracle_;
    double reach_m_;
};

}  // namespace

std::vector<ViewSample> view_samples(const TrueGround& ground, const Sight& sight, const Camera& camera,
                                     int threads) {
    const ViewSampler sampler(ground, sight, camera);
    const int across = std::clamp(camera.width_px, 1, samples_across);
    const int down = std::clamp(samples_across * camera.height_px / std::max(1, camera.width_px), 1,
                                std::min(camera.height_px, 4 * samples_across));
    const std::vector<int> xs = spread(across, camera.width_px), ys = spread(down, camera.height_px);
    std::vector<std::vector<ViewSampler::Seen>> seen(ys.size(), std::vector<ViewSampler::Seen>(xs.size()));
    in_parallel(down, threads, [&](int i) {
        const std::size_t row = static_cast<std::size_t>(i);
        for (std::size_t j = 0; j < xs.size(); ++j) seen[row][j] = sampler.at(xs[j], ys[row], true);
    });
    std::vector<ViewSampler::Found> between(ys.size());
    in_parallel(down, threads, [&](int i) {
        const std::size_t row = static_cast<std::size_t>(i);
        ViewSampler::Found& found = between[row];
        const auto look_aside = [&](std::size_t column, double rim_x_px) {
            sampler.look_at_rim(seen[row][column], {rim_x_px, ys[row] + 0.5}, found);
        };
        look_aside(0, 0.0);
        look_aside(xs.size() - 1, camera.width_px);
        for (std::size_t j = 0; j < xs.size(); ++j) {
            if (row == 0) sampler.look_at_rim(seen[row][j], {xs[j] + 0.5, 0.0}, found);
            if (row + 1 == ys.size()) {
                sampler.look_at_rim(seen[row][j], {xs[j] + 0.5, camera.height_px}, found);
            } else if (j + 1 < xs.size()) {
                sampler.look_between(
                    {xs[j],
                     ys[row],
                     xs[j + 1],
                     ys[row + 1],
                     {seen[row][j], seen[row][j + 1], seen[row + 1][j], seen[row + 1][j + 1]}},
                    found);
            }
        }
    });
    std::vector<ViewSample> samples;
    std::vector<PictureEdge> edges;
    for (std::size_t row = 0; row < ys.size(); ++row) {
        for (const ViewSampler::Seen& one : seen[row])
            if (one) samples.push_back(*one);
        const ViewSampler::Found& found = between[row];
        samples.insert(samples.end(), found.samples.begin(), found.samples.end());
        edges.insert(edges.end(), found.edges.begin(), found.edges.end());
    }
    const std::vector<ViewSample> behind = samples_behind(ground, sight, camera, edges, threads);
    samples.insert(samples.end(), behind.begin(), behind.end());
    return samples;
}

}  // namespace oro
