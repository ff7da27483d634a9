// Pages of a region for the choice of nodes on the processor, without a pyramid of it in memory.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "core/base/result.h"
#include "core/frame/region_pages.h"
#include "core/lod/pyramid_pages.h"

namespace oro {

// Each page is loaded when it is first asked for, and kept: 12 KB a page. For one thread at a time.
class LazyPyramid : public PyramidPages {
  public:
    // `pages` outlive them.
    explicit LazyPyramid(const RegionPages& pages);

    [[nodiscard]] const RegionShape& shape() const override { return pages_.facts().shape; }
    [[nodiscard]] bool wraps_longitude() const override { return pages_.wraps_longitude(); }
    [[nodiscard]] int levels() const override { return pages_.levels(); }
    [[nodiscard]] const LevelGrid& grid(int level) const override {
        return grids_[static_cast<std::size_t>(level)];
    }
    // One that cannot be read has nothing to draw, and is told by health().
    [[nodiscard]] const PyramidPage& page(const PageIndex& index) const override;

    // Pages that were asked for.
    [[nodiscard]] std::size_t kept() const { return kept_.size(); }
    // The first error that a page had when it was loaded.
    [[nodiscard]] Result<void> health() const { return fault_ ? Result<void>(*fault_) : Result<void>(); }

  private:
    Result<void> load(const PageIndex& index, PyramidPage& page) const;

    const RegionPages& pages_;
    std::vector<LevelGrid> grids_;
    std::vector<std::uint64_t> first_of_level_;  // pages before a level's
    std::unique_ptr<gpu::PageBlock> block_;
    mutable std::unordered_map<std::uint64_t, std::unique_ptr<PyramidPage>> kept_;  // by number
    mutable std::optional<Error> fault_;
};

}  // namespace oro
