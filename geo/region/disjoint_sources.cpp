#include "geo/region/disjoint_sources.h"

#include <algorithm>
#include <numeric>

#include "geo/region/region_grid.h"

namespace oro {
namespace {

// Whether two surfaces touch: their boxes are at most a spacing of the coarser one apart, in any turn.
bool touch(const Source& one, const Source& other) {
    const double lat_gap = std::max(one.lat_spacing_deg, other.lat_spacing_deg) * 1.01;
    if (one.south_deg > other.north_deg + lat_gap || other.south_deg > one.north_deg + lat_gap) return false;
    if (one.full_circle || other.full_circle) return true;
    const double lon_gap = std::max(one.lon_spacing_deg, other.lon_spacing_deg) * 1.01;
    return !turns_that_meet(one.lon, other.lon.west_deg - lon_gap, other.lon.east_deg + lon_gap).empty();
}

// Of each source, the number of the first one of its group.
std::vector<std::size_t> groups_of(const std::vector<Source>& sources) {
    std::vector<std::size_t> first(sources.size());
    std::iota(first.begin(), first.end(), std::size_t{0});
    const auto root = [&](std::size_t i) {
        while (first[i] != i) i = first[i] = first[first[i]];
        return i;
    };
    for (std::size_t i = 0; i < sources.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const std::size_t a = root(i), b = root(j);
            if (a != b && touch(sources[i], sources[j])) first[std::max(a, b)] = std::min(a, b);
        }
    }
    for (std::size_t i = 0; i < sources.size(); ++i) first[i] = root(i);
    return first;
}

double posts_of(std::span<const Source> sources, const std::optional<BoundingBox>& box) {
    const auto extent = region_extent(sources, box);
    return extent ? posts_of_region(sources, *extent) : 0.0;
}

}  // namespace

std::vector<std::vector<Source>> disjoint_sources(std::vector<Source> sources,
                                                  const std::optional<BoundingBox>& box) {
    const std::vector<std::size_t> first = groups_of(sources);
    const double together = posts_of(sources, box);
    std::vector<std::vector<Source>> groups;
    std::vector<std::size_t> numbers(sources.size());
    std::vector<Source> all = sources;
    for (std::size_t i = 0; i < sources.size(); ++i) {
        if (first[i] == i) {
            numbers[i] = groups.size();
            groups.emplace_back();
        }
        groups[numbers[first[i]]].push_back(std::move(sources[i]));
    }
    double alone = 0.0;
    for (const std::vector<Source>& group : groups) alone += posts_of(group, box);
    if (groups.size() < 2 || groups.size() > groups_max || together < apart_factor * alone)
        return {std::move(all)};
    return groups;
}

}  // namespace oro
