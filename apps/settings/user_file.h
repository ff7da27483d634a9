// JSON files that the program keeps for a user: read whatever state they are in, written whole.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace oro {

// Gives the object in a file; an empty one where there is no such file. A file that holds no JSON object is
// renamed to NAME.damaged (NAME.damaged.2 and so on where that is taken), one line about it is added to
// `notes`, and the object is empty: the next call finds no file and says nothing. Errors: a file that cannot
// be read, or a damaged one that cannot be renamed; both are left as they are.
Result<nlohmann::json> read_user_json(const std::filesystem::path& file, std::vector<std::string>& notes);

// Writes an object. Folders that are missing are made, for the user alone (mode 0700). Whoever reads the file
// meanwhile, or writes it, too, finds all of one version. Errors: an object that could not be read again (too
// deep, too long); the system's, and the file is then what it was.
Result<void> write_user_json(const std::filesystem::path& file, const nlohmann::json& object);

}  // namespace oro
