// What a window's search field finds, and where it leads (apps/search).
#pragma once

#include <string>
#include <vector>

#include "apps/window/viewer.h"

namespace oro {

// Fills the index: bookmarks, points of the files that are shown, gazetteers, and the CRS of eastings and
// northings. What is wrong with a file is told. Takes as long as reading gazetteers does.
void fill_search(Viewer& viewer);
// The same of the points alone, after other files are shown.
void index_points(Viewer& viewer);

// To what the search field says, or to the match that is chosen in its list; where that is no place, the
// field says why and stays.
void search(Viewer& viewer);
// To one match.
void go_to(Viewer& viewer, const SearchTarget& target);

}  // namespace oro
