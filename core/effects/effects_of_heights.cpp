// What levels leave out, and what nobody has measured.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <utility>
#include <vector>

#include "core/effects/effect_sizes.h"
#include "core/effects/effects.h"
#include "core/frame/sampled_detail.h"
#include "core/lod/levels_gpu.h"

namespace oro {

EffectSize EffectPrediction::found_off_by(const std::function<double(const ViewSample&)>& height_m) const {
    Sizes sizes;
    for (const Sample& sample : samples_) {
        if (sample.from_seen_px > 0.0) continue;  // what is seen
        const double off_m = height_m(sample);
        sizes.add(off_m, vertical_px(sample, off_m), sample.even);
    }
    return sizes.size(1.0);
}

// From the posts around what is seen: how far each second one lies from the middle of its neighbours is how
// far the ground may lie from the middle of posts twice as dense; half of that typically.
EffectSize EffectPrediction::interpolation(int apart) const {
    EffectSize size = found_off_by([&](const Sample& sample) {
        double bend_m = 0.0;
        for (const auto& [down, right] : {std::pair(apart, 0), std::pair(0, apart)}) {
            const PostGrid& posts = grid(sample);
            if (sample.row < down || sample.column < right || sample.row + down >= posts.rows() ||
                sample.column + right >= posts.columns())
                continue;
            const auto before = surface(sample).post_h_m(sample.row - down, sample.column - right);
            const auto here = surface(sample).post_h_m(sample.row, sample.column);
            const auto after = surface(sample).post_h_m(sample.row + down, sample.column + right);
            if (!before || !here || !after) continue;
            bend_m = std::max(bend_m, std::abs(*here - 0.5 * (*before + *after)));
        }
        return bend_m;
    });
    size.typical_m *= 0.5;
    size.typical_px *= 0.5;
    return size;
}

EffectSize EffectPrediction::interpolation_estimate(int apart) const {
    EffectSize size = interpolation(apart);
    size.worst_m *= between_samples;
    size.worst_px *= between_samples;
    return size;
}

Result<EffectSize> EffectPrediction::detail(double tau_px) const {
    Camera drawn = camera_;
    if (pages_[0].facts().undulation.N_m.empty())
        drawn.eye.h_m -= ground_.N_m(drawn.eye.lat_deg, drawn.eye.lon_deg);
    std::vector<std::unique_ptr<SampledDetail>> details;
    for (std::size_t grid = 0; grid < pages_.size(); ++grid)
        details.push_back(std::make_unique<SampledDetail>(pages_[grid], drawn, tau_px, sight_.refraction));
    constexpr double between_nodes = 1.5;
    Sizes heights, sideways;
    for (const Sample& sample : samples_) {
        ORO_TRY(const SampledDetail::Bound bound, details[sample.grid]->at(sample.row, sample.column));
        if (sample.from_seen_px > in_gaps_px + between_nodes * bound.error_px) continue;
        heights.add(bound.error_m, bound.error_px, sample.even);
        const double flat_m =
            bound.level == 0 ? 0.0 : flat_triangle(sample, std::ldexp(1.0, bound.level)).sideways_m;
        sideways.add(flat_m, any_way_px(sample, flat_m), sample.even);
    }
    EffectSize size = heights.size(between_nodes);
    size.worst_px = std::min(size.worst_px, tau_px);
    const EffectSize gaps = gaps_closed(tau_px);
    size.worst_m = std::max(size.worst_m, gaps.worst_m);
    size.worst_px = std::max(size.worst_px, gaps.worst_px);
    // Levels are certified by how far the surface moves; along it ground points move a little, too.
    const EffectSize flat = sideways.size(nearer);
    size.worst_m += flat.worst_m;
    size.worst_px += flat.worst_px;
    return size;
}

// What closes the gaps along the rims of grids reaches out over the picture, by no more than levels may move
// what it joins (core/seam/seam.h). 0 where no rim is in the picture.
EffectSize EffectPrediction::gaps_closed(double tau_px) const {
    const double reach_px = std::max(tau_px, static_cast<double>(gpu::least_gap_px));
    EffectSize size;
    const auto add = [&](const glm::dvec3& corner_m) {
        const glm::dvec3 seen_m = sight_.refraction.apparent_m(corner_m - sight_.eye.m);
        if ((view_from_ecef_ * seen_m).z >= 0.0 || outside_px(seen_m) > reach_px) return;
        size.worst_px = reach_px;
        size.worst_m = std::max(size.worst_m, reach_px / pixels_per_tangent_ * glm::length(seen_m));
    };
    for (const SurfaceTriangle& piece : ground_.pieces())
        for (const Geodetic& corner : piece.corners) add(ecef_from_geodetic(corner).m);
    for (const TrueMesh& mesh : ground_.meshes())
        for (const glm::dvec3& vertex_m : mesh.vertices_m()) add(vertex_m);
    return size;
}

// Nothing where no source says anything of itself; grids whose source does not count as right.
std::optional<EffectSize> EffectPrediction::stated_by_source() const {
    // Of a normal distribution: half of all errors are within 0.41 of what holds 90 %.
    constexpr double half_of_all = 0.41;
    std::vector<HeightsOff> stated;
    bool any = false;
    for (const EarthParameters::OfGrid& grid : world_.grids) {
        any |= grid.source_le90_m.has_value();
        const double le90_m = grid.source_le90_m.value_or(0.0);
        stated.push_back({le90_m, half_of_all * le90_m});
    }
    if (!any) return std::nullopt;
    return heights_off(stated);
}

EffectSize EffectPrediction::heights_off(std::span<const HeightsOff> of_grids) const {
    assert(of_grids.size() == ground_.grids());
    EffectSize size = lifted([&](const Sample& sample) { return of_grids[sample.grid].worst_m; });
    Sizes typical;
    double seen_m = 0.0;
    for (const Sample& sample : samples_) {
        const HeightsOff& off = of_grids[sample.grid];
        seen_m = std::max(seen_m, off.worst_m);
        const double share = off.worst_m > 0.0 ? off.typical_m / off.worst_m : 0.0;
        typical.add(off.typical_m, share * vertical_px(sample, off.worst_m), sample.even);
    }
    const EffectSize usual = typical.size(1.0);
    size.typical_px = usual.typical_px;
    size.typical_m = empty() ? of_grids.front().typical_m : usual.typical_m;
    size.worst_m = empty() ? of_grids.front().worst_m : seen_m;
    return size;
}

EffectSize EffectPrediction::heights_off_by(const std::function<double(const ViewSample&)>& height_m) const {
    EffectSize size = lifted(height_m);
    Sizes off;
    size.worst_m = 0.0;
    for (const Sample& sample : samples_) {
        const double off_m = height_m(sample);
        size.worst_m = std::max(size.worst_m, off_m);
        off.add(off_m, vertical_px(sample, off_m), sample.even);
    }
    const EffectSize usual = off.size(1.0);
    size.typical_m = usual.typical_m;
    size.typical_px = usual.typical_px;
    return size;
}

}  // namespace oro
