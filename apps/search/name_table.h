// Names of many places, found by parts of them as fast as they are typed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "apps/search/search_place.h"

namespace oro {

// How a name holds a text, the best first.
enum class NameMatch { whole, beginning, beginning_of_word, within };

class NameTable {
  public:
    struct Found {
        NameMatch match{};
        std::uint32_t number{};  // of place()
    };

    NameTable() = default;
    // Takes half a second for 200,000 names, and some 60 bytes each beside the places.
    explicit NameTable(std::vector<SearchPlace> places);

    // The places, the most important first (importance_of()), then by name.
    [[nodiscard]] std::size_t size() const { return places_.size(); }
    [[nodiscard]] const SearchPlace& place(std::uint32_t number) const { return places_[number]; }

    // The first `limit` places whose name holds a text that is folded() and not empty: by how, then by
    // importance. Takes a few milliseconds for 200,000 names. Safe from several threads.
    [[nodiscard]] std::vector<Found> find(std::string_view text, std::size_t limit) const;

  private:
    // A word of a name, by where it begins in names_.
    struct Word {
        std::uint64_t first_bytes;  // eight, the first on top
        std::uint32_t at;
        std::uint32_t number;
    };
    [[nodiscard]] std::string_view rest_of_name(const Word& word) const;
    void add_within(std::string_view text, std::size_t limit, std::vector<Found>& found) const;

    std::vector<SearchPlace> places_;
    std::string names_;                  // folded, each with a line feed behind it
    std::vector<std::uint32_t> begins_;  // of each name in names_, and the end of the last
    std::vector<Word> words_;            // of all names, by their letters from there on
};

}  // namespace oro
