#include "geo/drape/image_values.h"

#include <cpl_conv.h>
#include <cpl_string.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

namespace oro {
namespace {

using ProfileBytes = std::span<const std::byte>;

// A number of so many bytes, the highest first; nothing beyond the end.
std::optional<std::uint32_t> number_at(ProfileBytes bytes, std::size_t at, std::size_t count) {
    if (at > bytes.size() || bytes.size() - at < count) return std::nullopt;
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < count; ++i)
        number = number << 8U | std::to_integer<std::uint32_t>(bytes[at + i]);
    return number;
}

// Four letters as profiles have them.
constexpr std::uint32_t sign(std::string_view letters) {
    std::uint32_t number = 0;
    for (const char letter : letters) number = number << 8U | static_cast<unsigned char>(letter);
    return number;
}

// A tag's bytes; none where the profile has no such tag.
ProfileBytes tag_of(ProfileBytes profile, std::string_view name) {
    constexpr std::size_t header = 128, entry = 12;
    constexpr std::uint32_t most = 1000;
    const std::uint32_t count = std::min(number_at(profile, header, 4).value_or(0), most);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t at = header + 4 + entry * i;
        if (number_at(profile, at, 4) != sign(name)) continue;
        const auto from = number_at(profile, at + 4, 4), size = number_at(profile, at + 8, 4);
        if (!from || !size || *from > profile.size() || *size > profile.size() - *from) return {};
        return profile.subspan(*from, *size);
    }
    return {};
}

// A curve of nothing, of an exponent or of entries, or one of the formulas, which all have their exponent
// first.
bool is_straight(ProfileBytes curve) {
    constexpr double slack = 0.01;
    const auto type = number_at(curve, 0, 4), count = number_at(curve, 8, 4);
    if (type == sign("para")) return number_at(curve, 12, 4) == 0x10000U;
    if (type != sign("curv") || !count) return false;
    if (*count == 0) return true;
    if (*count == 1) return number_at(curve, 12, 2) == 0x100U;
    for (std::size_t i = 0; i < *count; ++i) {
        const auto entry = number_at(curve, 12 + 2 * i, 2);
        if (!entry) return false;
        const double even = static_cast<double>(i) / (*count - 1);
        if (std::abs(*entry / 65535.0 - even) > slack) return false;
    }
    return true;
}

}  // namespace

std::optional<ImageValues> values_by_profile(std::span<const std::byte> profile) {
    if (number_at(profile, 36, 4) != sign("acsp")) return std::nullopt;
    for (const char* const name : {"rTRC", "kTRC"}) {
        const ProfileBytes curve = tag_of(profile, name);
        if (!curve.empty()) return is_straight(curve) ? ImageValues::reflectance : ImageValues::codes;
    }
    // One of tables: of a scanner or a printer.
    return ImageValues::codes;
}

ImageValues values_in(GDALDatasetH dataset, const std::vector<int>& bands) {
    const auto is_byte = [&](int band) {
        return GDALGetRasterDataType(GDALGetRasterBand(dataset, band)) == GDT_Byte;
    };
    if (std::ranges::all_of(bands, is_byte)) return ImageValues::codes;
    const char* const text = GDALGetMetadataItem(dataset, "SOURCE_ICC_PROFILE", "COLOR_PROFILE");
    if (text == nullptr) return ImageValues::reflectance;
    std::string bytes = text;
    bytes.push_back('\0');
    const int size = CPLBase64DecodeInPlace(reinterpret_cast<GByte*>(bytes.data()));
    return values_by_profile(
               std::as_bytes(std::span(bytes).first(static_cast<std::size_t>(std::max(size, 0)))))
        .value_or(ImageValues::reflectance);
}

double white_code(GDALRasterBandH band, double largest) {
    constexpr double of_bytes = 255.0;
    const GDALDataType type = GDALGetRasterDataType(band);
    const bool is_float = GDALDataTypeIsFloating(type) != 0;
    if (is_float && largest <= 1.0) return 1.0;
    if (largest <= of_bytes) return of_bytes;
    int bits = is_float ? 16 : GDALGetDataTypeSizeBits(type) - (GDALDataTypeIsSigned(type) != 0 ? 1 : 0);
    if (const char* const recorded = GDALGetMetadataItem(band, "NBITS", "IMAGE_STRUCTURE"))
        bits = std::clamp(std::atoi(recorded), 1, bits);
    return std::ldexp(1.0, bits) - 1.0;
}

}  // namespace oro
