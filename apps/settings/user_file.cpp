#include "apps/settings/user_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <optional>

#include "apps/report/json_fields.h"
#include "core/base/file_target.h"
#include "core/base/json_bounds.h"
#include "core/base/open_file.h"
#include "geo/files/whole_file.h"

namespace oro {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

Error fault_of(const fs::path& file, const std::string& what) {
    return {ErrorKind::failed, file.string(), what};
}

// Another name for a damaged file. Nothing where another window has renamed it meanwhile.
Result<std::optional<fs::path>> set_aside(const fs::path& file, const std::string& damage) {
    constexpr int most = 99;
    for (int number = 1; number <= most; ++number) {
        fs::path other = file;
        other += number == 1 ? ".damaged" : ".damaged." + std::to_string(number);
        const int why = take_file_name(file.string(), other.string(), false);
        if (why == 0) return std::optional(other);
        if (why == ENOENT) return std::optional<fs::path>();
        if (why != EEXIST) return fault_of(file, damage + ", and cannot be renamed: " + system_reason(why));
    }
    return fault_of(
        file, damage + ", and there are " + std::to_string(most) + " damaged ones beside it: remove some");
}

// Makes a folder and those that it lies in. 0, or the system's error number.
int make_own_folder(const fs::path& folder) {
    if (folder.empty() || mkdir(folder.c_str(), S_IRWXU) == 0) return 0;
    int why = errno;
    if (why == ENOENT && folder.has_parent_path() && folder.parent_path() != folder) {
        if (const int above = make_own_folder(folder.parent_path()); above != 0) return above;
        why = mkdir(folder.c_str(), S_IRWXU) == 0 ? 0 : errno;
    }
    std::error_code unknown;
    return why == EEXIST && fs::is_directory(folder, unknown) ? 0 : why;
}

}  // namespace

Result<json> read_user_json(const fs::path& file, std::vector<std::string>& notes) {
    struct stat found {};
    if (stat(file.c_str(), &found) != 0 && (errno == ENOENT || errno == ENOTDIR)) return json::object();
    ORO_TRY(const std::string text, read_own_text_file(file.string()));
    std::string damage;
    try {
        json object = parsed_json(text);
        if (object.is_object()) return object;
        damage = std::string("is no JSON object, but ") + object.type_name();
    } catch (const JsonFault& fault) {
        damage = fault.what;
    }
    ORO_TRY(const std::optional<fs::path> other, set_aside(file, damage));
    if (other) notes.push_back(fault_of(file, damage + "; it is now " + other->string()).line());
    return json::object();
}

Result<void> write_user_json(const fs::path& file, const json& object) {
    const std::string text = object.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
    if (const auto much = beyond_json_bounds(text)) return fault_of(file, "is not written: " + *much);
    if (const int why = make_own_folder(file.parent_path()); why != 0)
        return fault_of(file.parent_path(), "cannot be made: " + system_reason(why));
    ORO_TRY(WholeFile whole, WholeFile::create(file.string(), true));
    ORO_CHECK(whole.write(text.data(), text.size()));
    return whole.commit_own();
}

}  // namespace oro
