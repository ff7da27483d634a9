#include "core/frame/plan_memory.h"

#include <utility>

namespace oro {
namespace {

constexpr std::size_t records_most = 16384;  // 16 MB

// The number of the page of the level above that holds what lies beyond a page's rim; nothing beyond the
// region.
std::optional<PageIndex> beyond_rim(const PageIndex& page, const PageLayout& layout, bool wraps,
                                    std::size_t side) {
    constexpr std::array<std::pair<int, int>, 4> steps{{{-1, 0}, {0, 1}, {1, 0}, {0, -1}}};
    const int row = page.row + steps[side].first;
    int column = page.column + steps[side].second;
    if (wraps && (column < 0 || column >= layout.columns))
        column = (column + layout.columns) % layout.columns;
    if (row < 0 || row >= layout.rows || column < 0 || column >= layout.columns) return std::nullopt;
    return PageIndex{row / 2, column / 2, page.level + 1};
}

}  // namespace

PlanMemory::PlanMemory(const RegionPages& pages)
    : pages_(&pages), angles_(pages.facts().grid), levels_(static_cast<std::size_t>(pages.levels())) {
    for (int level = 0; level < pages.levels(); ++level) layouts_.push_back(pages.layout(level));
}

std::uint64_t PlanMemory::begin_frame() {
    planned.clear();
    wanted.resize(levels_.size());
    for (std::vector<KeptPage*>& level : wanted) level.clear();
    if (size_ >= records_most) {
        for (Level& level : levels_) level = {};
        size_ = 0;
    }
    return ++turn_;
}

KeptPage* PlanMemory::find(const PageIndex& index) {
    if (index.level >= static_cast<int>(levels_.size())) return nullptr;
    const Level& level = levels_[static_cast<std::size_t>(index.level)];
    const std::uint32_t known = level.numbers.find(index.row, index.column);
    return known == PageTable::none ? nullptr : level.pages[known].get();
}

void PlanMemory::link(KeptPage& page) const {
    const PageSummary& summary = page.record.summary;
    page.place = summary.index;
    page.reach_m = page.record.reach_m;
    const auto ecef_m = [&](const glm::dvec3& in_page_m) {
        return summary.origin_ecef.m + summary.ecef_from_page * in_page_m;
    };
    page.centre_ecef_m = ecef_m(summary.centre_m);
    for (std::size_t i = 0; i < 4; ++i) page.quarter_ecef_m[i] = ecef_m(page.record.quarters[i].centre_m);
    find_ways(page);
}

// Which pages there are below it and beside the one above it.
void PlanMemory::find_ways(KeptPage& page) const {
    const PageIndex& index = page.index();
    for (std::size_t side = 0; side < 4; ++side)
        if (beyond_rim(index, layout(index.level), pages_->wraps_longitude(), side))
            page.has_beside |= 1U << side;
    if (index.level == 0) return;
    const PageLayout& below = layout(index.level - 1);
    for (int i = 0; i < 4; ++i)
        if (2 * index.row + i / 2 < below.rows && 2 * index.column + i % 2 < below.columns)
            page.has_child |= 1U << static_cast<unsigned>(i);
}

Result<KeptPage*> PlanMemory::page(const PageIndex& index) {
    KeptPage* const known = find(index);
    const bool has_record = can_have_record(index);
    if (known != nullptr) {
        if (known->has_record || !has_record) return known;
        ORO_TRY(known->record, pages_->record(index));
        known->has_record = true;
        link(*known);
        return known;
    }
    auto page = std::make_unique<KeptPage>();
    page->has_record = has_record;
    if (has_record) {
        ORO_TRY(page->record, pages_->record(index));
        link(*page);
    } else {
        page->place = index;
        find_ways(*page);
    }
    Level& level = levels_[static_cast<std::size_t>(index.level)];
    level.pages.push_back(std::move(page));
    level.numbers.insert(index.row, index.column, static_cast<std::uint32_t>(level.pages.size() - 1));
    ++size_;
    return level.pages.back().get();
}

Result<KeptPage*> PlanMemory::page_of(const GridPlan& plan, std::size_t number) {
    const PageIndex& index = plan.page_indices[number];
    if (number < planned.size() && planned[number]->index() == index) return planned[number];
    return page(index);
}

KeptPage* PlanMemory::find_parent(KeptPage& page) {
    const PageIndex& index = page.index();
    page.parent = find({index.row / 2, index.column / 2, index.level + 1});
    return page.parent;
}

KeptPage* PlanMemory::find_beside(KeptPage& page, std::size_t side) {
    if ((page.has_beside >> side & 1U) == 0) return nullptr;
    page.beside[side] =
        find(*beyond_rim(page.index(), layout(page.index().level), pages_->wraps_longitude(), side));
    return page.beside[side];
}

Result<KeptPage*> PlanMemory::find_child(KeptPage& page, std::size_t quarter) {
    const PageIndex& index = page.index();
    const int number = static_cast<int>(quarter);
    ORO_TRY(page.children[quarter],
            this->page({2 * index.row + number / 2, 2 * index.column + number % 2, index.level - 1}));
    page.children[quarter]->parent = &page;
    return page.children[quarter];
}

}  // namespace oro
