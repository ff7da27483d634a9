#include "core/frame/plan_sources.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>

#include "core/frame/shared_axes.h"

namespace oro {
namespace {

constexpr std::uint64_t row_bytes = gpu::page_posts * sizeof(gpu::RowSource);
constexpr std::uint64_t column_bytes = gpu::page_posts * sizeof(double);

// Of all levels together: rows of pages, columns of pages, pages.
struct SourceCounts {
    std::uint64_t rows{}, columns{}, pages{};
};
SourceCounts counts_of(const RegionPages& pages) {
    SourceCounts counts;
    for (int level = 0; level < pages.levels(); ++level) {
        const PageLayout layout = pages.layout(level);
        counts.rows += static_cast<std::uint64_t>(layout.rows);
        counts.columns += static_cast<std::uint64_t>(layout.columns);
        counts.pages += layout.count();
    }
    return counts;
}

}  // namespace

std::uint64_t PlanSources::bytes_of(const RegionPages& pages) {
    const SourceCounts counts = counts_of(pages);
    return counts.rows * row_bytes + counts.columns * column_bytes + counts.pages * sizeof(gpu::PageSource);
}

PlanSources::PlanSources(const RegionPages& pages, std::span<std::byte> memory, std::uint64_t address)
    : pages_(&pages), memory_(memory), address_(address) {
    const PostGrid& grid = pages.facts().grid;
    assert(!grid.net && memory.size() >= bytes_of(pages));
    const SourceCounts counts = counts_of(pages);
    columns_at_ = counts.rows * row_bytes;
    pages_at_ = columns_at_ + counts.columns * column_bytes;
    has_row_.resize(counts.rows);
    has_column_.resize(counts.columns);
    has_page_.resize(counts.pages);
    std::uint64_t row = 0, column = 0, page = 0;
    for (int level = 0; level < pages.levels(); ++level) {
        first_row_.push_back(static_cast<std::uint32_t>(row));
        first_column_.push_back(static_cast<std::uint32_t>(column));
        first_page_.push_back(static_cast<std::uint32_t>(page));
        const PageLayout layout = pages.layout(level);
        row += static_cast<std::uint64_t>(layout.rows);
        column += static_cast<std::uint64_t>(layout.columns);
        page += layout.count();
    }
    west_deg_ = grid.lon.at_deg(0);
    // Pages of the coarsest level may have columns as far beyond the last one.
    east_deg_ = grid.lon.at_deg(grid.columns() - 1);
    east_deg_ += std::abs(east_deg_ - west_deg_);
}

Result<void> PlanSources::fill(KeptAngles& angles) {
    for (int level = 0; level < pages_->levels(); ++level) {
        const LevelGrid grid = level_grid(pages_->facts().grid, level);
        const PageLayout layout = pages_->layout(level);
        for (int row = 0; row < layout.rows; ++row) rows(grid.row, row, angles.rows);
        for (int column = 0; column < layout.columns; ++column) columns(grid.column, column, angles.columns);
        for (int row = 0; row < layout.rows; ++row)
            for (int column = 0; column < layout.columns; ++column) {
                ORO_TRY(const PageRecord record, pages_->record({row, column, level}));
                const PageSummary& summary = record.summary;
                page(summary, summary.origin_ecef.m + summary.ecef_from_page * summary.centre_m);
            }
    }
    return {};
}

bool PlanSources::is_near(double eye_lon_deg) const {
    constexpr double within_deg = 44.0;
    const auto is_within = [&](double lon_deg) { return std::abs(lon_deg - eye_lon_deg) < within_deg; };
    return is_within(west_deg_) && is_within(east_deg_);
}

template <class Source>
void PlanSources::write(std::uint64_t at, std::size_t number, std::span<const Source> sources) {
    std::memcpy(&memory_[at + number * sources.size_bytes()], sources.data(), sources.size_bytes());
}

std::uint32_t PlanSources::rows(const LevelAxis& level, int page_row, RowAngles& angles) {
    const std::uint32_t number =
        first_row_[static_cast<std::size_t>(level.level)] + static_cast<std::uint32_t>(page_row);
    if (has_row_[number]) return number;
    has_row_[number] = true;
    const RowAngles::Rows rows = angles.of_pages(level, page_row);
    std::array<gpu::RowSource, gpu::page_posts> sources{};
    for (std::size_t i = 0; i < sources.size(); ++i)
        sources[i] = {rows.sine[i], rows.cosine[i], rows.normal_m[i], rows.polar_m[i]};
    write<gpu::RowSource>(0, number, sources);
    return number;
}

std::uint32_t PlanSources::columns(const LevelAxis& level, int page_column, ColumnAngles& angles) {
    const std::uint32_t number =
        first_column_[static_cast<std::size_t>(level.level)] + static_cast<std::uint32_t>(page_column);
    if (has_column_[number]) return number;
    has_column_[number] = true;
    write(columns_at_, number, angles.of_pages(level, page_column));
    return number;
}

std::uint32_t PlanSources::page(const PageSummary& page, const glm::dvec3& centre_ecef_m) {
    const PageIndex& index = page.index;
    const auto number =
        static_cast<std::uint32_t>(first_page_[static_cast<std::size_t>(index.level)] +
                                   pages_->layout(index.level).number(index.row, index.column));
    if (has_page_[number]) return number;
    has_page_[number] = true;
    gpu::PageSource source{};
    for (int column = 0; column < 3; ++column)
        put_axes(page.ecef_from_page[column], source.ecef_from_page, 3 * static_cast<std::size_t>(column));
    put_axes(page.origin_ecef.m, source.origin_ecef);
    put_axes(centre_ecef_m, source.centre_ecef);
    source.radius_m = page.radius_m;
    put_axes(page.horizon.direction, source.horizon);
    write<gpu::PageSource>(pages_at_, number, std::span(&source, 1));
    return number;
}

}  // namespace oro
