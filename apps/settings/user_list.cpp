#include "apps/settings/user_list.h"

#include <cerrno>

#include "apps/report/json_fields.h"
#include "apps/settings/user_file.h"
#include "core/base/file_target.h"
#include "core/base/open_file.h"

namespace oro {
namespace {

constexpr int list_format = 1;

}  // namespace

Result<bool> read_user_list(const UserList& list, const std::function<void(const nlohmann::json&)>& take,
                            std::vector<std::string>& notes) {
    ORO_TRY(const nlohmann::json object, read_user_json(list.file, notes));
    if (object.empty()) return true;
    std::string damage;
    try {
        (void)json_whole(object, list.format, list_format, list_format);
        const nlohmann::json& entries = json_field(object, list.entries);
        if (!entries.is_array()) throw JsonFault{"'" + std::string(list.entries) + "' must be a list"};
        for (const nlohmann::json& entry : entries) take(entry);
        return true;
    } catch (const JsonFault& fault) {
        damage = fault.what;
    }
    const std::string from = list.file.string();
    constexpr int most = 99;
    for (int number = 1; number <= most; ++number) {
        const std::string to = from + ".damaged" + (number == 1 ? "" : "." + std::to_string(number));
        const int why = take_file_name(from, to, false);
        if (why == EEXIST) continue;
        if (why != 0 && why != ENOENT)
            return Error{ErrorKind::failed, from, damage + ", and cannot be renamed: " + system_reason(why)};
        if (why == 0) notes.push_back(from + ": " + damage + "; it is now " + to);
        return false;
    }
    return Error{ErrorKind::failed, from, damage + ", and there are 99 damaged ones beside it: remove some"};
}

Result<void> write_user_list(const UserList& list, const nlohmann::json& entries) {
    nlohmann::json object = nlohmann::json::object();
    object[list.format] = list_format;
    object[list.entries] = entries;
    return write_user_json(list.file, object);
}

}  // namespace oro
