// Words that files say of themselves, as they can be shown and written.
#pragma once

#include <string>
#include <string_view>

namespace oro {

// The text in UTF-8 that XML and JSON allow: a byte that is no UTF-8 (an old GeoTIFF's Latin-1), and a
// control character that is no tab or end of line, becomes U+FFFD. What is fine already stays as it is.
std::string foreign_text(std::string_view text);

}  // namespace oro
