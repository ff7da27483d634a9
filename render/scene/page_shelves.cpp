#include "render/scene/page_shelves.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

namespace oro {

void PageShelves::add(std::size_t bytes) {
    shelves_.emplace_back();
    shelves_.back().push_back({{}, 0, 0, 0, shelves_.size() - 1, 0, bytes});
}

PageShelves::Slot* PageShelves::find(const Key& page) {
    const auto found = slot_of_.find(page);
    return found == slot_of_.end() ? nullptr : &*found->second;
}

PageShelves::Slot* PageShelves::take(const Key& page, std::size_t bytes) {
    for (Slots& slots : shelves_) {
        const auto free = std::ranges::find_if(
            slots, [&](const Slot& slot) { return slot.used == 0 && slot.bytes >= bytes; });
        if (free != slots.end()) return put(free, page, bytes);
    }
    return nullptr;
}

bool PageShelves::may_go(const Slot& slot, std::uint64_t spared) const {
    if (slot.used == 0) return true;
    return slot.used < frame_ && (slot.shown == 0 || slot.shown + spared < frame_);
}

PageShelves::Slot* PageShelves::take_used(const Key& page, std::size_t bytes, std::uint64_t spared) {
    using Age = std::pair<std::uint64_t, std::uint64_t>;
    std::optional<Age> oldest;
    Slots::iterator from, to;
    for (Slots& slots : shelves_) {
        for (auto first = slots.begin(); first != slots.end(); ++first) {
            Age age{0, 0};
            std::size_t length = 0;
            auto end = first;
            while (end != slots.end() && length < bytes && may_go(*end, spared)) {
                if (end->used != 0) age = std::max(age, Age{end->shown, end->used});
                length += end->bytes;
                ++end;
            }
            if (length < bytes || (oldest && *oldest <= age)) continue;
            oldest = age;
            from = first;
            to = end;
        }
    }
    if (!oldest) return nullptr;
    std::vector<Key> gone;
    for (auto slot = from; slot != to; ++slot)
        if (slot->used != 0) gone.push_back(slot->page);
    // What is freed grows together with what is free beside it.
    for (const Key& one : gone) from = free(slot_of_.extract(one).mapped());
    return put(from, page, bytes);
}

// A page at the begin of what is free.
PageShelves::Slot* PageShelves::put(Slots::iterator free, const Key& page, std::size_t bytes) {
    Slots& slots = shelves_[free->shelf];
    const auto slot = slots.insert(free, {page, frame_, 0, 0, free->shelf, free->place, bytes});
    free->place += bytes;
    free->bytes -= bytes;
    if (free->bytes == 0) slots.erase(free);
    slot_of_[page] = slot;
    return &*slot;
}

void PageShelves::free(const Key& page) {
    const auto found = slot_of_.find(page);
    if (found == slot_of_.end()) return;
    free(found->second);
    slot_of_.erase(found);
}

void PageShelves::free_all() {
    while (!slot_of_.empty()) free(Key(slot_of_.begin()->first));
}

// What is free there now, together with what was beside it.
PageShelves::Slots::iterator PageShelves::free(Slots::iterator slot) {
    Slots& slots = shelves_[slot->shelf];
    slot->used = slot->shown = slot->shown_before = 0;
    if (const auto next = std::next(slot); next != slots.end() && next->used == 0) {
        slot->bytes += next->bytes;
        slots.erase(next);
    }
    if (slot == slots.begin() || std::prev(slot)->used != 0) return slot;
    const auto before = std::prev(slot);
    before->bytes += slot->bytes;
    slots.erase(slot);
    return before;
}

bool PageShelves::has_room(std::size_t bytes) const {
    return std::ranges::any_of(shelves_, [&](const Slots& slots) {
        return std::ranges::any_of(slots,
                                   [&](const Slot& slot) { return slot.used == 0 && slot.bytes >= bytes; });
    });
}

std::size_t PageShelves::room(std::size_t bytes) const {
    std::size_t room = 0;
    for (const Slots& slots : shelves_) {
        std::size_t length = 0;
        for (const Slot& slot : slots) {
            if (may_go(slot, 0)) {
                length += slot.bytes;
                continue;
            }
            room += length / bytes;
            length = 0;
        }
        room += length / bytes;
    }
    return room;
}

std::vector<bool> PageShelves::release_unused() {
    std::vector<bool> stayed;
    std::vector<Slots> kept;
    for (Slots& slots : shelves_) {
        stayed.push_back(std::ranges::any_of(slots, [&](const Slot& slot) { return slot.used >= frame_; }));
        for (Slot& slot : slots) {
            if (stayed.back())
                slot.shelf = kept.size();
            else if (slot.used != 0)
                slot_of_.erase(slot.page);
        }
        if (stayed.back()) kept.push_back(std::move(slots));
    }
    shelves_ = std::move(kept);
    return stayed;
}

}  // namespace oro
