// Finds pages of a level by their place: what a frame asks most often.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace oro {

// Numbers by the place of a page in its level. Emptied in no time, and it keeps its room.
class PageTable {
  public:
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    void clear();
    // The place has no number yet.
    void insert(int row, int column, std::uint32_t number);
    // `none` where there is none.
    [[nodiscard]] std::uint32_t find(int row, int column) const;

  private:
    struct Entry {
        std::uint64_t place{};
        std::uint32_t number{};
        std::uint32_t turn{};  // of another turn: it is free
    };
    [[nodiscard]] std::size_t first_entry(std::uint64_t place) const;
    void grow();

    std::vector<Entry> entries_;  // a power of two, at most half of them taken
    std::size_t size_{};
    std::uint32_t turn_{1};
};

}  // namespace oro
