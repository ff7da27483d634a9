#include "geo/measures/post_places.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "geo/files/raster_library.h"

namespace oro {
namespace {

constexpr double same_place_deg = 1e-9;
constexpr int smallest_side = 8;  // of a part that is not placed post by post
constexpr std::array nodes{0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0};
constexpr std::array checks{std::array{1.0 / 6.0, 1.0 / 6.0}, std::array{0.5, 0.5},
                            std::array{5.0 / 6.0, 5.0 / 6.0}, std::array{5.0 / 6.0, 1.0 / 6.0}};

// Weights of the four nodes at a share of the way between the first and the last. Source: Lagrange's form of
// the cubic through four points.
std::array<double, 4> cubic_through_nodes(double at) {
    std::array<double, 4> weights{};
    for (std::size_t i = 0; i < 4; ++i) {
        weights[i] = 1.0;
        for (std::size_t j = 0; j < 4; ++j)
            if (j != i) weights[i] *= (at - nodes[j]) / (nodes[i] - nodes[j]);
    }
    return weights;
}

LatLon mix(const std::array<LatLon, 4>& of, const std::array<double, 4>& weights) {
    LatLon sum{0.0, 0.0};
    for (std::size_t i = 0; i < 4; ++i) {
        sum.lat_deg += weights[i] * of[i].lat_deg;
        sum.lon_deg += weights[i] * of[i].lon_deg;
    }
    return sum;
}

// At a share of the way down and right of 4 x 4 nodes.
LatLon on_cubics(const std::vector<LatLon>& placed, double down, double right) {
    const auto along = cubic_through_nodes(right);
    std::array<LatLon, 4> column{};
    for (std::size_t i = 0; i < 4; ++i)
        column[i] = mix({placed[4 * i], placed[4 * i + 1], placed[4 * i + 2], placed[4 * i + 3]}, along);
    return mix(column, cubic_through_nodes(down));
}

}  // namespace

struct PostPlaces::Way {
    const Source* source{};
    CoordinateTransformation transformation;  // none for sources on degrees
    std::mutex one_at_a_time;                 // PROJ's are for one thread
};

PostPlaces::PostPlaces() = default;
PostPlaces::PostPlaces(PostPlaces&&) noexcept = default;
PostPlaces& PostPlaces::operator=(PostPlaces&&) noexcept = default;
PostPlaces::~PostPlaces() = default;

Result<PostPlaces> PostPlaces::create(const Source& source) {
    PostPlaces places;
    places.way_ = std::make_unique<Way>();
    places.way_->source = &source;
    if (source.on_degrees) return places;
    const GdalMessages messages;
    const SpatialReference crs = spatial_reference(source.crs_wkt);
    places.way_->transformation.reset(OCTNewCoordinateTransformation(crs.get(), wgs84_degrees().get()));
    if (!places.way_->transformation)
        return Error{ErrorKind::failed, source.report.path,
                     "its posts cannot be placed on the Earth: " + messages.last("PROJ refuses its CRS")};
    return places;
}

// By their (fractional) row and column.
void PostPlaces::exactly(const std::vector<std::array<double, 2>>& posts, std::vector<LatLon>& places) const {
    const Source& source = *way_->source;
    const std::size_t count = posts.size();
    places.resize(count);
    if (source.on_degrees) {
        for (std::size_t i = 0; i < count; ++i)
            places[i] = {source.lat_axis.at_deg(posts[i][0]), source.lon_axis.at_deg(posts[i][1])};
        return;
    }
    const auto& m = source.crs_from_post;
    std::vector<double> x(count), y(count);
    std::vector<int> done(count);
    for (std::size_t i = 0; i < count; ++i) {
        x[i] = m[0] + m[1] * posts[i][1] + m[2] * posts[i][0];
        y[i] = m[3] + m[4] * posts[i][1] + m[5] * posts[i][0];
    }
    const std::scoped_lock lock(way_->one_at_a_time);
    const GdalMessages messages;
    OCTTransformEx(way_->transformation.get(), static_cast<int>(count), x.data(), y.data(), nullptr,
                   done.data());
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = 0; i < count; ++i) {
        const bool placed = done[i] && std::isfinite(x[i]) && std::isfinite(y[i]);
        places[i] = placed ? LatLon{y[i], x[i]} : LatLon{none, none};
    }
}

void PostPlaces::of(const PostLattice& lattice, std::vector<LatLon>& places) const {
    places.resize(static_cast<std::size_t>(lattice.rows) * static_cast<std::size_t>(lattice.columns));
    fill(lattice, 0, lattice.rows, 0, lattice.columns, places);
}

// A part of a lattice, by numbers of its own rows and columns.
void PostPlaces::fill(const PostLattice& lattice, int first_row, int rows, int first_column, int columns,
                      std::vector<LatLon>& places) const {
    const auto place = [&](int r, int c) -> LatLon& {
        return places[static_cast<std::size_t>(first_row + r) * static_cast<std::size_t>(lattice.columns) +
                      static_cast<std::size_t>(first_column + c)];
    };
    const auto post = [&](double r, double c) {
        return std::array{lattice.row + lattice.step * (first_row + r),
                          lattice.column + lattice.step * (first_column + c)};
    };
    std::vector<std::array<double, 2>> asked;
    std::vector<LatLon> placed;
    if (rows <= smallest_side || columns <= smallest_side) {
        for (int r = 0; r < rows; ++r)
            for (int c = 0; c < columns; ++c) asked.push_back(post(r, c));
        exactly(asked, placed);
        for (int r = 0; r < rows; ++r)
            for (int c = 0; c < columns; ++c)
                place(r, c) = placed[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns) +
                                     static_cast<std::size_t>(c)];
        return;
    }
    for (const double down : nodes)
        for (const double right : nodes) asked.push_back(post(down * (rows - 1), right * (columns - 1)));
    for (const auto& [down, right] : checks) asked.push_back(post(down * (rows - 1), right * (columns - 1)));
    exactly(asked, placed);
    // Without a jump of a turn.
    for (LatLon& one : placed)
        one.lon_deg = placed[0].lon_deg + std::remainder(one.lon_deg - placed[0].lon_deg, 360.0);
    bool fits = true;
    for (std::size_t i = 0; i < checks.size(); ++i) {
        const LatLon guess = on_cubics(placed, checks[i][0], checks[i][1]);
        const LatLon& exact = placed[nodes.size() * nodes.size() + i];
        // Not so where one is not a number.
        fits = fits && std::abs(guess.lat_deg - exact.lat_deg) <= same_place_deg &&
               std::abs(guess.lon_deg - exact.lon_deg) <= same_place_deg;
    }
    if (!fits) {
        const int upper = rows / 2, left = columns / 2;
        fill(lattice, first_row, upper, first_column, left, places);
        fill(lattice, first_row, upper, first_column + left, columns - left, places);
        fill(lattice, first_row + upper, rows - upper, first_column, left, places);
        fill(lattice, first_row + upper, rows - upper, first_column + left, columns - left, places);
        return;
    }
    std::vector<std::array<double, 4>> along(static_cast<std::size_t>(columns));
    for (int c = 0; c < columns; ++c)
        along[static_cast<std::size_t>(c)] = cubic_through_nodes(static_cast<double>(c) / (columns - 1));
    for (int r = 0; r < rows; ++r) {
        const auto down = cubic_through_nodes(static_cast<double>(r) / (rows - 1));
        std::array<LatLon, 4> row{};
        for (std::size_t i = 0; i < 4; ++i)
            row[i] = mix({placed[i], placed[4 + i], placed[8 + i], placed[12 + i]}, down);
        for (int c = 0; c < columns; ++c) place(r, c) = mix(row, along[static_cast<std::size_t>(c)]);
    }
}

}  // namespace oro
