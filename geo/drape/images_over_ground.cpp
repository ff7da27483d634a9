#include "geo/drape/images_over_ground.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "core/terrain/level_grid.h"
#include "geo/drape/image_pixels.h"
#include "geo/drape/image_place.h"
#include "geo/drape/shared_raster.h"
#include "geo/drape/tile_sampling.h"

namespace oro {
namespace {

constexpr int side = gpu::drape_stride;

// An image, and how threads read it.
struct SharedImage {
    explicit SharedImage(ImageSource image) : source(std::move(image)) {}
    ImageSource source;
    SharedRaster shared{source};
};

void add_samples(const TilePlacing& tile, const PixelPlace& moved, const Sampling& sampling,
                 const ImagePixels& pixels, std::vector<Colour>& texels) {
    const float share = 1.0F / static_cast<float>(sampling.count());
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            Colour& sum = texels[static_cast<std::size_t>(row * side + column)];
            for (int i = 0; i < sampling.count(); ++i) {
                const PixelPlace at = sampling.place_in(column, row, i), place = tile.at(at.column, at.row);
                if (!place.there()) continue;
                const Colour one = pixels.at(place.column + moved.column, place.row + moved.row);
                for (std::size_t k = 0; k < 4; ++k) sum[k] += share * one[k];
            }
        }
    }
}

// Pixels of an image within a tile; false where there are none.
Result<bool> sample(const ImageSource& image, OpenRaster& open, const PostGrid& grid, const ImageTile& tile,
                    std::vector<Colour>& texels) {
    const TilePlacing placing(grid, tile, open.placing);
    bool any = false;
    for (const PixelPlace& moved : turns_of(open.placing)) {
        Sampling sampling = sampling_of(placing.per_texel());
        const std::optional<PixelWindow> window = window_of(image, placing, moved, sampling);
        if (!window) continue;
        if (!any) texels.assign(gpu::drape_words, Colour{});
        any = true;
        ORO_TRY(const ImagePixels pixels, read_pixels(image, open.dataset.get(), *window, sampling.step));
        add_samples(placing, moved, sampling, pixels, texels);
    }
    return any;
}

std::uint32_t packed(const Colour& colour) {
    const auto byte = [](float value) {
        return static_cast<std::uint32_t>(std::lround(std::clamp(value, 0.0F, 255.0F)));
    };
    return byte(colour[0]) | byte(colour[1]) << 8U | byte(colour[2]) << 16U | byte(255.0F * colour[3]) << 24U;
}

class ImagesOverGround final : public GroundImage {
  public:
    ImagesOverGround(const PostGrid& grid, std::vector<std::unique_ptr<SharedImage>> images, int finest,
                     int coarsest)
        : grid_(grid), images_(std::move(images)), finest_(finest), coarsest_(coarsest) {}

    [[nodiscard]] int finest_level() const override { return finest_; }
    [[nodiscard]] int coarsest_level() const override { return coarsest_; }

    Result<bool> load(const ImageTile& tile, std::span<std::uint32_t> texels) const override {
        assert(texels.size() == gpu::drape_words);
        std::vector<Colour> all, one;
        for (const auto& image : images_) {
            ORO_TRY(OpenRaster open, image->shared.take());
            ORO_TRY(const bool any, sample(image->source, open, grid_, tile, one));
            image->shared.give_back(std::move(open));
            if (!any) continue;
            if (all.empty()) all.assign(gpu::drape_words, Colour{});
            for (std::size_t i = 0; i < all.size(); ++i) {
                const float left = 1.0F - std::min(one[i][3], 1.0F);
                for (std::size_t k = 0; k < 4; ++k) all[i][k] = one[i][k] + left * all[i][k];
            }
        }
        const auto shows = [](const Colour& colour) { return colour[3] > 0.0F; };
        if (std::ranges::none_of(all, shows)) return false;
        std::ranges::transform(all, texels.begin(), packed);
        return true;
    }

  private:
    PostGrid grid_;
    std::vector<std::unique_ptr<SharedImage>> images_;
    int finest_;
    int coarsest_;
};

}  // namespace

Result<std::unique_ptr<GroundImage>> images_over(const PostGrid& grid, std::vector<ImageSource> images,
                                                 std::vector<std::string>& outside) {
    const int coarsest = level_count(grid) - 1;
    int finest = coarsest;
    std::vector<std::unique_ptr<SharedImage>> shared;
    for (ImageSource& source : images) {
        auto image = std::make_unique<SharedImage>(std::move(source));
        ORO_TRY(OpenRaster open, image->shared.take());
        if (!lies_over(image->source, open.placing, grid)) outside.push_back(image->source.file);
        finest = std::min(finest, finest_level_of(image->source, open.placing, grid));
        image->shared.give_back(std::move(open));
        shared.push_back(std::move(image));
    }
    finest = std::max(finest, least_level(grid));
    return std::unique_ptr<GroundImage>(
        std::make_unique<ImagesOverGround>(grid, std::move(shared), finest, coarsest));
}

}  // namespace oro
