#include "geo/sources/height_unit.h"

#include <cpl_vsi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string_view>

#include "geo/datum/proj_operations.h"
#include "geo/files/foreign_text.h"
#include "geo/files/letter_case.h"
#include "geo/files/name_pattern.h"

namespace oro {
namespace {

struct CloseStream {
    void operator()(VSILFILE* file) const { VSIFCloseL(file); }
};
using Stream = std::unique_ptr<VSILFILE, CloseStream>;

std::string bytes_from(VSILFILE* file, std::uint64_t place, std::size_t length) {
    std::string bytes(length, '\0');
    if (VSIFSeekL(file, place, SEEK_SET) != 0) return "";
    bytes.resize(VSIFReadL(bytes.data(), 1, length, file));
    return bytes;
}

// The first directory of a TIFF (Adobe, TIFF 6.0; BigTIFF has 8 bytes where it has 2 or 4).
class TiffDirectory {
  public:
    explicit TiffDirectory(VSILFILE* file) : file_(file) {
        const std::string head = bytes_from(file, 0, 16);
        little_ = head.starts_with("II");
        if (head.size() < 16 || (!little_ && !head.starts_with("MM"))) return;
        const std::uint64_t version = number(head, 2, 2);
        if (version != 42 && version != 43) return;
        big_ = version == 43;
        const std::uint64_t place = big_ ? number(head, 8, 8) : number(head, 4, 4);
        const std::size_t wide = big_ ? 8 : 2;
        const std::uint64_t entries = number(bytes_from(file, place, wide), 0, wide);
        constexpr std::uint64_t most_entries = 4096;
        entries_ = bytes_from(file, place + wide,
                              std::min(entries, most_entries) * static_cast<std::uint64_t>(entry_bytes()));
    }

    // The bytes of a tag's values, each `each` bytes long; at most 1 MiB of them; "" where it is not there.
    [[nodiscard]] std::string values_of(std::uint64_t tag, std::size_t each) const {
        const std::size_t wide = big_ ? 8 : 4;
        for (std::size_t at = 0; at + entry_bytes() <= entries_.size(); at += entry_bytes()) {
            if (number(entries_, at, 2) != tag) continue;
            constexpr std::uint64_t most_bytes = std::uint64_t{1} << 20U;
            const std::uint64_t bytes =
                std::min(number(entries_, at + 4, wide), most_bytes) * static_cast<std::uint64_t>(each);
            const std::size_t value = at + 4 + wide;
            if (bytes <= wide) return entries_.substr(value, bytes);
            return bytes_from(file_, number(entries_, value, wide), std::min(bytes, most_bytes));
        }
        return "";
    }
    [[nodiscard]] std::uint64_t number(std::string_view bytes, std::size_t at, std::size_t length) const {
        std::uint64_t value = 0;
        if (at + length > bytes.size()) return 0;
        for (std::size_t i = 0; i < length; ++i) {
            const std::size_t byte = little_ ? at + length - 1 - i : at + i;
            value = value << 8U | static_cast<unsigned char>(bytes[byte]);
        }
        return value;
    }

  private:
    [[nodiscard]] std::size_t entry_bytes() const { return big_ ? 20 : 12; }
    VSILFILE* file_;
    bool little_{true};
    bool big_{false};
    std::string entries_;
};

struct LengthUnit {
    std::string name;
    double metres{};
};

std::string name_of_metres(double metres) {
    for (const auto& [name, value] : {std::pair{"m", 1.0},
                                      {"km", 1000.0},
                                      {"ft", 0.3048},
                                      {"us-ft", 1200.0 / 3937.0},
                                      {"cm", 0.01},
                                      {"dm", 0.1},
                                      {"mm", 0.001}})
        if (std::abs(metres - value) < 1e-9 * value) return name;
    return std::to_string(metres) + " m";
}

// A unit by its code of EPSG's; nothing where PROJ does not know it as a length.
std::optional<LengthUnit> epsg_unit(int code) {
    const ProjContext context = new_proj_context();
    const char* name = nullptr;
    const char* category = nullptr;
    double metres = 0.0;
    if (!context || !proj_uom_get_info_from_database(context.get(), "EPSG", std::to_string(code).c_str(),
                                                     &name, &metres, &category))
        return std::nullopt;
    if (category == nullptr || std::string_view(category) != "linear" || !(metres > 0.0)) return std::nullopt;
    const std::string short_name = name_of_metres(metres);
    return LengthUnit{short_name.ends_with(" m") && name != nullptr ? foreign_text(name) : short_name,
                      metres};
}

// The unit that all GeoTIFFs of a VRT share by their keys.
std::optional<int> shared_vertical_unit(const std::vector<std::string>& parts) {
    constexpr std::size_t most_parts = 64;
    std::optional<int> shared;
    for (std::size_t i = 0; i < std::min(parts.size(), most_parts); ++i) {
        const std::string name = lower_case(parts[i]);
        if (!name.ends_with(".tif") && !name.ends_with(".tiff")) continue;
        const auto unit = geotiff_heights(parts[i]).vertical_unit;
        if (!unit || (shared && *shared != *unit)) return std::nullopt;
        shared = unit;
    }
    return shared;
}

// A word of a unit's name: what it stands for, where it is one by itself; else what it tells of others.
struct UnitWord {
    enum class Kind { unit, foot, of_us, of_all, above_sea };
    std::string_view words;
    Kind kind;
    double metres{};
};
constexpr double foot_m = 0.3048;
constexpr double us_survey_foot_m = 1200.0 / 3937.0;
constexpr std::array words_of_units{
    UnitWord{"m|metre|metres|meter|meters|mtr|mtrs", UnitWord::Kind::unit, 1.0},
    UnitWord{"km|kilometre|kilometres|kilometer|kilometers", UnitWord::Kind::unit, 1000.0},
    UnitWord{"dm|decimetre|decimetres|decimeter|decimeters", UnitWord::Kind::unit, 0.1},
    UnitWord{"cm|centimetre|centimetres|centimeter|centimeters", UnitWord::Kind::unit, 0.01},
    UnitWord{"mm|millimetre|millimetres|millimeter|millimeters", UnitWord::Kind::unit, 0.001},
    UnitWord{"ift|ftint", UnitWord::Kind::unit, foot_m},
    UnitWord{"usft|ftus|sft|sftus", UnitWord::Kind::unit, us_survey_foot_m},
    UnitWord{"ft|foot|feet", UnitWord::Kind::foot, foot_m},
    UnitWord{"us|usa|survey", UnitWord::Kind::of_us},
    UnitWord{"international|intl|int", UnitWord::Kind::of_all},
    UnitWord{"above|mean|sea|level|asl|amsl|msl|masl|mamsl", UnitWord::Kind::above_sea},
};

// A unit's name in small letters, word by word: "U.S. survey-feet" is "us", "survey", "feet".
std::vector<std::string> words_of_unit(std::string_view name) {
    std::string plain = lower_case(name);
    for (const auto& [spaced, joined] : {std::pair{"a. s. l.", "asl"}, {"a. m. s. l.", "amsl"}})
        if (plain.ends_with(spaced)) plain.replace(plain.rfind("a. "), std::string::npos, joined);
    std::vector<std::string> words{""};
    for (const char c : plain) {
        if (c == '.') continue;
        if (std::string_view(" \t_-()[]").find(c) == std::string_view::npos)
            words.back() += c;
        else if (!words.back().empty())
            words.emplace_back();
    }
    if (words.back().empty()) words.pop_back();
    return words;
}

// One that says what heights count in, and who it is.
struct Saying {
    const char* who;
    std::string name;
    double metres{};
};

// All that say it, by precedence.
Result<std::vector<Saying>> sayings_of(const Source& source, GDALDatasetH dataset,
                                       const HeightUnitSays& says) {
    std::vector<Saying> all;
    const bool is_vrt = source.report.driver == "VRT";
    const GeoTiffHeights tiff =
        source.report.driver == "GTiff" ? geotiff_heights(source.file) : GeoTiffHeights{};
    const auto key = is_vrt ? shared_vertical_unit(says.parts) : tiff.vertical_unit;
    const char* const type = GDALGetRasterUnitType(GDALGetRasterBand(dataset, source.band));
    const std::string stated = type != nullptr ? foreign_text(type) : "";
    constexpr int user_defined = 32767;
    const bool has_key = key && *key != user_defined;
    // Without a unit of its own a TIFF's band has that of the vertical CRS, which the key makes precise.
    const bool band_is_crs = has_key && !is_vrt && !tiff.band_has_unit;
    if (!stated.empty() && !band_is_crs) {
        const auto metres = metres_in(stated);
        if (!metres)
            return Error{ErrorKind::failed, "",
                         "gives its heights in '" + stated +
                             "', which is no known unit of height; --height-unit " + height_unit_words() +
                             " tells it"};
        all.push_back({"its band", stated, *metres});
    }
    if (has_key) {
        const auto unit = epsg_unit(*key);
        if (!unit)
            return Error{ErrorKind::failed, "",
                         "gives its heights in EPSG's unit " + std::to_string(*key) +
                             " (GeoKey 4099), which is no known unit of height; --height-unit " +
                             height_unit_words() + " tells it"};
        all.push_back({"its GeoKey 4099 (VerticalUnitsGeoKey)", unit->name, unit->metres});
    }
    const double of_crs = std::abs(says.datum.metres_per_unit);
    const bool crs_says = !source.vertical_crs.empty() && source.report.vertical_datum.from == DatumFrom::crs;
    if (crs_says || (!source.vertical_crs.empty() && of_crs != 1.0))
        all.push_back({"its coordinate reference system", name_of_metres(of_crs), of_crs});
    const auto zunits = metres_of_zunits(source.file);
    // Who says it before decides.
    if (!zunits.ok() && all.empty()) return zunits.error();
    if (zunits.ok() && *zunits)
        all.push_back({"Zunits of its .prj file", name_of_metres(**zunits), **zunits});
    return all;
}

// Two units of which one may be meant for the other: more than rounding apart.
bool differ(double a_m, double b_m) {
    return std::abs(a_m - b_m) > 1e-5 * std::max(a_m, b_m);
}

// Where a CRS counts in another unit than metres, and nothing says what heights count in.
std::string metres_assumed(OGRSpatialReferenceH horizontal) {
    if (!OSRIsProjected(horizontal)) return "";
    char* name = nullptr;
    const double metres = OSRGetLinearUnits(horizontal, &name);
    if (!(metres > 0.0) || !differ(metres, 1.0)) return "";
    const std::string called = name != nullptr ? foreign_text(name) : "";
    const std::string option = name_of_metres(metres);
    return "its coordinate reference system counts in " + (called.empty() ? option : called) +
           ", and nothing says what its heights count in; metres are assumed (--height-unit " +
           (metres_in(option) ? option : "ft") + " tells it otherwise)";
}

}  // namespace

std::string height_unit_words() {
    return "m, ft, us-ft, cm, dm or mm";
}

std::optional<double> metres_in(const std::string& unit) {
    std::optional<double> metres;
    bool foot = false, of_us = false, of_all = false;
    for (const std::string& word : words_of_unit(unit)) {
        const auto known = std::ranges::find_if(
            words_of_units, [&](const UnitWord& one) { return matches_name(one.words, word); });
        if (known == words_of_units.end()) return std::nullopt;
        if (known->kind == UnitWord::Kind::unit) {
            if (metres && *metres != known->metres) return std::nullopt;
            metres = known->metres;
        }
        foot = foot || known->kind == UnitWord::Kind::foot;
        of_us = of_us || known->kind == UnitWord::Kind::of_us;
        of_all = of_all || known->kind == UnitWord::Kind::of_all;
    }
    if (of_us && of_all) return std::nullopt;
    if (!foot) return of_us || of_all ? std::nullopt : metres;
    const double length_m = of_us ? us_survey_foot_m : foot_m;
    if (metres && *metres != length_m) return std::nullopt;
    return length_m;
}

GeoTiffHeights geotiff_heights(const std::string& file) {
    GeoTiffHeights heights;
    const Stream stream(VSIFOpenL(file.c_str(), "rb"));
    if (!stream) return heights;
    const TiffDirectory directory(stream.get());
    // Four numbers a key (OGC 19-008r4, 7.1): its number, where its value stands (0: here), how many, the
    // value.
    const std::string keys = directory.values_of(34735, 2);
    for (std::size_t at = 8; at + 8 <= keys.size(); at += 8) {
        if (directory.number(keys, at, 2) == 4099 && directory.number(keys, at + 2, 2) == 0)
            heights.vertical_unit = static_cast<int>(directory.number(keys, at + 6, 2));
    }
    if (heights.vertical_unit == 0) heights.vertical_unit.reset();  // undefined
    heights.band_has_unit = directory.values_of(42112, 1).find("role=\"unittype\"") != std::string::npos;
    return heights;
}

Result<std::optional<double>> metres_of_zunits(const std::string& raster_file) {
    const std::optional<double> nothing;
    const std::size_t dot = raster_file.rfind('.');
    if (dot == std::string::npos || raster_file.find('/', dot) != std::string::npos) return nothing;
    std::string text;
    for (const char* ending : {".prj", ".PRJ"}) {
        const std::string name = raster_file.substr(0, dot) + ending;
        VSIStatBufL status;
        if (VSIStatExL(name.c_str(), &status, VSI_STAT_EXISTS_FLAG | VSI_STAT_NATURE_FLAG) != 0 ||
            !VSI_ISREG(status.st_mode))
            continue;
        const Stream stream(VSIFOpenL(name.c_str(), "rb"));
        if (stream) text = lower_case(bytes_from(stream.get(), 0, 65536));
        break;
    }
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
        std::string line = text.substr(at, end - at);
        at = end + 1;
        line.erase(0, line.find_first_not_of(" \t"));
        if (!line.starts_with("zunits") || line.find_first_of(" \t") != 6) continue;
        line.erase(0, line.find_first_not_of(" \t", 6));
        line.erase(line.find_last_not_of(" \t") + 1);
        if (const auto metres = metres_in(line)) return metres;
        // A number is units to a metre.
        char* rest = nullptr;
        const double to_a_metre = std::strtod(line.c_str(), &rest);
        if (rest != line.c_str() && *rest == '\0' && std::isfinite(to_a_metre) && to_a_metre > 0.0)
            return std::optional(1.0 / to_a_metre);
        if (line.empty() || matches_name("no|none|unknown|undefined", line)) return nothing;
        return Error{ErrorKind::failed, "",
                     "gives its heights in '" + foreign_text(line) +
                         "' (Zunits of its .prj file), which is no known unit of height; --height-unit " +
                         height_unit_words() + " tells it"};
    }
    return nothing;
}

Result<void> read_height_unit(Source& source, GDALDatasetH dataset, const HeightUnitSays& says,
                              std::vector<std::string>& doubts) {
    double metres = 1.0;
    HeightUnit& unit = source.report.height_unit;
    if (!says.specified_unit.empty()) {
        const auto specified = metres_in(says.specified_unit);
        if (!specified)
            return Error{ErrorKind::usage, "height unit '" + says.specified_unit + "'",
                         "is none of m, ft, us-ft, cm, dm, mm"};
        metres = *specified;
        unit = {says.specified_unit, UnitFrom::request};
    } else {
        ORO_TRY(const std::vector<Saying> all, sayings_of(source, dataset, says));
        if (!all.empty()) {
            metres = all.front().metres;
            unit.name = all.front().name;
        } else {
            unit.from = source.vertical_crs.empty() ? UnitFrom::assumed : UnitFrom::file;
        }
        const auto other = std::ranges::find_if(
            all, [&](const Saying& one) { return differ(one.metres, all.front().metres); });
        if (other != all.end())
            doubts.push_back(all.front().who + std::string(" gives heights in ") + all.front().name + ", " +
                             other->who + " in " + other->name + "; " + all.front().name +
                             " is taken (--height-unit tells it otherwise)");
        if (unit.from == UnitFrom::assumed)
            if (std::string doubt = metres_assumed(says.horizontal); !doubt.empty())
                doubts.push_back(std::move(doubt));
    }
    if (says.datum.metres_per_unit < 0.0) metres = -metres;  // depths
    const GDALRasterBandH band = GDALGetRasterBand(dataset, source.band);
    int scaled = 0, shifted = 0;
    const double scale = GDALGetRasterScale(band, &scaled);
    const double offset = GDALGetRasterOffset(band, &shifted);
    source.scale_m = (scaled && scale != 0.0 ? scale : 1.0) * metres;
    source.offset_m = (shifted ? offset : 0.0) * metres;
    return {};
}

}  // namespace oro
