#include "geo/cover/cover_over_ground.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <utility>

#include "core/base/srgb.h"
#include "core/terrain/level_grid.h"
#include "geo/drape/shared_raster.h"
#include "geo/drape/tile_sampling.h"
#include "geo/files/guarded_files.h"

namespace oro {
namespace {

constexpr int texels_along = gpu::drape_stride;
using CoverShares = CoverTexels::Shares;

float light_of_code(std::uint8_t code) {
    return static_cast<float>(light_of_srgb(code / 255.0));
}

std::vector<GroundColour> colours_of(const CoverTable& table) {
    std::vector<GroundColour> colours;
    for (const CoverGround& ground : grounds_of(table)) {
        GroundColour& one = colours.emplace_back();
        one.colour = {light_of_code(ground.colour[0]), light_of_code(ground.colour[1]),
                      light_of_code(ground.colour[2])};
        one.materials = static_cast<std::uint32_t>(ground.materials.front()) |
                        static_cast<std::uint32_t>(ground.materials.back()) << 8U;
        one.steepest_deg = static_cast<float>(ground.steepest_deg);
        one.lowest_H_m = static_cast<float>(ground.lowest_H_m);
        one.highest_H_m = static_cast<float>(ground.highest_H_m);
    }
    return colours;
}

// The codes of a window, each standing for step x step pixels.
struct CoverPixels {
    PixelWindow window;
    int columns{};
    int rows{};
    std::vector<float> codes;

    // At a place of the raster; no number beyond the window.
    [[nodiscard]] float at(double column, double row) const {
        const double x = std::floor((column - window.column) * columns / window.columns),
                     y = std::floor((row - window.row) * rows / window.rows);
        if (!(x >= 0.0 && y >= 0.0 && x < columns && y < rows)) return NAN;
        return codes[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) +
                     static_cast<std::size_t>(x)];
    }
};

Result<CoverPixels> read_cover(const CoverSource& source, GDALDatasetH dataset, const PixelWindow& window,
                               int step) {
    CoverPixels pixels{window, (window.columns + step - 1) / step, (window.rows + step - 1) / step, {}};
    const GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
    const GdalMessages messages;
    FileWatch watch(reading_limit_s + 1e-7 * window.rows * static_cast<double>(window.columns));
    if (!read_window({band, band, window, pixels.columns, pixels.rows, GRIORA_NearestNeighbour}, watch,
                     pixels.codes) ||
        !watch.fault().empty())
        return Error{ErrorKind::failed, source.file,
                     !watch.fault().empty() ? watch.fault() + " (overviews make it faster: gdaladdo)"
                                            : "cannot be read near row " + std::to_string(window.row) + ": " +
                                                  messages.last("the file is damaged")};
    return pixels;
}

class CoverOverGround final : public CoverTiles {
  public:
    CoverOverGround(const PostGrid& grid, std::shared_ptr<const CoverMap> map, int finest)
        : grid_(grid), map_(std::move(map)), finest_(finest), colours_(colours_of(map_->table())) {
        const std::vector<CoverGround> grounds = grounds_of(map_->table());
        for (const CoverClass& one : map_->table().classes) {
            const auto at =
                std::ranges::find_if(grounds, [&](const CoverGround& ground) { return ground.is_of(one); });
            for (const int code : one.codes)
                ground_of_[code] = static_cast<std::uint8_t>(at - grounds.begin());
        }
    }

    [[nodiscard]] int finest_level() const override { return finest_; }
    [[nodiscard]] int coarsest_level() const override { return level_count(grid_) - 1; }
    [[nodiscard]] std::span<const GroundColour> grounds() const override { return colours_; }
    Result<bool> load(const ImageTile& tile, std::span<std::uint32_t> texels) const override;

  private:
    Result<bool> add_file(std::size_t file, const ImageTile& tile, std::vector<CoverShares>& shares) const;
    void add_samples(const CoverSource& source, const TilePlacing& placing, const PixelPlace& moved,
                     const Sampling& sampling, const CoverPixels& pixels,
                     std::vector<CoverShares>& shares) const;

    PostGrid grid_;
    std::shared_ptr<const CoverMap> map_;
    int finest_;
    std::vector<GroundColour> colours_;
    std::map<int, std::uint8_t> ground_of_;  // by code
};

void CoverOverGround::add_samples(const CoverSource& source, const TilePlacing& placing,
                                  const PixelPlace& moved, const Sampling& sampling,
                                  const CoverPixels& pixels, std::vector<CoverShares>& shares) const {
    const float share = 1.0F / static_cast<float>(sampling.count());
    float before = NAN;
    std::size_t ground = unknown_ground;  // of the code before: most are alike
    for (int i = 0; i < texels_along * texels_along; ++i) {
        const int row = i / texels_along, column = i % texels_along;
        for (int k = 0; k < sampling.count(); ++k) {
            const PixelPlace at = sampling.place_in(column, row, k), place = placing.at(at.column, at.row);
            if (!place.there()) continue;
            const float code = pixels.at(place.column + moved.column, place.row + moved.row);
            if (std::isnan(code)) continue;
            if (code != before) {
                before = code;
                const auto found = ground_of_.find(static_cast<int>(code));
                const bool known = found != ground_of_.end() && static_cast<int>(code) != source.no_data;
                ground = known ? found->second : unknown_ground;
            }
            if (ground != unknown_ground) shares[static_cast<std::size_t>(i)][ground] += share;
        }
    }
}

// Shares of one file, without those of unknown ground; false where none of it lies in the tile.
Result<bool> CoverOverGround::add_file(std::size_t file, const ImageTile& tile,
                                       std::vector<CoverShares>& shares) const {
    const CoverSource& source = map_->sources()[file];
    ORO_TRY(OpenRaster open, map_->raster(file).take());
    const TilePlacing placing(grid_, tile, open.placing);
    bool any = false;
    for (const PixelPlace& moved : turns_of(open.placing)) {
        Sampling sampling = sampling_of(placing.per_texel());
        const std::optional<PixelWindow> window = window_of(source, placing, moved, sampling);
        if (!window) continue;
        if (!any) shares.assign(gpu::drape_words, CoverShares{});
        any = true;
        ORO_TRY(const CoverPixels pixels, read_cover(source, open.dataset.get(), *window, sampling.step));
        add_samples(source, placing, moved, sampling, pixels, shares);
    }
    map_->raster(file).give_back(std::move(open));
    return any;
}

Result<bool> CoverOverGround::load(const ImageTile& tile, std::span<std::uint32_t> texels) const {
    assert(texels.size() == gpu::drape_words);
    std::vector<CoverShares> all, one;
    for (std::size_t file = 0; file < map_->sources().size(); ++file) {
        ORO_TRY(const bool any, add_file(file, tile, one));
        if (!any) continue;
        if (all.empty()) all.assign(gpu::drape_words, CoverShares{});
        for (std::size_t i = 0; i < all.size(); ++i) {
            float left = 1.0F;
            for (const float share : one[i]) left -= share;
            for (std::size_t k = 0; k < unknown_ground; ++k)
                all[i][k] = one[i][k] + std::max(left, 0.0F) * all[i][k];
        }
    }
    bool shows = false;
    CoverTexels packing(texels_along);
    for (std::size_t i = 0; i < all.size(); ++i) {
        float known = 0.0F;
        for (const float share : all[i]) known += share;
        all[i][unknown_ground] = std::max(1.0F - known, 0.0F);
        shows = shows || known > 0.0F;
        texels[i] = packing.pack(i % static_cast<std::size_t>(texels_along), all[i]);
    }
    return shows;
}

}  // namespace

Result<std::unique_ptr<CoverTiles>> cover_over(const PostGrid& grid, std::shared_ptr<const CoverMap> map,
                                               std::vector<std::string>& outside) {
    int finest = level_count(grid) - 1;
    for (std::size_t file = 0; file < map->sources().size(); ++file) {
        const CoverSource& source = map->sources()[file];
        ORO_TRY(OpenRaster open, map->raster(file).take());
        if (!lies_over(source, open.placing, grid)) outside.push_back(source.file);
        finest = std::min(finest, finest_level_of(source, open.placing, grid));
        map->raster(file).give_back(std::move(open));
    }
    finest = std::max(finest, least_level(grid));
    return std::unique_ptr<CoverTiles>(std::make_unique<CoverOverGround>(grid, std::move(map), finest));
}

}  // namespace oro
