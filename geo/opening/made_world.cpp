#include "geo/opening/made_world.h"

#include <cstdio>
#include <utility>

#include "core/base/checksum.h"
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
