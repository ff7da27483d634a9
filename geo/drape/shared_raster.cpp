#include "geo/drape/shared_raster.h"

#include <utility>

#include "geo/drape/raster_opening.h"
#include "geo/files/guarded_files.h"

namespace oro {

Result<OpenRaster> SharedRaster::take() const {
    {
        const std::scoped_lock lock(*mutex_);
        if (!idle_->empty()) {
            OpenRaster raster = std::move(idle_->back());
            idle_->pop_back();
            return raster;
        }
    }
    const GdalMessages messages;
    const FileWatch watch(opening_limit_s);
    auto placing = ImagePlacing::of(*raster_);
    if (!placing)
        return Error{ErrorKind::failed, raster_->file,
                     "PROJ knows no way from WGS84 to its CRS, " + raster_->crs};
    Dataset dataset = raster_->held
                          ? held_dataset(*raster_)
                          : Dataset(GDALOpenEx(raster_->file.c_str(),
                                               GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR,
                                               trusted_drivers(), nullptr, nullptr));
    if (!dataset || !watch.fault().empty())
        return Error{ErrorKind::failed, raster_->file,
                     watch.fault().empty() ? "cannot be opened: " + messages.last("the file is damaged")
                                           : watch.fault()};
    return OpenRaster{std::move(dataset), std::move(*placing)};
}

void SharedRaster::give_back(OpenRaster raster) const {
    const std::scoped_lock lock(*mutex_);
    idle_->push_back(std::move(raster));
}

}  // namespace oro
