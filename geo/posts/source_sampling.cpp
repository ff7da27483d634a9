#include "geo/posts/source_sampling.h"

#include <gdal_alg.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geo/files/raster_library.h"

namespace oro {
namespace {

// Posts of two grids closer than this share of a spacing are the same post (a centimetre at 90 m: 1e-4).
constexpr double same_post = 0.01;
// GDAL's shortcut through PROJ may err by this share of a post.
constexpr double mapping_error_posts = 0.002;
// Long rows are mapped in pieces, so that no shortcut spans a cut of the projection.
constexpr std::size_t piece = 64;

// Every how many grid posts, and from which, an axis of a source has a post; false when they lie elsewhere.
bool nested(const SourceAxis& axis, const GridAxis& grid, double turn_deg, std::int64_t& part,
            std::int64_t& shift, double& moved) {
    const double parts = grid.posts_per_deg / axis.posts_per_deg;
    part = std::max<std::int64_t>(1, std::llround(parts));
    const double first = grid.index_at(axis.start_deg + turn_deg);
    const double last = grid.index_at(axis.at_deg(axis.count - 1) + turn_deg);
    shift = std::llround(first);
    const double should = static_cast<double>(shift + part * (axis.count - 1) * (axis.direction * grid.step));
    const double off = std::max(std::abs(first - static_cast<double>(shift)), std::abs(last - should));
    moved = std::max(moved, off);
    return off <= same_post;
}

}  // namespace

// WGS84 degrees to (fractional) post numbers of a source.
struct SourceOnGrid::Mapping {
    const Source* source{};
    CoordinateTransformation transformation;  // none for sources on degrees
    std::array<double, 6> post_from_crs{};
    double middle_x{};
    bool geographic{};
    void* shortcut{};

    Mapping() = default;
    Mapping(const Mapping&) = delete;
    Mapping& operator=(const Mapping&) = delete;
    ~Mapping() {
        if (shortcut) GDALDestroyApproxTransformer(shortcut);
    }

    static int exact(void* self, int, int count, double* x, double* y, double*, int* done) {
        const auto& m = *static_cast<Mapping*>(self);
        OCTTransformEx(m.transformation.get(), count, x, y, nullptr, done);
        for (int i = 0; i < count; ++i) {
            if (!done[i] || !std::isfinite(x[i]) || !std::isfinite(y[i])) {
                x[i] = y[i] = HUGE_VAL;
                done[i] = 0;
                continue;
            }
            if (m.geographic) x[i] = m.middle_x + std::remainder(x[i] - m.middle_x, 360.0);
            const auto& p = m.post_from_crs;
            const double column = p[0] + p[1] * x[i] + p[2] * y[i];
            y[i] = p[3] + p[4] * x[i] + p[5] * y[i];
            x[i] = column;
        }
        return 1;
    }

    // In: degrees; out: columns and rows, NaN where there is no answer.
    void run(std::span<double> x, std::span<double> y) {
        std::array<int, piece> done{};
        for (std::size_t first = 0; first < x.size(); first += piece) {
            const std::size_t count = std::min(piece, x.size() - first);
            if (transformation) {
                std::array<double, piece> z{};
                GDALApproxTransform(shortcut, 0, static_cast<int>(count), x.data() + first, y.data() + first,
                                    z.data(), done.data());
            }
            for (std::size_t i = first; i < first + count; ++i) {
                if (!transformation) {
                    x[i] = source->lon_axis.index_at(x[i]);
                    y[i] = source->lat_axis.index_at(y[i]);
                } else if (!done[i - first] || !std::isfinite(x[i]) || !std::isfinite(y[i])) {
                    x[i] = y[i] = std::numeric_limits<double>::quiet_NaN();
                }
            }
        }
    }
};

SourceOnGrid::SourceOnGrid() = default;
SourceOnGrid::SourceOnGrid(SourceOnGrid&&) noexcept = default;
SourceOnGrid& SourceOnGrid::operator=(SourceOnGrid&&) noexcept = default;
SourceOnGrid::~SourceOnGrid() = default;

Result<SourceOnGrid> SourceOnGrid::create(const Source& source, const PostGrid& grid, int turn) {
    SourceOnGrid placed;
    placed.source_ = &source;
    placed.grid_ = grid;
    placed.turn_ = turn;
    if (source.on_degrees) placed.fit_to_degrees();
    placed.mapping_ = std::make_unique<Mapping>();
    Mapping& mapping = *placed.mapping_;
    mapping.source = &source;
    if (!source.on_degrees) {
        const GdalMessages messages;
        const SpatialReference crs = spatial_reference(source.crs_wkt);
        mapping.transformation.reset(OCTNewCoordinateTransformation(wgs84_degrees().get(), crs.get()));
        std::array<double, 6> forward = source.crs_from_post;
        if (!mapping.transformation || !GDALInvGeoTransform(forward.data(), mapping.post_from_crs.data()))
            return Error{ErrorKind::failed, source.report.path,
                         "cannot be placed on the Earth: " + messages.last("its georeference is singular")};
        mapping.geographic = OSRIsGeographic(crs.get()) != 0;
        mapping.middle_x =
            forward[0] + 0.5 * forward[1] * source.report.columns + 0.5 * forward[2] * source.report.rows;
        mapping.shortcut = GDALCreateApproxTransformer(&Mapping::exact, &mapping, mapping_error_posts);
    }
    placed.find_rect();
    return placed;
}

void SourceOnGrid::fit_to_degrees() {
    const bool lat = nested(source_->lat_axis, grid_.lat, 0.0, lat_part_, row_shift_, moved_by_);
    const bool lon = nested(source_->lon_axis, grid_.lon, 360.0 * turn_, lon_part_, column_shift_, moved_by_);
    if (lat && lon) fit_ = lat_part_ == 1 && lon_part_ == 1 ? Fit::same_posts : Fit::every_kth_post;
}

void SourceOnGrid::find_rect() {
    // Half a cell more for sources whose cells reach beyond their posts.
    const double lat_margin = fit_ == Fit::elsewhere ? 0.5 * source_->lat_spacing_deg : 0.0;
    const double lon_margin = fit_ == Fit::elsewhere ? 0.5 * source_->lon_spacing_deg : 0.0;
    const auto between = [](double low, double high, int count) {
        const double first = std::max(0.0, std::ceil(low - same_post));
        const double last = std::min<double>(count - 1, std::floor(high + same_post));
        return std::pair{static_cast<int>(first), static_cast<int>(std::max(0.0, last - first + 1.0))};
    };
    std::tie(rect_.first_row, rect_.rows) =
        between(grid_.lat.index_at(source_->north_deg + lat_margin),
                grid_.lat.index_at(source_->south_deg - lat_margin), grid_.rows());
    rect_.first_column = 0;
    rect_.columns = grid_.columns();
    const bool anywhere = source_->full_circle && fit_ != Fit::same_posts;
    if (anywhere) return;
    const double turn_deg = 360.0 * turn_;
    double west = source_->lon.west_deg + turn_deg;
    double east = source_->lon.east_deg + turn_deg;
    if (fit_ == Fit::same_posts) east = source_->lon_axis.at_deg(source_->lon_axis.count - 1) + turn_deg;
    std::tie(rect_.first_column, rect_.columns) = between(
        grid_.lon.index_at(west - lon_margin), grid_.lon.index_at(east + lon_margin), grid_.columns());
}

PostWindow SourceOnGrid::window_for(int first_row, int rows) {
    constexpr int intervals = 48;
    double low_row = 1e18, high_row = -1e18, low_column = 1e18, high_column = -1e18;
    for (int j = 0; j <= intervals; ++j) {
        std::vector<double> x, y;
        for (int i = 0; i <= intervals; ++i) {
            const int column =
                rect_.first_column + static_cast<int>(std::int64_t{rect_.columns - 1} * i / intervals);
            x.push_back(grid_.lon.at_deg(column) - 360.0 * turn_);
            y.push_back(
                grid_.lat.at_deg(first_row + static_cast<int>(std::int64_t{rows - 1} * j / intervals)));
        }
        mapping_->run(x, y);
        for (std::size_t i = 0; i < x.size(); ++i) {
            if (std::isnan(x[i])) continue;
            low_column = std::min(low_column, x[i]);
            high_column = std::max(high_column, x[i]);
            low_row = std::min(low_row, y[i]);
            high_row = std::max(high_row, y[i]);
        }
    }
    const int all_rows = source_->on_degrees ? source_->lat_axis.count : source_->report.rows;
    const int all_columns = source_->on_degrees ? source_->lon_axis.count : source_->report.columns;
    // Room for the stencil, and for the curve of rows and columns between the samples.
    const double row_margin = 3.0 + (fit_ == Fit::elsewhere ? 0.05 * (high_row - low_row) : 0.0);
    const double column_margin = 3.0 + (fit_ == Fit::elsewhere ? 0.05 * (high_column - low_column) : 0.0);
    const auto clipped = [](double low, double high, int count) {
        const double first = std::clamp(std::floor(low), 0.0, static_cast<double>(count));
        const double last = std::clamp(std::ceil(high), -1.0, static_cast<double>(count - 1));
        return std::pair{static_cast<int>(first), static_cast<int>(std::max(0.0, last - first + 1.0))};
    };
    PostWindow window;
    if (low_row > high_row) return window;
    std::tie(window.row, window.rows) = clipped(low_row - row_margin, high_row + row_margin, all_rows);
    std::tie(window.column, window.columns) =
        clipped(low_column - column_margin, high_column + column_margin, all_columns);
    if (source_->full_circle && source_->on_degrees) {
        window.column = 0;
        window.columns = all_columns;
    }
    return window;
}

Result<void> SourceOnGrid::read(int first_row, int rows) {
    PostWindow window;
    if (fit_ == Fit::same_posts) {
        // Exactly the posts that are copied, so that what is counted in them is what the region gets.
        const int direction = source_->lat_axis.direction * grid_.lat.step;
        const auto at = [&](int row) { return static_cast<int>((row - row_shift_) * direction); };
        window.row = std::max(0, std::min(at(first_row), at(first_row + rows - 1)));
        window.rows = std::min(source_->lat_axis.count - window.row, rows);
        window.column = static_cast<int>(std::max<std::int64_t>(0, rect_.first_column - column_shift_));
        window.columns = std::min(source_->lon_axis.count - window.column, rect_.columns);
    } else {
        const GdalMessages messages;
        window = window_for(first_row, rows);
    }
    block_ = PostBlock{};
    block_.window = window;
    if (window.rows <= 0 || window.columns <= 0) {
        block_.window.rows = block_.window.columns = 0;
        return {};
    }
    ORO_TRY(block_, read_posts(*source_, window));
    return {};
}

void SourceOnGrid::row(int row, std::span<float> heights, std::span<float> beyond,
                       std::span<unsigned char> inside) {
    std::ranges::fill(heights, void_height_m);
    std::ranges::fill(beyond, void_height_m);
    std::ranges::fill(inside, static_cast<unsigned char>(0));
    if (block_.window.rows == 0) return;
    if (fit_ == Fit::same_posts) copy_row(row, heights, inside);
    if (fit_ == Fit::every_kth_post) interpolate_row(row, heights, inside);
    if (fit_ == Fit::elsewhere) resample_row(row, heights, beyond, inside);
}

void SourceOnGrid::copy_row(int row, std::span<float> heights, std::span<unsigned char> inside) const {
    const auto source_row =
        static_cast<int>((row - row_shift_) * source_->lat_axis.direction * grid_.lat.step);
    if (source_row < 0 || source_row >= source_->lat_axis.count) return;
    // Those columns of the stretch that the source has.
    const std::int64_t first = rect_.first_column - column_shift_;
    const std::int64_t from = std::max<std::int64_t>(0, -first);
    const std::int64_t to =
        std::min<std::int64_t>(static_cast<std::int64_t>(heights.size()), source_->lon_axis.count - first);
    if (to <= from) return;
    const auto skipped = static_cast<std::size_t>(from), count = static_cast<std::size_t>(to - from);
    const PostWindow& window = block_.window;
    const std::size_t post =
        static_cast<std::size_t>(source_row - window.row) * static_cast<std::size_t>(window.columns) +
        static_cast<std::size_t>(first + from - window.column);
    std::ranges::copy(std::span(block_.height_m).subspan(post, count), heights.subspan(skipped).begin());
    std::ranges::fill(inside.subspan(skipped, count), static_cast<unsigned char>(1));
}

void SourceOnGrid::interpolate_row(int row, std::span<float> heights, std::span<unsigned char> inside) const {
    const bool southwards = source_->lat_axis.direction < 0;
    const std::int64_t below_first = row - row_shift_;  // grid rows south of source row 0
    const auto floor_div = [](std::int64_t a, std::int64_t b) { return a / b - (a % b < 0 ? 1 : 0); };
    // Source rows north and south of the grid row, and how far south of the northern one it lies.
    const std::int64_t cell = floor_div(below_first, lat_part_);
    const double v = static_cast<double>(below_first - cell * lat_part_) / static_cast<double>(lat_part_);
    const auto north = static_cast<int>(southwards ? cell : -cell);
    const auto south = static_cast<int>(southwards ? cell + 1 : -cell - 1);
    for (std::size_t c = 0; c < heights.size(); ++c) {
        const std::int64_t east_of_first = rect_.first_column + static_cast<std::int64_t>(c) - column_shift_;
        const auto west = static_cast<int>(floor_div(east_of_first, lon_part_));
        const double u =
            static_cast<double>(east_of_first - west * lon_part_) / static_cast<double>(lon_part_);
        const auto post = [&](int column, int r) {
            return height_or_void(block_, source_->lon_axis.count, source_->full_circle, column, r);
        };
        inside[c] = 1;
        // The triangle north-east or south-west of the diagonal from north-west to south-east; posts without
        // weight do not count.
        double sum = 0.0;
        bool whole = true;
        const auto add = [&](double weight, int column, int r) {
            if (weight <= 0.0 || !whole) return;
            const float height = post(column, r);
            whole = !is_void(height);
            sum += weight * static_cast<double>(height);
        };
        add(1.0 - std::max(u, v), west, north);
        add(std::min(u, v), west + 1, south);
        if (u >= v) add(u - v, west + 1, north);
        if (v > u) add(v - u, west, south);
        heights[c] = whole ? static_cast<float>(sum) : void_height_m;
    }
}

void SourceOnGrid::resample_row(int row, std::span<float> heights, std::span<float> beyond,
                                std::span<unsigned char> inside) {
    const std::size_t count = heights.size();
    std::vector<double> x(count), y(count, grid_.lat.at_deg(row));
    for (std::size_t c = 0; c < count; ++c)
        x[c] = grid_.lon.at_deg(rect_.first_column + static_cast<std::int64_t>(c)) - 360.0 * turn_;
    {
        const GdalMessages messages;
        mapping_->run(x, y);
    }
    const bool round = source_->full_circle && source_->on_degrees;
    const int rows = source_->on_degrees ? source_->lat_axis.count : source_->report.rows;
    const int columns = source_->on_degrees ? source_->lon_axis.count : source_->report.columns;
    constexpr double slack = 1e-6;
    const double limit_m = 0.5 * source_->report.spacing_m;  // a slope of 45 degrees
    for (std::size_t c = 0; c < count; ++c) {
        if (std::isnan(x[c])) continue;
        const double out_columns = round ? 0.0 : std::max(-x[c], x[c] - (columns - 1));
        const double out = std::max({out_columns, -y[c], y[c] - (rows - 1)});
        if (out > 0.5 + slack) continue;
        inside[c] = 1;
        const float height = cubic_height_m(block_, rows, columns, round, x[c], y[c], limit_m);
        (out > slack ? beyond : heights)[c] = height;
    }
}

}  // namespace oro
