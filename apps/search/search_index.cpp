#include "apps/search/search_index.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <tuple>
#include <utility>

#include "apps/command_line/refusals.h"
#include "apps/search/folded_text.h"
#include "geo/opening/source_crs.h"
#include "geo/places/bounding_box.h"

namespace oro {
namespace {

constexpr double beyond_degrees = 360.0;

Error unresolved(const std::string& what) {
    return {ErrorKind::usage, "", what};
}

std::string without_ends(const std::string& text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string::npos) return "";
    return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

bool has_figure(const std::string& text) {
    return text.find_first_of("0123456789") != std::string::npos;
}

// "EPSG:2056 2642950,1166825" is its CRS and its numbers, "en 46,7" is "" and its numbers. Nothing for a text
// that begins otherwise.
std::optional<std::pair<std::string, std::string>> crs_before_numbers(const std::string& text) {
    const std::size_t gap = text.find(' ');
    if (gap == std::string::npos) return std::nullopt;
    const std::string word = text.substr(0, gap), rest = without_ends(text.substr(gap));
    if (word == "en" || word == "EN" || word == "en:" || word == "EN:") return std::pair(std::string(), rest);
    const std::size_t colon = word.find(':');
    const auto is_of = [](std::string_view part, auto kind) {
        return !part.empty() && std::ranges::all_of(part, kind);
    };
    const std::string_view name = word;
    if (colon == std::string::npos || colon + 1 == word.size()) return std::nullopt;
    if (!is_of(name.substr(0, colon), [](unsigned char c) { return std::isalpha(c) != 0; }) ||
        !is_of(name.substr(colon + 1), [](unsigned char c) { return std::isdigit(c) != 0; }))
        return std::nullopt;
    return std::pair(word, rest);
}

SearchTarget target_of_place(const Place& place) {
    return {place.cell ? SearchAction::frame : SearchAction::show, place, "", {}};
}

// Its middle, and the box as the cell that is framed.
SearchTarget target_of_box(const BoundingBox& box) {
    const double east_deg = box.east_deg < box.west_deg ? box.east_deg + 360.0 : box.east_deg;
    Place place;
    place.lat_deg = 0.5 * (box.south_deg + box.north_deg);
    place.lon_deg = std::remainder(0.5 * (box.west_deg + east_deg), 360.0);
    if (place.lon_deg == -180.0) place.lon_deg = 180.0;
    place.form = "box";
    place.cell = PlaceCell{box.south_deg, box.west_deg, box.north_deg, east_deg};
    return target_of_place(place);
}

// Two or four numbers in a CRS; nothing for other texts.
std::optional<Result<SearchTarget>> in_crs(const CrsPlaces& crs, const std::string& numbers) {
    const auto as_target = [](const auto& read, auto make) -> Result<SearchTarget> {
        if (!read.ok()) return unresolved(read.error().what);
        return make(*read);
    };
    if (const auto two = two_coordinates(numbers))
        return as_target(crs.place((*two)[0], (*two)[1]), target_of_place);
    if (const auto four = four_coordinates(numbers))
        return as_target(crs.box((*four)[0], (*four)[1], (*four)[2], (*four)[3]), target_of_box);
    return std::nullopt;
}

bool goes_beyond_degrees(const std::string& text) {
    const auto is_beyond = [](const auto& numbers) {
        return numbers &&
               std::ranges::any_of(*numbers, [](double one) { return std::abs(one) > beyond_degrees; });
    };
    return is_beyond(two_coordinates(text)) || is_beyond(four_coordinates(text));
}

// Of a text that is no place and no name.
Error no_such_place(const std::string& text, const Error& of_place, bool has_crs) {
    std::string what = of_place.what;
    if (!has_crs && goes_beyond_degrees(text))
        what += "; of coordinates of a map write the CRS before them: EPSG:2056 2642950,1166825";
    return unresolved(has_figure(text) ? what
                                       : "no place of this name is known here; a file of places (GPX, KML, "
                                         "GeoJSON) that is opened adds its names, and `orograph fetch "
                                         "--source peaks` gets such a file from OpenStreetMap");
}

}  // namespace

SearchTarget target_of(const SearchMatch& match) {
    SearchTarget target;
    target.name = match.place.name;
    target.place.lat_deg = match.place.lat_deg;
    target.place.lon_deg = match.place.lon_deg;
    target.place.form = "name";
    target.eye = match.eye;
    target.action = match.eye                                ? SearchAction::view
                    : match.place.kind == PlaceClass::summit ? SearchAction::stand
                                                             : SearchAction::show;
    return target;
}

void SearchIndex::set_bookmarks(const std::vector<Bookmark>& bookmarks) {
    std::vector<SearchPlace> places;
    eyes_.clear();
    for (const Bookmark& bookmark : bookmarks) {
        places.push_back({bookmark.name, bookmark.lat_deg, bookmark.lon_deg, {}, PlaceClass::other, 0.0});
        if (bookmark.eye) eyes_.push_back(bookmark);
    }
    bookmarks_ = NameTable(std::move(places));
}

std::vector<SearchMatch> SearchIndex::matches(const std::string& text, std::size_t limit) const {
    const std::string letters = folded(text);
    std::vector<SearchMatch> all;
    for (const auto& [source, table] : {std::pair{NameSource::bookmark, &bookmarks_},
                                        {NameSource::point, &points_},
                                        {NameSource::gazetteer, &gazetteer_}}) {
        for (const NameTable::Found& found : table->find(letters, limit)) {
            SearchMatch& match = all.emplace_back();
            match.place = table->place(found.number);
            match.source = source;
            match.match = found.match;
            if (source != NameSource::bookmark) continue;
            const auto eye = std::ranges::find(eyes_, match.place.name, &Bookmark::name);
            if (eye != eyes_.end()) match.eye = eye->eye;
        }
    }
    std::ranges::stable_sort(all, {},
                             [](const SearchMatch& one) { return std::pair(one.match, one.source); });
    all.resize(std::min(all.size(), limit));
    return all;
}

std::optional<Result<SearchTarget>> SearchIndex::read_coordinates(const std::string& text) const {
    if (const auto parts = crs_before_numbers(text)) {
        const auto& [name, numbers] = *parts;
        if (name.empty()) {
            if (crs_) return in_crs(*crs_, numbers);
            if (!two_coordinates(numbers) && !four_coordinates(numbers)) return std::nullopt;
            return unresolved(
                "the data have no CRS of eastings and northings: write it, EPSG:2056 2642950,1166825");
        }
        if (!two_coordinates(numbers) && !four_coordinates(numbers)) return std::nullopt;
        const Result<CrsPlaces> named = CrsPlaces::of(name);
        if (!named.ok()) return unresolved(name + " " + named.error().what);
        return in_crs(*named, numbers);
    }
    if (crs_ && goes_beyond_degrees(text)) return in_crs(*crs_, text);
    if (!four_coordinates(text)) return std::nullopt;
    const Result<BoundingBox> box = parse_bounding_box(text);
    if (!box.ok()) return unresolved(box.error().what);
    return target_of_box(*box);
}

Result<SearchTarget> SearchIndex::resolve(const std::string& text) const {
    const std::string plain = without_ends(text);
    if (plain.empty()) return unresolved("type a place: 46.57,7.99, a cell such as N46E008, or a name");
    const std::vector<SearchMatch> best = matches(plain, 1);
    if (!best.empty() && best.front().match == NameMatch::whole) return target_of(best.front());
    if (const auto read = read_coordinates(plain)) return *read;
    const Result<Place> place = parse_place(plain, "");
    if (place.ok()) return target_of_place(*place);
    if (!best.empty()) return target_of(best.front());
    return no_such_place(plain, place.error(), crs_.has_value());
}

Result<std::optional<CrsPlaces>> search_crs(const std::string& coordinates, const Region& region) {
    if (!coordinates.empty() && coordinates != "source") {
        Result<CrsPlaces> named = CrsPlaces::of(coordinates);
        if (!named.ok()) return refused("--coordinates", coordinates, named.error().what);
        return std::optional(std::move(named).value());
    }
    const std::vector<std::string> all = source_crs_of(region);
    if (all.size() != 1) return std::optional<CrsPlaces>();
    Result<CrsPlaces> of_source = CrsPlaces::of(all.front(), CrsPlaces::Reach::anywhere);
    if (!of_source.ok() || !of_source->is_projected()) return std::optional<CrsPlaces>();
    return std::optional(std::move(of_source).value());
}

}  // namespace oro
