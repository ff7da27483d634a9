#include "geo/opening/made_world.h"

#include <algorithm>
#include <cstdio>
#include <utility>
#include <vector>

#include "core/base/checksum.h"
#include "core/made/made_heights.h"
#include "core/made/made_rule.h"
#include "core/made_pages/made_pages.h"
#include "geo/datum/vertical_datum.h"
#include "geo/region/region_fingerprints.h"
#include "geo/region/region_grid.h"
#include "geo/sources/made_words.h"
#include "geo/sources/notes.h"

namespace oro {
namespace {

std::optional<MadeTerrain> terrain_of(std::span<const Source> sources) {
    if (sources.size() != 1 || sources.front().kind != SourceKind::made) return std::nullopt;
    const Result<MadeTerrain> made = made_terrain_of(sources.front().file);
    return made.ok() && makes_pages(*made) ? std::optional(*made) : std::nullopt;
}

}  // namespace

bool is_made_world(const ChosenGrid& chosen) {
    return !chosen.baked && is_made_world(chosen.sources, chosen.extent);
}

bool is_made_world(std::span<const Source> sources, const RegionExtent& extent) {
    if (!terrain_of(sources)) return false;
    const double posts = posts_of_region(sources, extent);
    return posts > posts_made_at_once && posts <= most_made_posts;
}

Result<RegionGrid> made_world(const ChosenGrid& chosen, const RegionRequest& request,
                              std::vector<std::string> notes) {
    const MadeTerrain made = *terrain_of(chosen.sources);
    RegionGrid world;
    world.notes = std::move(notes);
    world.rank = chosen.rank;
    ORO_TRY(const GeoidOfRegion geoid, GeoidOfRegion::open(request.strict_datum));
    const PostGrid grid = grid_over(chosen.sources, chosen.extent);
    const BoundingBox posts{grid.west_deg(), grid.south_deg(), grid.east_deg(), grid.north_deg()};
    ORO_TRY(const UndulationField undulation, geoid.undulation(posts));
    world.geoid = geoid.name();
    add_note(world.notes, geoid.note());
    world.field = made_field(made, grid, undulation);
    SourceReport report = chosen.sources.front().report;
    report.lowest_m = made_step_m * made.low;
    report.highest_m = made_step_m * made.high;
    world.sources.push_back(std::move(report));
    const gpu::MadeRule rule = made_rule(made);
    RunningChecksum sum;
    sum.add(std::as_bytes(std::span(&rule, 1)));
    const std::uint64_t of_grid = grid_fingerprint(grid);
    sum.add(std::as_bytes(std::span(&of_grid, 1)));
    world.posts_hash = sum.sum();
    world.sources.front().posts_hash = world.posts_hash;
    world.geoid_fingerprint = undulation_fingerprint(world.field.undulation);
    char note[320];
    std::snprintf(
        note, sizeof note,
        "%.3g posts are made where they are looked at; H is stated as the rule bounds it; windows, films and "
        "pictures from high up or near a pole have no shadows and no light of the sky unless --shadows on "
        "and --sky-openness on ask for them",
        grid.lat.count * static_cast<double>(grid.lon.count));
    add_note(world.notes, note);
    return world;
}

namespace {

// Whether a grid's posts are some of a terrain's, by their places.
bool lies_on(const PostGrid& grid, const MadeTerrain& made) {
    const GridAxis &lat = grid.lat, &lon = grid.lon;
    const auto per_deg = static_cast<double>(made.posts_per_deg);
    if (grid.net || lat.phase_deg != 0.0 || lon.phase_deg != 0.0 || lat.posts_per_deg != per_deg ||
        lon.posts_per_deg != per_deg)
        return false;
    if (lat.first > made.north || lat.first - (lat.count - 1) < made.south) return false;
    const std::int64_t turn = 360 * made.posts_per_deg;
    const std::int64_t from_west = ((lon.first - made.west) % turn + turn) % turn;
    return made.is_full_circle() || from_west + lon.count - 1 <= made.east - made.west;
}

// Whether a row of a grid has the heights of its rule: what was done to posts on their way shows.
bool is_row_of(const HeightField& field, const MadeTerrain& made, const MadeGround& ground, int row) {
    MadeTerrain part = made;
    part.north = ground.north;
    part.west = ground.west;
    const auto count = static_cast<std::size_t>(field.grid.columns());
    std::vector<MadeColumn> columns;
    for (std::size_t i = 0; i < count; ++i)
        columns.push_back(made_column(ground.west + static_cast<std::int64_t>(i), ground.posts_per_deg));
    std::vector<std::int32_t> steps(count);
    made_row_heights(part, ground.rule, row, 0, columns, steps);
    const float* const H_m = field.H_m.data() + static_cast<std::size_t>(row) * count;
    return std::equal(steps.begin(), steps.end(), H_m, [](std::int32_t step, float post_m) {
        return static_cast<float>(step * made_step_m) == post_m;
    });
}

}  // namespace

std::shared_ptr<const MadeGround> made_ground_of(const RegionGrid& grid) {
    if (grid.file || grid.field.posts || grid.field.H_m.empty() || grid.sources.size() != 1 ||
        grid.voids + grid.filled != 0 || grid.feathered || grid.canopy || grid.detail ||
        !is_made(grid.sources.front().path))
        return nullptr;
    const Result<MadeTerrain> made = made_terrain_of(grid.sources.front().path);
    if (!made.ok() || !lies_on(grid.field.grid, *made)) return nullptr;
    const PostGrid& posts = grid.field.grid;
    const MadeGround ground{made_rule(*made), made->posts_per_deg, posts.lat.first, posts.lon.first};
    for (const int row : {0, posts.rows() / 2, posts.rows() - 1})
        if (!is_row_of(grid.field, *made, ground, row)) return nullptr;
    return std::make_shared<const MadeGround>(ground);
}

Result<void> check_not_made_world(const RegionGrid& grid, const std::string& what) {
    if (!grid.field.posts || grid.file) return {};
    char words[200];
    std::snprintf(words, sizeof words,
                  "needs all posts, and this made terrain has %.3g, which are made where they are looked at; "
                  "narrow it with --bbox",
                  static_cast<double>(grid.field.grid.post_count()));
    return Error{ErrorKind::usage, what, words};
}

}  // namespace oro
