#include "apps/fetch/source_key.h"

#include <sys/stat.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>

#include "apps/command_line/refusals.h"
#include "apps/report/json_fields.h"
#include "apps/settings/user_folders.h"
#include "core/base/file_there.h"

namespace oro {
namespace {

constexpr std::size_t fewest_letters = 8, most_letters = 200;

Result<std::string> key_in(std::string text, const std::string& where) {
    constexpr const char* blanks = " \t\r\n";
    text.erase(0, text.find_first_not_of(blanks));
    text.erase(text.find_last_not_of(blanks) + 1);
    const bool is_plain = std::ranges::all_of(text, [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.' || c == '~';
    });
    if (is_plain && text.size() >= fewest_letters && text.size() <= most_letters) return text;
    return Error{ErrorKind::failed, where,
                 "holds no key: a key is 8 to 200 letters, figures, '-', '_', '.' and '~', and nothing else"};
}

Result<std::string> key_in_file(const std::string& file) {
    struct stat status {};
    if (stat(file.c_str(), &status) == 0 && (status.st_mode & (S_IRGRP | S_IROTH)) != 0)
        return Error{ErrorKind::failed, file, "may be read by others: make it yours alone with chmod 600"};
    ORO_TRY(const std::string text, read_own_text_file(file));
    return key_in(text, file);
}

}  // namespace

Result<std::string> key_for(const std::string& source, const std::string& variable,
                            const std::string& key_file) {
    if (!key_file.empty()) return key_in_file(key_file);
    if (const char* const value = std::getenv(variable.c_str()); value != nullptr && *value != '\0')
        return key_in(value, variable);
    const auto folder = user_config_folder();
    const std::string own = folder.ok() ? (*folder / "keys" / source).string() : "";
    if (!own.empty()) {
        ORO_TRY(const bool is_own_there, is_there(own));
        if (is_own_there) return key_in_file(own);
    }
    return refused("--source", source,
                   "needs a key of your own: put it into a file and name that with --key-file, or into " +
                       (own.empty() ? "" : own + ", or into ") + "the environment as " + variable);
}

}  // namespace oro
