#include "apps/cover/canopy_words.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/report/figures.h"
#include "apps/report/json_object.h"

namespace oro {
namespace {

std::string names_of_files(const CanopyMap& canopy) {
    std::string names;
    for (const CanopySource& source : canopy.sources())
        names += (names.empty() ? "" : ", ") + std::filesystem::path(source.file).filename().string();
    return names;
}

struct CanopyTotals {
    float highest_m{};
    std::uint64_t raised{}, unknown{};
};

CanopyTotals totals_of(const Region& raised) {
    CanopyTotals totals;
    for (const RegionGrid& grid : raised.grids) {
        if (!grid.canopy) continue;
        totals.highest_m = std::max(totals.highest_m, grid.canopy->highest_m);
        totals.raised += grid.canopy->posts;
        totals.unknown += grid.canopy->unknown;
    }
    return totals;
}

// "0.5 of it is in the data (SRTM)"; of grids with different shares all of them.
std::string held_words(const Region& raised) {
    std::vector<std::string> all;
    for (const RegionGrid& grid : raised.grids) {
        if (!grid.canopy) continue;
        char share[32];
        std::snprintf(share, sizeof share, "%g", grid.canopy->held_share);
        const std::string words =
            share + (grid.canopy->held_by.empty() ? std::string() : " (" + grid.canopy->held_by + ")");
        if (std::ranges::find(all, words) == all.end()) all.push_back(words);
    }
    std::string words;
    for (const std::string& one : all) words += (words.empty() ? "" : " or ") + one;
    return words + " of it is taken to be in the data already";
}

}  // namespace

std::string metres_words(double metres) {
    char text[40];
    std::snprintf(text, sizeof text, "%.1f m", metres);
    return text;
}

std::string canopy_words(const CanopyMap& canopy, const Region& raised, bool names_files) {
    std::string whence = names_files ? "data of " + names_of_files(canopy) : "data";
    if (canopy.is_invented()) whence = "invented, by classes of " + canopy.cover()->table().title;
    return "Canopy: " + whence + ", up to " + metres_words(totals_of(raised).highest_m) + "; " +
           held_words(raised);
}

nlohmann::ordered_json canopy_json(const CanopyMap& canopy, const Region& raised) {
    nlohmann::ordered_json json =
        json_object("from", canopy.is_invented() ? "class" : "file", "invented", canopy.is_invented());
    if (canopy.is_invented()) {
        json["table"] = canopy.cover()->table().name;
    } else {
        json["files"] = nlohmann::ordered_json::array();
        for (const CanopySource& source : canopy.sources()) json["files"].push_back(source.file);
    }
    const CanopyTotals totals = totals_of(raised);
    json["highest_m"] = totals.highest_m;
    json["held"] = nlohmann::ordered_json::array();
    for (const RegionGrid& grid : raised.grids) {
        if (!grid.canopy) continue;
        json["held"].push_back(json_object("share", grid.canopy->held_share));
        json["held"].back()["by"] = grid.canopy->held_by.empty()
                                        ? nlohmann::ordered_json(nullptr)
                                        : nlohmann::ordered_json(grid.canopy->held_by);
    }
    json["raised_posts"] = totals.raised;
    json["unknown_posts"] = totals.unknown;
    return json;
}

std::vector<std::string> notes_of_canopy(const Region& raised) {
    const CanopyTotals totals = totals_of(raised);
    if (totals.unknown == 0) return {};
    return {"no canopy is known over " + counted(totals.unknown, "post", "posts") +
            ": nothing is taken to grow there"};
}

}  // namespace oro
