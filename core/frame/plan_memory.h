// What the plans of one grid keep from frame to frame, so that it is not made anew for each.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/frame/cast_cells.h"
#include "core/frame/frame_plan.h"
#include "core/frame/frame_tables.h"
#include "core/frame/plan_sources.h"
#include "core/frame/region_pages.h"
#include "core/terrain/page_table.h"

namespace oro {

// A page that frames have asked for, and what of it is the same for every eye.
// What is asked of most pages comes first: it lies in two lines of a processor's cache.
struct alignas(64) KeptPage {
    // What the last choice that wanted it has made of it.
    struct Wanted {
        std::uint64_t turn{};  // number of that choice
        double distance_m{};
        std::uint64_t address{};  // 0: not on the GPU
        std::uint32_t fallback_quarters{};
        std::uint32_t number{gpu::no_page};  // in the frame
        bool open{};                         // takes part in the frame
        bool shows{};                        // or may, or is needed by one that may
    };
    Wanted wanted;
    // The last choices of casters that asked for it, that listed it, and that found it missing.
    std::uint64_t asked_by{}, listed_by{}, lacked_by{};
    PageIndex place;  // of record, and so is reach_m
    double reach_m{-1.0};
    // Pages of the next finer level, where they were asked for: north-west, north-east, south-west,
    // south-east. Which of them there are is a bit each.
    std::array<KeptPage*, 4> children{};
    std::uint32_t has_child{};
    bool has_record{true};  // false: it is missing, and of it its place alone is known
    // The page of the level above that this one lies in, and those that hold what lies beyond its rims:
    // north, east, south, west; null: nobody has found them. Which of these there may be is a bit each.
    KeptPage* parent{};
    std::array<KeptPage*, 4> beside{};
    std::uint32_t has_beside{};
    PageRecord record;
    // Middles of the spheres of record, ECEF: of summary.centre_m, and of each quarter.
    glm::dvec3 centre_ecef_m;
    std::array<glm::dvec3, 4> quarter_ecef_m;
    // Those around it on its own level, row by row; null: nobody has found them, or there are none.
    std::array<KeptPage*, 8> around{};
    [[nodiscard]] const PageIndex& index() const { return place; }
};

// Records, angles of rows and columns, and cells of casters are the same for every frame. For one thread at a
// time.
class PlanMemory {
  public:
    // The pages outlive it.
    explicit PlanMemory(const RegionPages& pages);

    // What pages were pointed to may be gone from here on. The number of the choice that begins, from 1 on.
    std::uint64_t begin_frame();
    // Whether plans wait for records that take long (RegionPages::knows_record()), as they do at first. Where
    // they do not, a page without one is missing, and so is all below it.
    void wait_for_records(bool on) { waits_ = on; }
    // Of the choice that began last.
    [[nodiscard]] std::uint64_t turn() const { return turn_; }
    // The number of the choice of casters that begins, from 1 on.
    std::uint64_t begin_casters() { return ++cast_turn_; }
    // A page, good until the next frame begins. Errors: as RegionPages::record().
    Result<KeptPage*> page(const PageIndex& index);
    // One of those that page() has given, or null.
    [[nodiscard]] KeptPage* find(const PageIndex& index);
    // Of a page the one above it, and those beside that: as KeptPage has them, found anew where that is not
    // known. Null: nobody has asked for it.
    [[nodiscard]] KeptPage* parent(KeptPage& page) {
        return page.parent != nullptr ? page.parent : find_parent(page);
    }
    [[nodiscard]] KeptPage* beside(KeptPage& page, std::size_t side) {
        return page.beside[side] != nullptr ? page.beside[side] : find_beside(page, side);
    }
    // Of a page's level the one so many rows below it and columns to the right, each -1 to 1; it is one of
    // the layout. Errors: as page().
    Result<KeptPage*> around(KeptPage& page, int down, int right) {
        const int place = 3 * (down + 1) + right + 1;
        if (place == 4) return &page;
        KeptPage*& known = page.around[static_cast<std::size_t>(place < 4 ? place : place - 1)];
        if (known != nullptr && known->has_record) return known;
        const PageIndex& index = page.index();
        ORO_TRY(known, this->page({index.row + down, index.column + right, index.level}));
        return known;
    }
    // One of the finer pages of a page that has it. Errors: as RegionPages::record().
    Result<KeptPage*> child(KeptPage& page, std::size_t quarter) {
        KeptPage* const known = page.children[quarter];
        if (known != nullptr && known->has_record) return known;
        return find_child(page, quarter);
    }

    // The pages of the last plan, in its order.
    std::vector<KeptPage*> planned;
    // Of each level, those that a choice wants: for it alone, which finds them empty.
    std::vector<std::vector<KeptPage*>> wanted;
    // A page of a plan by its number there; quick for the last plan. Errors: as page().
    Result<KeptPage*> page_of(const GridPlan& plan, std::size_t number);

    // From the next plan on, what a device can make by itself is left to it, of these sources (DevicePlan).
    // It does so on WGS84, where light goes straight and the eye is near (PlanSources::is_near()).
    void set_sources(PlanSources sources) { sources_.emplace(std::move(sources)); }
    // Null: there are none.
    [[nodiscard]] PlanSources* sources() { return sources_ ? &*sources_ : nullptr; }

    [[nodiscard]] KeptAngles& angles() { return angles_; }
    [[nodiscard]] CastCells& cast_cells(int level) {
        if (!cast_cells_ || cast_cells_->level() != level) cast_cells_.emplace(*pages_, level);
        return *cast_cells_;
    }
    // Those of the level that was asked for last.
    [[nodiscard]] CastCells& kept_cast_cells() { return *cast_cells_; }
    [[nodiscard]] const RegionPages& pages() const { return *pages_; }
    [[nodiscard]] const PageLayout& layout(int level) const {
        return layouts_[static_cast<std::size_t>(level)];
    }

  private:
    struct Level {
        PageTable numbers;
        std::vector<std::unique_ptr<KeptPage>> pages;
    };
    void link(KeptPage& page) const;
    void find_ways(KeptPage& page) const;
    [[nodiscard]] bool can_have_record(const PageIndex& index) const {
        return waits_ || pages_->knows_record(index);
    }
    KeptPage* find_parent(KeptPage& page);
    KeptPage* find_beside(KeptPage& page, std::size_t side);
    Result<KeptPage*> find_child(KeptPage& page, std::size_t quarter);

    const RegionPages* pages_;
    bool waits_{true};
    KeptAngles angles_;
    std::optional<CastCells> cast_cells_;
    std::optional<PlanSources> sources_;
    std::vector<PageLayout> layouts_;  // of each level
    std::vector<Level> levels_;
    std::size_t size_{};
    std::uint64_t turn_{}, cast_turn_{};
};

// The plans of core/frame/frame_plan.h and core/frame/casters.h, to the bit, in less time: of the pages of a
// memory that is kept from frame to frame. Casters are those of the memory's last plan.
Result<GridPlan> plan_grid(PlanMemory& memory, const Residency& residency, const FrameView& view,
                           const HeightQuantization& coding = {},
                           double shading_spacing_px = gpu::shading_spacing_px,
                           const IsHidden& is_hidden = {});
// What a plan is beside its pages, for a device that chooses them: nothing where the memory's sources do not
// serve the view (PlanMemory::set_sources()).
std::optional<GridPlan> plan_without_pages(PlanMemory& memory, const FrameView& view,
                                           const HeightQuantization& coding);
Result<std::vector<ShadowReceiver>> shadow_receivers(PlanMemory& memory, const FrameView& view,
                                                     const GridPlan& plan);
Result<void> plan_casters(PlanMemory& memory, const std::function<std::uint64_t(const PageIndex&)>& residency,
                          const FrameView& view, const ShadowRequest& request, double top_m, GridPlan& plan,
                          std::span<const ShadowReceiver> others = {});

}  // namespace oro
