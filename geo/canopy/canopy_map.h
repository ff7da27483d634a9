// How high what grows on the ground is, by place: from files, or from classes of land cover.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "geo/canopy/canopy_source.h"
#include "geo/cover/cover_map.h"

namespace oro {

class SharedRaster;

// The canopy over a place of which nothing is known.
inline constexpr float no_canopy_m = std::numeric_limits<float>::quiet_NaN();

// Canopy heights. Safe to ask from several threads.
class CanopyMap {
  public:
    // Of rasters, the later ones over the earlier ones; at least one.
    static std::shared_ptr<const CanopyMap> of_files(std::vector<CanopySource> sources);
    // Of the classes of land cover: each has the height of its table everywhere, so that it is invented.
    static std::shared_ptr<const CanopyMap> of_classes(std::shared_ptr<const CoverMap> cover);

    ~CanopyMap();
    CanopyMap(const CanopyMap&) = delete;
    CanopyMap& operator=(const CanopyMap&) = delete;

    // Whether heights are those of classes, and not measured.
    [[nodiscard]] bool is_invented() const { return cover_ != nullptr; }
    [[nodiscard]] const CoverMap* cover() const { return cover_.get(); }
    [[nodiscard]] std::span<const CanopySource> sources() const { return sources_; }
    // What a user must know of the files, one line each.
    [[nodiscard]] std::vector<std::string> notes() const;

    // Heights in metres, 0 or more, around places, WGS84 degrees: means of the pixels of the cell around each
    // place of which something is known, later files over earlier ones; no_canopy_m where none is. Of pixels
    // larger than half of a cell it is the one that the place lies in: nothing is interpolated. All three of
    // one length. Errors: a value that is no canopy's height (lowest_canopy_m, highest_canopy_m); a file that
    // has changed, is damaged or takes too long.
    Result<void> heights_around(std::span<const double> lat_deg, std::span<const double> lon_deg,
                                const CellSize& cell, std::span<float> canopy_m) const;

  private:
    // Of the pixels of a cell of which something is known.
    struct KnownSum {
        double metres{};
        std::uint32_t pixels{};
    };
    CanopyMap(std::vector<CanopySource> sources, std::shared_ptr<const CoverMap> cover);
    // Adds the heights that a file, by its number, knows in the cell around each place.
    Result<void> add_heights_of(std::size_t file, std::span<const double> lat_deg,
                                std::span<const double> lon_deg, const CellSize& cell,
                                std::span<KnownSum> sums) const;
    Result<void> add_classes_of(std::size_t file, std::span<const double> lat_deg,
                                std::span<const double> lon_deg, const CellSize& cell,
                                std::span<KnownSum> sums) const;

    std::vector<CanopySource> sources_;  // stay where they are: readers point to them
    std::vector<std::unique_ptr<const SharedRaster>> rasters_;
    std::shared_ptr<const CoverMap> cover_;
};

}  // namespace oro
