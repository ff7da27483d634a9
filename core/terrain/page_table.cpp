#include "core/terrain/page_table.h"

#include <utility>

namespace oro {
namespace {

constexpr std::size_t first_entries = 64;

std::uint64_t place_of(int row, int column) {
    return std::uint64_t{static_cast<std::uint32_t>(row)} << 32U | static_cast<std::uint32_t>(column);
}

}  // namespace

void PageTable::clear() {
    size_ = 0;
    if (++turn_ != 0) return;
    entries_.clear();
    turn_ = 1;
}

// D. Knuth, The Art of Computer Programming, volume 3, section 6.4: multiplicative hashing, linear probing.
std::size_t PageTable::first_entry(std::uint64_t place) const {
    const std::uint64_t hash = place * 0x9e3779b97f4a7c15ULL;
    return static_cast<std::size_t>(hash >> 32U) & (entries_.size() - 1);
}

void PageTable::grow() {
    const std::vector<Entry> before =
        std::exchange(entries_, std::vector<Entry>(entries_.empty() ? first_entries : 2 * entries_.size()));
    size_ = 0;
    for (const Entry& entry : before)
        if (entry.turn == turn_)
            insert(static_cast<int>(entry.place >> 32U), static_cast<int>(entry.place & 0xffffffffU),
                   entry.number);
}

void PageTable::insert(int row, int column, std::uint32_t number) {
    if (2 * (size_ + 1) > entries_.size()) grow();
    const std::uint64_t place = place_of(row, column);
    std::size_t at = first_entry(place);
    while (entries_[at].turn == turn_) at = (at + 1) & (entries_.size() - 1);
    entries_[at] = {place, number, turn_};
    ++size_;
}

std::uint32_t PageTable::find(int row, int column) const {
    if (size_ == 0) return none;
    const std::uint64_t place = place_of(row, column);
    for (std::size_t at = first_entry(place); entries_[at].turn == turn_;
         at = (at + 1) & (entries_.size() - 1))
        if (entries_[at].place == place) return entries_[at].number;
    return none;
}

}  // namespace oro
