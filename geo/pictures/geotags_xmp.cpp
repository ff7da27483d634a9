#include "geo/pictures/geotags_xmp.h"

#include <utf8.h>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <pugixml.hpp>
#include <string_view>

namespace oro {
namespace {

constexpr std::string_view name_space = "urn:orograph:1.0/";

std::string number(double value) {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value);
    return {digits.data(), end.ptr};
}

// XML 1.0 (fifth edition), production 2.
bool xml_allows(std::uint32_t code) {
    if (code < 0x20) return code == '\t' || code == '\n' || code == '\r';
    return code < 0xD800 || (code > 0xDFFF && code < 0xFFFE) || (code > 0xFFFF && code < 0x110000);
}

// As the text of an XML element. A carriage return is written as an entity, for XML readers turn a bare one
// into a line feed; quotes need none.
Result<std::string> escaped(const std::string& what, const std::string& text) {
    std::string xml;
    xml.reserve(text.size() + text.size() / 16);
    const auto refused = [&](std::string::const_iterator at, const char* why) {
        return Error{ErrorKind::failed, "geotags",
                     "the " + what + " holds at byte " + std::to_string(at - text.begin()) + why};
    };
    const auto valid_end = utf8::find_invalid(text.begin(), text.end());
    for (auto at = text.begin(); at != valid_end;) {
        const auto start = at;
        const std::uint32_t code = utf8::unchecked::next(at);
        if (!xml_allows(code)) return refused(start, " a control character");
        switch (code) {
            case '&':
                xml += "&amp;";
                break;
            case '<':
                xml += "&lt;";
                break;
            case '>':
                xml += "&gt;";
                break;
            case '\r':
                xml += "&#xD;";
                break;
            default:
                xml.append(start, at);
        }
    }
    if (valid_end != text.end()) return refused(valid_end, " something that is not UTF-8");
    return xml;
}

// True where every & of a text begins one of XML's five entities or a number of a character that XML allows:
// the parser passes over others as they stand, and a damaged view would be read as another one.
bool entities_are_whole(std::string_view xml) {
    constexpr std::size_t longest = 10;  // &#x10FFFF;
    for (std::size_t at = xml.find('&'); at != std::string_view::npos; at = xml.find('&', at + 1)) {
        const std::size_t stop = xml.substr(0, at + longest).find(';', at);
        if (stop == std::string_view::npos) return false;
        std::string_view name = xml.substr(at + 1, stop - at - 1);
        if (name == "amp" || name == "lt" || name == "gt" || name == "quot" || name == "apos") continue;
        if (!name.starts_with('#')) return false;
        const bool hexadecimal = name.starts_with("#x");
        name.remove_prefix(hexadecimal ? 2 : 1);
        std::uint32_t code = 0;
        const auto end = std::from_chars(name.data(), name.data() + name.size(), code, hexadecimal ? 16 : 10);
        if (end.ec != std::errc{} || end.ptr != name.data() + name.size() || !xml_allows(code)) return false;
    }
    return true;
}

// The prefix that an element or one around it binds to our name space; nothing where none does.
std::optional<std::string> our_prefix(pugi::xml_node element) {
    for (; element; element = element.parent()) {
        for (const pugi::xml_attribute attribute : element.attributes()) {
            const std::string_view name = attribute.name();
            if (name.starts_with("xmlns:") && name_space == attribute.value())
                return std::string(name.substr(6)) + ":";
        }
    }
    return std::nullopt;
}

// Looks for the view in a packet. Other programs may have rewritten it: with another prefix, or with the view
// as an attribute.
class ViewSearch : public pugi::xml_tree_walker {
  public:
    bool for_each(pugi::xml_node& element) override {
        constexpr int deepest = 100;  // packets have 5; each element asks all around it for its prefix
        too_deep = depth() > deepest;
        if (too_deep) return false;
        const auto prefix = our_prefix(element);
        if (!prefix) return true;
        const std::string name = *prefix + "View";
        const pugi::xml_attribute attribute = element.attribute(name.c_str());
        found = attribute || name == element.name();
        if (found) view = attribute ? attribute.value() : element.child_value();
        return !found;
    }

    std::string view;
    bool found{false};
    bool too_deep{false};
};

std::string iso_time(std::int64_t time_utc_s) {
    using namespace std::chrono;
    const sys_seconds time{seconds{time_utc_s}};
    const auto midnight = floor<days>(time);
    const year_month_day date{midnight};
    const hh_mm_ss clock{time - midnight};
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, "%04d-%02u-%02uT%02d:%02d:%02dZ", static_cast<int>(date.year()),
                  static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                  static_cast<int>(clock.hours().count()), static_cast<int>(clock.minutes().count()),
                  static_cast<int>(clock.seconds().count()));
    return buffer;
}

std::string_view media_type(PictureFormat format) {
    switch (format) {
        case PictureFormat::png:
            return "image/png";
        case PictureFormat::jpeg:
            return "image/jpeg";
        case PictureFormat::tiff:
            break;
    }
    return "image/tiff";
}

void put(std::string_view name, std::string_view value, std::string& xmp) {
    (((((xmp += '<') += name) += '>') += value) += "</") += name;
    xmp += ">\n";
}

// Columns count from the left border of the whole circle, whose middle is the picture's; rows of a cylinder
// from its level line, and those above it are negative.
std::string panorama_fields(const Geotags& tags, const PanoramaTag& panorama) {
    std::string xmp;
    const auto whole = [&](std::string_view name, long value) {
        put("GPano:" + std::string(name), std::to_string(value), xmp);
    };
    const long all_around_px = std::lround(tags.width_px * 360.0 / panorama.sweep_deg);
    put("GPano:ProjectionType", "cylindrical", xmp);
    put("GPano:UsePanoramaViewer", "True", xmp);
    put("GPano:PoseHeadingDegrees", number(tags.heading_deg), xmp);
    put("GPano:PosePitchDegrees", "0", xmp);
    put("GPano:PoseRollDegrees", "0", xmp);
    whole("CroppedAreaImageWidthPixels", tags.width_px);
    whole("CroppedAreaImageHeightPixels", tags.height_px);
    whole("FullPanoWidthPixels", all_around_px);
    whole("FullPanoHeightPixels", tags.height_px);
    whole("CroppedAreaLeftPixels", (all_around_px - tags.width_px) / 2);
    whole("CroppedAreaTopPixels", -panorama.level_row_px);
    whole("LargestValidInteriorRectLeft", 0);
    whole("LargestValidInteriorRectTop", panorama.first_row_px);
    whole("LargestValidInteriorRectWidth", tags.width_px);
    whole("LargestValidInteriorRectHeight", panorama.scene_rows_px);
    return xmp;
}

}  // namespace

Result<std::string> xmp_packet(const Geotags& tags, PictureFormat format) {
    ORO_TRY(const std::string software, escaped("software", tags.software));
    ORO_TRY(const std::string rights, escaped("attribution", tags.attribution));
    ORO_TRY(const std::string geoid, escaped("geoid", tags.geoid));
    ORO_TRY(const std::string view, escaped("view", tags.view_json));
    std::string xmp =
        "<?xpacket begin=\"\uFEFF\" id=\"W5M0MpCehiHzreSzNTczkc9d\"?>\n"
        "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\">\n"
        "<rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">\n"
        "<rdf:Description rdf:about=\"\" xmlns:dc=\"http://purl.org/dc/elements/1.1/\""
        " xmlns:xmp=\"http://ns.adobe.com/xap/1.0/\"";
    if (tags.panorama) xmp += " xmlns:GPano=\"http://ns.google.com/photos/1.0/panorama/\"";
    ((xmp += " xmlns:orograph=\"") += name_space) += "\">\n";
    const auto property = [&](std::string_view name, std::string_view value) { put(name, value, xmp); };
    property("dc:format", media_type(format));
    if (!rights.empty())
        property("dc:rights", "<rdf:Alt><rdf:li xml:lang=\"x-default\">" + rights + "</rdf:li></rdf:Alt>");
    if (!software.empty()) property("xmp:CreatorTool", software);
    property("xmp:CreateDate", iso_time(tags.time_utc_s));
    if (tags.panorama) xmp += panorama_fields(tags, *tags.panorama);
    property("orograph:Yaw", number(tags.heading_deg));
    property("orograph:Pitch", number(tags.pitch_deg));
    property("orograph:Roll", number(tags.roll_deg));
    property("orograph:VerticalFieldOfView", number(tags.vertical_fov_deg));
    property("orograph:OrthometricHeight", number(tags.H_m));
    property("orograph:EllipsoidalHeight", number(tags.h_m));
    property("orograph:GeoidUndulation", number(tags.N_m));
    property("orograph:Geoid", geoid);
    property("orograph:View", view);
    xmp += "</rdf:Description>\n</rdf:RDF>\n</x:xmpmeta>\n<?xpacket end=\"w\"?>";
    return xmp;
}

Result<std::string> view_in_xmp(const std::string& packet, const std::string& where) {
    const auto damaged = [&](const std::string& what) { return Error{ErrorKind::failed, where, what}; };
    if (packet.find(name_space) == std::string::npos) return damaged("carries no view of Orograph");
    if (!entities_are_whole(packet)) return damaged("carries XMP with a damaged entity");
    pugi::xml_document document;
    // Line ends stay as they are: what was written comes back to the byte.
    const pugi::xml_parse_result parsed = document.load_buffer(
        packet.data(), packet.size(), (pugi::parse_default | pugi::parse_ws_pcdata) & ~pugi::parse_eol,
        pugi::encoding_utf8);
    if (!parsed)
        return damaged("carries XMP that is damaged at its byte " + std::to_string(parsed.offset) + ": " +
                       parsed.description());
    ViewSearch search;
    document.traverse(search);
    if (search.too_deep) return damaged("carries XMP that is nested too deeply");
    if (!search.found) return damaged("carries no view of Orograph");
    std::string view = search.view;
    if (view.empty()) return damaged("carries an empty view");
    return view;
}

}  // namespace oro
