// Finds the handles of a cache's items by their keys: what each plan asks of every page.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace oro {

// Numbers by key; none may be `none`. Keys lie in one array, so that finding one touches little memory.
template <class Key>
class HandleTable {
  public:
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    // `none` where the key has no number.
    [[nodiscard]] std::uint32_t find(const Key& key) const {
        if (entries_.empty()) return none;
        for (std::size_t at = place_of(key);; at = next(at)) {
            const Entry& entry = entries_[at];
            if (entry.handle == none || entry.key == key) return entry.handle;
        }
    }
    // In place of the one that it has, if any.
    void set(const Key& key, std::uint32_t handle) {
        if (2 * (size_ + 1) > entries_.size()) grow();
        std::size_t at = place_of(key);
        while (entries_[at].handle != none && !(entries_[at].key == key)) at = next(at);
        if (entries_[at].handle == none) ++size_;
        entries_[at] = {key, handle};
    }
    // What lies behind it and could lie before it moves up, so that nothing is hidden by a gap. Source: D. E.
    // Knuth, The Art of Computer Programming, vol. 3, 2nd ed. 1998, section 6.4, algorithm R.
    void erase(const Key& key) {
        if (entries_.empty()) return;
        std::size_t gap = place_of(key);
        while (entries_[gap].handle != none && !(entries_[gap].key == key)) gap = next(gap);
        if (entries_[gap].handle == none) return;
        --size_;
        const std::size_t mask = entries_.size() - 1;
        for (std::size_t at = next(gap); entries_[at].handle != none; at = next(at)) {
            const std::size_t home = place_of(entries_[at].key);
            if (((at - home) & mask) < ((at - gap) & mask)) continue;
            entries_[gap] = entries_[at];
            gap = at;
        }
        entries_[gap].handle = none;
    }

  private:
    struct Entry {
        Key key{};
        std::uint32_t handle{none};
    };
    [[nodiscard]] std::size_t place_of(const Key& key) const {
        const std::uint64_t mixed = static_cast<std::uint64_t>(std::hash<Key>()(key)) * 0x9e3779b97f4a7c15ULL;
        return static_cast<std::size_t>(mixed >> 32U) & (entries_.size() - 1);
    }
    [[nodiscard]] std::size_t next(std::size_t at) const { return (at + 1) & (entries_.size() - 1); }
    void grow() {
        std::vector<Entry> before(std::max<std::size_t>(64, 2 * entries_.size()));
        before.swap(entries_);
        size_ = 0;
        for (const Entry& entry : before)
            if (entry.handle != none) set(entry.key, entry.handle);
    }

    std::vector<Entry> entries_;  // a power of two, at most half of them taken
    std::size_t size_{};
};

}  // namespace oro
