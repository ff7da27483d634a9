#include "core/baked/bake.h"

#include <algorithm>
#include <mutex>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "core/baked/measured_parts.h"
#include "core/baked/page_compression.h"
#include "core/baked/region_file.h"
#include "core/base/parallel.h"
#include "core/lod/pyramid.h"
#include "core/lod/row_deviations.h"
#include "core/terrain/page.h"

namespace oro {
namespace {

// Of a row's posts 1 where there is a height, else 0.
void posts_there(const HeightField& field, int row, std::vector<unsigned char>& there) {
    for (std::size_t column = 0; column < there.size(); ++column)
        there[column] = is_void(field.H_at_post_m(row, static_cast<int>(column))) ? 0 : 1;
}

// Triangles that the field draws.
std::uint64_t triangle_count(const HeightField& field, int threads) {
    constexpr int band_rows = 64;
    const int rows = field.grid.rows() - 1, bands = (rows + band_rows - 1) / band_rows;
    std::vector<std::uint64_t> counts(static_cast<std::size_t>(std::max(bands, 0)));
    in_parallel(bands, threads, [&](int band) {
        std::vector<unsigned char> north(static_cast<std::size_t>(field.grid.columns())), south(north.size());
        const int first = band * band_rows;
        posts_there(field, first, south);
        std::uint64_t count = 0;
        for (int row = first; row < std::min(first + band_rows, rows); ++row) {
            std::swap(north, south);
            posts_there(field, row + 1, south);
            for (std::size_t c = 0; c + 1 < north.size(); ++c)
                count += static_cast<unsigned>((north[c] & south[c + 1]) * (south[c] + north[c + 1]));
        }
        counts[static_cast<std::size_t>(band)] = count;
    });
    return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

RegionOutline outline_of(const HeightField& field, const BakeOptions& options) {
    const HeightRange range = height_range(field);
    return {field.grid,
            field.undulation,
            region_shape(field, 1.0),
            range.lowest_m,
            range.highest_m,
            range.voids,
            triangle_count(field, options.threads),
            options.description};
}

PagePayload payload_of(const HeightField& field, const PyramidPage& page) {
    PagePayload payload;
    payload.H_m = page_elevations(field, page.summary.index).H_m;
    for (std::size_t i = 0; i < page.nodes.size(); ++i) {
        payload.error_m[i] = page.nodes[i].error_m;
        payload.lod_radius_m[i] = page.nodes[i].lod_radius;
    }
    return payload;
}

// A region on its way into a file.
class Bake {
  public:
    Bake(const HeightField& field, RegionFileWriter& writer, const BakeProgress& progress)
        : field_(field),
          writer_(writer),
          progress_(progress),
          found_(writer.pages_done()),
          encoded_(PyramidHooks::pages_at_a_time) {}

    [[nodiscard]] PyramidHooks hooks() {
        PyramidHooks hooks;
        hooks.bounding = MeshletBounding::spheres;  // a file holds no more
        hooks.recall = [this](const PageIndex& index, PyramidHooks::Measured& measured) {
            return recall(index, measured);
        };
        hooks.work = [this](int slot, const PyramidPage& page, const gpu::PageBlock&) {
            if (!is_found(page.summary.index))
                encoded_[static_cast<std::size_t>(slot)] = encode_page(page, payload_of(field_, page));
        };
        hooks.sink = [this](int slot, const PyramidPage& page, const gpu::PageBlock&,
                            const StitchedDeviations& stitched) { return take(slot, page, stitched); };
        return hooks;
    }
    // Of rows that parts have; nothing where there are none.
    [[nodiscard]] KnownDeviations known(const MeasuredParts* parts) {
        if (parts == nullptr) return {};
        return [this, parts](const PageIndex& page, int row, RowDeviations& deviations) {
            const Result<void> read = parts->row(page, row, deviations);
            return read.ok() || keep_fault(read.error());
        };
    }

  private:
    // False, for what asks whether something could be read.
    bool keep_fault(const Error& fault) {
        const std::scoped_lock lock(mutex_);
        if (!fault_) fault_ = fault;
        return false;
    }

    [[nodiscard]] bool is_found(const PageIndex& index) const {
        return writer_.order().number(index) < found_;
    }

    // Pages that the file has already. One that cannot be read any more must not become a part of the
    // finished file: the fault ends the bake, and the same command begins again before it.
    bool recall(const PageIndex& index, PyramidHooks::Measured& measured) {
        if (!is_found(index)) return false;
        const std::uint64_t number = writer_.order().number(index);
        PagePayload payload;
        Result<void> read = writer_.payload(number, payload);
        if (read.ok()) read = writer_.stitched(number, measured.stitched);
        if (!read.ok()) return keep_fault(read.error());
        measured.error_m = payload.error_m;
        measured.lod_radius_m = payload.lod_radius_m;
        return true;
    }

    Result<void> take(int slot, const PyramidPage& page, const StitchedDeviations& stitched) {
        if (fault_) return *fault_;
        std::optional<Result<EncodedPage>>& encoded = encoded_[static_cast<std::size_t>(slot)];
        if (!is_found(page.summary.index)) {
            if (!encoded->ok()) return encoded->error();
            ORO_CHECK(writer_.append(**encoded, stitched));
            encoded.reset();
        }
        const double share = static_cast<double>(writer_.order().number(page.summary.index) + 1) /
                             static_cast<double>(writer_.order().count());
        if (progress_ && !progress_(share))
            return Error{ErrorKind::failed, "bake", "was interrupted; the same command goes on from here"};
        return {};
    }

    const HeightField& field_;
    RegionFileWriter& writer_;
    const BakeProgress& progress_;
    std::uint64_t found_;
    std::vector<std::optional<Result<EncodedPage>>> encoded_;
    std::mutex mutex_;
    std::optional<Error> fault_;  // the first page, or row of a part, that could not be read
};

}  // namespace

Result<BakeReport> bake_region(const HeightField& field, const BakeOptions& options,
                               const BakeProgress& progress) {
    return bake_region(field, outline_of(field, options), options, progress);
}

Result<BakeReport> bake_region(const HeightField& field, const RegionOutline& outline,
                               const BakeOptions& options, const BakeProgress& progress) {
    if (outline.triangles == 0)
        return Error{ErrorKind::no_data, "region", "no triangle has a height at each corner"};
    ORO_TRY(RegionFileWriter writer,
            RegionFileWriter::create(options.path, outline, options.fingerprint, options.overwrite));
    BakeReport report{writer.order().count(), writer.pages_done(), outline.triangles};
    if (report.pages_found < report.pages) {
        const DrawnHeights heights = drawn_heights(field, 1.0, options.threads);
        Bake bake(field, writer, progress);
        const Result<LevelPyramid> built =
            build_pyramid_from(field.grid, outline.shape, heights, options.threads, bake.hooks(), false,
                               bake.known(options.parts));
        if (!built.ok()) return built.error();
    }
    ORO_CHECK(writer.finish());
    return report;
}

}  // namespace oro
