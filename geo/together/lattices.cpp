#include "geo/together/lattices.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "geo/posts/own_posts.h"
#include "geo/region/disjoint_sources.h"
#include "geo/region/region_grid.h"

namespace oro {
namespace {

// One group of them all.
std::vector<std::vector<Source>> as_one(std::vector<Source> sources) {
    std::vector<std::vector<Source>> groups;
    groups.push_back(std::move(sources));
    return groups;
}

bool same_axis(const SourceAxis& one, const SourceAxis& other) {
    constexpr double same_post = 0.01;
    const double far = std::max(one.count, other.count);
    if (std::abs(one.posts_per_deg / other.posts_per_deg - 1.0) * far > same_post) return false;
    const double apart = (one.start_deg - other.start_deg) * one.posts_per_deg;
    return std::abs(apart - std::round(apart)) < same_post;
}

double posts_of(std::span<const Source> sources, const std::optional<BoundingBox>& box) {
    const auto extent = region_extent(sources, box);
    return extent ? posts_of_region(sources, *extent) : 0.0;
}

}  // namespace

bool share_lattice(const Source& one, const Source& other) {
    if (one.on_degrees != other.on_degrees) return false;
    if (one.on_degrees)
        return same_axis(one.lat_axis, other.lat_axis) && same_axis(one.lon_axis, other.lon_axis);
    return is_on_lattice(one, other);
}

std::vector<std::vector<Source>> by_lattice(std::vector<Source> sources,
                                            const std::optional<BoundingBox>& box) {
    std::vector<std::vector<Source>> lattices;
    for (const Source& source : sources) {
        const auto own = std::ranges::find_if(lattices, [&](const std::vector<Source>& lattice) {
            return share_lattice(source, lattice.front());
        });
        if (own == lattices.end())
            lattices.push_back({source});
        else
            own->push_back(source);
    }
    if (lattices.size() < 2) return as_one(std::move(sources));
    double alone = 0.0;
    for (const std::vector<Source>& lattice : lattices) alone += posts_of(lattice, box);
    const bool cheap = posts_of(sources, box) < apart_factor * alone;
    if (cheap && std::ranges::all_of(sources, &Source::on_degrees)) return as_one(std::move(sources));
    return lattices;
}

std::vector<std::vector<Source>> grids_of_sources(std::vector<Source> sources, const RegionRequest& request) {
    if (!request.allow_multiple_grids) return as_one(std::move(sources));
    std::vector<std::vector<Source>> grids;
    for (std::vector<Source>& near : disjoint_sources(std::move(sources), request.box)) {
        if (request.resample) {
            grids.push_back(std::move(near));
            continue;
        }
        for (std::vector<Source>& lattice : by_lattice(std::move(near), request.box))
            for (std::vector<Source>& grid : disjoint_sources(std::move(lattice), request.box))
                grids.push_back(std::move(grid));
    }
    if (grids.size() <= groups_max) return grids;
    std::vector<Source> all;
    for (std::vector<Source>& grid : grids) std::ranges::move(grid, std::back_inserter(all));
    return as_one(std::move(all));
}

}  // namespace oro
