#include "geo/sources/elevation_band.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>
#include <vector>

#include "geo/files/foreign_text.h"
#include "geo/files/letter_case.h"
#include "geo/sources/unwritten_parts.h"

namespace oro {
namespace {

Error no_elevation(const std::string& why) {
    return {ErrorKind::failed, "", why};
}

// A reason why a band is no elevation whatever it holds, or "".
std::string never_elevation(GDALRasterBandH band) {
    if (GDALGetRasterColorTable(band) || GDALGetRasterColorInterpretation(band) == GCI_PaletteIndex)
        return "has a colour palette: an image, no elevation";
    if (GDALDataTypeIsComplex(GDALGetRasterDataType(band))) return "holds complex numbers, no elevation";
    return "";
}

// "elevation", "DEM (m)": by the first word of its description.
bool is_called_heights(GDALRasterBandH band) {
    const char* const text = GDALGetDescription(band);
    const std::string name = lower_case(text != nullptr ? foreign_text(text) : "");
    const std::string word = name.substr(0, name.find_first_not_of("abcdefghijklmnopqrstuvwxyz"));
    constexpr std::array words{"elevation", "elevations", "height", "heights", "altitude",
                               "dem",       "dsm",        "dtm",    "z",       "hgt"};
    return std::ranges::find(words, std::string_view(word)) != words.end();
}

// What some posts of a band tell: its codes, if that is what it holds.
enum class Holds { mask, codes, other };

Holds holds(GDALRasterBandH band) {
    constexpr int side = 64;
    constexpr std::size_t most_codes = 16;
    const int columns = GDALGetRasterBandXSize(band), rows = GDALGetRasterBandYSize(band);
    const int wide = std::min(side, columns), tall = std::min(side, rows);
    std::vector<double> values(static_cast<std::size_t>(wide) * static_cast<std::size_t>(tall));
    std::set<double> found;
    for (const auto& [u, v] : {std::pair{0.5, 0.5}, {0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}}) {
        if (GDALRasterIO(band, GF_Read, static_cast<int>(u * (columns - wide)),
                         static_cast<int>(v * (rows - tall)), wide, tall, values.data(), wide, tall,
                         GDT_Float64, 0, 0) != CE_None)
            return Holds::other;
        for (const double value : values) {
            if (std::isnan(value)) continue;
            if (value != std::floor(value) || value < 0.0 || value > 255.0) return Holds::other;
            found.insert(value);
        }
        if (found.size() > most_codes) break;
    }
    const auto is_flag = [](double value) { return value == 0.0 || value == 1.0 || value == 255.0; };
    if (std::ranges::all_of(found, is_flag)) return Holds::mask;
    const bool is_byte = GDALGetRasterDataType(band) == GDT_Byte;
    return is_byte || found.size() <= most_codes ? Holds::codes : Holds::other;
}

// The number of the heights' band among several; 0 where it cannot be told.
int band_of_heights(GDALDatasetH dataset, int bands) {
    std::vector<int> called, others, no_masks;
    for (int band = 1; band <= bands; ++band) {
        const GDALRasterBandH raster = GDALGetRasterBand(dataset, band);
        if (!never_elevation(raster).empty()) continue;
        const bool is_colour = GDALGetRasterColorInterpretation(raster) > GCI_PaletteIndex;
        if (is_called_heights(raster)) called.push_back(band);
        if (is_colour) continue;
        const Holds content = holds(raster);
        if (content == Holds::other) others.push_back(band);
        if (content != Holds::mask && GDALGetRasterDataType(raster) != GDT_Byte) no_masks.push_back(band);
    }
    if (called.size() == 1) return called.front();
    // A plain has few heights, and they may look like codes; what is no mask is then it.
    if (no_masks.size() == 1) return no_masks.front();
    return others.size() == 1 && others.front() == 1 ? 1 : 0;
}

// Where the bytes of a band's sources are signed. GDAL before 3.7 has no type for them, and says so in the
// band's metadata; a VRT says nothing, gives 0 to 255 in whatever type it has, and its sources tell.
enum class SignedBytes { none, all, mixed };

// GDAL from 3.7 on gives signed bytes a type, GDT_Int8, and warns of whoever asks for the mark.
#if GDAL_VERSION_NUM >= GDAL_COMPUTE_VERSION(3, 7, 0)
bool is_marked_signed(GDALRasterBandH) {
    return false;
}
#else
bool is_marked_signed(GDALRasterBandH raster) {
    const char* const type = GDALGetMetadataItem(raster, "PIXELTYPE", "IMAGE_STRUCTURE");
    return type != nullptr && std::string_view(type) == "SIGNEDBYTE";
}
#endif

SignedBytes signed_bytes(GDALDatasetH dataset, int band, int depth) {
    const GDALRasterBandH raster = GDALGetRasterBand(dataset, band);
    if (raster == nullptr) return SignedBytes::none;
    if (is_marked_signed(raster)) return SignedBytes::all;
    constexpr int deepest = 4;
    constexpr std::size_t most_files = 16;  // of a mosaic: one program wrote them all
    std::vector<VrtPart> parts = parts_of_vrt_band(dataset, band);
    if (const auto warped = source_of_warped_vrt(dataset, band)) parts = {*warped};
    if (depth >= deepest) return SignedBytes::none;
    if (parts.size() > most_files) parts.resize(most_files);
    std::size_t all = 0, none = 0;
    for (const VrtPart& part : parts) {
        const Dataset source(GDALOpenEx(part.file.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY,
                                        trusted_drivers(), nullptr, nullptr));
        const SignedBytes own = source ? signed_bytes(source.get(), part.band, depth + 1) : SignedBytes::none;
        if (own == SignedBytes::mixed || (own == SignedBytes::all && part.changes_values))
            return SignedBytes::mixed;
        ++(own == SignedBytes::all ? all : none);
    }
    if (all > 0 && none > 0) return SignedBytes::mixed;
    return all > 0 ? SignedBytes::all : SignedBytes::none;
}

}  // namespace

Result<ElevationBand> elevation_band(GDALDatasetH dataset) {
    const int bands = GDALGetRasterCount(dataset);
    if (bands == 0)
        return no_elevation("holds no raster of its own (a container of several?): name the one to open");
    ElevationBand chosen;
    const bool alpha =
        bands == 2 && GDALGetRasterColorInterpretation(GDALGetRasterBand(dataset, 2)) == GCI_AlphaBand;
    const std::string count = "has " + std::to_string(bands) + " bands";
    if (bands > 1 && !alpha) {
        chosen.band = band_of_heights(dataset, bands);
        const bool bytes = [&] {
            for (int band = 1; band <= bands; ++band)
                if (GDALGetRasterDataType(GDALGetRasterBand(dataset, band)) != GDT_Byte) return false;
            return true;
        }();
        if (chosen.band == 0 || (bytes && bands > 2))
            return no_elevation(count +
                                (bytes ? ": an image, no elevation (which has one)"
                                       : ", and nothing tells which of them holds heights: gdal_translate "
                                         "-b N takes one out (or it is an image, no elevation)"));
        chosen.doubt = count + "; heights are taken from band " + std::to_string(chosen.band) +
                       " (gdal_translate -b N takes another one out)";
    }
    if (const std::string why = never_elevation(GDALGetRasterBand(dataset, chosen.band)); !why.empty())
        return no_elevation(why);
    const SignedBytes bytes = signed_bytes(dataset, chosen.band, 0);
    if (bytes == SignedBytes::mixed)
        return no_elevation(
            "mixes or scales signed bytes (PIXELTYPE=SIGNEDBYTE) as if they were 0 to 255: "
            "convert its sources to Int16 first");
    chosen.signed_bytes = bytes == SignedBytes::all;
    return chosen;
}

}  // namespace oro
