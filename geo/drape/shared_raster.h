// A raster that several threads read: each opens it for itself.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "core/base/result.h"
#include "geo/drape/image_place.h"
#include "geo/drape/placed_raster.h"
#include "geo/files/raster_library.h"

namespace oro {

// A raster that a thread has opened for itself.
struct OpenRaster {
    Dataset dataset;
    ImagePlacing placing;  // from places of the Earth to its pixels
};

// Gives each thread that asks a raster of its own, and keeps it for the next one.
class SharedRaster {
  public:
    // The raster stays where it is as long as this lives.
    explicit SharedRaster(const PlacedRaster& raster) : raster_(&raster) {}

    // Errors: a file that cannot be opened any more; a CRS that PROJ knows no way to.
    Result<OpenRaster> take() const;
    void give_back(OpenRaster raster) const;

  private:
    const PlacedRaster* raster_;
    std::unique_ptr<std::mutex> mutex_ = std::make_unique<std::mutex>();
    std::unique_ptr<std::vector<OpenRaster>> idle_ = std::make_unique<std::vector<OpenRaster>>();
};

}  // namespace oro
