// What the codes of a land-cover product stand for.
#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/drape/materials.h"

namespace oro {

// A class of a product. Its heights and numbers are means of such places, and stand where its table has their
// sources.
struct CoverClass {
    std::vector<int> codes;                // that files have for it; the first names it
    std::string name;                      // "tree cover"
    std::array<std::uint8_t, 3> colour{};  // of the ground from above, sRGB codes
    std::vector<Material> materials;       // one, or two of which it has half each
    double canopy_m{};                     // height of what grows there: mean,
    double canopy_spread_m{};              // ... and standard deviation
    double stems_per_ha{};                 // trees on a hectare
    double steepest_deg{90.0};             // it is on no steeper ground,
    double lowest_H_m{-12000.0};           // ... on none that is lower,
    double highest_H_m{9000.0};            // ... and on none that is higher
    bool operator==(const CoverClass&) const = default;
};

// The classes of a product.
struct CoverTable {
    std::string name;       // as an option gives it: "worldcover", or the file of a user's own
    std::string title;      // "ESA WorldCover"
    std::vector<int> none;  // codes of places of which nothing is known
    std::vector<CoverClass> classes;

    // The class of a code; null where the table has none.
    [[nodiscard]] const CoverClass* class_of(int code) const;
    // Whether a code stands for places of which nothing is known.
    [[nodiscard]] bool is_none(int code) const;
};

// Different colours and materials that a table may have together: a texel of cover tiles counts them with
// four bits.
inline constexpr std::size_t most_grounds = 15;
// A colour with its materials, that one or several classes have, and the widest of their limits.
struct CoverGround {
    std::array<std::uint8_t, 3> colour{};
    std::vector<Material> materials;
    double steepest_deg{};
    double lowest_H_m{};
    double highest_H_m{};
    [[nodiscard]] bool is_of(const CoverClass& one) const {
        return colour == one.colour && materials == one.materials;
    }
};
// Those of a table, in the order of its classes, each once.
std::vector<CoverGround> grounds_of(const CoverTable& table);

// Which of some tables codes are of: the one that has all of them, and at least half of whose classes are
// among them where several have them all. `codes` are without those that a file marks as no data. Errors (a
// reason, without a file's name): codes of no table; codes that fit several.
Result<std::size_t> table_of_codes(const std::vector<CoverTable>& tables, const std::set<int>& codes);

// "10, 20 and 3 more"
std::string codes_words(const std::set<int>& codes);

}  // namespace oro
