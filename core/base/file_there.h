// What names lead to. A file system that cannot tell (no memory, a disk that fails) is an error, never "no":
// <filesystem> makes both alike.
#pragma once

#include <string>
#include <system_error>

#include "core/base/result.h"

namespace oro {

// True where a question about a name failed for another reason than the name: neither yes nor no.
[[nodiscard]] bool is_no_answer(const std::error_code& failed);

// The Error of a question about `path` that has no answer.
Error no_answer(const std::string& path, const std::error_code& failed);

// Whether `path` leads to anything. Names that cannot lead anywhere (too long, through what is no folder or
// may not be searched) lead to nothing.
Result<bool> is_there(const std::string& path);

// Whether two names lead to one file or folder; false where one leads to nothing.
Result<bool> is_same_file(const std::string& path, const std::string& other);

}  // namespace oro
