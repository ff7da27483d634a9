#include "geo/posts/seams.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>
#include <string_view>

#include "geo/sources/row_scans.h"

namespace oro {
namespace {

std::string_view file_name(std::string_view path) {
    const std::size_t slash = path.rfind('/');
    return slash == std::string_view::npos ? path : path.substr(slash + 1);
}

}  // namespace

Precedence precedence_of(const SourceReport& source) {
    // Files of one lattice have the same, wherever on it they lie.
    const double nominal_deg = source.nominal_spacing_deg;
    if (nominal_deg > 0.0) return {source.listed, nominal_deg, nominal_deg, source.path};
    return {source.listed, source.lat_spacing_deg, source.lon_spacing_deg, source.path};
}

std::vector<std::size_t> by_precedence(std::span<const Precedence> sources) {
    // Spacings are compared in classes, so that the order stays one: each class starts at its finest member.
    std::vector<std::size_t> order(sources.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto spacing = [&](std::size_t i) {
        return std::sqrt(sources[i].lat_spacing_deg * sources[i].lon_spacing_deg);
    };
    std::ranges::sort(order, {}, spacing);
    std::vector<int> spacing_class(sources.size());
    double finest = 0.0;
    int current = 0;
    for (const std::size_t i : order) {
        if (spacing(i) > finest * (1.0 + 1e-6)) {
            finest = spacing(i);
            ++current;
        }
        spacing_class[i] = current;
    }
    std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
        if (sources[a].listed != sources[b].listed) return sources[a].listed < sources[b].listed;
        if (spacing_class[a] != spacing_class[b]) return spacing_class[a] < spacing_class[b];
        const std::string_view name_a = file_name(sources[a].path);
        const std::string_view name_b = file_name(sources[b].path);
        if (name_a != name_b) return name_a < name_b;
        return sources[a].path < sources[b].path;
    });
    return order;
}

std::vector<std::size_t> by_precedence(std::span<const Source> sources) {
    std::vector<Precedence> ranks;
    for (const Source& source : sources) {
        Precedence rank = precedence_of(source.report);
        if (source.report.nominal_spacing_deg <= 0.0) {
            rank.lat_spacing_deg = source.lat_spacing_deg;
            rank.lon_spacing_deg = source.lon_spacing_deg;
        }
        ranks.push_back(rank);
    }
    return by_precedence(ranks);
}

std::string note_of_contradictions(std::span<const Source> sources) {
    constexpr std::size_t most_named = 4;
    // Between posts that are much farther apart, mountains rise that coarse data does not have.
    constexpr double like_spacing = 4.0;
    double finest_m = std::numeric_limits<double>::infinity();
    for (const Source& source : sources) finest_m = std::min(finest_m, source.report.spacing_m);
    std::string names;
    std::size_t count = 0;
    double largest_m = 0.0;
    for (const Source& source : sources) {
        const SeamReport& seams = source.report.seams;
        if (2 * seams.contradicting_posts <= seams.compared_posts) continue;
        if (seams.shared_posts < seams.compared_posts && source.report.spacing_m > like_spacing * finest_m)
            continue;
        largest_m = std::max(largest_m, seams.largest_contradiction_m);
        if (++count > most_named) continue;
        names += (names.empty() ? "" : ", ") + source.report.path + " (" +
                 std::to_string(seams.contradicting_posts) + " of " + std::to_string(seams.compared_posts) +
                 " shared posts)";
    }
    if (count == 0) return "";
    if (count > most_named) names += " and " + std::to_string(count - most_named) + " more files";
    char by[80];
    std::snprintf(by, sizeof by,
                  "files contradict each other by more than %.0f m, up to %.1f m: ", contradiction_m,
                  largest_m);
    return by + names +
           " against what wins over it; one holds no elevation, or counts in another unit or from another "
           "datum, or lies elsewhere";
}

JoinedSurface::JoinedSurface(const PostGrid& grid)
    : grid_(grid), heights_(grid.post_count(), void_height_m), marks_(grid.post_count(), 0) {}

std::uint64_t JoinedSurface::lay(int row, int first_column, std::span<const float> heights,
                                 std::span<const unsigned char> inside, bool own_posts,
                                 SeamReport& of_source) {
    const std::size_t start = static_cast<std::size_t>(row) * static_cast<std::size_t>(grid_.columns()) +
                              static_cast<std::size_t>(first_column);
    std::uint64_t voids_filled = 0;
    constexpr std::size_t piece = 128;
    for (std::size_t c = 0; c < heights.size(); c += piece) {
        const std::size_t count = std::min(piece, heights.size() - c);
        const std::span part = heights.subspan(c, count);
        const std::span inside_of_part = inside.subspan(c, count);
        if (!lay_on_none(start + c, part, inside_of_part, own_posts))
            voids_filled += lay_posts(start + c, part, inside_of_part, own_posts, of_source);
    }
    return voids_filled;
}

// What most posts are: a source has heights for all of a stretch, and none was there before. False where that
// is not so; then nothing is laid.
bool JoinedSurface::lay_on_none(std::size_t post, std::span<const float> heights,
                                std::span<const unsigned char> inside, bool own_posts) {
    const std::size_t count = heights.size();
    const std::span there = std::span(heights_).subspan(post, count);
    const std::span marks = std::span(marks_).subspan(post, count);
    const auto any = [](unsigned char mark) { return mark != 0; };
    if (std::ranges::find(inside, static_cast<unsigned char>(0)) != inside.end() ||
        std::ranges::any_of(marks, any) || !all_void(there) || any_void(heights))
        return false;
    std::ranges::copy(heights, there.begin());
    std::ranges::fill(marks, static_cast<unsigned char>(covered_mark | (own_posts ? own_mark : 0)));
    return true;
}

// Post by post. Gives what lay() gives.
std::uint64_t JoinedSurface::lay_posts(std::size_t start, std::span<const float> heights,
                                       std::span<const unsigned char> inside, bool own_posts,
                                       SeamReport& of_source) {
    std::uint64_t voids_filled = 0;
    for (std::size_t c = 0; c < heights.size(); ++c) {
        if (!inside[c]) continue;
        const std::size_t post = start + c;
        unsigned char& marks = marks_[post];
        const bool covered_before = (marks & covered_mark) != 0;
        marks |= covered_mark;
        if (is_void(heights[c])) continue;
        if (is_void(heights_[post])) {
            heights_[post] = heights[c];
            voids_filled += covered_before;
            if (own_posts) marks |= own_mark;
            continue;
        }
        const double difference =
            std::abs(static_cast<double>(heights[c]) - static_cast<double>(heights_[post]));
        ++of_source.compared_posts;
        if (difference > contradiction_m) {
            ++of_source.contradicting_posts;
            of_source.largest_contradiction_m = std::max(of_source.largest_contradiction_m, difference);
        }
        if (!own_posts || !(marks & own_mark)) continue;
        if (!(marks & shared_mark)) ++seams_.shared_posts;
        marks |= shared_mark;
        ++of_source.shared_posts;
        of_source.disagreeing_posts += difference > 0.0;
        of_source.largest_difference_m = std::max(of_source.largest_difference_m, difference);
        if (difference > 0.0 && !(marks & disagreeing_mark)) {
            ++seams_.disagreeing_posts;
            marks |= disagreeing_mark;
        }
        seams_.largest_difference_m = std::max(seams_.largest_difference_m, difference);
    }
    return voids_filled;
}

void JoinedSurface::lay_later(int row, int first_column, std::span<const float> heights) {
    const std::size_t start = static_cast<std::size_t>(row) * static_cast<std::size_t>(grid_.columns()) +
                              static_cast<std::size_t>(first_column);
    for (std::size_t c = 0; c < heights.size(); ++c) {
        if (!is_void(heights[c])) later_.push_back({start + c, heights[c]});
    }
}

void JoinedSurface::unite_pole(int row) {
    const auto columns = static_cast<std::size_t>(grid_.columns());
    const std::span<float> posts(heights_.data() + static_cast<std::size_t>(row) * columns, columns);
    double sum = 0.0;
    std::size_t count = 0;
    for (const float height : posts) {
        if (is_void(height)) continue;
        sum += static_cast<double>(height);
        ++count;
    }
    if (count == 0) return;
    std::ranges::fill(posts, static_cast<float>(sum / static_cast<double>(count)));
}

void JoinedSurface::finish() {
    for (const Later& later : later_) {
        if (is_void(heights_[later.post])) heights_[later.post] = later.height;
    }
    later_ = {};
    if (grid_.net) return;
    const auto columns = static_cast<std::size_t>(grid_.columns());
    if (grid_.columns() > 1 && std::abs(grid_.east_deg() - grid_.west_deg() - 360.0) < 1e-9) {
        for (std::size_t first = 0; first < heights_.size(); first += columns) {
            float& west = heights_[first];
            float& east = heights_[first + columns - 1];
            if (is_void(west)) west = east;
            east = west;
        }
    }
    if (grid_.north_deg() >= 90.0) unite_pole(0);
    if (grid_.south_deg() <= -90.0) unite_pole(grid_.rows() - 1);
}

}  // namespace oro
