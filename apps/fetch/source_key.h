// The key with which a user is known to a server.
#pragma once

#include <string>

#include "core/base/result.h"

namespace oro {

// The key for a source: what the file `key_file` holds; where that is "", what the environment's variable
// `variable` holds; where that is not set, what the file keys/SOURCE of the user's folder of settings holds.
// A key is 8 to 200 letters, figures, '-', '_', '.' and '~', with blanks around them. No message has any of
// it. Errors: none of these is there (which says where a key belongs); a file that others may read; one that
// holds something else.
Result<std::string> key_for(const std::string& source, const std::string& variable,
                            const std::string& key_file);

}  // namespace oro
