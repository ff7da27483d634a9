#include "geo/opening/grid_describing.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include "geo/opening/region_sources.h"
#include "geo/posts/holes.h"
#include "geo/posts/value_notes.h"
#include "geo/region/region_fingerprints.h"
#include "geo/sources/notes.h"
#include "geo/together/contradictions.h"

namespace oro {
namespace {

// Counts the posts without a height, and why.
void describe_voids(std::span<const Source> sources, const JoinedSurface& surface, RegionGrid& region) {
    if (region.field.grid.net) {
        for (std::size_t post = 0; post < region.field.H_m.size(); ++post)
            region.outside += is_void(region.field.H_m[post]) && !surface.covered(post) ? 1U : 0U;
        return;
    }
    region.missing_cells = cells_without(sources, region.field.grid);
    const Uncovered uncovered = count_uncovered(region.field, region.missing_cells,
                                                [&](std::size_t post) { return surface.covered(post); });
    region.outside = uncovered.outside;
    region.in_missing = uncovered.in_missing;
}

// Of a region whose posts all lack a height: why.
std::string all_without_height(const RegionGrid& region) {
    std::string why;
    for (const auto& [posts, words] : {std::pair{region.void_posts(), "void in their file"},
                                       {region.outside, "outside the raster"},
                                       {region.in_missing, "in missing tiles"}})
        if (posts > 0) why += (why.empty() ? "" : ", ") + std::to_string(posts) + " " + words;
    return "all its posts are " + (why.find(',') == std::string::npos ? why.substr(why.find(' ') + 1) : why);
}

// That of most posts comes first, and has the notes on all.
void put_largest_first(std::vector<RegionGrid>& grids) {
    const auto largest = std::ranges::max_element(
        grids, {}, [](const RegionGrid& grid) { return grid.field.grid.post_count(); });
    std::rotate(grids.begin(), largest, largest + 1);
    for (RegionGrid& other : std::span(grids).subspan(1))
        for (const std::string& note : std::exchange(other.notes, {})) add_note(grids.front().notes, note);
}

}  // namespace

Result<RegionGrid> describe_grid(LaidGrid laid, const RegionRequest& request) {
    RegionGrid& made = laid.grid;
    if (!laid.surface) return std::move(made);
    std::vector<Source>& sources = laid.sources;
    made.voids = static_cast<std::uint64_t>(std::ranges::count_if(made.field.H_m, is_void));
    describe_voids(sources, *laid.surface, made);
    note_values(sources, made.notes);
    const PostGrid& grid = made.field.grid;
    const BoundingBox posts{grid.west_deg(), grid.south_deg(), grid.east_deg(), grid.north_deg()};
    if (made.voids == made.field.H_m.size())
        return Error{ErrorKind::no_data, paths_words(request),
                     "no height in " + bounding_box_text(posts) + ": " + all_without_height(made) +
                         why_no_height(sources)};
    made.posts_hash = posts_hash(made.field);
    made.geoid_fingerprint = undulation_fingerprint(made.field.undulation);
    for (Source& source : sources) made.sources.push_back(std::move(source.report));
    return std::move(made);
}

Region describe_region(std::vector<RegionGrid> grids, const std::vector<Error>& left_out, bool is_baked) {
    Region region{std::move(grids)};
    if (is_baked) return region;
    put_largest_first(region.grids);
    std::vector<std::string>& notes = region.grids.front().notes;
    for (const Error& error : left_out) add_note(notes, "left out: " + error.what);
    add_note(notes, note_of_contradicting_grids(region));
    return region;
}

}  // namespace oro
