// What the parts of the region reader know of one source, and its posts once they are read.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "geo/sources/source_report.h"

namespace oro {

// Longitudes from west to east without a jump: west in [-180, 180), east in [west, west + 360].
struct LonSpan {
    double west_deg{};
    double east_deg{};
};

// Posts of a source along one axis, when they lie on a grid of WGS84 degrees: post i is at start + direction
// * i / posts_per_deg.
struct SourceAxis {
    double posts_per_deg{};
    double start_deg{};
    int direction{1};
    int count{};

    [[nodiscard]] double at_deg(double i) const { return start_deg + direction * i / posts_per_deg; }
    [[nodiscard]] double index_at(double angle_deg) const {
        return (angle_deg - start_deg) * posts_per_deg * direction;
    }
};

enum class SourceKind { hgt, raster, made };

// How far a source's surface goes on beyond its own last posts, to the first ones of a neighbour: 0 where it
// ends there.
struct SeamReach {
    double west_deg{};
    double south_deg{};
    double east_deg{};
    double north_deg{};
};

// So many posts hold one stored value: as the file has it, without scale, offset and unit.
struct StoredCount {
    double value{};
    std::uint64_t posts{};
};

// Heights in metres, as posts have them, from the first to the last, that stand for "no height here" although
// the file does not declare them.
struct NoHeights {
    float first_m{}, last_m{};
    float code_m{};  // the height that the no-data value has which they are or come from
};

// Undeclared voids of a whole file, found once, so that every window of it gives the same posts; unset until
// then. Copies of a source share it.
struct UndeclaredVoids {
    std::mutex mutex;
    std::optional<std::vector<NoHeights>> ranges;
};

// What a user must know of the values that were read of a source; counts are posts.
struct ValueFindings {
    std::vector<StoredCount> undeclared;   // taken as void: no tag declares them (undeclared_voids.h)
    std::vector<StoredCount> implausible;  // stored heights that no terrain has, the first few by value
    std::uint64_t implausible_posts{};
    std::uint64_t read{};       // posts in all
    std::uint64_t unwritten{};  // gaps of a mosaic, and blocks that were never written (unwritten_parts.h)
    std::uint64_t pairs{};      // neighbouring posts that were compared, and of these
    std::uint64_t steep{};      // those with a slope of more than 80 degrees between them
    // Of what is stored, in metres; lowest above highest where nothing is.
    double lowest_stored_m{std::numeric_limits<double>::infinity()};
    double highest_stored_m{-std::numeric_limits<double>::infinity()};

    // Adds what was found in another part of the same source.
    void add(const ValueFindings& part);
};

struct Source {
    SourceKind kind{SourceKind::raster};
    std::string file;  // as GDAL's virtual file system opens it
    bool named{};      // by the user, not found in a folder
    bool crs_specified{};  // by the user: the file states none
    bool bytes{};      // whole numbers of 0 to 255, and nothing says that they are heights
    SourceReport report;
    LonSpan lon;  // of the posts
    double south_deg{};
    double north_deg{};
    SeamReach reach;     // set by reach_over_seams
    bool projected{};    // spacing is even in metres rather than degrees
    bool full_circle{};  // the posts go round the Earth: east of the last one comes the first
    double lat_spacing_deg{};
    double lon_spacing_deg{};  // at the source's middle

    // Sources whose posts are a grid of WGS84 degrees.
    bool on_degrees{};
    SourceAxis lat_axis;
    SourceAxis lon_axis;
    // All others: the horizontal CRS, and the affine map from post numbers to it: x = m[0] + m[1] column +
    // m[2] row, y = m[3] + m[4] column + m[5] row.
    std::string crs_wkt;
    std::array<double, 6> crs_from_post{};

    // From a stored value to metres, upwards: value * scale_m + offset_m.
    double scale_m{1.0};
    double offset_m{0.0};
    // The full CRS when it states what heights refer to, as WKT2; "EPSG:5773"-like code when metadata states
    // it; or nothing.
    std::string vertical_crs;
    int band{1};          // of a raster: which of its bands holds the heights
    bool signed_bytes{};  // stored bytes above 127 stand for negative numbers, although GDAL gives 0 to 255
    std::shared_ptr<UndeclaredVoids> undeclared{std::make_shared<UndeclaredVoids>()};
    ValueFindings values;  // of all posts that were read so far; filled in where posts are laid
};

// A rectangle of a source's posts.
struct PostWindow {
    int row{};
    int column{};
    int rows{};
    int columns{};
};

// Posts as read: metres in the source's own vertical datum, void_height_m where there is none.
struct PostBlock {
    PostWindow window;
    std::vector<float> height_m;
    std::uint64_t voids{};        // those among them without a height
    std::uint64_t implausible{};  // those of the voids whose stored height no terrain has
    // Of what is stored, in metres as above, implausible heights too; lowest above highest where nothing is.
    double lowest_stored_m{std::numeric_limits<double>::infinity()};
    double highest_stored_m{-std::numeric_limits<double>::infinity()};
    ValueFindings values;  // for those who tell it; all of the above is in it, too

    [[nodiscard]] float at(int row, int column) const {
        return height_m[static_cast<std::size_t>(row - window.row) *
                            static_cast<std::size_t>(window.columns) +
                        static_cast<std::size_t>(column - window.column)];
    }
};

// Heights that no terrain has: below the deepest trench or above the highest mountain.
inline constexpr double lowest_plausible_m = -12000.0;
inline constexpr double highest_plausible_m = 9000.0;

// A slope of 80 degrees: half of all neighbouring posts are nowhere as steep as that.
inline constexpr double steep_m_per_m = 5.67;

// Counts one post whose stored value is a height that no terrain has.
void count_implausible(PostBlock& block, double stored);

// Reads a window of a source's posts. What a file does not declare as no data and is none becomes void, too.
// Errors: a file that has changed, is damaged or ends early.
Result<PostBlock> read_posts(const Source& source, const PostWindow& window);

}  // namespace oro
