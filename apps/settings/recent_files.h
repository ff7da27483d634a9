// What was opened last.
#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"

namespace oro {

// The list in recent.json of user_state_folder(). Each entry is what was opened together: the paths of a
// region, or a picture or a view alone. The last opened comes first.
struct RecentFiles {
    std::vector<std::vector<std::string>> all;
    std::vector<std::string> notes;  // what the user must know of the file, one line each
};

inline constexpr std::size_t most_recent_files = 20;

// Reads the list; none where there is no file. A damaged file is set aside, and a note says so. Errors: a
// file that cannot be read; no folder for it.
Result<RecentFiles> read_recent_files();
// Puts paths at its head, from where they stood, if they were in it; the oldest beyond most_recent_files go.
// Paths that lead from the working folder are kept as absolute ones; what GDAL alone can open (/vsi...)
// stays. Gives the new list. Errors: no path (usage); a file that cannot be read or written.
Result<RecentFiles> add_recent_files(const std::vector<std::string>& paths);

}  // namespace oro
