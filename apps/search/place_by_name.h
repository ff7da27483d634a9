// The one place that a name stands for, among the places of files.
#pragma once

#include <string>
#include <vector>

#include "apps/search/search_place.h"
#include "core/base/result.h"

namespace oro {

// Whether a text may be a name: it has a letter.
bool may_be_name(const std::string& text);

struct NamedPlaceFound {
    SearchPlace place;
    bool is_whole{};  // the text is the whole name, and not its beginning
};

// The place whose whole name is the text, letter case, accents and what stands between words set aside
// (folded()); else the only one whose name begins with it. Places of one name within a micro-degree of each
// other are one. Errors (usage): several such places, of which at most five are listed, the most important
// first (importance_of()), each with its height and its latitude and longitude; none, with at most five names
// that hold the text or are spelt nearly so. `where` of an error is empty. source: what the places are of, as
// an error says it ("peaks.geojson").
Result<NamedPlaceFound> place_by_name(const std::string& text, const std::vector<SearchPlace>& places,
                                      const std::string& source);

// Reads places with names from a file: points of whatever read_vectors() takes, whose field `name_field` says
// the name; or else a dump of GeoNames, as read_gazetteer() takes it. Errors: those of read_vectors(); a file
// without a point that has a name.
Result<std::vector<SearchPlace>> read_named_places(const std::string& file, const std::string& name_field);

}  // namespace oro
