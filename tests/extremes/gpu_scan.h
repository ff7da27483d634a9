// Looks through every number that is sent to the GPU for those that are none.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "core/frame/frame_plan.h"
#include "core/frame/region_pages.h"

namespace oro::test {

struct GpuScan {
    std::uint64_t floats{};      // looked at
    std::uint64_t not_finite{};  // NaN or infinite
};
// All that this program has scanned so far.
GpuScan scanned();

void scan(std::span<const float> values);
// Page blocks are scanned when they are loaded (ScannedPages), frames when they are planned, styles and the
// undulation's table when they are set.
void scan(const gpu::PageBlock& block);
void scan(const FramePlan& plan);
void scan(const gpu::FrameStyle& style);

// Pages that are scanned on their way to the GPU.
class ScannedPages : public RegionPages {
  public:
    explicit ScannedPages(std::unique_ptr<RegionPages> pages);
    [[nodiscard]] Result<PageRecord> record(const PageIndex& page) const override {
        return pages_->record(page);
    }
    Result<void> load(const PageIndex& page, gpu::PageBlock& block) const override;

  private:
    std::unique_ptr<RegionPages> pages_;
};

}  // namespace oro::test
