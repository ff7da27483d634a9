#include "geo/fetch/places_source.h"

#include <array>
#include <cctype>
#include <cstdio>
#include <string_view>
#include <utility>

namespace oro {
namespace {

std::string side_text(double value_deg) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.7f", value_deg);
    std::string shortest = text.data();
    while (shortest.back() == '0') shortest.pop_back();
    if (shortest.back() == '.') shortest.pop_back();
    return shortest == "-0" ? "0" : shortest;
}

// As the value of a field of an address. Source: RFC 3986, 2.1 and 2.3.
std::string percent_encoded(std::string_view text) {
    constexpr std::string_view digits = "0123456789ABCDEF";
    std::string encoded;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (std::isalnum(byte) != 0 || std::string_view("-._~").find(c) != std::string_view::npos) {
            encoded += c;
        } else {
            encoded += '%';
            encoded += digits[byte >> 4U];
            encoded += digits[byte & 15U];
        }
    }
    return encoded;
}

}  // namespace

std::string fault_of_address(const std::string& url) {
    if (!url.starts_with("http://") && !url.starts_with("https://"))
        return "'url' must begin with https:// or http://";
    const std::size_t begin = url.find("://") + 3;
    const std::string host = url.substr(begin, url.find_first_of("/?", begin) - begin);
    if (host.empty() || host.find('@') != std::string::npos)
        return "'url' must name a server, and no user or password";
    return "";
}

std::string fault_of(const PlacesSource& source) {
    if (const std::string fault = fault_of_address(source.url); !fault.empty()) return fault;
    for (const char* const side : {"{south}", "{west}", "{north}", "{east}"})
        if (source.query.find(side) == std::string::npos)
            return "'query' must have {south}, {west}, {north} and {east}";
    return "";
}

Result<std::vector<BoundingBox>> boxes_to_ask(const std::vector<BoundingBox>& boxes, double most_deg2) {
    std::vector<BoundingBox> parts;
    double area_deg2 = 0.0;
    for (const BoundingBox& box : boxes) {
        const bool crosses = box.west_deg > box.east_deg;
        if (!crosses) parts.push_back(box);
        if (crosses && box.west_deg < 180.0)
            parts.push_back({box.west_deg, box.south_deg, 180.0, box.north_deg});
        if (crosses && box.east_deg > -180.0)
            parts.push_back({-180.0, box.south_deg, box.east_deg, box.north_deg});
        const double width_deg = box.east_deg - box.west_deg + (crosses ? 360.0 : 0.0);
        area_deg2 += width_deg * (box.north_deg - box.south_deg);
        if (area_deg2 > most_deg2)
            return Error{ErrorKind::usage, bounding_box_text(box),
                         "with it the region has more than " + side_text(most_deg2) +
                             " square degrees: name a smaller box"};
    }
    return parts;
}

std::string url_of(const PlacesSource& source, const BoundingBox& box) {
    std::string query = source.query;
    for (const auto& [field, value_deg] : {std::pair<std::string_view, double>{"{south}", box.south_deg},
                                           {"{west}", box.west_deg},
                                           {"{north}", box.north_deg},
                                           {"{east}", box.east_deg}}) {
        for (std::size_t at = query.find(field); at != std::string::npos; at = query.find(field, at))
            query.replace(at, field.size(), side_text(value_deg));
    }
    return source.url + (source.url.find('?') == std::string::npos ? "?" : "&") +
           "data=" + percent_encoded(query);
}

}  // namespace oro
