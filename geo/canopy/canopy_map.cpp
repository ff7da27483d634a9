#include "geo/canopy/canopy_map.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <utility>

#include "geo/drape/pixel_values.h"
#include "geo/drape/shared_raster.h"

namespace oro {
namespace {

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
                                       std::span<const double> lon_deg, const CellSize& cell,
                                       std::span<KnownSum> sums) const {
    const CanopySource& source = sources_[file];
    return read_pixels_around(source, *rasters_[file], lat_deg, lon_deg, cell,
                              [&](const PixelValue& pixel) -> Result<void> {
                                  if (!std::isfinite(pixel.value) || pixel.value == source.no_data) return {};
                                  const double height_m = source.scale * pixel.value + source.offset;
                                  if (!(height_m >= lowest_canopy_m && height_m <= highest_canopy_m))
                                      return Error{ErrorKind::failed, source.file,
                                                   fault_of_height(height_m, pixel.column, pixel.row)};
                                  sums[pixel.place].metres += std::max(height_m, 0.0);
                                  ++sums[pixel.place].pixels;
                                  return {};
                              });
}

Result<void> CanopyMap::add_classes_of(std::size_t file, std::span<const double> lat_deg,
                                       std::span<const double> lon_deg, const CellSize& cell,
                                       std::span<KnownSum> sums) const {
    return cover_->read_codes_around(file, lat_deg, lon_deg, cell,
                                     [&](std::size_t place, int code) -> Result<void> {
                                         const CoverClass* const known = cover_->table().class_of(code);
                                         if (!known) return {};
                                         sums[place].metres += known->canopy_m;
                                         ++sums[place].pixels;
                                         return {};
                                     });
}

Result<void> CanopyMap::heights_around(std::span<const double> lat_deg, std::span<const double> lon_deg,
                                       const CellSize& cell, std::span<float> canopy_m) const {
    assert(lat_deg.size() == lon_deg.size() && lat_deg.size() == canopy_m.size());
    std::ranges::fill(canopy_m, no_canopy_m);
    std::vector<KnownSum> sums(canopy_m.size());
    const std::size_t files = cover_ ? cover_->sources().size() : sources_.size();
    for (std::size_t file = 0; file < files; ++file) {
        std::ranges::fill(sums, KnownSum{});
        ORO_CHECK(cover_ ? add_classes_of(file, lat_deg, lon_deg, cell, sums)
                         : add_heights_of(file, lat_deg, lon_deg, cell, sums));
        for (std::size_t i = 0; i < sums.size(); ++i)
            if (sums[i].pixels > 0) canopy_m[i] = static_cast<float>(sums[i].metres / sums[i].pixels);
    }
    return {};
}

}  // namespace oro
