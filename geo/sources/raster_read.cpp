// Stored values to heights in metres: no-data, masks, scale and unit.
#include <cpl_error.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "geo/files/guarded_files.h"
#include "geo/files/raster_library.h"
#include "geo/sources/hgt_source.h"
#include "geo/sources/made_source.h"
#include "geo/sources/raster_source.h"
#include "geo/sources/undeclared_voids.h"
#include "geo/sources/unwritten_parts.h"

namespace oro {
namespace {

// What a band declares as "no height here".
class NoData {
  public:
    explicit NoData(GDALRasterBandH band) {
        int declared = 0;
        const double value = GDALGetRasterNoDataValue(band, &declared);
        if (!declared) return;
        value_ = value;
        // A float band cannot hold every double: -9999.006 is stored, and must be compared, as a float.
        single_ = GDALGetRasterDataType(band) == GDT_Float32;
    }
    [[nodiscard]] bool holds(double value) const {
        if (!std::isfinite(value)) return true;
        if (!value_) return false;
        return single_ ? static_cast<float>(value) == static_cast<float>(*value_) : value == *value_;
    }

  private:
    std::optional<double> value_;
    bool single_{false};
};

// Masks of their own (bands, sidecars, alpha); no-data values are looked at directly.
GDALRasterBandH mask_of(GDALRasterBandH band) {
    const int flags = GDALGetMaskFlags(band);
    const bool own =
        (flags & (GMF_PER_DATASET | GMF_ALPHA)) != 0 && (flags & (GMF_NODATA | GMF_ALL_VALID)) == 0;
    return own ? GDALGetMaskBand(band) : nullptr;
}

// True when a window of values could be read; it is given up when the watch's time is spent.
bool read_values(GDALRasterBandH band, const PostWindow& window, void* to, GDALDataType type,
                 FileWatch& watch) {
    GDALRasterIOExtraArg more;
    INIT_RASTERIO_EXTRA_ARG(more);
    more.pfnProgress = [](double, const char*, void* data) -> int {
        return static_cast<FileWatch*>(data)->spent() ? FALSE : TRUE;
    };
    more.pProgressData = &watch;
    return GDALRasterIOEx(band, GF_Read, window.column, window.row, window.columns, window.rows, to,
                          window.columns, window.rows, type, 0, 0, &more) == CE_None;
}

// Marks the posts of some rows, from `row` on, that lie in one of these parts.
void mark_unwritten(const std::vector<PostWindow>& parts, const PostWindow& rows,
                    std::vector<unsigned char>& unwritten) {
    std::ranges::fill(unwritten, static_cast<unsigned char>(0));
    for (const PostWindow& part : parts) {
        const int first = std::max(part.row, rows.row),
                  end = std::min(part.row + part.rows, rows.row + rows.rows);
        for (int row = first; row < end; ++row) {
            auto* const from = unwritten.data() + static_cast<std::ptrdiff_t>(row - rows.row) * rows.columns +
                               (part.column - rows.column);
            std::fill_n(from, part.columns, static_cast<unsigned char>(1));
        }
    }
}

// Values as GDAL gives them, and what makes them none.
struct StoredStrip {
    std::vector<double> values;
    std::vector<unsigned char> valid;      // by a mask; empty where there is none
    std::vector<unsigned char> unwritten;  // empty where all is written
};

void add_post(const Source& source, const NoData& no_data, const StoredStrip& strip, std::size_t i,
              PostBlock& block) {
    double value = strip.values[i];
    if (source.signed_bytes && value > 127.0) value -= 256.0;
    const bool unwritten = !strip.unwritten.empty() && strip.unwritten[i] != 0;
    const bool empty = unwritten || no_data.holds(value) || (!strip.valid.empty() && strip.valid[i] == 0);
    const double height_m = value * source.scale_m + source.offset_m;
    const bool implausible = !empty && !(height_m >= lowest_plausible_m && height_m <= highest_plausible_m);
    if (!empty) {
        block.lowest_stored_m = std::min(block.lowest_stored_m, height_m);
        block.highest_stored_m = std::max(block.highest_stored_m, height_m);
    }
    block.voids += empty || implausible;
    block.values.unwritten += unwritten;
    if (implausible) count_implausible(block, value);
    block.height_m.push_back(empty || implausible ? void_height_m : static_cast<float>(height_m));
}

Result<PostBlock> read_stored(const Source& source, const PostWindow& window) {
    switch (source.kind) {
        case SourceKind::hgt:
            return read_hgt(source, window);
        case SourceKind::made:
            return read_made(source, window);
        case SourceKind::raster:
            break;
    }
    return read_raster(source, window);
}

}  // namespace

Result<PostBlock> read_raster(const Source& source, const PostWindow& window) {
    const GdalMessages messages;
    FileWatch watch(reading_limit_s + 1e-6 * window.rows * static_cast<double>(window.columns));
    const Dataset dataset(GDALOpenEx(source.file.c_str(),
                                     GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR,
                                     trusted_drivers(), nullptr, nullptr));
    const auto fault = [&](const std::string& what) {
        return Error{ErrorKind::failed, source.report.path,
                     watch.fault().empty() ? what + messages.last("the file is damaged") : watch.fault()};
    };
    if (!dataset) return fault("cannot be opened: ");
    const GDALRasterBandH band = GDALGetRasterBand(dataset.get(), source.band);
    if (!band) return fault("has lost its band " + std::to_string(source.band) + ": ");
    const GDALRasterBandH mask = mask_of(band);
    const NoData no_data(band);
    const std::vector<PostWindow> unwritten = unwritten_parts(dataset.get(), source.band, window);
    const auto columns = static_cast<std::size_t>(window.columns);
    // Whole rows of the file's own blocks at a time, so that each block is unpacked once.
    int block_columns = 0;
    int block_rows = 0;
    GDALGetBlockSize(band, &block_columns, &block_rows);
    const int step = std::clamp(block_rows, 1, 1024);
    StoredStrip strip;
    strip.values.resize(columns * static_cast<std::size_t>(step));
    if (mask) strip.valid.resize(strip.values.size());
    if (!unwritten.empty()) strip.unwritten.resize(strip.values.size());
    PostBlock block;
    block.window = window;
    block.height_m.reserve(columns * static_cast<std::size_t>(window.rows));
    for (int r = 0; r < window.rows; r += step) {
        const int rows = std::min(step, window.rows - r);
        const int row = window.row + r;
        const PostWindow part{row, window.column, rows, window.columns};
        if (!read_values(band, part, strip.values.data(), GDT_Float64, watch))
            return fault("cannot be read near row " + std::to_string(row) + ": ");
        if (mask && !read_values(mask, part, strip.valid.data(), GDT_Byte, watch))
            return fault("its mask cannot be read near row " + std::to_string(row) + ": ");
        // Some drivers go on after a failure.
        if (!watch.fault().empty() || !messages.last("").empty())
            return fault("cannot be read near row " + std::to_string(row) + ": ");
        if (!unwritten.empty()) mark_unwritten(unwritten, part, strip.unwritten);
        for (std::size_t i = 0; i < columns * static_cast<std::size_t>(rows); ++i)
            add_post(source, no_data, strip, i, block);
    }
    return block;
}

Result<PostBlock> read_posts(const Source& source, const PostWindow& window) {
    ORO_TRY(PostBlock block, read_stored(source, window));
    // What is made has no voids that could be undeclared.
    if (source.kind != SourceKind::made) ORO_CHECK(take_out_undeclared(source, block, read_stored));
    measure_steepness(source, block);
    block.values.read = block.height_m.size();
    block.values.lowest_stored_m = block.lowest_stored_m;
    block.values.highest_stored_m = block.highest_stored_m;
    return block;
}

}  // namespace oro
