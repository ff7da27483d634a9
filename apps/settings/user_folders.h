// Where the program keeps what belongs to its user, and how: small JSON files in the folders of the XDG Base
// Directory Specification.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "core/base/result.h"

namespace oro {

// The program's folder for what its user has chosen and keeps: `orograph` in $XDG_CONFIG_HOME, else in
// $HOME/.config. It need not be there. Errors: neither names an absolute path.
Result<std::filesystem::path> user_config_folder();
// Likewise for what the program remembers by itself: in $XDG_STATE_HOME, else in $HOME/.local/state.
// Source: XDG Base Directory Specification, version 0.8 (2021).
Result<std::filesystem::path> user_state_folder();

struct UserJson {
    nlohmann::json json;  // an object; null where there is no file
    std::string note;     // what its user must know: that a damaged file was set aside; or ""
};

// Reads such a file. One that is no JSON object is set aside as FILE.damaged (which replaces an earlier one),
// and a note says so. Errors: a file that cannot be read, or cannot be set aside.
Result<UserJson> read_user_json(const std::filesystem::path& file);
// Sets aside a file that is JSON, but not what it must be; `why` says what is wrong. Gives the note.
Result<std::string> set_damaged_aside(const std::filesystem::path& file, const std::string& why);
// Writes such a file, whole or not at all, with its folder, which only its user may enter. Errors: a folder
// or a file that cannot be written.
Result<void> write_user_json(const std::filesystem::path& file, const nlohmann::ordered_json& json);

}  // namespace oro
