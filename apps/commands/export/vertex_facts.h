// What an export tells of vertices one by one: their colours and their sources.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "apps/options/export_options.h"
#include "core/base/result.h"
#include "core/drape/ground_image.h"
#include "geo/cover/cover_map.h"
#include "geo/region/region.h"
#include "geo/tilesets/glb.h"
#include "geo/tilesets/ground_mesh.h"

namespace oro {

// The images or the land cover of a request over one grid of a region, and its sources. May be asked from
// several threads.
class ExportedFacts {
  public:
    // plain: the ground's own colour, linear light. `region` outlives it. Errors: those of open_images(),
    // images_over() and open_cover().
    static Result<std::unique_ptr<ExportedFacts>> of(const ExportOptions& options, const Region& region,
                                                     std::size_t grid, const std::array<double, 3>& plain);

    [[nodiscard]] const std::vector<GroundSource>& sources() const { return sources_; }
    // Whether an image or land cover colours the ground.
    [[nodiscard]] bool has_colours() const { return images_ != nullptr || cover_ != nullptr; }
    // What the colours come from, for a key of tiles that are kept: fingerprints of all files.
    [[nodiscard]] const std::string& key() const { return key_; }
    // What a user must know of the files, one line each.
    [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }
    // Of vertices of tiles of a level, whose triangles are 2^level times as long as those of level 0. Colours
    // are those of the images there, as the mean over some 2^(level + 1) posts, or of the class of land cover
    // at the place; the ground's own where there is neither. Errors: a file that cannot be read.
    [[nodiscard]] Result<VertexFacts> at(int level, std::span<const VertexPlace> places) const;

  private:
    ExportedFacts() = default;
    Result<void> add_image_colours(int level, std::span<const VertexPlace> places, VertexFacts& facts) const;
    Result<void> add_cover_colours(std::span<const VertexPlace> places, VertexFacts& facts) const;

    [[nodiscard]] std::array<double, 3> colour_of(std::uint32_t texel) const;

    const RegionGrid* grid_{};
    std::array<double, 3> plain_{};
    std::unique_ptr<GroundImage> images_;
    std::shared_ptr<const CoverMap> cover_;
    std::vector<GroundSource> sources_;
    std::vector<std::string> notes_;
    std::string key_;
};

}  // namespace oro
