#include "core/frame/plan_memory.h"

#include <utility>

namespace oro {
namespace {

constexpr std::size_t records_most = 16384;  // 12 MB

}  // namespace

void PlanMemory::begin_frame() {
    if (size_ < records_most) return;
    levels_.clear();
    size_ = 0;
}

Result<const PageRecord*> PlanMemory::record(const PageIndex& page) {
    const auto number = static_cast<std::size_t>(page.level);
    if (levels_.size() <= number) levels_.resize(number + 1);
    Level& level = levels_[number];
    if (const std::uint32_t known = level.numbers.find(page.row, page.column); known != PageTable::none)
        return static_cast<const PageRecord*>(level.records[known].get());
    ORO_TRY(PageRecord record, pages_->record(page));
    level.records.push_back(std::make_unique<PageRecord>(std::move(record)));
    level.numbers.insert(page.row, page.column, static_cast<std::uint32_t>(level.records.size() - 1));
    ++size_;
    return static_cast<const PageRecord*>(level.records.back().get());
}

}  // namespace oro
