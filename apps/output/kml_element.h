// Elements that the program's KML files have in common.
#pragma once

#include <cmath>
#include <cstdio>
#include <string>

#include "apps/report/xml_escape.h"
#include "geo/files/foreign_text.h"

namespace oro {

// An element with a number, exact to 1e-9; never "-0.000000000".
inline std::string kml_element(const char* name, double value) {
    constexpr double half_a_digit = 5.0e-10;
    char text[120];
    std::snprintf(text, sizeof text, "<%s>%.9f</%s>", name, std::abs(value) < half_a_digit ? 0.0 : value,
                  name);
    return text;
}

// The name of a picture's file, and who is to be named for its data; "" leaves the description out.
inline std::string kml_name_and_description(const std::string& picture_name, const std::string& attribution) {
    std::string text = "  <name>" + xml_escaped(foreign_text(picture_name)) + "</name>\n";
    if (!attribution.empty()) text += "  <description>" + xml_escaped(attribution) + "</description>\n";
    return text;
}

}  // namespace oro
