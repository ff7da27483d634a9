#include "geo/region/region_grid.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/base/system_room.h"
#include "core/earth/ellipsoid.h"

namespace oro {
namespace {

// Overlaps narrower than this are lines, not areas (1e-7 degree is 1 cm).
constexpr double line_deg = 1e-7;
// Posts nearer to a bound than this share of their spacing are on it.
constexpr double on_post = 1e-6;

double whole_turns(double lon_deg) {
    return std::floor((lon_deg + 180.0) / 360.0) * 360.0;
}

// The narrowest interval that holds all spans: what is left of the circle without its largest gap.
LonSpan narrowest(std::span<const Source> sources) {
    std::vector<LonSpan> spans;
    for (const Source& source : sources) {
        if (source.full_circle) return {-180.0, 180.0};
        const double turn = whole_turns(source.lon.west_deg);
        spans.push_back({source.lon.west_deg - turn, source.lon.east_deg - turn});
    }
    std::ranges::sort(spans, {}, &LonSpan::west_deg);
    double covered = spans.front().east_deg;
    double start = spans.front().west_deg;
    double largest_gap = -1.0;
    for (std::size_t i = 1; i < spans.size(); ++i) {
        const double gap = spans[i].west_deg - covered;
        if (gap > largest_gap) {
            largest_gap = gap;
            start = spans[i].west_deg;
        }
        covered = std::max(covered, spans[i].east_deg);
    }
    const double gap_over_antimeridian = spans.front().west_deg + 360.0 - covered;
    if (gap_over_antimeridian >= largest_gap) {
        largest_gap = gap_over_antimeridian;
        start = spans.front().west_deg;
    }
    if (largest_gap < line_deg) return {-180.0, 180.0};
    return {start, start + 360.0 - largest_gap};
}

// Bounds of a source with its reach over seams; not unwrapped.
BoundingBox reached(const Source& source) {
    return {source.lon.west_deg - source.reach.west_deg, source.south_deg - source.reach.south_deg,
            source.lon.east_deg + source.reach.east_deg, source.north_deg + source.reach.north_deg};
}

LonSpan reached_lon(const Source& source) {
    const BoundingBox box = reached(source);
    return {box.west_deg, box.east_deg};
}

double finest_per_deg(std::span<const Source> sources, bool latitude, double lat_nearest_equator_deg) {
    double finest = 0.0;
    for (const Source& source : sources) {
        double spacing = latitude ? source.lat_spacing_deg : source.lon_spacing_deg;
        if (!latitude && source.projected) {
            const double radius = prime_vertical_radius_m(lat_nearest_equator_deg) *
                                  std::max(1e-6, std::cos(radians_from_deg(lat_nearest_equator_deg).rad));
            // Meridians run together towards a pole; a degree is close enough there whatever the metres.
            spacing = std::min(1.0, deg_from_radians(Radians(source.report.spacing_m / radius)));
        }
        finest = std::max(finest, 1.0 / spacing);
    }
    return finest;
}

// A whole number of posts a degree, or of degrees a post, no coarser than asked.
double rounded_per_deg(double per_deg) {
    if (per_deg >= 1.0) return std::ceil(per_deg - on_post);
    return 1.0 / std::floor(1.0 / per_deg + on_post);
}

// Angle of the post nearest to zero of an axis with posts at `start`.
double phase_of(double start_deg, double per_deg) {
    const double index = start_deg * per_deg;
    const double off_index = index - std::round(index);
    if (std::abs(off_index) < on_post) return 0.0;
    if (std::abs(std::abs(off_index) - 0.5) < on_post) return 0.5 / per_deg;
    return off_index / per_deg;
}

struct Spacing {
    double per_deg;
    double phase_deg;
};

Spacing spacing_of(std::span<const Source> sources, bool latitude, const BoundingBox& box) {
    const double nearest_equator = box.south_deg <= 0.0 && box.north_deg >= 0.0
                                       ? 0.0
                                       : std::min(std::abs(box.south_deg), std::abs(box.north_deg));
    const double needed = finest_per_deg(sources, latitude, nearest_equator);
    const Source* reference = nullptr;
    const auto per_deg = [&](const Source& s) {
        return latitude ? s.lat_axis.posts_per_deg : s.lon_axis.posts_per_deg;
    };
    for (const Source& source : sources) {
        if (source.on_degrees && (!reference || per_deg(source) > per_deg(*reference))) reference = &source;
    }
    if (!reference) return {rounded_per_deg(needed), 0.0};
    // A quarter coarser than another source is fine enough: a whole second grid would cost twice the posts.
    const double parts = std::max(1.0, std::ceil(needed / per_deg(*reference) - 0.25));
    double start = latitude ? reference->lat_axis.start_deg : reference->lon_axis.start_deg;
    if (!latitude) {
        const auto turns = turns_that_meet(reference->lon, box.west_deg, box.east_deg);
        if (!turns.empty()) start += 360.0 * turns.front();
    }
    return {parts * per_deg(*reference), phase_of(start, per_deg(*reference))};
}

// World indices of the first and last post between two angles: outwards where that bound was asked for,
// otherwise inwards.
std::pair<std::int64_t, std::int64_t> posts_between(const Spacing& spacing, double low_deg, bool low_asked,
                                                    double high_deg, bool high_asked) {
    const double low = (low_deg - spacing.phase_deg) * spacing.per_deg;
    const double high = (high_deg - spacing.phase_deg) * spacing.per_deg;
    const double first_out = std::floor(low + on_post);
    const double last_out = std::ceil(high - on_post);
    double first = low_asked ? first_out : std::ceil(low - on_post);
    double last = high_asked ? last_out : std::floor(high + on_post);
    if (last - first < 1.0) {
        first = first_out;
        last = std::max(last_out, first_out + 1.0);
    }
    return {static_cast<std::int64_t>(first), static_cast<std::int64_t>(last)};
}

double middle_of(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

// Which sources make a region large: the one with the closest posts, and the one that lies farthest from
// where most lie.
std::string large_by(std::span<const Source> sources) {
    if (sources.size() < 2) return "";
    const Source& finest = sources[finest_of(sources)];
    const Source& farthest = sources[farthest_of(sources)];
    char spacing[40];
    std::snprintf(spacing, sizeof spacing, "%.3g m", finest.report.spacing_m);
    return ". Its closest posts, " + std::string(spacing) + " apart, are those of " + finest.report.path +
           "; farthest from the others lies " + farthest.report.path +
           ": open such files by themselves, or leave them out";
}

}  // namespace

Result<void> check_size(double rows, double columns, const BoundingBox& box,
                        std::span<const Source> sources) {
    // Heights, what is known of each post, and the pages built from them.
    constexpr double bytes_a_post = 12.0;
    const auto memory_bytes = machine_memory_bytes();
    // A machine that does not say it may have any.
    const double memory =
        memory_bytes ? static_cast<double>(*memory_bytes) : std::numeric_limits<double>::infinity();
    const double posts = rows * columns;
    const double most = std::min(0.75 * memory / bytes_a_post, 1e6 * std::numeric_limits<int>::max());
    if (posts <= most && std::max(rows, columns) < std::numeric_limits<int>::max()) return {};
    const double side = std::sqrt(most / posts);
    char what[320];
    std::snprintf(what, sizeof what,
                  "the region would have %.0f x %.0f = %.3g posts, which need %.3g GB; this machine has %.3g "
                  "GB. Narrow it with "
                  "--bbox to about %.3g x %.3g degrees",
                  rows, columns, posts, posts * bytes_a_post / 1e9, memory / 1e9,
                  (box.east_deg - box.west_deg) * side * 0.99, (box.north_deg - box.south_deg) * side * 0.99);
    return Error{ErrorKind::failed, "region too large", what + large_by(sources)};
}

std::size_t finest_of(std::span<const Source> sources) {
    return static_cast<std::size_t>(std::ranges::min_element(sources, {}, &Source::lat_spacing_deg) -
                                    sources.begin());
}

std::size_t farthest_of(std::span<const Source> sources) {
    std::vector<double> lats_deg, lons_deg;
    for (const Source& source : sources) {
        lats_deg.push_back(source.south_deg);
        lons_deg.push_back(source.lon.west_deg);
    }
    const double lat_deg = middle_of(lats_deg), lon_deg = middle_of(lons_deg);
    const auto away_deg = [&](const Source& source) {
        const double turned = std::abs(std::remainder(source.lon.west_deg - lon_deg, 360.0));
        return std::max(std::abs(source.south_deg - lat_deg), turned);
    };
    return static_cast<std::size_t>(std::ranges::max_element(sources, {}, away_deg) - sources.begin());
}

BoundingBox unwrapped(const BoundingBox& box) {
    BoundingBox result = box;
    if (result.west_deg > result.east_deg) result.east_deg += 360.0;
    const double turn = whole_turns(result.west_deg);
    result.west_deg -= turn;
    result.east_deg -= turn;
    return result;
}

std::vector<int> turns_that_meet(const LonSpan& span, double west_deg, double east_deg) {
    std::vector<int> turns;
    for (const int turn : {-2, -1, 0, 1, 2}) {
        const double overlap = std::min(span.east_deg + 360.0 * turn, east_deg) -
                               std::max(span.west_deg + 360.0 * turn, west_deg);
        if (overlap > line_deg) turns.push_back(turn);
    }
    return turns;
}

void reach_over_seams(std::span<Source> sources) {
    // Posts of neighbours are this far apart, where their cells touch; rounding may add a little.
    constexpr double slack = 1.01;
    for (Source& source : sources) {
        for (const Source& other : sources) {
            const double lat_gap = 0.5 * (source.lat_spacing_deg + other.lat_spacing_deg) * slack;
            const double lon_gap = 0.5 * (source.lon_spacing_deg + other.lon_spacing_deg) * slack;
            const double north_gap = other.south_deg - source.north_deg;
            const double south_gap = source.south_deg - other.north_deg;
            if (north_gap > lat_gap || south_gap > lat_gap) continue;
            const LonSpan widened{source.lon.west_deg - lon_gap, source.lon.east_deg + lon_gap};
            const std::vector<int> turns = turns_that_meet(other.lon, widened.west_deg, widened.east_deg);
            if (turns.empty() && !source.full_circle && !other.full_circle) continue;
            if (north_gap > 0.0) source.reach.north_deg = std::max(source.reach.north_deg, north_gap);
            if (south_gap > 0.0) source.reach.south_deg = std::max(source.reach.south_deg, south_gap);
            for (const int turn : turns) {
                const double east_gap = other.lon.west_deg + 360.0 * turn - source.lon.east_deg;
                const double west_gap = source.lon.west_deg - other.lon.east_deg - 360.0 * turn;
                if (east_gap > 0.0) source.reach.east_deg = std::max(source.reach.east_deg, east_gap);
                if (west_gap > 0.0) source.reach.west_deg = std::max(source.reach.west_deg, west_gap);
            }
        }
    }
}

bool meets(const Source& source, const BoundingBox& box) {
    if (std::min(reached(source).north_deg, box.north_deg) -
            std::max(reached(source).south_deg, box.south_deg) <=
        line_deg)
        return false;
    return source.full_circle || !turns_that_meet(reached_lon(source), box.west_deg, box.east_deg).empty();
}

std::optional<RegionExtent> region_extent(std::span<const Source> sources,
                                          const std::optional<BoundingBox>& asked) {
    if (sources.empty()) return std::nullopt;
    BoundingBox limits{};
    if (asked) {
        limits = unwrapped(*asked);
    } else {
        const LonSpan span = narrowest(sources);
        limits = {span.west_deg, -90.0, span.east_deg, 90.0};
    }
    BoundingBox hull{limits.east_deg, 90.0, limits.west_deg, -90.0};
    bool any = false;
    for (const Source& source : sources) {
        if (!meets(source, limits)) continue;
        any = true;
        const BoundingBox bounds = reached(source);
        hull.south_deg = std::min(hull.south_deg, std::max(bounds.south_deg, limits.south_deg));
        hull.north_deg = std::max(hull.north_deg, std::min(bounds.north_deg, limits.north_deg));
        if (source.full_circle) {
            hull.west_deg = limits.west_deg;
            hull.east_deg = limits.east_deg;
            continue;
        }
        for (const int turn : turns_that_meet(reached_lon(source), limits.west_deg, limits.east_deg)) {
            hull.west_deg =
                std::min(hull.west_deg, std::max(bounds.west_deg + 360.0 * turn, limits.west_deg));
            hull.east_deg =
                std::max(hull.east_deg, std::min(bounds.east_deg + 360.0 * turn, limits.east_deg));
        }
    }
    if (!any) return std::nullopt;
    RegionExtent extent{hull};
    if (asked) {
        extent.west_asked = hull.west_deg == limits.west_deg;
        extent.east_asked = hull.east_deg == limits.east_deg;
        extent.south_asked = hull.south_deg == limits.south_deg;
        extent.north_asked = hull.north_deg == limits.north_deg;
    }
    const double turn = whole_turns(extent.box.west_deg);
    extent.box.west_deg -= turn;
    extent.box.east_deg -= turn;
    return extent;
}

std::optional<RegionExtent> choose_extent(std::vector<Source>& sources,
                                          const std::optional<BoundingBox>& box) {
    if (box) reach_over_seams(sources);
    const auto extent = region_extent(sources, box);
    if (extent) std::erase_if(sources, [&](const Source& source) { return !meets(source, extent->box); });
    return extent;
}

namespace {

// World indices of a region's outermost posts.
struct WorldPosts {
    Spacing lat, lon;
    std::int64_t north, south, west, east;

    [[nodiscard]] double rows() const { return static_cast<double>(north - south + 1); }
    [[nodiscard]] double columns() const { return static_cast<double>(east - west + 1); }
};

WorldPosts world_posts(std::span<const Source> sources, const RegionExtent& extent) {
    const BoundingBox& box = extent.box;
    const Spacing lat = spacing_of(sources, true, box);
    const Spacing lon = spacing_of(sources, false, box);
    auto [south, north] =
        posts_between(lat, box.south_deg, extent.south_asked, box.north_deg, extent.north_asked);
    const auto pole = [&](double pole_deg) { return (pole_deg - lat.phase_deg) * lat.per_deg; };
    north = std::min(north, static_cast<std::int64_t>(std::floor(pole(90.0) + on_post)));
    south = std::max(south, static_cast<std::int64_t>(std::ceil(pole(-90.0) - on_post)));
    auto [west, east] = posts_between(lon, box.west_deg, extent.west_asked, box.east_deg, extent.east_asked);
    const double circle = 360.0 * lon.per_deg;
    if (box.east_deg - box.west_deg >= 360.0 - line_deg ||
        static_cast<double>(east - west) > circle + on_post) {
        west = static_cast<std::int64_t>(std::ceil((box.west_deg - lon.phase_deg) * lon.per_deg - on_post));
        east = west + static_cast<std::int64_t>(std::floor(circle + on_post));
    }
    // A first post snapped beyond the antimeridian is the same one at the other end of the world, if the
    // posts close up.
    if (lon.phase_deg + static_cast<double>(west) / lon.per_deg < -180.0) {
        const bool closes = std::abs(circle - std::round(circle)) < on_post;
        const auto turn = static_cast<std::int64_t>(std::round(circle));
        west += closes ? turn : 1;
        east += closes ? turn : 0;
    }
    return {lat, lon, north, south, west, east};
}

}  // namespace

double posts_of_region(std::span<const Source> sources, const RegionExtent& extent) {
    const WorldPosts posts = world_posts(sources, extent);
    return posts.rows() * posts.columns();
}

Result<PostGrid> region_grid(std::span<const Source> sources, const RegionExtent& extent) {
    const WorldPosts posts = world_posts(sources, extent);
    ORO_CHECK(check_size(posts.rows(), posts.columns(), extent.box, sources));
    return grid_over(sources, extent);
}

PostGrid grid_over(std::span<const Source> sources, const RegionExtent& extent) {
    const WorldPosts posts = world_posts(sources, extent);
    PostGrid grid;
    grid.lat = {posts.lat.per_deg, posts.lat.phase_deg, posts.north, -1, static_cast<int>(posts.rows())};
    grid.lon = {posts.lon.per_deg, posts.lon.phase_deg, posts.west, +1, static_cast<int>(posts.columns())};
    return grid;
}

}  // namespace oro
