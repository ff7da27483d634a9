#include "geo/posts/own_posts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <mutex>
#include <utility>

#include "core/base/parallel.h"
#include "core/terrain/page_on_net.h"
#include "geo/files/raster_library.h"
#include "geo/measures/stored_values.h"
#include "geo/posts/mosaic.h"
#include "geo/region/region_fingerprints.h"
#include "geo/region/region_grid.h"
#include "geo/sources/horizontal_datum.h"
#include "geo/sources/notes.h"

namespace oro {
namespace {

// A rectangle of a lattice: posts by the numbers that the first source would give them.
struct LatticeWindow {
    std::int64_t row{}, column{};
    int rows{}, columns{};
};

// Exact places of the posts of a lattice; may be asked from several threads.
class SourcePlaces {
  public:
    // pipeline: by this alone. Without, PROJ takes what is best for each place.
    explicit SourcePlaces(const Source& source, const std::string& pipeline = "")
        : source_(source),
          crs_(spatial_reference(source.crs_wkt)),
          outwards_(way_from(crs_.get(), pipeline)) {}
    [[nodiscard]] bool usable() const { return outwards_ != nullptr; }

    // Of posts of a window whose rows may run the other way.
    Result<void> places(const LatticeWindow& window, bool upside_down, std::span<const PostNumber> posts,
                        std::span<PostPlace> places) const {
        const auto& m = source_.crs_from_post;
        std::vector<double> x(posts.size()), y(posts.size()), z(posts.size());
        std::vector<int> done(posts.size());
        for (std::size_t i = 0; i < posts.size(); ++i) {
            const double row = static_cast<double>(window.row) +
                               (upside_down ? window.rows - 1 - posts[i].row : posts[i].row);
            const double column = static_cast<double>(window.column) + posts[i].column;
            x[i] = m[0] + m[1] * column + m[2] * row;
            y[i] = m[3] + m[4] * column + m[5] * row;
        }
        const GdalMessages messages;
        CoordinateTransformation outwards = taken();
        if (!outwards)
            return Error{ErrorKind::failed, source_.report.path,
                         "PROJ has no memory for another way to WGS84"};
        OCTTransformEx(outwards.get(), static_cast<int>(x.size()), x.data(), y.data(), z.data(), done.data());
        give_back(std::move(outwards));
        for (std::size_t i = 0; i < posts.size(); ++i) {
            if (!done[i] || !std::isfinite(x[i]) || !std::isfinite(y[i]))
                return Error{
                    ErrorKind::failed, source_.report.path,
                    "post " + std::to_string(posts[i].row) + ", " + std::to_string(posts[i].column) +
                        " cannot be placed on the Earth: " + messages.last("it lies outside its CRS")};
            places[i] = {y[i], x[i]};
        }
        return {};
    }

  private:
    static CoordinateTransformation way_from(OGRSpatialReferenceH crs, const std::string& pipeline) {
        if (crs == nullptr) return nullptr;
        const SpatialReference degrees = wgs84_degrees();
        if (pipeline.empty())
            return CoordinateTransformation(OCTNewCoordinateTransformation(crs, degrees.get()));
        OGRCoordinateTransformationOptionsH const options = OCTNewCoordinateTransformationOptions();
        OCTCoordinateTransformationOptionsSetOperation(options, pipeline.c_str(), 0);
        CoordinateTransformation way(OCTNewCoordinateTransformationEx(crs, degrees.get(), options));
        OCTDestroyCoordinateTransformationOptions(options);
        return way;
    }
    // One that no other thread has.
    [[nodiscard]] CoordinateTransformation taken() const {
        const std::lock_guard lock(lending_);
        if (spare_.empty()) return CoordinateTransformation(OCTClone(outwards_.get()));
        CoordinateTransformation one = std::move(spare_.back());
        spare_.pop_back();
        return one;
    }
    void give_back(CoordinateTransformation one) const {
        const std::lock_guard lock(lending_);
        spare_.push_back(std::move(one));
    }

    const Source& source_;
    SpatialReference crs_;
    CoordinateTransformation outwards_;
    mutable std::mutex lending_;
    mutable std::vector<CoordinateTransformation> spare_;
};

// Do rows run as north does from east in the window's middle, seen from above?
Result<bool> runs_northwards(const SourcePlaces& source, const LatticeWindow& window) {
    const double row = 0.5 * (window.rows - 1), column = 0.5 * (window.columns - 1);
    const std::array<PostNumber, 3> posts{{{row, column}, {row, column + 1.0}, {row + 1.0, column}}};
    std::array<PostPlace, 3> places{};
    ORO_CHECK(source.places(window, false, posts, places));
    std::array<glm::dvec3, 3> at{};
    for (std::size_t i = 0; i < 3; ++i) at[i] = ecef_from_enu(places[i].lat_deg, places[i].lon_deg)[2];
    return glm::dot(glm::cross(at[1] - at[0], at[2] - at[0]), at[0]) > 0.0;
}

using FittedNet = Result<std::shared_ptr<const LatticeGeoreference>>;
FittedNet net_by(const SourcePlaces& places, const LatticeWindow& window, bool upside_down) {
    return LatticeGeoreference::fit(window.rows, window.columns,
                                    [&](std::span<const PostNumber> posts, std::span<PostPlace> there) {
                                        return places.places(window, upside_down, posts, there);
                                    });
}

// Where PROJ's best operation is another in another part of the source, places jump there by as much as the
// two differ (0.8 m within Austria). Then the operation for the source's middle puts all of it.
FittedNet net_of(const SourcePlaces& places, const Source& source, const LatticeWindow& window,
                 bool upside_down) {
    FittedNet net = net_by(places, window, upside_down);
    if (net.ok() || net.error().where != "grid of posts") return net;
    const auto& m = source.crs_from_post;
    const double column = 0.5 * (source.report.columns - 1), row = 0.5 * (source.report.rows - 1);
    const std::string pipeline = pipeline_at(source.crs_wkt, m[0] + m[1] * column + m[2] * row,
                                             m[3] + m[4] * column + m[5] * row, unwrapped(source.report.box));
    if (pipeline.empty()) return net;
    const SourcePlaces by_one(source, pipeline);
    // Not one that reads the source's coordinates in another way: operations differ by metres.
    constexpr double some_metres_deg = 1.0e-3;
    const std::array<PostNumber, 1> middle{{{0.5 * (window.rows - 1), 0.5 * (window.columns - 1)}}};
    std::array<PostPlace, 1> usual{}, own{};
    if (!by_one.usable() || !places.places(window, upside_down, middle, usual).ok() ||
        !by_one.places(window, upside_down, middle, own).ok() ||
        !(std::abs(usual[0].lat_deg - own[0].lat_deg) < some_metres_deg) ||
        !(std::abs(std::remainder(usual[0].lon_deg - own[0].lon_deg, 360.0)) < some_metres_deg))
        return net;
    FittedNet by_one_net = net_by(by_one, window, upside_down);
    return by_one_net.ok() ? std::move(by_one_net) : std::move(net);
}

// Where a source's first post lies on the lattice of another; nothing where it is not on it.
struct LatticePlace {
    std::int64_t row{}, column{};
};
std::optional<LatticePlace> place_on_lattice(const Source& source, const Source& first) {
    if (source.on_degrees || first.on_degrees) return std::nullopt;
    const SpatialReference one = spatial_reference(source.crs_wkt), other = spatial_reference(first.crs_wkt);
    if (!one || !other || !OSRIsSame(one.get(), other.get())) return std::nullopt;
    const auto &m = source.crs_from_post, &to = first.crs_from_post;
    const double determinant = to[1] * to[5] - to[2] * to[4];
    const double x = m[0] - to[0], y = m[3] - to[3];
    const double column = (x * to[5] - y * to[2]) / determinant, row = (y * to[1] - x * to[4]) / determinant;
    // At the far end of the source, too.
    constexpr double same_post = 0.01;
    const double far = std::max(source.report.rows, source.report.columns);
    const double post = std::sqrt(std::abs(determinant));
    double off = std::max(std::abs(row - std::round(row)), std::abs(column - std::round(column)));
    for (const std::size_t i : {1U, 2U, 4U, 5U}) off = std::max(off, std::abs(m[i] - to[i]) * far / post);
    if (!(off < same_post)) return std::nullopt;
    return LatticePlace{std::llround(row), std::llround(column)};
}

// The rectangle of all sources; the places of each.
Result<LatticeWindow> window_of_all(std::span<const Source> sources, std::span<const LatticePlace> places) {
    std::int64_t north = 0, west = 0, south = 0, east = 0;
    for (std::size_t i = 0; i < sources.size(); ++i) {
        north = std::min(north, places[i].row);
        west = std::min(west, places[i].column);
        south = std::max(south, places[i].row + sources[i].report.rows);
        east = std::max(east, places[i].column + sources[i].report.columns);
    }
    const BoundingBox box = sources.front().report.box;
    ORO_CHECK(check_size(static_cast<double>(south - north), static_cast<double>(east - west), box, sources));
    return LatticeWindow{north, west, static_cast<int>(south - north), static_cast<int>(east - west)};
}

// Where the posts of a window lie in the CRS.
PostsCrs crs_of(const Source& source, const LatticeWindow& window, bool upside_down) {
    const auto& m = source.crs_from_post;
    const double row = static_cast<double>(window.row + (upside_down ? window.rows - 1 : 0)),
                 column = static_cast<double>(window.column), down = upside_down ? -1.0 : 1.0;
    return {source.crs_wkt,
            {m[0] + m[1] * column + m[2] * row, m[1], down * m[2], m[3] + m[4] * column + m[5] * row, m[4],
             down * m[5]}};
}

OwnPosts not_kept(const std::string& why) {
    OwnPosts none;
    none.why_not = why;
    return none;
}

}  // namespace

PostWindow posts_in_box(const LatticeGeoreference& net, const BoundingBox& box) {
    constexpr int steps = 64;
    // Far beyond the raster parallels and meridians bend away from its rows and columns.
    const LatticeGeoreference::Box& all = net.box();
    const double south_deg = std::max(box.south_deg, all.south_deg),
                 north_deg = std::min(box.north_deg, all.north_deg);
    double west_deg = all.east_deg, east_deg = all.west_deg;
    for (const double turn_deg : {-720.0, -360.0, 0.0, 360.0, 720.0}) {
        const double west = std::max(box.west_deg + turn_deg, all.west_deg),
                     east = std::min(box.east_deg + turn_deg, all.east_deg);
        if (west > east) continue;
        west_deg = std::min(west_deg, west);
        east_deg = std::max(east_deg, east);
    }
    if (south_deg > north_deg || west_deg > east_deg) return {};
    double north = net.rows(), south = -1.0, west = net.columns(), east = -1.0;
    for (int i = 0; i <= steps; ++i) {
        for (int j = 0; j <= steps; ++j) {
            const PostNumber post = net.post_at(south_deg + (north_deg - south_deg) * i / steps,
                                                west_deg + (east_deg - west_deg) * j / steps);
            north = std::min(north, post.row);
            south = std::max(south, post.row);
            west = std::min(west, post.column);
            east = std::max(east, post.column);
        }
    }
    const auto held = [](double number, int posts) {
        return static_cast<int>(std::clamp(number, 0.0, posts - 1.0));
    };
    if (north > net.rows() - 1.0 || south < 0.0 || west > net.columns() - 1.0 || east < 0.0) return {};
    const int first_row = held(std::floor(north), net.rows()), last_row = held(std::ceil(south), net.rows());
    const int first_column = held(std::floor(west), net.columns()),
              last_column = held(std::ceil(east), net.columns());
    return {first_row, first_column, last_row - first_row + 1, last_column - first_column + 1};
}

Result<OwnPosts> own_posts(std::span<const Source> sources, const std::optional<BoundingBox>& box) {
    const Source& first = sources.front();
    std::vector<LatticePlace> starts;
    for (const Source& source : sources) {
        const auto place = place_on_lattice(source, first);
        if (!place)
            return not_kept(
                "the posts of " + source.report.path + " and " + first.report.path +
                " lie on no common lattice (CRS, spacing, turn, whole posts apart); opened one by "
                "one, files keep their own posts");
        starts.push_back(*place);
    }
    const SourcePlaces places(first);
    if (!places.usable()) return not_kept("PROJ knows no way from the CRS of " + first.report.path);
    ORO_TRY(LatticeWindow window, window_of_all(sources, starts));
    if (window.rows < 2 || window.columns < 2)
        return Error{ErrorKind::no_data, first.report.path,
                     "its posts lie on a line or a point, and cover no area"};
    OwnPosts own;
    const auto northwards = runs_northwards(places, window);
    if (!northwards.ok()) return not_kept(northwards.error().line());
    own.upside_down = *northwards;
    auto fitted = net_of(places, first, window, own.upside_down);
    if (!fitted.ok())
        return not_kept(fitted.error().where == "grid of posts"
                            ? "the posts of " + first.report.path + ": " + fitted.error().what
                            : fitted.error().line());
    std::shared_ptr<const LatticeGeoreference> net = std::move(*fitted);
    if (box) {
        const PostWindow part = posts_in_box(*net, unwrapped(*box));
        if (part.rows < 2 || part.columns < 2)
            return Error{ErrorKind::no_data, first.report.path, "has no posts in the box that was asked for"};
        window.column += part.column;
        window.row += own.upside_down ? window.rows - part.row - part.rows : part.row;
        window.columns = part.columns;
        window.rows = part.rows;
        ORO_TRY(net, net->part(part.row, part.column, part.rows, part.columns));
    }
    if (!fits_one_page(*net))
        return not_kept(
            "the posts of " + first.report.path +
            " reach too far over the Earth's bend, some 5,000 km from their middle; a part of them (--bbox) "
            "stays where it is");
    for (const LatticePlace& start : starts)
        own.parts.push_back(
            {static_cast<int>(start.row - window.row), static_cast<int>(start.column - window.column)});
    own.crs = crs_of(first, window, own.upside_down);
    own.grid = grid_on_net(std::move(net));
    return own;
}

namespace {

// Heights of a stretch of one of the region's rows.
Result<void> shift_row(GeoidOfRegion::Shift& shift, const OwnMosaicTarget& target, int row, int first_column,
                       std::span<float> heights) {
    if (shift.does_nothing()) return {};
    for (std::size_t c = 0; c < heights.size(); ++c) {
        if (is_void(heights[c])) continue;
        const PostPlace place = target.posts.grid.net->place_at(row, first_column + static_cast<double>(c));
        ORO_CHECK(shift.apply(target.undulation, place.lat_deg, {&place.lon_deg, 1}, heights.subspan(c, 1)));
    }
    return {};
}

// What of a source lies in the region, by its own numbers.
PostWindow window_within(const Source& source, const OwnPart& part, const PostGrid& grid) {
    const auto from = [](int start) { return std::max(0, -start); };
    const int row = from(part.row), column = from(part.column);
    return {row, column, std::min(source.report.rows, grid.rows() - part.row) - row,
            std::min(source.report.columns, grid.columns() - part.column) - column};
}

// Reads a source in strips that fit memory.
Result<void> lay_rows(Source& source, const OwnPart& part, const OwnMosaicTarget& target,
                      GeoidOfRegion::Shift& shift, JoinedSurface& surface) {
    constexpr std::size_t posts_a_strip = std::size_t{1} << 26;
    const PostGrid& grid = target.posts.grid;
    const PostWindow window = window_within(source, part, grid);
    if (window.rows <= 0 || window.columns <= 0) return {};
    SourceReport& report = source.report;
    const auto columns = static_cast<std::size_t>(window.columns);
    const int strip = static_cast<int>(
        std::clamp<std::size_t>(posts_a_strip / columns, 1, static_cast<std::size_t>(window.rows)));
    const int first_column = part.column + window.column;
    std::vector<float> heights(columns);
    const std::vector<unsigned char> inside(columns, 1);
    SourceFingerprint fingerprint;
    StoredValues stored;
    fingerprint.begin(grid, part.row + window.row, first_column, window.rows, window.columns);
    for (int first = window.row; first < window.row + window.rows; first += strip) {
        const int rows = std::min(strip, window.row + window.rows - first);
        ORO_TRY(const PostBlock block, read_posts(source, {first, window.column, rows, window.columns}));
        source.values.add(block.values);
        stored.add(block);
        report.voids += block.voids;
        report.implausible += block.implausible;
        for (int from = first; from < first + rows; ++from) {
            const int row = target.posts.upside_down ? grid.rows() - 1 - (part.row + from) : part.row + from;
            for (std::size_t c = 0; c < columns; ++c)
                heights[c] = block.at(from, window.column + static_cast<int>(c));
            ORO_CHECK(shift_row(shift, target, row, first_column, heights));
            surface.lay(row, first_column, heights, inside, true, report.seams);
            fingerprint.add(heights);
            for (const float height : heights) {
                if (is_void(height)) continue;
                report.lowest_m = std::min(report.lowest_m, static_cast<double>(height));
                report.highest_m = std::max(report.highest_m, static_cast<double>(height));
            }
        }
    }
    report.posts_hash = fingerprint.value();
    report.stored = stored.range(report.rows, report.columns);
    return {};
}

Result<void> lay_one(Source& source, const OwnPart& part, const OwnMosaicTarget& target,
                     JoinedSurface& surface, std::vector<std::string>& notes) {
    SourceReport& report = source.report;
    const PostGrid& grid = target.posts.grid;
    GeoidOfRegion::Shift shift;
    if (!source.vertical_crs.empty()) {
        const BoundingBox box{grid.west_deg(), grid.south_deg(), grid.east_deg(), grid.north_deg()};
        auto found = target.geoid.shift_from(source.vertical_crs, box, target.strict_datum);
        if (!found) return Error{found.error().kind, report.path, found.error().line()};
        shift = std::move(*found);
        report.vertical_datum.egm96_stands_in = shift.egm96_stands_in();
        add_note(notes, shift.note());
    }
    report.lowest_m = std::numeric_limits<double>::max();
    report.highest_m = std::numeric_limits<double>::lowest();
    report.placement = Placement{Fit::same_posts, 0.0, 1, 1};
    ORO_CHECK(lay_rows(source, part, target, shift, surface));
    return note_findings(report, 0, shift.beyond_grid(), target.strict_datum, notes);
}

}  // namespace

bool is_on_lattice(const Source& source, const Source& other) {
    return place_on_lattice(source, other).has_value();
}

Result<void> mosaic_own_posts(std::vector<Source>& sources, const OwnMosaicTarget& target,
                              JoinedSurface& surface, std::vector<float>& N_of_posts_m,
                              std::vector<std::string>& notes, const Progress& progress) {
    N_of_posts_m = N_of_net_m(*target.posts.grid.net, target.undulation, thread_count());
    std::size_t done = 0;
    for (const std::size_t i : by_precedence(sources)) {
        if (progress)
            progress(0.1 + 0.85 * static_cast<double>(done++) / static_cast<double>(sources.size()),
                     "reading " + sources[i].report.path);
        ORO_CHECK(lay_one(sources[i], target.posts.parts[i], target, surface, notes));
    }
    return {};
}

}  // namespace oro
