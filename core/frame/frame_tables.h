// What places a frame's posts: tables of its rows and columns relative to the eye, and the constants of the
// frame.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/earth/camera.h"
#include "core/earth/world_model.h"
#include "core/frame/column_angles.h"
#include "core/frame/height_quantization.h"
#include "core/frame/region_pages.h"
#include "core/frame/row_angles.h"
#include "shaders/plan/shared_plan.h"
#include "shaders/shared.h"

namespace oro {

class PlanSources;

// What tables of a grid keep from frame to frame.
struct KeptAngles {
    // The grid outlives it.
    explicit KeptAngles(const PostGrid& grid) : rows(grid), columns(grid) {}
    RowAngles rows;
    ColumnAngles columns;
    // Of the last frame's tables.
    std::size_t row_count{}, column_count{};
};

// The terms of shaders/shared.h's RowTerms and ColumnTerms for the pages of a frame. Each depends on the
// post's own angle and the eye alone, so that all pages that share a row or a column hold the same bits.
class FrameTables {
  public:
    // The eye's longitude may be in any whole turn; its height anything from the Earth's centre to the Moon.
    // kept: of the same grid, from frame to frame, for the same bits in less time; null: nothing is kept.
    FrameTables(const PostGrid& grid, const Geodetic& eye, Earth earth = Earth::ellipsoid,
                KeptAngles* kept = nullptr);
    FrameTables(const FrameTables&) = delete;
    FrameTables& operator=(const FrameTables&) = delete;

    // What a device makes of this eye's tables is the device's, from here on: place() says where it will be.
    // sources: outlive this. On the ellipsoid; the eye is_near().
    void leave_to(PlanSources& sources) { sources_ = &sources; }
    // Numbers of rows of pages and of columns of pages of those sources, in the order of the tables.
    [[nodiscard]] std::span<const gpu::uint> row_sources() const { return row_sources_; }
    [[nodiscard]] std::span<const gpu::uint> column_sources() const { return column_sources_; }
    // Tells it of the eye.
    void set_eye(gpu::PlanTerms& terms) const;

    // Makes sure that a page's rows and columns are there, and tells the page where, and where it lies.
    void place(const PageIndex& index, gpu::FramePage& page);

    // Rows or columns of posts from the first to the last, both included.
    struct Span {
        std::int32_t first, last;
    };
    // Room for all rows and columns of the region's posts, in their order: after those that are there
    // already. Those in any of the spans are there, the others are nowhere: reckoning takes longest.
    void place_spans(std::span<const Span> rows, std::span<const Span> columns);

    std::vector<gpu::RowTerms> take_rows() {
        kept_->row_count = rows_.size();
        return std::move(rows_);
    }
    std::vector<gpu::ColumnTerms> take_columns() {
        kept_->column_count = columns_.size();
        return std::move(columns_);
    }

  private:
    void place_for_device(const LevelGrid& level, const PageIndex& index, std::uint32_t& row,
                          std::uint32_t& column);
    void add_row(std::int64_t row);
    void add_rows(const RowAngles::Rows& rows, std::size_t count);
    void add_page_rows(const LevelAxis& level, int page_row);
    void add_columns(std::span<const double> lon_deg);
    [[nodiscard]] bool is_on_ellipsoid() const { return earth_ == Earth::ellipsoid && !grid_.net; }
    [[nodiscard]] gpu::RowTerms round_row(const RowAngles::Row& row) const;
    [[nodiscard]] gpu::RowTerms flat_row(double lat_deg) const;

    const PostGrid& grid_;
    Geodetic eye_;
    Earth earth_;
    double reference_m_;
    double rho_m_;
    double z_m_;
    std::vector<gpu::RowTerms> rows_;
    std::vector<gpu::ColumnTerms> columns_;
    // By level, then by row or column of pages; nowhere: they are not there.
    using FirstOfPages = std::vector<std::vector<std::uint32_t>>;
    static constexpr std::uint32_t nowhere = ~std::uint32_t{0};
    // Of one of `count` of a level, where its posts begin in rows_ or columns_.
    static std::uint32_t& first_of(FirstOfPages& all, int level, int number, int count);
    FirstOfPages first_rows_, first_columns_;
    std::optional<KeptAngles> own_angles_;
    KeptAngles* kept_;
    std::vector<double> east_deg_;  // of columns that are being added
    PlanSources* sources_{};
    std::vector<gpu::uint> row_sources_, column_sources_;
};

// The whole metres that a frame's heights are relative to: the eye's own, but no farther from the ellipsoid
// than 524,000 m.
double reference_height_m(const Geodetic& eye);

// The flat Earth is cut along the meridian opposite to the eye: the number of the last column of posts before
// it that has the next one beyond, at the other end of the plane; gpu::no_column when the region has none,
// and on a round Earth. No triangle may lie across.
gpu::uint cut_column(const PostGrid& grid, const Geodetic& eye, Earth earth);

// All of a frame's constants that do not depend on buffers and style. coding: of the heights on the GPU.
gpu::FrameConstants frame_constants(const RegionPages& pages, const Camera& camera, const Tile& tile,
                                    double tau_px, const WorldModel& model = {},
                                    const HeightQuantization& coding = {});

}  // namespace oro
