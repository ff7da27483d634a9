// What a window's search field finds, and where it leads (apps/search).
#pragma once

#include <string>
#include <vector>

#include "apps/window/viewer.h"

namespace oro {

// Fills the index: bookmarks, points of the files that are shown, and the CRS of eastings and northings. What
// is wrong with a file is told.
void fill_search(Viewer& viewer);
// Reads gazetteers in the background once the first picture is shown, and adds their names when they are
// there. To be called in every turn.
void take_gazetteers(Viewer& viewer);
// The names that hold what is typed.
void find_matches(Viewer& viewer);
// The same of the points alone, after other files are shown.
void index_points(Viewer& viewer);

// Keeps the view that is shown by the name that is typed (viewer.bookmark_name), removes one, and goes to
// one. What cannot be kept is told.
void keep_bookmark(Viewer& viewer);
void drop_bookmark(Viewer& viewer, const std::string& name);
void go_to_bookmark(Viewer& viewer, const Bookmark& bookmark);

// To what the search field says, or to the match that is chosen in its list; where that is no place, the
// field says why and stays.
void search(Viewer& viewer);
// To one match.
void go_to(Viewer& viewer, const SearchTarget& target);

}  // namespace oro
