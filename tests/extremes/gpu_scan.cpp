#include "tests/extremes/gpu_scan.h"

#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <utility>
#include <vector>

namespace oro::test {
namespace {

// Pages are loaded by several threads.
std::atomic<std::uint64_t> floats{0}, not_finite{0};

// The floats from one place of a struct to another.
template <class Struct>
void scan_part(const Struct& value, std::size_t from, std::size_t to) {
    std::vector<float> part((to - from) / sizeof(float));
    std::memcpy(part.data(), reinterpret_cast<const std::byte*>(&value) + from, to - from);
    scan(part);
}

template <class Struct>
void scan_all(std::span<const Struct> values) {
    std::vector<float> all(values.size_bytes() / sizeof(float));
    if (!all.empty()) std::memcpy(all.data(), values.data(), values.size_bytes());
    scan(all);
}

static_assert(sizeof(gpu::MeshletBounds) == 10 * sizeof(float));
static_assert(sizeof(gpu::RowTerms) == 7 * sizeof(float));
static_assert(sizeof(gpu::ColumnTerms) == 2 * sizeof(float));
// All that comes before the first whole number.
static_assert(offsetof(gpu::FramePage, block) == 35 * sizeof(float));

}  // namespace

GpuScan scanned() {
    return {floats, not_finite};
}

void scan(std::span<const float> values) {
    std::uint64_t wrong = 0;
    for (const float value : values) wrong += std::isfinite(value) ? 0U : 1U;
    floats += values.size();
    not_finite += wrong;
}

void scan(const gpu::PageBlock& block) {
    scan_part(block, 0, offsetof(gpu::PageBlock, boxes));  // what comes after are bits and whole numbers
}

void scan(const FramePlan& plan) {
    for (const gpu::FramePage& page : plan.grids[0].pages)
        scan_part(page, 0, offsetof(gpu::FramePage, block));
    scan_all(std::span<const gpu::RowTerms>(plan.grids[0].row_terms));
    scan_all(std::span<const gpu::ColumnTerms>(plan.grids[0].column_terms));
    using Constants = gpu::FrameConstants;
    const Constants& frame = plan.grids[0].constants;
    scan_part(frame, 0, offsetof(Constants, reference_steps));
    scan_part(frame, offsetof(Constants, projection_scale), offsetof(Constants, placing));
    scan_part(frame, offsetof(Constants, view_from_ecef), offsetof(Constants, height_bits));
    scan_part(frame, offsetof(Constants, up_view), offsetof(Constants, width_px));
    scan_part(frame, offsetof(Constants, pixels_per_tangent), offsetof(Constants, last_row));
    scan_part(frame.undulation, offsetof(gpu::UndulationTable, first), sizeof(gpu::UndulationTable));
}

void scan(const gpu::FrameStyle& style) {
    scan_part(style, 0, offsetof(gpu::FrameStyle, tint_count));
    scan_part(style, offsetof(gpu::FrameStyle, sun_enu), sizeof(gpu::FrameStyle));
}

ScannedPages::ScannedPages(std::unique_ptr<RegionPages> pages)
    : RegionPages(pages->facts()), pages_(std::move(pages)) {
    scan(facts().undulation.N_m);
}

Result<void> ScannedPages::load(const PageIndex& page, gpu::PageBlock& block) const {
    ORO_CHECK(pages_->load(page, block));
    scan(block);
    return {};
}

}  // namespace oro::test
