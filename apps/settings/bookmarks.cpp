#include "apps/settings/bookmarks.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "apps/options/view_limits.h"
#include "apps/report/json_fields.h"
#include "apps/report/json_object.h"
#include "apps/settings/user_folders.h"
#include "apps/settings/user_list.h"
#include "core/base/one_line.h"

namespace oro {
namespace {

namespace limits = view_limits;
using nlohmann::json;

constexpr Limits pitch_deg{-90, 90}, roll_deg{-360, 360};

Result<UserList> bookmarks_list() {
    ORO_TRY(const std::filesystem::path folder, user_config_folder());
    return UserList{folder / "bookmarks.json", "orograph_bookmarks", "bookmarks"};
}

Result<void> write_bookmarks(const std::vector<Bookmark>& all) {
    ORO_TRY(const UserList list, bookmarks_list());
    json entries = json::array();
    for (const Bookmark& bookmark : all) entries.push_back(bookmark_to_json(bookmark));
    return write_user_list(list, entries);
}

// That it can be read again.
Result<void> check_bookmark(const Bookmark& bookmark) {
    const auto refused = [&](const std::string& what) {
        return Error{ErrorKind::usage, "bookmark \"" + bookmark.name + "\"", what};
    };
    if (bookmark.name.empty()) return refused("needs a name");
    if (bookmark.name != one_line(bookmark.name, Joiners::kept_in_words))
        return refused("its name is not one line of text");
    try {
        (void)bookmark_from_json(bookmark_to_json(bookmark));
    } catch (const JsonFault& fault) {
        return refused(fault.what);
    }
    return {};
}

}  // namespace

Bookmark bookmark_from_json(const json& entry) {
    const auto number = [](const json& object, const char* name, const Limits& within) {
        return json_number(object, name, within.low, within.high);
    };
    Bookmark bookmark;
    bookmark.name = json_string(entry, "name");
    bookmark.lat_deg = number(entry, "lat_deg", limits::lat_deg);
    bookmark.lon_deg = number(entry, "lon_deg", limits::lon_deg);
    if (!entry.contains("eye")) return bookmark;
    const json& eye = json_field(entry, "eye");
    bookmark.eye = BookmarkedEye{number(eye, "h_m", limits::eye_h_m), number(eye, "heading_deg", {-360, 360}),
                                 number(eye, "pitch_deg", pitch_deg), number(eye, "roll_deg", roll_deg),
                                 number(eye, "vertical_fov_deg", limits::fov_deg)};
    return bookmark;
}

json bookmark_to_json(const Bookmark& bookmark) {
    json entry =
        json_object<json>("name", bookmark.name, "lat_deg", bookmark.lat_deg, "lon_deg", bookmark.lon_deg);
    if (const auto& eye = bookmark.eye)
        entry["eye"] =
            json_object<json>("h_m", eye->h_m, "heading_deg", eye->heading_deg, "pitch_deg", eye->pitch_deg,
                              "roll_deg", eye->roll_deg, "vertical_fov_deg", eye->vertical_fov_deg);
    return entry;
}

Result<Bookmarks> read_bookmarks() {
    Bookmarks bookmarks;
    ORO_TRY(const UserList list, bookmarks_list());
    const auto take = [&](const json& entry) {
        if (bookmarks.all.size() == most_bookmarks)
            throw JsonFault{"holds more than " + std::to_string(most_bookmarks) + " bookmarks"};
        bookmarks.all.push_back(bookmark_from_json(entry));
    };
    ORO_TRY(const bool is_whole, read_user_list(list, take, bookmarks.notes));
    if (!is_whole) bookmarks.all.clear();
    return bookmarks;
}

Result<Bookmarks> add_bookmark(const Bookmark& bookmark) {
    ORO_CHECK(check_bookmark(bookmark));
    ORO_TRY(Bookmarks bookmarks, read_bookmarks());
    const auto same = std::ranges::find(bookmarks.all, bookmark.name, &Bookmark::name);
    if (same != bookmarks.all.end())
        *same = bookmark;
    else if (bookmarks.all.size() >= most_bookmarks)
        return Error{ErrorKind::usage, "bookmark \"" + bookmark.name + "\"",
                     "there are " + std::to_string(most_bookmarks) + " already: remove one"};
    else
        bookmarks.all.push_back(bookmark);
    ORO_CHECK(write_bookmarks(bookmarks.all));
    return bookmarks;
}

Result<Bookmarks> remove_bookmark(const std::string& name) {
    ORO_TRY(Bookmarks bookmarks, read_bookmarks());
    if (std::erase_if(bookmarks.all, [&](const Bookmark& one) { return one.name == name; }) == 0)
        return Error{ErrorKind::usage, "bookmark \"" + name + "\"", "there is none of that name"};
    ORO_CHECK(write_bookmarks(bookmarks.all));
    return bookmarks;
}

}  // namespace oro
