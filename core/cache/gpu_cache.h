// Which items are in GPU memory, and where: the bookkeeping of a cache. It knows no GPU.
#pragma once

#include <algorithm>
#include <cassert>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/cache/handle_table.h"

namespace oro {

// Bytes that several caches share. It is for one thread at a time.
class MemoryBudget {
  public:
    explicit MemoryBudget(std::uint64_t bytes) : bytes_(bytes) {}
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
    [[nodiscard]] std::uint64_t left() const { return taken_ < bytes_ ? bytes_ - taken_ : 0; }
    // Bytes that count as taken for as long as somebody owns the share.
    using Share = std::shared_ptr<void>;
    static Share take(std::shared_ptr<MemoryBudget> budget, std::uint64_t bytes) {
        budget->taken_ += bytes;
        return {nullptr, [budget = std::move(budget), bytes](void*) { budget->taken_ -= bytes; }};
    }

  private:
    std::uint64_t bytes_;
    std::uint64_t taken_{};
};

struct NoValue {};

// A key that std::hash is there for.
template <class Key>
concept HashedKey = std::is_default_constructible_v<std::hash<Key>>;
template <class Key, class Handle>
struct CacheTable {
    using Type = std::map<Key, Handle>;
};
template <HashedKey Key, class Handle>
struct CacheTable<Key, Handle> {
    using Type = HandleTable<Key>;
};

// A cache is a bin allocator: items lie in bins (buffers of a budget) one behind the other, each as long as
// it is. An item is inserted where enough bytes are free, and where there are none others are evicted for it.
//
// Frames are numbered by the timeline values that the GPU signals at their ends. An item is used by the frame
// that inserted it or that used it last. Its bytes are given to another once the GPU has completed that
// frame, and no sooner, whether it was evicted or erased: so several frames may be in flight.
//
// A key has an order, or a hash (std::hash), or is a whole number, which is the index of a table then. The
// cache keeps a Value with each item for its owner. It is for one thread at a time.
template <class Key, class Value = NoValue>
class GpuCache {
  public:
    // Names an item as long as it is in the cache.
    using Handle = std::uint32_t;
    static constexpr Handle none = ~Handle{0};
    struct Slot {
        Key key{};
        [[no_unique_address]] Value value{};
        std::uint64_t used{};  // by this frame last; of free bytes: what was there before
        std::uint64_t rank{};  // items of the lowest are evicted first; 0 until it is set
        std::uint32_t bin{}, offset{}, bytes{};
        Handle previous{none}, next{none};  // neighbours in the bin
        bool is_free{true};
    };

    explicit GpuCache(std::shared_ptr<MemoryBudget> budget) : budget_(std::move(budget)) {}

    // From here on items are used by the frame that signals `value`, which rises from call to call; it begins
    // with 1. The GPU has completed all frames up to `completed`, which is less. A frame that is begun and
    // never submitted counts as completed with the next.
    void begin_frame(std::uint64_t value, std::uint64_t completed) {
        assert(value > frame_ && completed < value && completed >= completed_);
        frame_ = value;
        completed_ = completed;
        run_bytes_ = 0;
    }
    // The next frame of a renderer that waits for each, or whose queue fills bytes after all frames that were
    // submitted before: these may have in flight what is evicted.
    void begin_frame() { begin_frame(frame_ + 1, frame_); }
    [[nodiscard]] std::uint64_t frame() const { return frame_; }

    // A new bin, empty. Bins are numbered as they came. The first may take more than the budget has.
    void add_bin(std::size_t bytes) {
        assert(bins_.empty() || bytes <= budget_->left());
        const Handle first = new_slot();
        slots_[first].bin = static_cast<std::uint32_t>(bins_.size());
        slots_[first].bytes = static_cast<std::uint32_t>(bytes);
        free_.emplace(position(first), first);
        bins_.push_back({first, MemoryBudget::take(budget_, bytes)});
        run_bytes_ = 0;
    }
    // Removes the bins of which no byte is in use by the frame or by one in flight, and numbers the others
    // anew in their order: which of them stayed.
    std::vector<bool> release_unused() {
        std::vector<bool> stayed;
        free_.clear();
        for (const Bin& bin : bins_) {
            bool stays = false;
            for_each_in(bin, [&](Handle at) { stays = stays || !is_completed(slots_[at]); });
            const auto new_number = static_cast<std::uint32_t>(std::ranges::count(stayed, true));
            for_each_in(bin, [&](Handle at) {
                slots_[at].bin = new_number;
                if (!stays) spare_.push_back(at);
                if (!stays && !slots_[at].is_free) remove(at);
                if (stays && slots_[at].is_free) free_.emplace(position(at), at);
            });
            stayed.push_back(stays);
        }
        std::size_t number = 0;
        std::erase_if(bins_, [&](const Bin&) { return !stayed[number++]; });
        run_bytes_ = 0;
        return stayed;
    }

    // `none` where an item is not in the cache. Finding it is no use.
    [[nodiscard]] Handle find(const Key& key) const {
        if constexpr (std::is_integral_v<Key>) {
            return key < table_.size() ? table_[key] : none;
        } else {
            if constexpr (std::is_same_v<decltype(table_), HandleTable<Key>>) {
                return table_.find(key);
            } else {
                const auto found = table_.find(key);
                return found == table_.end() ? none : found->second;
            }
        }
    }
    [[nodiscard]] const Slot& at(Handle handle) const { return slots_[handle]; }
    [[nodiscard]] Value& value(Handle handle) { return slots_[handle].value; }
    void use(Handle handle) { slots_[handle].used = frame_; }
    void set_rank(Handle handle, std::uint64_t rank) { slots_[handle].rank = rank; }

    // The item, which is not in the cache yet, where bytes are free first; `none` where there are too few.
    Handle insert(const Key& key, std::size_t bytes) {
        assert(find(key) == none && bytes > 0);
        const Handle piece = first_free(bytes);
        return piece == none ? none : place(piece, key, bytes);
    }
    // The item in place of others, where insert() gives none: of neighbours that are long enough, of those
    // whose highest rank is the lowest; of these, of those used least recently; and of these the first. An
    // item whose rank is one of the last `spared` frames stays. `none` where too few bytes may be evicted.
    Handle evict(const Key& key, std::size_t bytes, std::uint64_t spared = 0) {
        if (run_bytes_ != bytes || run_spared_ != spared) list_runs(bytes, spared);
        while (!runs_.empty()) {
            std::ranges::pop_heap(runs_, std::greater());
            const Run run = runs_.back();
            runs_.pop_back();
            // What has been used since it was listed may not go any more, or goes later.
            const std::optional<Run> now = run_at(run.first, bytes, spared);
            if (now && *now > run) {
                runs_.push_back(*now);
                std::ranges::push_heap(runs_, std::greater());
            } else if (now) {
                // What is free before the run waits for a frame in flight, or the run would begin there.
                if (!slots_[run.first].is_free) free(run.first, false);
                while (slots_[run.first].bytes < bytes) free(slots_[run.first].next);
                return place(run.first, key, bytes);
            }
        }
        return none;
    }
    void erase(const Key& key) {
        if (const Handle handle = find(key); handle != none) free(handle);
        run_bytes_ = 0;
    }
    // Removes all items. Each bin is free in one piece then.
    void clear() {
        for (const Bin& bin : bins_)
            for (Handle at = bin.first; at != none; at = slots_[at].next)
                if (!slots_[at].is_free) at = free(at);
        run_bytes_ = 0;
    }

    // Number of items.
    [[nodiscard]] std::size_t size() const { return size_; }
    // Whether so many bytes are free in one piece.
    [[nodiscard]] bool has_free(std::size_t bytes) const { return first_free(bytes) != none; }
    // How many items of so many bytes find bytes that are free or that may be evicted.
    [[nodiscard]] std::size_t fitting(std::size_t bytes) const {
        std::size_t count = 0, length = 0;
        for (const Bin& bin : bins_) {
            for_each_in(bin, [&](Handle at) {
                if (!may_go(slots_[at], 0))
                    count += std::exchange(length, 0) / bytes;
                else
                    length += slots_[at].bytes;
            });
            count += std::exchange(length, 0) / bytes;
        }
        return count;
    }
    template <class Visit>
    void for_each(const Visit& visit) const {
        for (const Slot& slot : slots_)
            if (!slot.is_free) visit(slot);
    }

  private:
    struct Bin {
        Handle first;
        MemoryBudget::Share share;
    };
    // Neighbours that may be evicted together for one item, in the order in which that is done.
    struct Run {
        std::uint64_t rank{}, used{};  // the highest of its items
        std::uint64_t position{};
        Handle first{};
        auto operator<=>(const Run&) const = default;
    };

    template <class Visit>
    void for_each_in(const Bin& bin, const Visit& visit) const {
        for (Handle at = bin.first; at != none; at = slots_[at].next) visit(at);
    }
    [[nodiscard]] std::uint64_t position(Handle handle) const {
        return std::uint64_t{slots_[handle].bin} << 32U | slots_[handle].offset;
    }
    [[nodiscard]] bool is_completed(const Slot& slot) const { return slot.used <= completed_; }
    [[nodiscard]] bool may_go(const Slot& slot, std::uint64_t spared) const {
        return is_completed(slot) &&
               (slot.is_free || spared == 0 || slot.rank == 0 || slot.rank + spared < frame_);
    }
    [[nodiscard]] Handle first_free(std::size_t bytes) const {
        const auto found = std::ranges::find_if(free_, [&](const auto& piece) {
            return slots_[piece.second].bytes >= bytes && is_completed(slots_[piece.second]);
        });
        return found == free_.end() ? none : found->second;
    }
    void set_handle(const Key& key, Handle handle) {
        if constexpr (std::is_integral_v<Key>) {
            if (key >= table_.size()) table_.resize(key + std::size_t{1}, none);
            table_[key] = handle;
        } else if (handle == none) {
            table_.erase(key);
        } else {
            if constexpr (std::is_same_v<decltype(table_), HandleTable<Key>>)
                table_.set(key, handle);
            else
                table_[key] = handle;
        }
    }
    Handle new_slot() {
        if (spare_.empty()) {
            slots_.emplace_back();
            return static_cast<Handle>(slots_.size() - 1);
        }
        const Handle handle = spare_.back();
        spare_.pop_back();
        slots_[handle] = {};
        return handle;
    }
    // The item takes the begin of a free piece.
    Handle place(Handle piece, const Key& key, std::size_t bytes) {
        auto node = free_.extract({position(piece), piece});
        const auto length = static_cast<std::uint32_t>(bytes);
        if (slots_[piece].bytes > length) {
            const Handle rest = new_slot();
            const Slot& slot = slots_[piece];
            slots_[rest] = {.used = slot.used,
                            .bin = slot.bin,
                            .offset = slot.offset + length,
                            .bytes = slot.bytes - length,
                            .previous = piece,
                            .next = slot.next};
            if (slot.next != none) slots_[slot.next].previous = rest;
            slots_[piece].next = rest;
            node.value() = {position(rest), rest};
            free_.insert(std::move(node));
            run_bytes_ = 0;
        }
        const Slot& slot = slots_[piece];
        slots_[piece] = {key, {}, frame_, 0, slot.bin, slot.offset, length, slot.previous, slot.next, false};
        set_handle(key, piece);
        ++size_;
        return piece;
    }
    void remove(Handle handle) {
        set_handle(slots_[handle].key, none);
        slots_[handle].is_free = true;
        --size_;
    }
    // The free piece that an item's bytes are part of now.
    Handle free(Handle handle, bool joins_previous = true) {
        remove(handle);
        free_.emplace(position(handle), handle);
        const Handle next = slots_[handle].next, previous = slots_[handle].previous;
        if (next != none && slots_[next].is_free) join_with_next(handle);
        if (!joins_previous || previous == none || !slots_[previous].is_free) return handle;
        join_with_next(previous);
        return previous;
    }
    void join_with_next(Handle handle) {
        Slot& slot = slots_[handle];
        const Handle next = slot.next;
        free_.erase({position(next), next});
        slot.bytes += slots_[next].bytes;
        slot.used = std::max(slot.used, slots_[next].used);
        slot.next = slots_[next].next;
        if (slot.next != none) slots_[slot.next].previous = handle;
        spare_.push_back(next);
        run_bytes_ = 0;
    }
    [[nodiscard]] std::optional<Run> run_at(Handle first, std::size_t bytes, std::uint64_t spared) const {
        std::pair<std::uint64_t, std::uint64_t> age{0, 0};
        std::size_t length = 0;
        for (Handle at = first; length < bytes; at = slots_[at].next) {
            if (at == none || !may_go(slots_[at], spared)) return std::nullopt;
            if (!slots_[at].is_free) age = std::max(age, {slots_[at].rank, slots_[at].used});
            length += slots_[at].bytes;
        }
        return Run{age.first, age.second, position(first), first};
    }
    void list_runs(std::size_t bytes, std::uint64_t spared) {
        runs_.clear();
        for (const Bin& bin : bins_)
            for_each_in(bin, [&](Handle at) {
                if (const auto run = run_at(at, bytes, spared)) runs_.push_back(*run);
            });
        std::ranges::make_heap(runs_, std::greater());
        run_bytes_ = bytes;
        run_spared_ = spared;
    }

    std::shared_ptr<MemoryBudget> budget_;
    std::vector<Bin> bins_;
    std::vector<Slot> slots_;                          // items and free pieces
    std::vector<Handle> spare_;                        // of slots that are neither
    std::set<std::pair<std::uint64_t, Handle>> free_;  // by their positions
    std::conditional_t<std::is_integral_v<Key>, std::vector<Handle>, typename CacheTable<Key, Handle>::Type>
        table_;
    std::size_t size_{};
    std::uint64_t frame_{1};
    std::uint64_t completed_{0};
    // What may be evicted for so many bytes, a heap whose front is the next. 0: it is to be listed anew.
    std::vector<Run> runs_;
    std::size_t run_bytes_{};
    std::uint64_t run_spared_{};
};

}  // namespace oro
