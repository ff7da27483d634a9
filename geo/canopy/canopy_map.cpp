#include "geo/canopy/canopy_map.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <utility>

#include "geo/drape/raster_opening.h"
#include "geo/drape/shared_raster.h"
#include "geo/files/guarded_files.h"

namespace oro {
namespace {

// The middle of a raster's longitudes, where it has some: places are looked for in the turn around it.
double middle_x(const CanopySource& source) {
    const auto& m = source.crs_from_pixel;
    return m[0] + 0.5 * (m[1] * source.columns + m[2] * source.rows);
}

// What is wrong with a value as the height of a canopy.
std::string fault_of_height(double height_m, int column, int row) {
    char text[240];
    if (height_m < lowest_canopy_m)
        std::snprintf(
            text, sizeof text,
            "holds %g m in column %d, row %d: a canopy is 0 m high or more (a value for no data that "
            "the file does not name?)",
            height_m, column, row);
    else
        std::snprintf(
            text, sizeof text,
            "holds %g m in column %d, row %d: no canopy is higher than %g m (codes, centimetres, or "
            "heights above the sea?)",
            height_m, column, row, highest_canopy_m);
    return text;
}

// Reads single pixels of one file. The library keeps the blocks that they are in.
class HeightReader {
  public:
    HeightReader(const CanopySource& source, GDALDatasetH dataset)
        : source_(source), band_(GDALGetRasterBand(dataset, 1)) {}

    // Leaves the height where the place is beyond the raster, and where that has no data.
    Result<void> read(const PixelPlace& place, float& canopy_m) {
        if (!place.there()) return {};
        const double x = std::floor(place.column), y = std::floor(place.row);
        if (!(x >= 0.0 && y >= 0.0 && x < source_.columns && y < source_.rows)) return {};
        const int column = static_cast<int>(x), row = static_cast<int>(y);
        double value = 0.0;
        const bool is_read = band_ != nullptr && GDALRasterIO(band_, GF_Read, column, row, 1, 1, &value, 1, 1,
                                                              GDT_Float64, 0, 0) == CE_None;
        if (!is_read || !watch_.fault().empty())
            return Error{ErrorKind::failed, source_.file,
                         !watch_.fault().empty() ? watch_.fault()
                                                 : "cannot be read near row " + std::to_string(row) + ": " +
                                                       messages_.last("the file is damaged")};
        if (!std::isfinite(value) || value == source_.no_data) return {};
        const double height_m = source_.scale * value + source_.offset;
        if (!(height_m >= lowest_canopy_m && height_m <= highest_canopy_m))
            return Error{ErrorKind::failed, source_.file, fault_of_height(height_m, column, row)};
        canopy_m = static_cast<float>(std::max(height_m, 0.0));
        return {};
    }

  private:
    const CanopySource& source_;
    GDALRasterBandH band_;
    GdalMessages messages_;
    FileWatch watch_{reading_limit_s};
};

}  // namespace

CanopyMap::CanopyMap(std::vector<CanopySource> sources, std::shared_ptr<const CoverMap> cover)
    : sources_(std::move(sources)), cover_(std::move(cover)) {
    for (const CanopySource& source : sources_)
        rasters_.push_back(std::make_unique<const SharedRaster>(source));
}

CanopyMap::~CanopyMap() = default;

std::shared_ptr<const CanopyMap> CanopyMap::of_files(std::vector<CanopySource> sources) {
    assert(!sources.empty());
    return std::shared_ptr<const CanopyMap>(new CanopyMap(std::move(sources), nullptr));
}

std::shared_ptr<const CanopyMap> CanopyMap::of_classes(std::shared_ptr<const CoverMap> cover) {
    assert(cover);
    return std::shared_ptr<const CanopyMap>(new CanopyMap({}, std::move(cover)));
}

std::vector<std::string> CanopyMap::notes() const {
    std::vector<std::string> notes;
    for (const CanopySource& source : sources_)
        notes.insert(notes.end(), source.notes.begin(), source.notes.end());
    return notes;
}

Result<void> CanopyMap::add_heights_of(std::size_t file, std::span<const double> lat_deg,
                                       std::span<const double> lon_deg, std::span<float> canopy_m) const {
    const CanopySource& source = sources_[file];
    ORO_TRY(OpenRaster open, rasters_[file]->take());
    std::vector<double> x(lon_deg.begin(), lon_deg.end()), y(lat_deg.begin(), lat_deg.end());
    std::vector<PixelPlace> places;
    open.placing.place(x, y, source.geographic ? middle_x(source) : 0.0, places);
    {
        HeightReader reader(source, open.dataset.get());
        for (std::size_t i = 0; i < places.size(); ++i) ORO_CHECK(reader.read(places[i], canopy_m[i]));
    }
    rasters_[file]->give_back(std::move(open));
    return {};
}

Result<void> CanopyMap::heights_at(std::span<const double> lat_deg, std::span<const double> lon_deg,
                                   std::span<float> canopy_m) const {
    assert(lat_deg.size() == lon_deg.size() && lat_deg.size() == canopy_m.size());
    std::ranges::fill(canopy_m, no_canopy_m);
    if (cover_) {
        std::vector<int> codes(lat_deg.size());
        ORO_CHECK(cover_->codes_at(lat_deg, lon_deg, codes));
        for (std::size_t i = 0; i < codes.size(); ++i) {
            const CoverClass* const known =
                codes[i] == no_cover_code ? nullptr : cover_->table().class_of(codes[i]);
            if (known) canopy_m[i] = static_cast<float>(known->canopy_m);
        }
        return {};
    }
    for (std::size_t file = 0; file < sources_.size(); ++file)
        ORO_CHECK(add_heights_of(file, lat_deg, lon_deg, canopy_m));
    return {};
}

}  // namespace oro
