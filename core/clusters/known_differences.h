// Differences between a surface and edges over it that were found before.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace oro {

// Keeps differences by the vertices of their edges, in a table of fixed size: a newer one may take the
// place of an older one, which is then found again. One thread.
class KnownDifferences {
  public:
    // Numbers of an edge's vertices in the group, in the order in which its difference is asked for: the
    // other way it may be rounded otherwise.
    struct Key {
        int from, to;
        bool operator==(const Key&) const = default;
    };

    KnownDifferences() : entries_(places) {}

    // Of another group nothing is known.
    void forget() {
        if (++group_ != 0) return;
        entries_.assign(places, {});
        group_ = 1;
    }
    // The difference; where it is above `limit`, a value above the limit that is not above the difference, as
    // OriginalSurface has it. `measure` finds it where it is not known well enough.
    template <class Measure>
    [[nodiscard]] double find(const Key& key, double limit, const Measure& measure) {
        Entry& entry = entries_[place_of(key)];
        if (entry.group == group_ && entry.key == key) {
            if (entry.value >= 0.0) return entry.value;
            if (-entry.value > limit) return -entry.value;
        }
        const double value = measure();
        entry = {key, group_, value > limit ? -value : value};
        return value;
    }

  private:
    static constexpr std::size_t places = 1U << 13U;
    struct Entry {
        Key key{};
        std::uint32_t group{};  // 0: of none
        double value{};         // below 0: what the difference is at least
    };
    [[nodiscard]] static std::size_t place_of(const Key& key) {
        const auto number = [](int vertex) { return static_cast<std::uint32_t>(vertex); };
        const std::uint32_t mixed = number(key.from) * 0x9E3779B1U + number(key.to) * 0x85EBCA77U;
        return (mixed ^ (mixed >> 15U)) & (places - 1);
    }

    std::vector<Entry> entries_;
    std::uint32_t group_{1};
};

}  // namespace oro
