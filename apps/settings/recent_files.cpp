#include "apps/settings/recent_files.h"

#include <algorithm>
#include <filesystem>

#include "apps/report/json_object.h"
#include "apps/report/json_fields.h"
#include "apps/settings/user_folders.h"
#include "apps/settings/user_list.h"
#include "core/base/file_there.h"

namespace oro {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t most_paths = 10'000;  // of one entry

Result<UserList> recent_list() {
    ORO_TRY(const fs::path folder, user_state_folder());
    return UserList{folder / "recent.json", "orograph_recent", "opened"};
}

std::vector<std::string> entry_from(const json& entry) {
    if (!entry.is_array() || entry.empty() || entry.size() > most_paths)
        throw JsonFault{"an entry must be a list of paths"};
    std::vector<std::string> paths;
    for (const json& path : entry) paths.push_back(path_from(json_object<json>("path", path), "path"));
    return paths;
}

Result<std::string> absolute_path(const std::string& path) {
    if (path.starts_with("/vsi") || fs::path(path).is_absolute()) return path;
    ORO_TRY(const bool there, is_there(path));
    if (!there) return path;  // a name of GDAL's, which leads from nowhere
    std::error_code failed;
    const fs::path whole = fs::absolute(path, failed);
    if (failed) return no_answer(path, failed);
    return whole.lexically_normal().string();
}

}  // namespace

Result<RecentFiles> read_recent_files() {
    RecentFiles recent;
    ORO_TRY(const UserList list, recent_list());
    const auto take = [&](const json& entry) {
        std::vector<std::string> paths = entry_from(entry);
        if (recent.all.size() < most_recent_files) recent.all.push_back(std::move(paths));
    };
    ORO_TRY(const bool is_whole, read_user_list(list, take, recent.notes));
    if (!is_whole) recent.all.clear();
    return recent;
}

Result<RecentFiles> add_recent_files(const std::vector<std::string>& paths) {
    if (paths.empty() || paths.size() > most_paths)
        return Error{ErrorKind::usage, "recent files",
                     "an entry has 1 to " + std::to_string(most_paths) + " paths"};
    std::vector<std::string> entry;
    for (const std::string& path : paths) {
        ORO_TRY(std::string whole, absolute_path(path));
        entry.push_back(std::move(whole));
    }
    ORO_TRY(RecentFiles recent, read_recent_files());
    std::erase(recent.all, entry);
    recent.all.insert(recent.all.begin(), entry);
    recent.all.resize(std::min(recent.all.size(), most_recent_files));
    json entries = json::array();
    for (const auto& one : recent.all) {
        json names = json::array();
        for (const std::string& path : one) names.push_back(json(path_json(path)));
        entries.push_back(std::move(names));
    }
    ORO_TRY(const UserList list, recent_list());
    ORO_CHECK(write_user_list(list, entries));
    return recent;
}

}  // namespace oro
