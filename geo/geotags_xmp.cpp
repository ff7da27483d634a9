#include "geo/geotags_xmp.h"

#include <array>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string_view>

namespace oro {
namespace {

constexpr std::string_view name_space = "urn:orograph:1.0/";
constexpr std::string_view view_starts = "<orograph:View>";
constexpr std::string_view view_ends = "</orograph:View>";

std::string number(double value) {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value);
    return {digits.data(), end.ptr};
}

// The code point at `at`, which moves behind it; nothing for what is not UTF-8.
std::optional<std::uint32_t> next_code_point(std::string_view text, std::size_t& at) {
    const auto lead = static_cast<unsigned char>(text[at++]);
    if (lead < 0x80) return lead;
    const int following = lead >= 0xF0 ? 3 : lead >= 0xE0 ? 2 : 1;
    if (lead < 0xC2 || lead > 0xF4) return std::nullopt;
    auto code = static_cast<std::uint32_t>(lead & (0x3F >> following));
    for (int i = 0; i < following; ++i) {
        if (at >= text.size()) return std::nullopt;
        const auto byte = static_cast<unsigned char>(text[at++]);
        if ((byte & 0xC0) != 0x80) return std::nullopt;
        code = code << 6 | (byte & 0x3F);
    }
    constexpr std::array<std::uint32_t, 4> shortest{0, 0x80, 0x800, 0x10000};
    if (code < shortest[static_cast<std::size_t>(following)]) return std::nullopt;
    return code;
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
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t start = at;
        const auto code = next_code_point(text, at);
        if (!code || !xml_allows(*code))
            return Error{ErrorKind::failed, "geotags",
                         "the " + what + " holds at byte " + std::to_string(start) +
                             (code ? " a control character" : " something that is not UTF-8")};
        switch (*code) {
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
                xml.append(text, start, at - start);
        }
    }
    return xml;
}

void append_utf8(std::string& text, std::uint32_t code) {
    const auto put = [&](std::uint32_t byte) { text += static_cast<char>(static_cast<unsigned char>(byte)); };
    if (code < 0x80) return put(code);
    if (code < 0x800) {
        put(0xC0 | code >> 6);
    } else {
        if (code < 0x10000) {
            put(0xE0 | code >> 12);
        } else {
            put(0xF0 | code >> 18);
            put(0x80 | (code >> 12 & 0x3F));
        }
        put(0x80 | (code >> 6 & 0x3F));
    }
    put(0x80 | (code & 0x3F));
}

// "lt", "#38", "#x26": what stands between & and ;.
std::optional<std::uint32_t> entity(std::string_view name) {
    if (name == "amp") return '&';
    if (name == "lt") return '<';
    if (name == "gt") return '>';
    if (name == "quot") return '"';
    if (name == "apos") return '\'';
    if (!name.starts_with('#')) return std::nullopt;
    name.remove_prefix(1);
    const bool hexadecimal = name.starts_with('x');
    if (hexadecimal) name.remove_prefix(1);
    std::uint32_t code = 0;
    const auto end = std::from_chars(name.data(), name.data() + name.size(), code, hexadecimal ? 16 : 10);
    if (end.ec != std::errc{} || end.ptr != name.data() + name.size() || !xml_allows(code))
        return std::nullopt;
    return code;
}

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
        " xmlns:xmp=\"http://ns.adobe.com/xap/1.0/\" xmlns:orograph=\"";
    xmp += name_space;
    xmp += "\">\n";
    const auto property = [&](std::string_view name, std::string_view value) {
        (((((xmp += '<') += name) += '>') += value) += "</") += name;
        xmp += ">\n";
    };
    property("dc:format", media_type(format));
    if (!rights.empty())
        property("dc:rights", "<rdf:Alt><rdf:li xml:lang=\"x-default\">" + rights + "</rdf:li></rdf:Alt>");
    if (!software.empty()) property("xmp:CreatorTool", software);
    property("xmp:CreateDate", iso_time(tags.time_utc_s));
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
    const std::size_t start = packet.find(view_starts);
    if (start == std::string::npos || packet.find(name_space) == std::string::npos)
        return damaged("carries no view of Orograph");
    const std::size_t end = packet.find(view_ends, start);
    if (end == std::string::npos) return damaged("carries a view that is cut off");
    const std::string_view xml(packet.data() + start + view_starts.size(), end - start - view_starts.size());
    std::string view;
    view.reserve(xml.size());
    for (std::size_t at = 0; at < xml.size(); ++at) {
        if (xml[at] != '&') {
            view += xml[at];
            continue;
        }
        constexpr std::size_t longest = 10;  // &#x10FFFF;
        const std::size_t stop = xml.substr(0, at + longest).find(';', at);
        const auto code =
            stop == std::string_view::npos ? std::nullopt : entity(xml.substr(at + 1, stop - at - 1));
        if (!code) return damaged("carries a view that is damaged at its byte " + std::to_string(at));
        append_utf8(view, *code);
        at = stop;
    }
    if (view.empty()) return damaged("carries an empty view");
    return view;
}

}  // namespace oro
