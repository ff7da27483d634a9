#include "geo/pictures/geotags_exif.h"

#include <libexif/exif-data.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <numbers>

namespace oro {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Integers = std::vector<std::uint32_t>;
using Rationals = ExifRationals;

Error unfit(const std::string& what) {
    return {ErrorKind::failed, "geotags", what};
}

// value >= 0 over a power of ten, the finest up to `denominator` whose numerator fits 32 bits.
ExifRational rational(double value, std::uint32_t denominator) {
    while (denominator > 1 && value * denominator > 4294967295.0) denominator /= 10;
    const double numerator = std::min(std::round(value * denominator), 4294967295.0);
    return {static_cast<std::uint32_t>(numerator), denominator};
}

// |angle| as degrees, minutes and seconds. Rounded once, in units of 1e-7 second, so that 59.99999999 seconds
// carry.
Rationals degrees_minutes_seconds(double angle_deg) {
    constexpr std::uint64_t unit = 10'000'000;
    const auto units =
        static_cast<std::uint64_t>(std::llround(std::abs(angle_deg) * 3600 * static_cast<double>(unit)));
    const std::uint64_t minutes = units / (60 * unit);
    return {{static_cast<std::uint32_t>(minutes / 60), 1},
            {static_cast<std::uint32_t>(minutes % 60), 1},
            {static_cast<std::uint32_t>(units % (60 * unit)), static_cast<std::uint32_t>(unit)}};
}

// [0, 360), also after rounding.
ExifRational direction(double angle_deg) {
    constexpr std::uint32_t unit = 10'000;
    const double turned = std::fmod(std::fmod(angle_deg, 360.0) + 360.0, 360.0);
    return {static_cast<std::uint32_t>(std::llround(turned * unit)) % (360 * unit), unit};
}

struct TimeText {
    std::string date;       // 2024:06:07
    std::string date_time;  // 2024:06:07 12:34:56
    std::uint32_t hour{};
    std::uint32_t minute{};
    std::uint32_t second{};
};

Result<TimeText> time_text(std::int64_t time_utc_s) {
    using namespace std::chrono;
    constexpr std::int64_t year_0 = -62167219200;
    constexpr std::int64_t year_10000 = 253402300800;
    if (time_utc_s < year_0 || time_utc_s >= year_10000)
        return unfit("the time " + std::to_string(time_utc_s) + " s is outside the years 0 to 9999");
    const sys_seconds time{seconds{time_utc_s}};
    const auto midnight = floor<days>(time);
    const year_month_day date{midnight};
    const hh_mm_ss clock{time - midnight};
    TimeText text;
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, "%04d:%02u:%02u", static_cast<int>(date.year()),
                  static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()));
    text.date = buffer;
    text.hour = static_cast<std::uint32_t>(clock.hours().count());
    text.minute = static_cast<std::uint32_t>(clock.minutes().count());
    text.second = static_cast<std::uint32_t>(clock.seconds().count());
    std::snprintf(buffer, sizeof buffer, "%s %02u:%02u:%02u", text.date.c_str(), text.hour, text.minute,
                  text.second);
    text.date_time = buffer;
    return text;
}

Result<void> check_position(const std::string& what, double lat_deg, double lon_deg) {
    if (!(std::abs(lat_deg) <= 90)) return unfit(what + "'s latitude is " + std::to_string(lat_deg));
    if (!(std::abs(lon_deg) <= 180)) return unfit(what + "'s longitude is " + std::to_string(lon_deg));
    return {};
}

Result<void> check(const Geotags& tags) {
    ORO_CHECK(check_position("the eye", tags.lat_deg, tags.lon_deg));
    for (const auto& [name, value] : {std::pair{"height H", tags.H_m},
                                      {"height h", tags.h_m},
                                      {"undulation N", tags.N_m},
                                      {"heading", tags.heading_deg},
                                      {"pitch", tags.pitch_deg},
                                      {"roll", tags.roll_deg}})
        if (!std::isfinite(value)) return unfit(std::string("the ") + name + " is not finite");
    if (!(tags.vertical_fov_deg > 0 && tags.vertical_fov_deg < 180))
        return unfit("the field of view is " + std::to_string(tags.vertical_fov_deg) + " degrees");
    if (!tags.destination) return {};
    ORO_CHECK(check_position("the destination", tags.destination->lat_deg, tags.destination->lon_deg));
    if (!std::isfinite(tags.destination->bearing_deg))
        return unfit("the destination's bearing is not finite");
    if (!(tags.destination->distance_m >= 0) || !std::isfinite(tags.destination->distance_m))
        return unfit("the destination's distance is " + std::to_string(tags.destination->distance_m));
    return {};
}

ExifField text(std::uint16_t tag, std::string value) {
    return {tag, ExifType::ascii, std::move(value)};
}
ExifField rationals(std::uint16_t tag, Rationals value) {
    return {tag, ExifType::rational, std::move(value)};
}
ExifField short_integer(std::uint16_t tag, std::uint32_t value) {
    return {tag, ExifType::short_integer, Integers{value}};
}

// Moves them, where an initializer list would copy.
template <class... Fields>
std::vector<ExifField> fields_of(Fields... fields) {
    std::vector<ExifField> all;
    all.reserve(sizeof...(fields));
    (all.push_back(std::move(fields)), ...);
    return all;
}

// Tags by number, as EXIF 2.31 (CIPA DC-008-2016) lists them: the names are the same in libexif and libtiff,
// the macros are not.
std::vector<ExifField> gps_fields(const Geotags& tags, const TimeText& time) {
    const ExifRational height = rational(std::abs(tags.H_m), 10'000);
    const std::uint8_t below = tags.H_m < 0 && height.numerator != 0;
    std::vector<ExifField> fields = fields_of(
        ExifField{0, ExifType::byte, Bytes{2, 3, 0, 0}}, text(1, tags.lat_deg < 0 ? "S" : "N"),
        rationals(2, degrees_minutes_seconds(tags.lat_deg)), text(3, tags.lon_deg < 0 ? "W" : "E"),
        rationals(4, degrees_minutes_seconds(tags.lon_deg)), ExifField{5, ExifType::byte, Bytes{below}},
        rationals(6, {height}), rationals(7, {{time.hour, 1}, {time.minute, 1}, {time.second, 1}}),
        text(16, "T"), rationals(17, {direction(tags.heading_deg)}), text(18, "WGS-84"));
    if (tags.destination) {
        const DestinationTag& destination = *tags.destination;
        for (ExifField& field :
             fields_of(text(19, destination.lat_deg < 0 ? "S" : "N"),
                       rationals(20, degrees_minutes_seconds(destination.lat_deg)),
                       text(21, destination.lon_deg < 0 ? "W" : "E"),
                       rationals(22, degrees_minutes_seconds(destination.lon_deg)), text(23, "T"),
                       rationals(24, {direction(destination.bearing_deg)}), text(25, "K"),
                       rationals(26, {rational(destination.distance_m / 1000, 1'000'000)})))
            fields.push_back(std::move(field));
    }
    // GPSProcessingMethod: entered by hand, not by a receiver. A TIFF must have it.
    fields.push_back(
        {27, ExifType::undefined, Bytes{'A', 'S', 'C', 'I', 'I', 0, 0, 0, 'M', 'A', 'N', 'U', 'A', 'L'}});
    fields.push_back(text(29, time.date));
    return fields;
}

// The field's value as it lies in the block, little-endian.
Bytes encoded(const ExifField& field) {
    Bytes bytes;
    const auto put = [&](std::uint32_t value, int size) {
        for (int i = 0; i < size; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
    };
    if (const auto* string = std::get_if<std::string>(&field.value)) {
        bytes.assign(string->begin(), string->end());
        bytes.push_back(0);
    } else if (const auto* raw = std::get_if<Bytes>(&field.value)) {
        bytes = *raw;
    } else if (const auto* integers = std::get_if<Integers>(&field.value)) {
        for (const std::uint32_t value : *integers) put(value, field.type == ExifType::short_integer ? 2 : 4);
    } else {
        for (const ExifRational& value : std::get<Rationals>(field.value)) {
            put(value.numerator, 4);
            put(value.denominator, 4);
        }
    }
    return bytes;
}

std::size_t component_size(ExifType type) {
    switch (type) {
        case ExifType::short_integer:
            return 2;
        case ExifType::long_integer:
            return 4;
        case ExifType::rational:
            return 8;
        case ExifType::byte:
        case ExifType::ascii:
        case ExifType::undefined:
            break;
    }
    return 1;
}

bool add_fields(ExifMem* memory, ExifContent* directory, const std::vector<ExifField>& fields) {
    for (const ExifField& field : fields) {
        const Bytes bytes = encoded(field);
        const std::unique_ptr<ExifEntry, decltype(&exif_entry_unref)> entry(exif_entry_new_mem(memory),
                                                                            exif_entry_unref);
        auto* const data =
            static_cast<unsigned char*>(exif_mem_alloc(memory, static_cast<ExifLong>(bytes.size())));
        if (!entry || !data) return false;
        std::memcpy(data, bytes.data(), bytes.size());
        entry->tag = static_cast<ExifTag>(field.tag);
        entry->format = static_cast<ExifFormat>(field.type);
        entry->components = bytes.size() / component_size(field.type);
        entry->size = static_cast<unsigned>(bytes.size());
        entry->data = data;
        exif_content_add_entry(directory, entry.get());
    }
    return true;
}

}  // namespace

const double film_diagonal_mm = std::hypot(36.0, 24.0);

double focal_length_35mm(double vertical_fov_deg, int width_px, int height_px) {
    const double half_diagonal_mm = film_diagonal_mm / 2;
    const double half_height = std::tan(vertical_fov_deg * std::numbers::pi / 360);
    return half_diagonal_mm / (half_height * std::hypot(width_px, height_px) / height_px);
}

namespace {

// What tells the angle of view of a picture on a plane; a panorama has no such angle.
std::vector<ExifField> lens_fields(const Geotags& tags) {
    if (tags.panorama) return {};
    const double focal_mm = focal_length_35mm(tags.vertical_fov_deg, tags.width_px, tags.height_px);
    // A frame of the picture's shape with the diagonal of 36 x 24 mm: there the 35 mm equivalent is the focal
    // length itself, and has fractions.
    constexpr std::uint32_t finest = 1'000'000'000;
    const ExifRational pixels_per_cm =
        rational(std::hypot(tags.width_px, tags.height_px) / (film_diagonal_mm / 10), finest);
    return fields_of(
        rationals(0x920A, {rational(focal_mm, finest)}), rationals(0xA20E, {pixels_per_cm}),
        rationals(0xA20F, {pixels_per_cm}), short_integer(0xA210, 3),
        // 0 would mean unknown.
        short_integer(0xA405, static_cast<std::uint32_t>(std::clamp(std::round(focal_mm), 1.0, 65535.0))));
}

std::vector<ExifField> photo_fields(const Geotags& tags, const TimeText& time) {
    std::vector<ExifField> fields = fields_of(
        ExifField{0x9000, ExifType::undefined, Bytes{'0', '2', '3', '1'}}, text(0x9003, time.date_time),
        text(0x9010, "+00:00"), text(0x9011, "+00:00"),
        ExifField{0x9101, ExifType::undefined, Bytes{1, 2, 3, 0}},
        ExifField{0xA000, ExifType::undefined, Bytes{'0', '1', '0', '0'}}, short_integer(0xA001, 1),  // sRGB
        ExifField{0xA002, ExifType::long_integer, Integers{static_cast<std::uint32_t>(tags.width_px)}},
        ExifField{0xA003, ExifType::long_integer,
                  Integers{static_cast<std::uint32_t>(tags.height_px + tags.strip_px)}});
    for (ExifField& field : lens_fields(tags)) fields.push_back(std::move(field));
    // By number, as directories are.
    std::ranges::sort(fields, {}, &ExifField::tag);
    return fields;
}

}  // namespace

Result<ExifFields> exif_fields(const Geotags& tags) {
    ORO_CHECK(check(tags));
    ORO_TRY(const TimeText time, time_text(tags.time_utc_s));
    ExifFields fields;
    fields.image = fields_of(
        rationals(0x011A, {{72, 1}}),  // a resolution must be given, and a picture on no paper has none
        rationals(0x011B, {{72, 1}}), short_integer(0x0128, 2), text(0x0132, time.date_time));
    if (!tags.software.empty()) fields.image.push_back(text(0x0131, tags.software));
    // UTF-8, as the Metadata Working Group's guidelines (2010) ask for.
    if (!tags.attribution.empty()) fields.image.push_back(text(0x8298, tags.attribution));
    fields.photo = photo_fields(tags, time);
    fields.gps = gps_fields(tags, time);
    return fields;
}

namespace {

// libexif leaves out what it has no memory for, and says nothing.
thread_local bool lacked_memory = false;

template <class Memory>
void* noted(Memory* memory) {
    if (memory == nullptr) lacked_memory = true;
    return memory;
}
void* take_memory(ExifLong size) {
    return noted(std::calloc(1, size));
}
void* resize_memory(void* old, ExifLong size) {
    return noted(std::realloc(old, size));
}

}  // namespace

Result<Bytes> exif_block(const ExifFields& fields) {
    lacked_memory = false;
    const std::unique_ptr<ExifMem, decltype(&exif_mem_unref)> memory(
        exif_mem_new(take_memory, resize_memory, std::free), exif_mem_unref);
    const std::unique_ptr<ExifData, decltype(&exif_data_unref)> data(
        memory ? exif_data_new_mem(memory.get()) : nullptr, exif_data_unref);
    if (!data) return unfit("no memory for EXIF");
    exif_data_set_byte_order(data.get(), EXIF_BYTE_ORDER_INTEL);
    unsigned char* block = nullptr;
    unsigned size = 0;
    if (add_fields(memory.get(), data->ifd[EXIF_IFD_0], fields.image) &&
        add_fields(memory.get(), data->ifd[EXIF_IFD_EXIF], fields.photo) &&
        add_fields(memory.get(), data->ifd[EXIF_IFD_GPS], fields.gps))
        exif_data_save_data(data.get(), &block, &size);
    const std::unique_ptr<unsigned char, decltype(&std::free)> owned(block, std::free);
    constexpr unsigned header = 6;  // "Exif\0\0"
    if (lacked_memory) return unfit("no memory for EXIF");
    if (!block || size <= header) return unfit("EXIF could not be written");
    return Bytes(block + header, block + size);
}

}  // namespace oro
