// What a device makes the tables of plans of, and the places of their pages, whatever the eye: in memory that
// the device reads, filled as plans come to need it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/frame/frame_tables.h"
#include "core/frame/region_pages.h"
#include "shaders/plan/shared_plan.h"

namespace oro {

// Of one grid without a net: gpu::RowSource, longitudes and gpu::PageSource for each row, each column and
// each page of pages of all levels. A place is written once, before the plan that needs it is given away,
// and stays as it is; so frames under way may read the others. For one thread at a time.
class PlanSources {
  public:
    // Bytes for all pages of a region.
    [[nodiscard]] static std::uint64_t bytes_of(const RegionPages& pages);
    // The region outlives it. memory: so many bytes, at a multiple of 8, that outlive it; address: where the
    // device finds them.
    PlanSources(const RegionPages& pages, std::span<std::byte> memory, std::uint64_t address);

    // Numbers of a row of pages of a level, a column of pages, and a page, each of its own kind.
    std::uint32_t rows(const LevelAxis& level, int page_row, RowAngles& angles);
    std::uint32_t columns(const LevelAxis& level, int page_column, ColumnAngles& angles);
    // centre_ecef_m: of the sphere around the page's posts.
    std::uint32_t page(const PageSummary& page, const glm::dvec3& centre_ecef_m);
    // All of them, for a device that chooses pages by itself. Errors: as RegionPages::record().
    Result<void> fill(KeptAngles& angles);
    // Whether the longitudes of all columns are within 45 degrees of an eye's: nearer than that a device
    // finds their sines.
    [[nodiscard]] bool is_near(double eye_lon_deg) const;

    [[nodiscard]] std::uint64_t row_address() const { return address_; }
    [[nodiscard]] std::uint64_t column_address() const { return address_ + columns_at_; }
    [[nodiscard]] std::uint64_t page_address() const { return address_ + pages_at_; }

  private:
    template <class Source>
    void write(std::uint64_t at, std::size_t number, std::span<const Source> sources);

    const RegionPages* pages_;
    std::span<std::byte> memory_;
    std::uint64_t address_;
    std::uint64_t columns_at_{}, pages_at_{};
    // Of each level: the numbers of its first row, column and page.
    std::vector<std::uint32_t> first_row_, first_column_, first_page_;
    std::vector<bool> has_row_, has_column_, has_page_;
    double west_deg_, east_deg_;
};

}  // namespace oro
