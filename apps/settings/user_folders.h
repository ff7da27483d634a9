// The folders that the program keeps a user's files in.
// Source: XDG Base Directory Specification 0.8, https://specifications.freedesktop.org/basedir-spec/0.8/
#pragma once

#include <filesystem>

#include "core/base/result.h"

namespace oro {

// Each gives the folder `orograph` in the one that the specification names; whether it is there is not asked.
// Relative paths in the environment are passed over, as the specification wants it. Errors: neither the
// variable nor HOME holds an absolute path.

// Settings: in XDG_CONFIG_HOME, else in .config of HOME.
Result<std::filesystem::path> user_config_folder();
// What the last run left, such as recent files: in XDG_STATE_HOME, else in .local/state of HOME.
Result<std::filesystem::path> user_state_folder();
// What can be made again: OROGRAPH_CACHE itself, whatever path that is; else in XDG_CACHE_HOME, else in
// .cache of HOME.
Result<std::filesystem::path> user_cache_folder();

}  // namespace oro
