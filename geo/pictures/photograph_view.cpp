#include "geo/pictures/photograph_view.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <numbers>
#include <pugixml.hpp>
#include <span>
#include <string_view>
#include <utility>

#include "core/base/open_file.h"
#include "core/light/utc_time.h"
#include "geo/pictures/exif_reader.h"

namespace oro {
namespace {

// Tags by number, as EXIF 2.32 (CIPA DC-008-2019) lists them.
namespace exif_tag {
constexpr std::uint16_t width = 0x0100, height = 0x0101, orientation = 0x0112;  // of the image itself
constexpr std::uint16_t time_original = 0x9003, offset_original = 0x9011;
constexpr std::uint16_t focal_length = 0x920A, photo_width = 0xA002, photo_height = 0xA003;
constexpr std::uint16_t plane_x_resolution = 0xA20E, plane_y_resolution = 0xA20F, plane_unit = 0xA210;
constexpr std::uint16_t focal_length_35mm = 0xA405;
constexpr std::uint16_t lat_ref = 1, lat = 2, lon_ref = 3, lon = 4, altitude_ref = 5, altitude = 6;
constexpr std::uint16_t gps_time = 7, direction_ref = 16, direction = 17, map_datum = 18, gps_date = 29;
}  // namespace exif_tag

constexpr double degrees_in_radian = 180.0 / std::numbers::pi;

// Degrees, minutes and seconds, of which the last may be left out; negative by the letter `below`.
std::optional<double> dms_deg(const ExifDirectory& gps, std::uint16_t angle, std::uint16_t ref, char below) {
    const auto parts = gps.numbers.find(angle);
    if (parts == gps.numbers.end() || parts->second.empty() || parts->second.size() > 3) return std::nullopt;
    double value_deg = 0.0, share = 1.0;
    for (const double part : parts->second) {
        value_deg += part * share;
        share /= 60.0;
    }
    if (!std::isfinite(value_deg) || value_deg < 0.0) return std::nullopt;
    return gps.text(ref).starts_with(below) ? -value_deg : value_deg;
}

Result<void> take_place(const ExifDirectory& gps, const std::string& path, PhotographView& view) {
    if (!gps.numbers.contains(exif_tag::lat) && !gps.numbers.contains(exif_tag::lon))
        return Error{ErrorKind::failed, path,
                     "does not tell where it was taken: its EXIF has no GPS position"};
    const auto lat_deg = dms_deg(gps, exif_tag::lat, exif_tag::lat_ref, 'S'),
               lon_deg = dms_deg(gps, exif_tag::lon, exif_tag::lon_ref, 'W');
    if (!lat_deg || !lon_deg || std::abs(*lat_deg) > 90.0 || std::abs(*lon_deg) > 180.0)
        return Error{ErrorKind::failed, path, "does not tell where it was taken: its GPS position is none"};
    view.lat_deg = *lat_deg;
    view.lon_deg = *lon_deg;
    const std::string datum = gps.text(exif_tag::map_datum);
    if (!datum.empty() && datum.find("84") == std::string::npos)
        view.notes.push_back("its position is of the datum '" + datum + "', and is taken as WGS84");
    // 0 and 1: above and below sea level; 2 and 3: above and below the ellipsoid (EXIF 3.0).
    const double ref = gps.number(exif_tag::altitude_ref).value_or(0.0);
    if (const auto height_m = gps.number(exif_tag::altitude)) {
        view.height_m = ref == 1.0 || ref == 3.0 ? -*height_m : *height_m;
        view.is_height_ellipsoidal = ref >= 2.0;
    }
    if (const auto direction_deg = gps.number(exif_tag::direction)) {
        view.heading_deg = std::fmod(*direction_deg, 360.0);
        if (gps.text(exif_tag::direction_ref).starts_with('M'))
            view.notes.push_back("its direction is magnetic: true north is some degrees away");
    }
    return {};
}

// "2024:06:07" as "2024-06-07"; "" of what is no date.
std::string iso_date(std::string text) {
    constexpr std::size_t length = 10;
    if (text.size() < length) return "";
    text.resize(length);
    std::ranges::replace(text, ':', '-');
    return text;
}

void take_time(const ExifDirectories& exif, PhotographView& view) {
    const auto clock = exif.gps.numbers.find(exif_tag::gps_time);
    const std::string date = iso_date(exif.gps.text(exif_tag::gps_date));
    std::string text;
    const auto is_figure = [](double part) { return part >= 0.0 && part < 60.0; };
    if (!date.empty() && clock != exif.gps.numbers.end() && clock->second.size() == 3 &&
        std::ranges::all_of(clock->second, is_figure)) {
        char time[40];
        std::snprintf(time, sizeof time, "T%02d:%02d:%02dZ", static_cast<int>(clock->second[0]),
                      static_cast<int>(clock->second[1]), static_cast<int>(clock->second[2]));
        text = date + time;
    } else if (const std::string local = exif.photo.text(exif_tag::time_original); local.size() >= 19) {
        text = iso_date(local) + "T" + local.substr(11, 8) + exif.photo.text(exif_tag::offset_original);
    }
    if (const auto time_s = utc_time_from(text); time_s.ok()) view.time_utc_s = *time_s;
}

// A whole number of pixels; 0 where there is none.
int pixels(const std::optional<double>& number) {
    constexpr double most_px = 1e9;
    return number && *number >= 1.0 && *number <= most_px ? static_cast<int>(*number) : 0;
}

void take_lens(const ExifDirectories& exif, PhotographView& view) {
    const ExifDirectory& photo = exif.photo;
    int width_px = pixels(photo.number(exif_tag::photo_width)),
        height_px = pixels(photo.number(exif_tag::photo_height));
    if (width_px == 0) width_px = pixels(exif.image.number(exif_tag::width));
    if (height_px == 0) height_px = pixels(exif.image.number(exif_tag::height));
    const bool is_turned = exif.image.number(exif_tag::orientation).value_or(1.0) >= 5.0;
    view.width_px = is_turned ? height_px : width_px;
    view.height_px = is_turned ? width_px : height_px;
    const double film_mm = photo.number(exif_tag::focal_length_35mm).value_or(0.0);
    if (!(film_mm > 0.0) || width_px == 0 || height_px == 0) return;
    double half_height =
        0.5 * std::hypot(36.0, 24.0) / film_mm * view.height_px / std::hypot(width_px, height_px);
    // Inches, cm, mm, micrometres (TIFF/EP has the last two).
    const double unit = photo.number(exif_tag::plane_unit).value_or(2.0);
    const double unit_mm = unit == 3.0 ? 10.0 : unit == 4.0 ? 1.0 : unit == 5.0 ? 0.001 : 25.4;
    const auto focal_mm = photo.number(exif_tag::focal_length),
               per_unit =
                   photo.number(is_turned ? exif_tag::plane_x_resolution : exif_tag::plane_y_resolution);
    if (focal_mm && per_unit && *focal_mm > 0.0 && *per_unit > 0.0) {
        const double finer = 0.5 * view.height_px / *per_unit * unit_mm / *focal_mm;
        // Half of a millimetre, to which the other is rounded, and some more. Of pictures that were made
        // smaller many keep the resolution of the large one.
        if (std::abs(finer / half_height - 1.0) <= 0.6 / film_mm) half_height = finer;
    }
    view.vertical_fov_deg = 2.0 * std::atan(half_height) * degrees_in_radian;
}

// The values of some properties of an XMP packet, by the names that programs usually give them, whether they
// are written as elements or as attributes.
class XmpNumbers : public pugi::xml_tree_walker {
  public:
    bool for_each(pugi::xml_node& element) override {
        constexpr int deepest = 100;
        if (depth() > deepest) return false;
        take(element.name(), element.child_value());
        for (const pugi::xml_attribute attribute : element.attributes())
            take(attribute.name(), attribute.value());
        return true;
    }
    [[nodiscard]] std::optional<double> number(std::string_view name, double low, double high) const {
        for (const auto& [known, value] : all_)
            if (known == name && value >= low && value <= high) return value;
        return std::nullopt;
    }
    bool is_panorama{};

  private:
    void take(std::string_view name, std::string_view text) {
        is_panorama |= name == "GPano:ProjectionType";
        if (!name.starts_with("orograph:") && !name.starts_with("drone-dji:Gimbal")) return;
        if (text.starts_with('+')) text.remove_prefix(1);
        double value = 0.0;
        const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
        if (read.ec == std::errc{} && read.ptr == text.data() + text.size())
            all_.emplace_back(std::string(name), value);
    }

    std::vector<std::pair<std::string, double>> all_;
};

// What XMP tells that EXIF has no tags for. A packet that is damaged tells nothing.
void take_xmp(PictureBytes& bytes, const std::string& path, PhotographView& view) {
    const auto place = find_xmp(bytes, path);
    if (!place.ok() || place->packet.empty()) return;
    pugi::xml_document document;
    if (!document.load_buffer(place->packet.data(), place->packet.size())) return;
    XmpNumbers numbers;
    document.traverse(numbers);
    const auto first = [&](const char* one, const char* other, double most) {
        const auto found = numbers.number(one, -most, most);
        return found ? found : numbers.number(other, -most, most);
    };
    // A camera that hangs level turns to 180 degrees when it is upside down.
    view.pitch_deg = first("orograph:Pitch", "drone-dji:GimbalPitchDegree", 90.0);
    view.roll_deg = first("orograph:Roll", "drone-dji:GimbalRollDegree", 180.0);
    const auto yaw_deg = first("orograph:Yaw", "drone-dji:GimbalYawDegree", 360.0);
    if (!view.heading_deg && yaw_deg) view.heading_deg = *yaw_deg < 0.0 ? *yaw_deg + 360.0 : *yaw_deg;
    if (const auto fov_deg = numbers.number("orograph:VerticalFieldOfView", 1e-3, 179.0))
        view.vertical_fov_deg = fov_deg;
    if (!numbers.is_panorama) return;
    view.vertical_fov_deg.reset();
    view.notes.push_back("it is a panorama: it has no angle of view of a picture on a plane");
}

}  // namespace

Result<PhotographView> photograph_view(const std::string& path) {
    ORO_TRY(const OpenFile file, OpenFile::open(path, OpenFile::Use::read));
    ORO_TRY(const std::uint64_t size, file.size());
    FileBytes bytes(file, size);
    ORO_TRY(const auto exif, find_exif(bytes, path));
    if (!exif) return Error{ErrorKind::failed, path, "does not tell where it was taken: it has no EXIF"};
    PhotographView view;
    ORO_CHECK(take_place(exif->gps, path, view));
    take_time(*exif, view);
    take_lens(*exif, view);
    take_xmp(bytes, path, view);
    return view;
}

}  // namespace oro
