#include "apps/search/place_by_name.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <tuple>
#include <utility>

#include "apps/command_line/edit_distance.h"
#include "apps/command_line/refusals.h"
#include "apps/search/folded_text.h"
#include "apps/search/gazetteer.h"

namespace oro {
namespace {

constexpr std::size_t most_listed = 5;
constexpr double one_place_deg = 1.0e-6;

bool is_same_place(const SearchPlace& one, const SearchPlace& other) {
    return folded(one.name) == folded(other.name) && std::abs(one.lat_deg - other.lat_deg) <= one_place_deg &&
           std::abs(std::remainder(one.lon_deg - other.lon_deg, 360.0)) <= one_place_deg;
}

// The most important first, each once.
std::vector<SearchPlace> ranked(std::vector<SearchPlace> places) {
    std::ranges::stable_sort(places, [](const SearchPlace& one, const SearchPlace& other) {
        return std::tuple(-importance_of(one), std::string_view(one.name), one.lat_deg, one.lon_deg) <
               std::tuple(-importance_of(other), std::string_view(other.name), other.lat_deg, other.lon_deg);
    });
    std::vector<SearchPlace> once;
    for (SearchPlace& place : places)
        if (std::ranges::none_of(once, [&](const SearchPlace& one) { return is_same_place(one, place); }))
            once.push_back(std::move(place));
    return once;
}

// "Rothorn, 3103 m, at 46.02131,7.81921"
std::string place_words(const SearchPlace& place) {
    char at[80];
    std::snprintf(at, sizeof at, "at %.5f,%.5f", place.lat_deg, place.lon_deg);
    char height[40] = "";
    if (place.H_m) std::snprintf(height, sizeof height, ", %.0f m", *place.H_m);
    return place.name + height + ", " + at;
}

Error several_places(const std::vector<SearchPlace>& places, const std::string& what,
                     const std::string& advice) {
    std::string list;
    for (std::size_t i = 0; i < std::min(places.size(), most_listed); ++i)
        list += (i == 0 ? "" : "; ") + place_words(places[i]);
    if (places.size() > most_listed) list += "; and " + std::to_string(places.size() - most_listed) + " more";
    return {ErrorKind::usage, "", what + " " + std::to_string(places.size()) + " places: " + list + advice};
}

// How many letters of a name may be others than those that were typed: one of three.
std::size_t most_other_letters(std::string_view text, std::string_view name) {
    return std::min(std::size_t{3}, std::max(text.size(), name.size()) / 3);
}

// Names that hold the text, and then those that are spelt nearly so.
std::vector<std::string> near_names(const std::string& letters, const std::vector<SearchPlace>& places) {
    struct Near {
        std::size_t changes;
        double importance;
        const std::string* name;
    };
    constexpr std::size_t least_held = 3;
    std::vector<Near> all;
    for (const SearchPlace& place : places) {
        const std::string name = folded(place.name);
        const bool holds = letters.size() >= least_held && name.find(letters) != std::string::npos;
        const std::size_t most = most_other_letters(letters, name);
        const std::size_t longer =
            std::max(letters.size(), name.size()) - std::min(letters.size(), name.size());
        if (!holds && longer > most) continue;
        const std::size_t changes = holds ? 0 : edit_distance(letters, name);
        if (changes <= most || holds) all.push_back({changes, importance_of(place), &place.name});
    }
    std::ranges::stable_sort(all, [](const Near& one, const Near& other) {
        return std::tuple(one.changes, -one.importance, std::string_view(*one.name)) <
               std::tuple(other.changes, -other.importance, std::string_view(*other.name));
    });
    std::vector<std::string> names;
    for (const Near& near : all)
        if (names.size() < most_listed && std::ranges::find(names, *near.name) == names.end())
            names.push_back(*near.name);
    return names;
}

}  // namespace

bool may_be_name(const std::string& text) {
    return std::ranges::any_of(folded(text),
                               [](char letter) { return letter != ' ' && (letter < '0' || letter > '9'); });
}

Result<NamedPlaceFound> place_by_name(const std::string& text, const std::vector<SearchPlace>& places,
                                      const std::string& source) {
    const std::string letters = folded(text);
    std::vector<SearchPlace> whole, beginning;
    for (const SearchPlace& place : places) {
        const std::string name = folded(place.name);
        if (letters.empty() || !name.starts_with(letters)) continue;
        (name.size() == letters.size() ? whole : beginning).push_back(place);
    }
    const bool is_whole = !whole.empty();
    const std::vector<SearchPlace> found = ranked(std::move(is_whole ? whole : beginning));
    if (found.size() == 1) return NamedPlaceFound{found.front(), is_whole};
    if (is_whole) return several_places(found, "is the name of", "; give the coordinates of one");
    if (!found.empty())
        return several_places(found, "begins the names of",
                              "; give more of the name, or the coordinates of one");
    const std::vector<std::string> near = near_names(letters, places);
    return Error{
        ErrorKind::usage, "",
        "is no name of " + source + (near.empty() ? "" : ": did you mean " + joined(near, " or ") + "?")};
}

Result<std::vector<SearchPlace>> read_named_places(const std::string& file, const std::string& name_field) {
    const Result<VectorFile> read = read_vectors(file);
    if (!read.ok()) {
        // A dump of GeoNames is no vector file, and says so by its content.
        Result<Gazetteer> gazetteer = read_gazetteer(file);
        return gazetteer.ok() ? Result<std::vector<SearchPlace>>(std::move(gazetteer->places)) : read.error();
    }
    std::vector<SearchPlace> places = places_of(*read, name_field);
    if (places.empty())
        return Error{ErrorKind::failed, file,
                     "has no point with something in the field '" + name_field + "'"};
    return places;
}

}  // namespace oro
