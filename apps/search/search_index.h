// What one search field takes: places in every form, boxes, coordinates of a CRS, and names.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/search/name_table.h"
#include "apps/search/search_place.h"
#include "apps/settings/bookmarks.h"
#include "core/base/result.h"
#include "geo/coordinates/crs_places.h"
#include "geo/places/place.h"
#include "geo/region/region.h"

namespace oro {

// Whence a name is known. Among names that match alike, bookmarks come before points, and points before those
// of gazetteers.
enum class NameSource { bookmark, point, gazetteer };

struct SearchMatch {
    SearchPlace place;
    NameSource source{};
    NameMatch match{};
    std::optional<BookmarkedEye> eye;  // of a bookmark of a whole view
};

// What is to be done about a text.
enum class SearchAction {
    frame,  // show all of place.cell
    show,   // show the place, from a side
    stand,  // stand on the place, a summit, with the horizon before one
    view,   // be at `eye` over the place
};

struct SearchTarget {
    SearchAction action{};
    Place place;
    std::string name;                  // as it is found; "" of what was given by numbers
    std::optional<BookmarkedEye> eye;  // of SearchAction::view
};

// What to do about a match that was chosen.
SearchTarget target_of(const SearchMatch& match);

// Not safe to use from several threads; a NameTable may be made on another one.
class SearchIndex {
  public:
    void set_bookmarks(const std::vector<Bookmark>& bookmarks);
    // Of the vector files that are loaded (places_of()), and of gazetteers.
    void set_points(NameTable points) { points_ = std::move(points); }
    void set_gazetteer(NameTable names) { gazetteer_ = std::move(names); }
    // The CRS of two plain numbers that are no degrees, one of them beyond 360.
    void set_crs(std::optional<CrsPlaces> crs) { crs_ = std::move(crs); }
    [[nodiscard]] const std::optional<CrsPlaces>& crs() const { return crs_; }

    // The first `limit` names that hold a text, letter case, accents and what is between words set aside:
    // whole names, then beginnings of names, of words, and parts of words; each by source, then by
    // importance.
    [[nodiscard]] std::vector<SearchMatch> matches(const std::string& text, std::size_t limit) const;

    // What to do about a text: a whole name; coordinates (2642950,1166825 where a CRS is set; EPSG:2056
    // 2642950,1166825; en 2642950,1166825 for the CRS that is set, whatever the numbers); a box of four
    // numbers, west first, in degrees or likewise; whatever parse_place() reads; and else the first of
    // matches(). A text of spaces alone is an error, too. Errors (usage): one line for people, to be shown
    // beside the field; `where` is empty.
    [[nodiscard]] Result<SearchTarget> resolve(const std::string& text) const;

  private:
    [[nodiscard]] std::optional<Result<SearchTarget>> read_coordinates(const std::string& text) const;

    std::vector<Bookmark> eyes_;  // those with an eye
    NameTable bookmarks_, points_, gazetteer_;
    std::optional<CrsPlaces> crs_;
};

// The CRS that a search takes eastings and northings in, of a region: what --coordinates names
// (WindowOptions::coordinates), else that of the region's sources where they have one and it is projected.
// Nothing else. Errors (usage): a CRS that is none.
Result<std::optional<CrsPlaces>> search_crs(const std::string& coordinates, const Region& region);

}  // namespace oro
