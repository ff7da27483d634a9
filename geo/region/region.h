// From paths and a bounding box to one surface: which sources there are, what they say of themselves, and the
// height field that they make together.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/baked/region_file.h"
#include "core/base/result.h"
#include "core/cluster_file/cluster_file.h"
#include "core/terrain/post_grid.h"
#include "geo/region/source_report.h"

namespace oro {

// "west,south,east,north". Usage errors for anything else: not four numbers, not finite, out of range, south
// >= north, no width; numbers that would be a box with latitude first get the hint that it may be meant.
Result<BoundingBox> parse_bounding_box(const std::string& text);
// The same numbers as south,west,north,east, the order of places: nothing where they are no such box.
std::optional<BoundingBox> with_latitude_first(const BoundingBox& box);
// As it is written: "8,46,9,47".
std::string bounding_box_text(const BoundingBox& box);
// "N46E008", or "N46E006:N47E010" for the box of both corner cells with all between.
Result<BoundingBox> parse_tile_range(const std::string& text);

struct RegionRequest {
    std::vector<std::string>
        paths;  // files, folders (recursive), .zip, .gz, VRT: what GDAL or the .hgt reader opens; or one .oro
    std::optional<BoundingBox> box;  // nothing: all that the sources cover
    bool strict_datum{false};        // refuse instead of letting another geoid stand in
    bool fill_voids{
        false};            // fill void posts from their neighbours (GDALFillNodata) instead of leaving holes
    bool resample{false};  // bring the posts of files in a CRS of their own onto latitudes and longitudes,
                           // instead of keeping them where they are
    // Where several have ground for a place, the one named first wins (of a folder by the byte order of
    // names), not the finest.
    bool listed_first{false};
    // Of several grids: heights go over to those of the coarser within so many metres of a finer one's rim;
    // 0: they do not.
    double feather_m{0.0};
    std::string height_unit;  // "", or "m", "ft", "us-ft", "cm": overrides what the files say
    // For files that do not say themselves: where they lie ("EPSG:2056", or whatever PROJ knows), and what
    // their heights refer to (a vertical CRS, or one of ellipsoidal heights: "EPSG:5728", "EPSG:4979"). ""
    // for nothing told.
    std::string source_crs, source_vertical;
    // Whoever asks can do with several grids: files that lie far apart (lying_apart.h) are then a region
    // each. Otherwise one grid holds them all, with what lies between.
    bool grids_apart{false};
};

// What --feather did to a grid (geo/together/feather.h).
struct Feathered {
    double width_m{};
    std::uint64_t posts{};  // that have other heights
    double most_m{};        // by which one was changed
    double rms_m{};         // of all of them
};

// What becomes of void posts: they are left out of the terrain, or filled from their neighbours.
enum class VoidMethod { holes, filled };

// Where the posts of a region on a net lie in the CRS of their sources: x = m[0] + m[1] column + m[2] row,
// y = m[3] + m[4] column + m[5] row.
struct PostsCrs {
    std::string wkt;
    std::array<double, 6> crs_from_post{};
};

struct Region {
    HeightField field;
    std::optional<PostsCrs> posts_crs;  // of a grid on a net
    // The baked region that the field is, whole; null when it comes from other sources or is a part of one.
    std::shared_ptr<const RegionFile> file;
    std::shared_ptr<const ClusterFile> clusters;  // of `file`, where it was baked with them
    std::vector<SourceReport> sources;            // those that the region uses
    SeamReport seams;
    std::string geoid;               // "EGM96 (egm96_15.gtx)": what N in the field is
    UndulationField geoid_left_out;  // N that the field had, where a view goes without it
    std::vector<float> N_of_posts_left_out_m;
    std::vector<std::string>
        missing_cells;           // whole-degree cells of the region without any source, e.g. "N45E008"
    std::uint64_t voids{};       // posts of the region without a height, for whatever reason; of these:
    std::uint64_t outside{};     // beyond the rims of all sources, in cells that one touches
    std::uint64_t in_missing{};  // in missing_cells
    std::uint64_t filled{};      // void posts filled
    // Fingerprints (region_prints.h) of all its posts, and of N over it, also where a view leaves that out.
    // The first is unknown of a whole region that was baked before there were any.
    std::optional<std::uint64_t> posts_print;
    std::uint64_t geoid_print{};
    VoidMethod void_method{VoidMethod::holes};
    // False where it is not known which of the voids are beyond rims: in a part of a baked region, and of
    // one that was baked before they were told apart. `outside` is then too small, void_posts() too large.
    bool tells_voids_apart{true};
    // Void in the source that covers them: what --fill-voids is for.
    [[nodiscard]] std::uint64_t void_posts() const { return voids - outside - in_missing; }
    std::vector<std::string> notes;  // what a user must know, one line each (a geoid that stands in, ...)
    // Regions of other files, that lie far from this one's, or over it or beside it with posts of their own;
    // only where RegionRequest.grids_apart. None of them has any in turn; this is the one of most posts, and
    // the notes are those of all.
    std::vector<Region> beside;
    // Where several have ground for a place, that with the smallest rank is the ground (geo/together): the
    // finest, or the one named first.
    int rank{};
    std::optional<Feathered> feathered;  // of this grid
    // Of all grids. Errors: posts that could not be read, and so counted as void.
    [[nodiscard]] Result<void> health() const;
};

// Told how far reading is, 0..1, from the calling thread.
using Progress = std::function<void(double share, const std::string& what)>;

// Reads a region, or opens a baked one: the way from files to posts.
//     RegionRequest request;
//     request.paths = {"jacksboro.tif"};
//     request.box = BoundingBox{-84.3, 36.5, -84.2, 36.6};  // west, south, east, north
//     ORO_TRY(const Region region, open_region(request));
//     const float H_m = region.field.H_at_post_m(0, 0);  // the north-west post, above the geoid
// Errors: a path that is not there or unreadable, a source that is
// damaged (file, place, value, reason), no data in the region (ErrorKind::no_data), a datum that cannot be
// honoured with strict_datum, a baked region beside other paths or with an option that was decided when it
// was baked (ErrorKind::usage).
Result<Region> open_region(const RegionRequest& request, const Progress& progress = {});

}  // namespace oro
