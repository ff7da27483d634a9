#include "apps/report/xml_escape.h"

#include <utf8.h>

#include <iterator>

namespace oro {

std::string xml_escaped(const std::string& text) {
    std::string valid, xml;
    utf8::replace_invalid(text.begin(), text.end(), std::back_inserter(valid));
    for (const char c : valid) {
        if (c == '&')
            xml += "&amp;";
        else if (c == '<')
            xml += "&lt;";
        else if (c == '>')
            xml += "&gt;";
        else if (static_cast<unsigned char>(c) < 0x20)
            xml += "\uFFFD";
        else
            xml += c;
    }
    return xml;
}

}  // namespace oro
