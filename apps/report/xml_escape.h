// Text within XML that the program writes.
#pragma once

#include <string>

namespace oro {

// Text as the content of an XML element: `&`, `<` and `>` are written as entities; what XML forbids, and what
// is no UTF-8, becomes U+FFFD. Source: Extensible Markup Language (XML) 1.0, fifth edition, 2008, 2.2
// and 2.4.
std::string xml_escaped(const std::string& text);

}  // namespace oro
