#include "apps/settings/user_folders.h"

#include <cstdlib>
#include <string>

namespace oro {
namespace {

namespace fs = std::filesystem;

fs::path path_in(const char* variable) {
    const char* const value = std::getenv(variable);
    return fs::path(value ? value : "");
}

Result<fs::path> user_folder(const char* variable, const char* in_home) {
    if (const fs::path all = path_in(variable); all.is_absolute()) return all / "orograph";
    if (const fs::path home = path_in("HOME"); home.is_absolute()) return home / in_home / "orograph";
    return Error{ErrorKind::failed, variable,
                 "neither it nor HOME is set to an absolute path: there is no folder for this user's files"};
}

}  // namespace

Result<fs::path> user_config_folder() {
    return user_folder("XDG_CONFIG_HOME", ".config");
}

Result<fs::path> user_state_folder() {
    return user_folder("XDG_STATE_HOME", ".local/state");
}

Result<fs::path> user_cache_folder() {
    if (const fs::path own = path_in("OROGRAPH_CACHE"); !own.empty()) return own;
    return user_folder("XDG_CACHE_HOME", ".cache");
}

}  // namespace oro
