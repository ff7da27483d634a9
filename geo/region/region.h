// A region: the grids of posts that its sources make, and what is known of each.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/baked/region_file.h"
#include "core/base/result.h"
#include "core/cluster_file/cluster_file.h"
#include "core/terrain/grid_part.h"
#include "core/terrain/post_grid.h"
#include "geo/sources/region_request.h"
#include "geo/sources/source_report.h"

namespace oro {

// What --feather did to a grid (geo/together/feather.h).
struct Feathered {
    double width_m{};
    std::uint64_t posts{};  // that have other heights
    double most_m{};        // by which one was changed
    double rms_m{};         // of all of them
};

// Where the posts of a grid on a net lie in the CRS of their sources: x = m[0] + m[1] column + m[2] row,
// y = m[3] + m[4] column + m[5] row.
struct PostsCrs {
    std::string wkt;
    std::array<double, 6> crs_from_post{};
};

// How the note begins of a grid that is a part of a baked one: of what is known of its sources.
inline constexpr const char* clipped_from = "cut out of ";

// What grows on the ground of a grid whose posts were raised to its top (geo/canopy).
struct GridCanopy {
    // To H of each post, row by row; 0 where nothing grows and where nothing is known.
    std::vector<float> added_m;
    std::vector<float> ground_H_m;  // H of the same posts before
    double held_share{};            // of the canopy's height that the data hold already: it was not added
    std::string held_by;      // whose heights hold it: "SRTM"; "" where somebody said the share, or it is 0
    float highest_m{};        // of the whole canopy over the posts, with what the data hold
    std::uint64_t posts{};    // that were raised
    std::uint64_t unknown{};  // over which no canopy is known
};

// Ground between the posts of data that is invented: what a grid is that lies over a part of another one, of
// the data, and has more posts there (geo/refined).
struct GridDetail {
    int halvings{};      // of the way from a post of the data to the next: 2^halvings posts in place of one
    double radius_km{};  // how far it reaches from its middle
    double lat_deg{};    // its middle, WGS84
    double lon_deg{};
    GridPart part{};  // the posts of the data that it lies between
    int data_rank{};  // the rank of the grid that has them
    double rms_m{};   // by which posts that are not the data's are off the data's surface
    double largest_m{};
    std::uint64_t posts{};  // that are not the data's
    std::uint64_t still{};  // of these on the data's surface: on water, ice and built land, along its rim
    bool by_cover{};        // water, ice and built land are those of a land cover
};

// One grid of a region: the height field that some sources make together.
struct RegionGrid {
    HeightField field;
    std::optional<PostsCrs> posts_crs;  // of a grid on a net
    // The baked grid that the field is, whole; null when it comes from other sources or is a part of one.
    std::shared_ptr<const RegionFile> file;
    std::shared_ptr<const ClusterFile> clusters;  // of `file`, where it was baked with them
    std::vector<SourceReport> sources;            // those that the grid uses
    SeamReport seams;
    std::string geoid;               // "EGM96 (egm96_15.gtx)": what N in the field is
    UndulationField geoid_left_out;  // N that the field had, where a view goes without it
    std::vector<float> N_of_posts_left_out_m;
    std::vector<std::string>
        missing_cells;           // whole-degree cells of the grid without any source, e.g. "N45E008"
    std::uint64_t voids{};       // posts of the grid without a height, for whatever reason; of these:
    std::uint64_t outside{};     // beyond the rims of all sources, in cells that one touches
    std::uint64_t in_missing{};  // in missing_cells
    std::uint64_t filled{};      // void posts filled
    // Fingerprints (region_fingerprints.h) of all its posts, and of N over it, also where a view leaves that
    // out.
    std::uint64_t posts_hash{};
    std::uint64_t geoid_fingerprint{};
    VoidMethod void_method{VoidMethod::holes};
    // False where it is not known which of the voids are beyond rims: in a part of a baked region. `outside`
    // is then too small, void_posts() too large.
    bool classifies_voids{true};
    // Void in the source that covers them: what --fill-voids is for.
    [[nodiscard]] std::uint64_t void_posts() const { return voids - outside - in_missing; }
    std::vector<std::string> notes;  // what a user must know, one line each (a geoid that stands in, ...)
    // Where several have ground for a place, that with the smallest rank is the ground (geo/together): the
    // finest, or the one named first.
    int rank{};
    std::optional<Feathered> feathered;
    std::optional<GridCanopy> canopy;  // nothing: the field is the ground as its sources have it
    std::optional<GridDetail> detail;  // nothing: its posts are the data's
};

struct PlacedMesh;

// What a request opens: grids that lie over each other, next to each other or far apart; one where their
// posts are those of one lattice. The first is the one of most posts, until a view puts that under its eye
// first; it has the notes on all.
struct Region {
    std::vector<RegionGrid> grids;
    // Meshes on its ground (geo/meshes/placed_mesh.h); null: none.
    std::shared_ptr<const std::vector<PlacedMesh>> meshes{};
    // Of all grids. Errors: posts that could not be read, and so counted as void.
    [[nodiscard]] Result<void> health() const;
};

}  // namespace oro
