// A list that the program keeps for a user in a file of its own (apps/settings/user_file.h).
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace oro {

// How such a file is laid out: {"orograph_bookmarks": 1, "bookmarks": [...]}.
struct UserList {
    std::filesystem::path file;
    const char* format;   // the key of its version, which is 1
    const char* entries;  // the key of the list
};

// Gives the entries to `take`, in their order; none where there is no file. A file that is not laid out so,
// or of which `take` refuses an entry (it throws a JsonFault), is renamed as read_user_json() does it, and
// one line about it is added to `notes`; false then. Errors: those of read_user_json().
Result<bool> read_user_list(const UserList& list, const std::function<void(const nlohmann::json&)>& take,
                            std::vector<std::string>& notes);
// Errors: those of write_user_json().
Result<void> write_user_list(const UserList& list, const nlohmann::json& entries);

}  // namespace oro
