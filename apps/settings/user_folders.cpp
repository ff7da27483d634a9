#include "apps/settings/user_folders.h"

#include <sys/stat.h>

#include <cstdlib>
#include <system_error>

#include "apps/report/json_fields.h"
#include "apps/report/json_text.h"
#include "core/base/file_there.h"
#include "geo/files/whole_file.h"

namespace oro {
namespace fs = std::filesystem;
namespace {

Result<fs::path> folder_named(const char* variable, const char* in_home) {
    const auto named = [](const char* name) {
        const char* const value = std::getenv(name);
        return fs::path(value ? value : "");
    };
    // The specification wants a relative path passed over.
    if (const fs::path all = named(variable); all.is_absolute()) return all / "orograph";
    if (const fs::path home = named("HOME"); home.is_absolute()) return home / in_home / "orograph";
    return Error{ErrorKind::failed, variable, "is not set, nor is HOME: there is no folder for settings"};
}

}  // namespace

Result<fs::path> user_config_folder() {
    return folder_named("XDG_CONFIG_HOME", ".config");
}

Result<fs::path> user_state_folder() {
    return folder_named("XDG_STATE_HOME", ".local/state");
}

Result<std::string> set_damaged_aside(const fs::path& file, const std::string& why) {
    const fs::path aside = file.string() + ".damaged";
    std::error_code failed;
    fs::rename(file, aside, failed);
    if (failed)
        return Error{ErrorKind::failed, file.string(),
                     "is damaged (" + why + ") and cannot be set aside: " + failed.message()};
    return file.string() + " is damaged (" + why + "): set aside as " + aside.string();
}

Result<UserJson> read_user_json(const fs::path& file) {
    UserJson read;
    ORO_TRY(const bool there, is_there(file.string()));
    if (!there) return read;
    ORO_TRY(const std::string text, read_own_text_file(file.string()));
    std::string why = "it is no JSON object";
    try {
        read.json = parsed_json(text);
        if (read.json.is_object()) return read;
    } catch (const JsonFault& fault) {
        why = fault.what;
    }
    read.json = nullptr;
    ORO_TRY(read.note, set_damaged_aside(file, why));
    return read;
}

Result<void> write_user_json(const fs::path& file, const nlohmann::ordered_json& json) {
    const fs::path folder = file.parent_path();
    std::error_code failed;
    // The specification's mode for folders that are made: 0700.
    if (fs::create_directories(folder, failed)) (void)chmod(folder.c_str(), S_IRWXU);
    if (failed) return Error{ErrorKind::failed, folder.string(), "cannot be made: " + failed.message()};
    return write_whole_file(file.string(), json_text(json, true) + "\n", true);
}

}  // namespace oro
