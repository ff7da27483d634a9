#include "geo/cover/cover_table.h"

#include <algorithm>

namespace oro {
namespace {

// Those that are classes, of how many of which they are.
std::size_t classes_among(const CoverTable& table, const std::set<int>& codes) {
    return static_cast<std::size_t>(std::ranges::count_if(table.classes, [&](const CoverClass& one) {
        return std::ranges::any_of(one.codes, [&](int code) { return codes.contains(code); });
    }));
}

bool has_all(const CoverTable& table, const std::set<int>& codes) {
    return std::ranges::all_of(
        codes, [&](int code) { return table.is_none(code) || table.class_of(code) != nullptr; });
}

std::string names_of(const std::vector<CoverTable>& tables, const std::vector<std::size_t>& numbers) {
    std::string names;
    for (std::size_t i = 0; i < numbers.size(); ++i)
        names += (i == 0 ? "" : i + 1 == numbers.size() ? " and " : ", ") + tables[numbers[i]].name;
    return names;
}

}  // namespace

const CoverClass* CoverTable::class_of(int code) const {
    for (const CoverClass& one : classes)
        if (std::ranges::find(one.codes, code) != one.codes.end()) return &one;
    return nullptr;
}

bool CoverTable::is_none(int code) const {
    return std::ranges::find(none, code) != none.end();
}

std::vector<CoverGround> grounds_of(const CoverTable& table) {
    std::vector<CoverGround> grounds;
    for (const CoverClass& one : table.classes) {
        const auto found =
            std::ranges::find_if(grounds, [&](const CoverGround& ground) { return ground.is_of(one); });
        if (found == grounds.end()) {
            grounds.push_back({one.colour, one.materials, one.steepest_deg, one.lowest_H_m, one.highest_H_m});
            continue;
        }
        found->steepest_deg = std::max(found->steepest_deg, one.steepest_deg);
        found->lowest_H_m = std::min(found->lowest_H_m, one.lowest_H_m);
        found->highest_H_m = std::max(found->highest_H_m, one.highest_H_m);
    }
    return grounds;
}

std::string codes_words(const std::set<int>& codes) {
    constexpr std::size_t most = 8;
    std::string words;
    std::size_t named = 0;
    for (const int code : codes) {
        if (named == most) return words + " and " + std::to_string(codes.size() - most) + " more";
        words += (named++ == 0 ? "" : ", ") + std::to_string(code);
    }
    return words;
}

Result<std::size_t> table_of_codes(const std::vector<CoverTable>& tables, const std::set<int>& codes) {
    std::vector<std::size_t> fitting, likely;
    for (std::size_t i = 0; i < tables.size(); ++i) {
        const std::size_t among = classes_among(tables[i], codes);
        if (among == 0 || !has_all(tables[i], codes)) continue;
        fitting.push_back(i);
        if (2 * among >= tables[i].classes.size()) likely.push_back(i);
    }
    if (fitting.size() == 1) return fitting.front();
    if (likely.size() == 1) return likely.front();
    std::string all;
    for (const CoverTable& table : tables) all += (all.empty() ? "" : ", ") + table.name;
    const std::string way = fitting.empty() ? all + " or a table of your own" : names_of(tables, fitting);
    return Error{ErrorKind::failed, "",
                 (codes.empty() ? std::string("it holds no code")
                                : "its codes (" + codes_words(codes) + ") " +
                                      (fitting.empty() ? "are those of no table" : "fit several tables")) +
                     ": name its table after a comma: " + way};
}

}  // namespace oro
