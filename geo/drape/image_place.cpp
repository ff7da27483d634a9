#include "geo/drape/image_place.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace oro {
namespace {

// One more than the rim's on each side: texels are sampled around their middles, too.
constexpr double first_texel = -2.0;
constexpr double texels_across = gpu::drape_stride + 1;

double angle_deg(const GridAxis& axis, double post) {
    return axis.phase_deg + (static_cast<double>(axis.first) + axis.step * post) / axis.posts_per_deg;
}

PostPlace place_at(const PostGrid& grid, double row, double column) {
    if (grid.net) return grid.net->place_at(row, column);
    return {std::clamp(angle_deg(grid.lat, row), -90.0, 90.0), angle_deg(grid.lon, column)};
}

PixelPlace pixel_of(const PlacedRaster& raster, double x, double y) {
    const auto& m = raster.pixel_from_crs;
    return {m[0] + m[1] * x + m[2] * y, m[3] + m[4] * x + m[5] * y};
}

double length(const PixelPlace& a) {
    return std::hypot(a.column, a.row);
}

}  // namespace

std::optional<ImagePlacing> ImagePlacing::of(const PlacedRaster& raster) {
    const SpatialReference crs = spatial_reference(raster.crs_wkt), wgs84 = wgs84_degrees();
    if (!crs || !wgs84) return std::nullopt;
    ImagePlacing placing(raster);
    placing.to_image_.reset(OCTNewCoordinateTransformation(wgs84.get(), crs.get()));
    placing.from_image_.reset(OCTNewCoordinateTransformation(crs.get(), wgs84.get()));
    if (!placing.to_image_ || !placing.from_image_) return std::nullopt;
    return placing;
}

void ImagePlacing::place(std::vector<double>& lon_deg, std::vector<double>& lat_deg, double near_lon_deg,
                         std::vector<PixelPlace>& places) const {
    assert(lon_deg.size() == lat_deg.size());
    std::vector<int> done(lon_deg.size(), 0);
    OCTTransformEx(to_image_.get(), static_cast<int>(lon_deg.size()), lon_deg.data(), lat_deg.data(), nullptr,
                   done.data());
    places.resize(lon_deg.size());
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = 0; i < places.size(); ++i) {
        double x = lon_deg[i];
        if (raster_->geographic) x = near_lon_deg + std::remainder(x - near_lon_deg, 360.0);
        places[i] = done[i] != 0 && std::isfinite(x) && std::isfinite(lat_deg[i])
                        ? pixel_of(*raster_, x, lat_deg[i])
                        : PixelPlace{none, none};
    }
}

std::optional<ImagePlacing::Spot> ImagePlacing::spot(const PixelPlace& place) const {
    const auto& m = raster_->crs_from_pixel;
    double x = m[0] + m[1] * place.column + m[2] * place.row,
           y = m[3] + m[4] * place.column + m[5] * place.row;
    int done = 0;
    OCTTransformEx(from_image_.get(), 1, &x, &y, nullptr, &done);
    if (!done || !std::isfinite(x) || !std::isfinite(y)) return std::nullopt;
    return Spot{x, y};
}

std::optional<PixelPlace> ImagePlacing::turn() const {
    if (!raster_->geographic) return std::nullopt;
    const auto& m = raster_->pixel_from_crs;
    return PixelPlace{360.0 * m[1], 360.0 * m[4]};
}

TilePlacing::TilePlacing(const PostGrid& grid, const ImageTile& tile, const ImagePlacing& placing)
    : grid_(&grid), tile_(tile) {
    for (const int cells : {8, 16, 32, 64}) {
        lay(cells, placing);
        measure();
        if (holds(placing)) return;
    }
    lay(static_cast<int>(texels_across), placing);  // each by itself
    measure();
}

std::vector<PixelPlace> TilePlacing::places(const std::vector<double>& u, const std::vector<double>& v,
                                            const ImagePlacing& placing) const {
    std::vector<double> lon_deg, lat_deg;
    const double posts_per_texel = post_of_texel(tile_.level, 0, 1) - post_of_texel(tile_.level, 0, 0);
    const double first_row = post_of_texel(tile_.level, tile_.row, 0),
                 first_column = post_of_texel(tile_.level, tile_.column, 0);
    for (const double row : v) {
        for (const double column : u) {
            const PostPlace place =
                place_at(*grid_, first_row + posts_per_texel * row, first_column + posts_per_texel * column);
            lat_deg.push_back(place.lat_deg);
            lon_deg.push_back(place.lon_deg);
        }
    }
    std::vector<PixelPlace> found;
    const double half = posts_per_texel * 0.5 * texels_across;
    const double middle_deg = place_at(*grid_, first_row + half, first_column + half).lon_deg;
    placing.place(lon_deg, lat_deg, middle_deg, found);
    return found;
}

void TilePlacing::lay(int cells, const ImagePlacing& placing) {
    cells_ = cells;
    std::vector<double> nodes;
    for (int i = 0; i <= cells; ++i) nodes.push_back(first_texel + texels_across * i / cells);
    nodes_ = places(nodes, nodes, placing);
}

void TilePlacing::measure() {
    PixelPlace sum{0.0, 0.0};
    int count = 0;
    const double texels = texels_across / cells_;
    const auto node = [&](int row, int column) -> const PixelPlace& {
        return nodes_[static_cast<std::size_t>(row * (cells_ + 1) + column)];
    };
    for (int row = 0; row < cells_; ++row) {
        for (int column = 0; column < cells_; ++column) {
            const PixelPlace &a = node(row, column), &b = node(row, column + 1), &c = node(row + 1, column);
            if (!a.there() || !b.there() || !c.there()) continue;
            sum.column += length({b.column - a.column, b.row - a.row}) / texels;
            sum.row += length({c.column - a.column, c.row - a.row}) / texels;
            ++count;
        }
    }
    per_texel_ = count > 0 ? PixelPlace{sum.column / count, sum.row / count} : PixelPlace{0.0, 0.0};
}

// Whether it is good enough half way between the nodes.
bool TilePlacing::holds(const ImagePlacing& placing) const {
    if (std::ranges::any_of(nodes_, [](const PixelPlace& node) { return !node.there(); })) return false;
    const double slack = std::min(per_texel_.column, per_texel_.row) / 20.0;
    std::vector<double> middles;
    for (int i = 0; i < cells_; ++i) middles.push_back(first_texel + texels_across * (i + 0.5) / cells_);
    const std::vector<PixelPlace> truth = places(middles, middles, placing);
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const auto across = static_cast<std::size_t>(cells_);
        const PixelPlace here = at(middles[i % across], middles[i / across]);
        if (!truth[i].there() || length({here.column - truth[i].column, here.row - truth[i].row}) > slack)
            return false;
    }
    return true;
}

PixelPlace TilePlacing::at(double u, double v) const {
    const double x = std::clamp((u - first_texel) / texels_across, 0.0, 1.0) * cells_,
                 y = std::clamp((v - first_texel) / texels_across, 0.0, 1.0) * cells_;
    const int column = std::min(static_cast<int>(x), cells_ - 1),
              row = std::min(static_cast<int>(y), cells_ - 1);
    const double right = x - column, down = y - row;
    const auto* const north = &nodes_[static_cast<std::size_t>(row * (cells_ + 1) + column)];
    const auto* const south = north + cells_ + 1;
    const auto mixed = [&](double PixelPlace::*axis) {
        return (1.0 - down) * ((1.0 - right) * north[0].*axis + right * north[1].*axis) +
               down * ((1.0 - right) * south[0].*axis + right * south[1].*axis);
    };
    return {mixed(&PixelPlace::column), mixed(&PixelPlace::row)};
}

bool TilePlacing::bounds(PixelPlace& low, PixelPlace& high) const {
    bool any = false;
    for (const PixelPlace& node : nodes_) {
        if (!node.there()) continue;
        if (!any) low = high = node;
        any = true;
        low = {std::min(low.column, node.column), std::min(low.row, node.row)};
        high = {std::max(high.column, node.column), std::max(high.row, node.row)};
    }
    return any;
}

}  // namespace oro
