#include "geo/drape/images_over_ground.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <mutex>
#include <optional>
#include <utility>

#include "core/terrain/level_grid.h"
#include "geo/drape/image_pixels.h"
#include "geo/drape/image_place.h"
#include "geo/files/guarded_files.h"

namespace oro {
namespace {

constexpr int side = gpu::drape_stride;
constexpr double most_pixels = 3e7;  // that are read for a tile

// An image that a thread has opened for itself.
struct OpenImage {
    Dataset dataset;
    ImagePlacing placing;
};

// One image; gives each thread that asks one of its own.
class SharedImage {
  public:
    explicit SharedImage(ImageSource source) : source_(std::make_unique<ImageSource>(std::move(source))) {}

    [[nodiscard]] const ImageSource& source() const { return *source_; }
    Result<OpenImage> take() const {
        {
            const std::scoped_lock lock(*mutex_);
            if (!idle_->empty()) {
                OpenImage image = std::move(idle_->back());
                idle_->pop_back();
                return image;
            }
        }
        const GdalMessages messages;
        const FileWatch watch(opening_limit_s);
        auto placing = ImagePlacing::of(*source_);
        if (!placing)
            return Error{ErrorKind::failed, source_->file,
                         "PROJ knows no way from WGS84 to its CRS, " + source_->crs};
        Dataset dataset(GDALOpenEx(source_->file.c_str(),
                                   GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR,
                                   trusted_drivers(), nullptr, nullptr));
        if (!dataset || !watch.fault().empty())
            return Error{ErrorKind::failed, source_->file,
                         watch.fault().empty() ? "cannot be opened: " + messages.last("the file is damaged")
                                               : watch.fault()};
        return OpenImage{std::move(dataset), std::move(*placing)};
    }
    void give_back(OpenImage image) const {
        const std::scoped_lock lock(*mutex_);
        idle_->push_back(std::move(image));
    }

  private:
    std::unique_ptr<ImageSource> source_;  // places point to it
    std::unique_ptr<std::mutex> mutex_ = std::make_unique<std::mutex>();
    std::unique_ptr<std::vector<OpenImage>> idle_ = std::make_unique<std::vector<OpenImage>>();
};

// How a tile is sampled: the pixels that are averaged before, and the places of a texel along either axis
// that are averaged afterwards. Together they cover the texel.
struct Sampling {
    int step{1};
    int columns{1};
    int rows{1};
};
Sampling sampling_of(const PixelPlace& per_texel) {
    const double least = std::min(per_texel.column, per_texel.row);
    Sampling sampling;
    while (sampling.step * 4.0 <= least && sampling.step < (1 << 28)) sampling.step *= 2;
    const auto places = [&](double pixels) {
        return std::clamp(static_cast<int>(std::ceil(pixels / sampling.step - 0.01)), 1, 16);
    };
    sampling.columns = places(per_texel.column);
    sampling.rows = places(per_texel.row);
    return sampling;
}

// What of an image a tile can see, moved by so much: whole steps, so that neighbours read the same averages.
std::optional<PixelWindow> window_of(const ImageSource& image, const TilePlacing& tile,
                                     const PixelPlace& moved, Sampling& sampling) {
    PixelPlace low, high;
    if (!tile.bounds(low, high)) return std::nullopt;
    for (;; sampling.step *= 2) {
        const double step = sampling.step,
                     rim = 2.0 * step + std::max(tile.per_texel().column, tile.per_texel().row);
        const auto from = [&](double at) { return std::max(0.0, std::floor((at - rim) / step) * step); };
        const auto to = [&](double at, int end) {
            return std::min<double>(end, std::ceil((at + rim) / step) * step);
        };
        const double west = from(low.column + moved.column), north = from(low.row + moved.row);
        const double east = to(high.column + moved.column, image.columns),
                     south = to(high.row + moved.row, image.rows);
        if (!(west < east && north < south)) return std::nullopt;
        if ((east - west) * (south - north) / (step * step) > most_pixels) continue;
        return PixelWindow{static_cast<int>(west), static_cast<int>(north), static_cast<int>(east - west),
                           static_cast<int>(south - north)};
    }
}

void add_samples(const TilePlacing& tile, const PixelPlace& moved, const Sampling& sampling,
                 const ImagePixels& pixels, std::vector<Colour>& texels) {
    const float share = 1.0F / static_cast<float>(sampling.columns * sampling.rows);
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            Colour& sum = texels[static_cast<std::size_t>(row * side + column)];
            for (int i = 0; i < sampling.rows * sampling.columns; ++i) {
                const double u = column - 1 + (i % sampling.columns + 0.5) / sampling.columns - 0.5;
                const double v = row - 1 + (i / sampling.columns + 0.5) / sampling.rows - 0.5;
                const PixelPlace place = tile.at(u, v);
                if (!place.there()) continue;
                const Colour one = pixels.at(place.column + moved.column, place.row + moved.row);
                for (std::size_t k = 0; k < 4; ++k) sum[k] += share * one[k];
            }
        }
    }
}

// Pixels of an image within a tile; false where there are none.
Result<bool> sample(const SharedImage& shared, OpenImage& open, const PostGrid& grid, const ImageTile& tile,
                    std::vector<Colour>& texels) {
    const ImageSource& image = shared.source();
    const TilePlacing placing(grid, tile, open.placing);
    bool any = false;
    const std::optional<PixelPlace> turn = open.placing.turn();
    for (int turns = -1; turns <= 1; ++turns) {
        if (turns != 0 && !turn) continue;
        const PixelPlace moved = turn ? PixelPlace{turns * turn->column, turns * turn->row} : PixelPlace{};
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

// Rows or columns, whichever are more; nothing where that is not known.
double posts_between(const PostGrid& grid, const ImagePlacing::Spot& here, const ImagePlacing::Spot& there) {
    if (grid.net) {
        const PostNumber one = grid.net->post_at(here.lat_deg, here.lon_deg),
                         other = grid.net->post_at(there.lat_deg, there.lon_deg);
        // Far from the grid its rows and columns say nothing.
        const double far = 2.0 * std::max(grid.rows(), grid.columns());
        if (std::max(std::abs(one.row), std::abs(one.column)) > far) return 0.0;
        return std::max(std::abs(other.row - one.row), std::abs(other.column - one.column));
    }
    return std::max(std::abs((there.lat_deg - here.lat_deg) * grid.lat.posts_per_deg),
                    std::abs(std::remainder(there.lon_deg - here.lon_deg, 360.0) * grid.lon.posts_per_deg));
}

// The finest level that shows more of an image than the one above it: a pixel is at least two texels.
// Interpolated twice, edges are then where they are interpolated once.
int finest_level_of(const ImageSource& image, const ImagePlacing& placing, const PostGrid& grid) {
    double least_posts = HUGE_VAL;
    constexpr int places = 8;
    for (int i = 0; i <= places * (places + 2); ++i) {
        const double column = image.columns * static_cast<double>(i % (places + 1)) / places,
                     row = image.rows * static_cast<double>(i / (places + 1)) / places;
        const auto here = placing.spot({column, row});
        for (const PixelPlace& next : {PixelPlace{column + 1.0, row}, PixelPlace{column, row + 1.0}}) {
            const auto there = placing.spot(next);
            if (!here || !there) continue;
            const double posts = posts_between(grid, *here, *there);
            if (posts > 0.0) least_posts = std::min(least_posts, posts);
        }
    }
    return std::isfinite(least_posts) ? static_cast<int>(std::floor(std::log2(least_posts))) : 0;
}

class ImagesOverGround final : public GroundImage {
  public:
    ImagesOverGround(const PostGrid& grid, std::vector<SharedImage> images, int finest, int coarsest)
        : grid_(grid), images_(std::move(images)), finest_(finest), coarsest_(coarsest) {}

    [[nodiscard]] int finest_level() const override { return finest_; }
    [[nodiscard]] int coarsest_level() const override { return coarsest_; }

    Result<bool> load(const ImageTile& tile, std::span<std::uint32_t> texels) const override {
        assert(texels.size() == gpu::drape_words);
        std::vector<Colour> all, one;
        for (const SharedImage& image : images_) {
            ORO_TRY(OpenImage open, image.take());
            ORO_TRY(const bool any, sample(image, open, grid_, tile, one));
            image.give_back(std::move(open));
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
    std::vector<SharedImage> images_;
    int finest_;
    int coarsest_;
};

// Numbers of quads of the finest level must be whole numbers of the GPU.
int least_level(const PostGrid& grid) {
    int level = 0;
    while (level > gpu::drape_finest &&
           (std::int64_t{std::max(grid.rows(), grid.columns())} << (1 - level)) < (std::int64_t{1} << 30))
        --level;
    return level;
}

}  // namespace

Result<std::unique_ptr<GroundImage>> images_over(const PostGrid& grid, std::vector<ImageSource> images,
                                                 std::vector<std::string>& outside) {
    const int coarsest = level_count(grid) - 1;
    int finest = coarsest;
    std::vector<SharedImage> shared;
    for (ImageSource& source : images) {
        SharedImage image(std::move(source));
        ORO_TRY(OpenImage open, image.take());
        const TilePlacing whole(grid, {coarsest, 0, 0}, open.placing);
        bool is_over = false;
        const std::optional<PixelPlace> turn = open.placing.turn();
        for (int turns = -1; turns <= 1; ++turns) {
            Sampling sampling = sampling_of(whole.per_texel());
            const PixelPlace moved =
                turn ? PixelPlace{turns * turn->column, turns * turn->row} : PixelPlace{};
            is_over = is_over || window_of(image.source(), whole, moved, sampling);
        }
        if (!is_over) outside.push_back(image.source().file);
        finest = std::min(finest, finest_level_of(image.source(), open.placing, grid));
        image.give_back(std::move(open));
        shared.push_back(std::move(image));
    }
    finest = std::max(finest, least_level(grid));
    return std::unique_ptr<GroundImage>(
        std::make_unique<ImagesOverGround>(grid, std::move(shared), finest, coarsest));
}

}  // namespace oro
