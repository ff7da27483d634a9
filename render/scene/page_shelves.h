// Where pages lie in the buffers of a store: one behind the other, each as long as it is. Knows no GPU.
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <tuple>
#include <vector>

namespace oro {

// Of pages that the current frame does not use, those that have not been shown for longest make room for what
// comes.
class PageShelves {
  public:
    using Key = std::tuple<int, int, int>;  // level, row, column
    struct Slot {
        Key page;
        std::uint64_t used{};   // frame; 0: no page is there
        std::uint64_t shown{};  // the last frame that showed it, and the last before this one
        std::uint64_t shown_before{};
        std::size_t shelf{};
        std::size_t place{};  // bytes from the shelf's begin
        std::size_t bytes{};
    };

    // From here on pages count as used by another frame: those of earlier ones may make room.
    void begin_frame() { ++frame_; }
    [[nodiscard]] std::uint64_t frame() const { return frame_; }

    // A new shelf, empty; the shelves are numbered as they came.
    void add(std::size_t bytes);
    // Where a page lies; null where it is not here. Asking does not count as use.
    [[nodiscard]] Slot* find(const Key& page);
    // The first place that is free and long enough, for a page that is not here yet; null where there is
    // none.
    Slot* take(const Key& page, std::size_t bytes);
    // The same where pages are that this frame does not use, nor were shown in the last `spared` frames; of
    // such places that whose pages all have not been shown for longest, and of these have not been used for
    // longest.
    Slot* take_used(const Key& page, std::size_t bytes, std::uint64_t spared);
    // The page is not here any more; none is.
    void free(const Key& page);
    void free_all();

    [[nodiscard]] std::size_t pages() const { return slot_of_.size(); }
    // Room for a page of that many bytes that is free; how many of them fit where this frame uses no page.
    [[nodiscard]] bool has_room(std::size_t bytes) const;
    [[nodiscard]] std::size_t room(std::size_t bytes) const;
    // Lets go of the shelves whose pages the current frame does not use, and numbers the others anew in their
    // order: which of them stayed.
    std::vector<bool> release_unused();

  private:
    using Slots = std::list<Slot>;
    [[nodiscard]] bool may_go(const Slot& slot, std::uint64_t spared) const;
    Slot* put(Slots::iterator free, const Key& page, std::size_t bytes);
    Slots::iterator free(Slots::iterator slot);

    std::vector<Slots> shelves_;  // without gaps
    std::map<Key, Slots::iterator> slot_of_;
    std::uint64_t frame_{1};
};

}  // namespace oro
