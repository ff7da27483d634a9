// Bytes of text files, which come with marks and in several encodings, as UTF-8.
#pragma once

#include <string>

#include "core/base/result.h"

namespace oro {

// The text in UTF-8, without a byte order mark: bytes of UTF-16 and UTF-32 (told by their mark, or where
// there is none by the zero bytes beside a first '<', '{', '[' or '#') are turned into it, what is half a
// character there becomes U+FFFD; all other bytes stay as they are. Errors (a reason, without the file's
// name): UTF-16 or UTF-32 that ends within a unit.
Result<std::string> utf8_text(std::string bytes);

// Text of an XML file in UTF-8: as above, and an encoding that its declaration names is heeded. Errors: as
// above; an encoding that is not known here.
Result<std::string> utf8_xml(std::string bytes);

}  // namespace oro
