// Places that the user keeps by a name.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace oro {

// How the eye looked from a place. Degrees; h_m above the ellipsoid.
struct BookmarkedEye {
    double h_m{};
    double heading_deg{};
    double pitch_deg{};
    double roll_deg{};
    double vertical_fov_deg{};
};

// A place of WGS84, and the eye there, where the whole view is kept.
struct Bookmark {
    std::string name;
    double lat_deg{};
    double lon_deg{};
    std::optional<BookmarkedEye> eye;
};

// The list in bookmarks.json of user_config_folder(), in the order in which they were added.
struct Bookmarks {
    std::vector<Bookmark> all;
    std::vector<std::string> notes;  // what the user must know of the file, one line each
};

// One as JSON, and back; the latter throws JsonFault (apps/report/json_fields.h).
nlohmann::json bookmark_to_json(const Bookmark& bookmark);
Bookmark bookmark_from_json(const nlohmann::json& entry);

// At most so many are kept.
inline constexpr std::size_t most_bookmarks = 10'000;

// Reads them; none where there is no file. A damaged file is set aside, and a note says so. Errors: a file
// that cannot be read; no folder for it.
Result<Bookmarks> read_bookmarks();
// Adds one, in the place of that with the same name, if there is one; reads the file first, so that those of
// another window stay. Gives the new list. Errors: no name, a place or an eye that is none, too many (usage);
// a file that cannot be read or written.
Result<Bookmarks> add_bookmark(const Bookmark& bookmark);
// Removes the one of that name. Gives the new list. Errors: there is none (usage); as above.
Result<Bookmarks> remove_bookmark(const std::string& name);

}  // namespace oro
