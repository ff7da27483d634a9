// What one source says of itself and what was found in it: facts. source_words.h makes words of them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geo/places/bounding_box.h"

namespace oro {

// .hgt tiles with posts every 1 or 3 seconds of arc; all else is read by GDAL.
enum class SourceFormat { srtm1_hgt, srtm3_hgt, raster };

enum class PostsAre { points, cell_centres };

// Whence it is known what a source's heights refer to. Assumed is EGM96.
enum class DatumFrom {
    crs,
    dted_egm96,  // DTED metadata say so
    dted_egm2008,
    hgt_format,          // .hgt files state none: it is SRTM's format, whose heights are of EGM96
    assumed_unstated,    // the file states none
    assumed_unreadable,  // PROJ cannot read what the CRS states
    specified,           // by the request, because the file does not say
    product  // by the file's name: the product that it is of has them (geo/sources/known_products.h)
};

struct HeightDatum {
    DatumFrom from{DatumFrom::assumed_unstated};
    // From a CRS or told, as PROJ calls it: "EPSG:5703 NAVD88 height"; of a product with the product's name.
    std::string name;
    bool egm96_stands_in{};  // a grid for it is missing
};

// What a source's latitudes and longitudes refer to, and how good the way from there to WGS84 is that PROJ
// has on this machine.
struct HorizontalDatum {
    bool is_wgs84{true};               // then nothing else is known, nor needs to be
    std::string name{};                // "EPSG:4267 NAD27"
    std::string operation{};           // PROJ's name: "NAD27 to WGS 84 (4)"; "" where PROJ lists none
    std::optional<double> accuracy_m;  // as the operation's authors state it
    bool ballpark{};                   // it leaves the datums' difference out
    bool unchanged{};                  // by an operation that leaves degrees as they are: WGS84 by convention
    bool one_to_two_metres{};          // such a one, which is known to be that far off (NAD83, ETRS89)
    // Of the most accurate operation for the place that is better, and lacks grids.
    std::vector<std::string> missing_grids{};
    std::optional<double> accuracy_with_grids_m;
    std::optional<double> frame_epoch;       // year; of a dynamic datum, where ground moves
    std::optional<double> coordinate_epoch;  // year for which the file states its coordinates
};

enum class UnitFrom { file, request, assumed };

struct HeightUnit {
    std::string name{"m"};
    UnitFrom from{UnitFrom::file};
};

// How a source's posts stand to the region's: they are the same, the region has some between them, or they
// lie elsewhere and heights are resampled (bicubic).
enum class Fit { same_posts, every_kth_post, elsewhere };

// How a source was laid into the region.
struct Placement {
    Fit fit{Fit::elsewhere};
    double moved_by_posts{};                // a post, at most; nothing where heights are resampled
    std::int64_t lat_part{1}, lon_part{1};  // every how many posts of the region the source has one
};

// Where sources of one spacing meet or overlap. Rule: the finer spacing wins; among equals the first in the
// byte order of file names.
struct SeamReport {
    std::uint64_t shared_posts{};
    std::uint64_t disagreeing_posts{};
    double largest_difference_m{};
    // Posts of the region for which a source has a height, its own or interpolated, and one that wins over
    // it, too; those where they differ by more than elevation data is accurate (seams.h), and by how much.
    // Not kept in a baked region, which keeps the note on them.
    std::uint64_t compared_posts{};
    std::uint64_t contradicting_posts{};
    double largest_contradiction_m{};
};

// Lowest and highest of the values that a file stores, in metres: its scale, offset and unit applied, before
// its datum is changed and before it is resampled. Heights that no terrain has count; values that stand for
// none do not.
struct StoredRange {
    double lowest_m{};
    double highest_m{};
    bool whole{};  // every post of the file was read; else only those around the region
};

// One of a source's own posts, and what the region shows at its place: H in metres.
struct PostShown {
    double lat_deg{};
    double lon_deg{};
    double own_H_m{};
    std::optional<double> shown_H_m;  // nothing where the region has no ground
};

// How far the region's surface is from a source's own posts, where heights were resampled or interpolated.
struct Resampling {
    std::uint64_t posts{};     // of the source with a height, as far as it was read
    std::uint64_t compared{};  // those among them that were held against the surface
    std::uint64_t unshown{};   // of those looked at: in the region's box, and no ground there
    std::uint64_t hidden{};    // of those looked at: another source that wins has the ground there
    double rms_m{};
    std::optional<PostShown> worst;  // nothing where none was compared
    // The highest and the lowest of all posts that were read and lie in the region's box.
    std::optional<PostShown> highest, lowest;
};

// A rectangle of a region's posts.
struct PartOfGrid {
    int row{}, column{};
    int rows{}, columns{};
};

struct SourceReport {
    std::string path;  // as found, e.g. tiles.zip/N46E008.hgt
    SourceFormat format{SourceFormat::raster};
    std::string driver;  // of a raster: GDAL's name of its format, "GTiff"
    std::string crs;     // e.g. "EPSG:4326 WGS 84"
    HorizontalDatum horizontal_datum;
    HeightDatum vertical_datum;
    HeightUnit height_unit;
    PostsAre posts_are{PostsAre::points};
    std::string attribution;  // "" when unknown
    int rows{};
    int columns{};
    double lat_spacing_deg{};
    double lon_spacing_deg{};
    double spacing_m{};  // north-south, metres
    // As its CRS counts it, the mean of both ways, in degrees of the equator: equal for all files of one
    // lattice. 0 where posts lie on degrees.
    double nominal_spacing_deg{};
    // Where the one named first wins (RegionRequest::listed_first): its number among all, from 1. Else 0.
    int listed{};
    std::optional<PartOfGrid> part;  // of a region on a net, where it is known
    BoundingBox box;                 // of the posts
    double lowest_m{};               // of posts of the region that have its heights, H in metres
    double highest_m{};
    std::optional<StoredRange> stored;     // nothing where nothing was read, or no value is stored
    std::optional<Resampling> resampling;  // nothing where posts are copied
    std::uint64_t voids{};
    // Read, and void everywhere: then there is neither a lowest nor a highest.
    [[nodiscard]] bool is_all_void() const {
        return voids > 0 && voids >= static_cast<std::uint64_t>(rows) * static_cast<std::uint64_t>(columns);
    }
    std::uint64_t implausible{};  // heights no terrain has (below -12,000 m or above 9,000 m), taken as void
    std::optional<Placement> placement;  // nothing for a source that was not laid
    SeamReport seams;  // with the sources that win over it: its posts that one of them has, too
    std::optional<std::uint64_t> posts_hash;  // of its posts as they were laid (region_fingerprints.h)
    std::vector<std::string> files;  // of this machine that it is made of: the archive it is in, all that a
                                     // VRT names; unknown ({}) in a baked region
};

}  // namespace oro
