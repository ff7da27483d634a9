#include "geo/sources/source_words.h"

#include <array>
#include <cstdio>
#include <string_view>
#include <utility>

namespace oro {
namespace {

template <class Fact>
struct Words {
    Fact fact;
    const char* words;
};

constexpr std::array formats{Words<SourceFormat>{SourceFormat::srtm1_hgt, "SRTM1 .hgt"},
                             Words<SourceFormat>{SourceFormat::srtm3_hgt, "SRTM3 .hgt"}};
constexpr std::array posts{Words<PostsAre>{PostsAre::points, "points"},
                           Words<PostsAre>{PostsAre::cell_centres, "cell centres (area)"}};
constexpr std::array datums{
    Words<DatumFrom>{DatumFrom::dted_egm96, "EGM96 height (DTED metadata: E96)"},
    Words<DatumFrom>{DatumFrom::dted_egm2008, "EGM2008 height (DTED metadata: E08)"},
    Words<DatumFrom>{DatumFrom::hgt_format, "EGM96 height (by definition of .hgt, SRTM's format)"},
    Words<DatumFrom>{DatumFrom::assumed_unstated, "EGM96 height (assumed: the file states none)"},
    Words<DatumFrom>{DatumFrom::assumed_unreadable,
                     "EGM96 height (assumed: PROJ cannot read what the CRS states of heights)"}};
constexpr std::array units{Words<UnitFrom>{UnitFrom::request, " (as told)"},
                           Words<UnitFrom>{UnitFrom::assumed, " (assumed)"}};
constexpr std::array void_methods{
    Words<VoidMethod>{VoidMethod::holes, "holes"},
    Words<VoidMethod>{VoidMethod::filled, "filled by inverse-distance interpolation (GDALFillNodata)"}};

constexpr std::string_view as_specified = " (as told)";
constexpr std::string_view by_name = " (by its name)";
constexpr std::string_view stands_in = "; EGM96 stands in";
constexpr std::string_view copied = "posts copied";
constexpr const char* interpolated =
    "interpolated over its triangles (one post for %lld x %lld of the region)";
constexpr std::string_view resampled = "cubic resampling from ";

// "10", "0.9", "2010.5"
std::string number_words(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

template <class Table, class Fact>
std::string words_in(const Table& table, Fact fact) {
    for (const auto& entry : table)
        if (entry.fact == fact) return entry.words;
    return "";
}

template <class Fact, std::size_t count>
std::optional<Fact> fact_in(const std::array<Words<Fact>, count>& table, std::string_view words) {
    for (const auto& entry : table)
        if (words == entry.words) return entry.fact;
    return std::nullopt;
}

}  // namespace

std::string format_words(const SourceReport& source) {
    return source.format == SourceFormat::raster ? source.driver : words_in(formats, source.format);
}

std::string posts_words(PostsAre which) {
    return words_in(posts, which);
}

std::string datum_words(const HeightDatum& datum) {
    std::string words = words_in(datums, datum.from);
    if (words.empty()) words = datum.name;
    if (datum.from == DatumFrom::specified) words += as_specified;
    if (datum.from == DatumFrom::product) words += by_name;
    return words + std::string(datum.egm96_stands_in ? stands_in : "");
}

std::string horizontal_words(const HorizontalDatum& datum) {
    if (datum.is_wgs84) return "";
    std::string words;
    if (datum.operation.empty())
        words = "how near to WGS84 is not known: PROJ lists no way from it";
    else if (datum.ballpark)
        words =
            "taken as WGS84, because PROJ knows no way from it here (ballpark): off by an unknown amount, "
            "often 100 m and more";
    else if (datum.one_to_two_metres)
        words = "taken as WGS84, within 1 to 2 m";
    else if (datum.unchanged)
        words = "taken as WGS84" + (datum.accuracy_m ? ", within " + number_words(*datum.accuracy_m) + " m"
                                                     : ", how near is not stated");
    else
        words = (datum.accuracy_m ? "within " + number_words(*datum.accuracy_m) + " m of WGS84"
                                  : "how near to WGS84 is not stated") +
                ", by " + datum.operation;
    if (!datum.missing_grids.empty()) {
        std::string grids;
        for (const std::string& grid : datum.missing_grids) grids += (grids.empty() ? "" : " and ") + grid;
        words += "; within " + number_words(datum.accuracy_with_grids_m.value_or(0.0)) + " m with " + grids +
                 ", which PROJ lacks";
    }
    if (datum.frame_epoch)
        words += "; dynamic, reference epoch " + number_words(*datum.frame_epoch) +
                 (datum.coordinate_epoch ? ""
                                         : ", the coordinates' epoch is not stated: ground moves by "
                                           "centimetres a year");
    if (datum.coordinate_epoch) words += "; coordinates of epoch " + number_words(*datum.coordinate_epoch);
    return words;
}

std::string unit_words(const HeightUnit& unit) {
    return unit.name + words_in(units, unit.from);
}

std::string placement_words(const SourceReport& source) {
    if (!source.placement) return "";
    const Placement& placement = *source.placement;
    if (placement.fit == Fit::elsewhere) {
        const std::string code = source.crs.substr(0, source.crs.find(' '));
        return std::string(resampled) + (code.starts_with("EPSG:") ? code : source.crs);
    }
    std::string words(copied);
    if (placement.fit == Fit::every_kth_post) {
        char text[160];
        std::snprintf(text, sizeof text, interpolated, static_cast<long long>(placement.lat_part),
                      static_cast<long long>(placement.lon_part));
        words = text;
    }
    constexpr double too_little_to_tell = 1e-4;
    if (placement.moved_by_posts > too_little_to_tell)
        words += " (moved by up to " + std::to_string(placement.moved_by_posts).substr(0, 6) + " of a post)";
    return words;
}

std::string void_method_words(VoidMethod method) {
    return words_in(void_methods, method);
}

void set_format(SourceReport& source, const std::string& words) {
    const auto known = fact_in(formats, words);
    source.format = known.value_or(SourceFormat::raster);
    source.driver = known ? "" : words;
}

HeightDatum datum_of_words(const std::string& words) {
    HeightDatum datum;
    std::string_view rest = words;
    datum.egm96_stands_in = rest.ends_with(stands_in);
    if (datum.egm96_stands_in) rest.remove_suffix(stands_in.size());
    const auto known = fact_in(datums, rest);
    datum.from = known.value_or(rest.ends_with(as_specified) ? DatumFrom::specified
                                : rest.ends_with(by_name)    ? DatumFrom::product
                                                             : DatumFrom::crs);
    if (datum.from == DatumFrom::specified) rest.remove_suffix(as_specified.size());
    if (datum.from == DatumFrom::product) rest.remove_suffix(by_name.size());
    if (!known) datum.name = rest;
    return datum;
}

HeightUnit unit_of_words(const std::string& words) {
    for (const auto& entry : units) {
        const std::string_view end = entry.words;
        if (words.ends_with(end)) return {words.substr(0, words.size() - end.size()), entry.fact};
    }
    return {words, UnitFrom::file};
}

std::optional<PostsAre> posts_of_words(const std::string& words) {
    return fact_in(posts, words);
}

std::optional<Placement> placement_of_words(const std::string& words) {
    Placement placement;
    long long lat = 1, lon = 1;
    if (words.starts_with(resampled)) return placement;
    if (std::sscanf(words.c_str(), interpolated, &lat, &lon) == 2)
        placement = {Fit::every_kth_post, 0.0, lat, lon};
    else if (words.starts_with(copied))
        placement.fit = Fit::same_posts;
    else
        return std::nullopt;
    if (const std::size_t moved = words.find(" (moved"); moved != std::string::npos)
        std::sscanf(words.c_str() + moved, " (moved by up to %lf", &placement.moved_by_posts);
    return placement;
}

std::optional<VoidMethod> void_method_of_words(const std::string& words) {
    return fact_in(void_methods, words);
}

}  // namespace oro
