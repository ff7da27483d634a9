#include "geo/sources/raster_content.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <vector>

#include "core/terrain/post_grid.h"
#include "geo/files/letter_case.h"
#include "geo/files/name_pattern.h"
#include "geo/files/raster_library.h"
#include "geo/sources/known_products.h"

namespace oro {
namespace {

// What is made of heights by gdaldem and its like: words that a name ends in, and the values that it has.
// Heights of mountains fit none of these.
struct Derived {
    std::string_view words, holds;
    double lowest, highest;
    bool anywhere{};  // in a name, not as its last word alone
    // Up to here if they come close to 0, as what level ground has: slopes in per cent, steps of coarse
    // posts.
    double steepest{};
    bool whole_bytes{};  // of whole numbers of one byte alone: heights may have such a name
};
constexpr std::array derived{
    Derived{"hillshade*|shadedrelief|shaded", "a hillshade", 0.0, 255.0, true},
    Derived{"hs|hshd|shade*|shading|shadow*|hillshd", "a hillshade", 0.0, 255.0, true, 0.0, true},
    Derived{"aspect*", "aspect", -180.0, 360.0, true},
    Derived{"slope*|steepness", "slope", 0.0, 90.0, true, 2000.0},
    Derived{"roughness|ruggedness|tri|vrm", "roughness", 0.0, 100.0, true, 2000.0},
    Derived{"tpi", "position beside its neighbours", -50.0, 50.0, true, 1000.0},
};

// What gdaldem writes for flat ground, whether it is declared as no-data or not.
constexpr double no_direction = -9999.0;

struct ValueRange {
    double lowest{}, highest{};
};

// Of 16 rows that lie evenly; nothing where they cannot be read, or hold no value.
std::optional<ValueRange> sampled_range(GDALDatasetH dataset) {
    constexpr int most_rows = 16;
    const GdalMessages messages;
    const GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
    const int rows = GDALGetRasterYSize(dataset), columns = GDALGetRasterXSize(dataset);
    int declared = 0;
    const double no_data = GDALGetRasterNoDataValue(band, &declared);
    std::optional<ValueRange> range;
    std::vector<double> values(static_cast<std::size_t>(columns));
    for (int i = 0; i < std::min(most_rows, rows); ++i) {
        const int row = static_cast<int>((2 * std::int64_t{i} + 1) * rows / (2 * std::min(most_rows, rows)));
        if (GDALRasterIO(band, GF_Read, 0, row, columns, 1, values.data(), columns, 1, GDT_Float64, 0, 0) !=
            CE_None)
            return std::nullopt;
        for (const double value : values) {
            const bool empty =
                !std::isfinite(value) || value == no_direction || (declared != 0 && value == no_data);
            if (empty) continue;
            if (!range) range = ValueRange{value, value};
            range->lowest = std::min(range->lowest, value);
            range->highest = std::max(range->highest, value);
        }
    }
    return range;
}

bool is_named(const Derived& kind, std::string_view name) {
    const std::string small = lower_case(name.substr(0, name.rfind('.')));
    std::string_view stem = without_copy_marks(small);
    for (;;) {
        const std::size_t end = stem.find_first_of(between_words);
        const bool is_last = end == std::string_view::npos;
        if ((is_last || kind.anywhere) && matches_name(kind.words, stem.substr(0, end))) return true;
        if (is_last) return false;
        stem.remove_prefix(end + 1);
    }
}

bool fits(const Derived& kind, const ValueRange& range, bool is_landscape) {
    if (range.lowest >= kind.lowest && range.highest <= kind.highest) return true;
    if (is_landscape) return false;
    // Around 0, as much down as up; or from near 0 upwards.
    constexpr double level_part = 0.1, lopsided = 5.0;
    if (range.highest > kind.steepest || range.lowest < -kind.steepest) return false;
    if (kind.lowest >= 0.0) return range.lowest >= 0.0 && range.lowest <= level_part * range.highest;
    return range.lowest < 0.0 && range.highest > 0.0 && range.highest <= -lopsided * range.lowest &&
           -range.lowest <= lopsided * range.highest;
}

// A value, and the nine heights at and around its place, row by row from the north-west.
struct Sample {
    double value{};
    std::array<double, 9> around{};
    double across{}, down{};  // distance of posts
};

// Horn's: three times in a row and a column, the middle one twice.
double eastward(const Sample& at) {
    const auto& z = at.around;
    return (z[2] + 2.0 * z[5] + z[8] - z[0] - 2.0 * z[3] - z[6]) / 8.0;
}
double southward(const Sample& at) {
    const auto& z = at.around;
    return (z[6] + 2.0 * z[7] + z[8] - z[0] - 2.0 * z[1] - z[2]) / 8.0;
}

// How often two values are the same within a part of the second, at least of 1.
template <class Expected>
bool agree(const std::vector<Sample>& samples, const Expected& expected) {
    constexpr double within = 0.01, often = 0.95;
    const auto fits = std::ranges::count_if(samples, [&](const Sample& at) {
        const double value = expected(at);
        return std::abs(at.value - value) <= within * std::max(1.0, std::abs(value));
    });
    return static_cast<double>(fits) >= often * static_cast<double>(samples.size());
}

double steepness(const Sample& at, bool in_posts) {
    return std::hypot(eastward(at) / (in_posts ? 1.0 : at.across),
                      southward(at) / (in_posts ? 1.0 : at.down));
}

// Whether values are one multiple of the heights' own steepness: whoever made them may have counted posts,
// degrees or metres, and have drawn heights higher.
template <class Tangent>
bool is_slope(const std::vector<Sample>& samples, const Tangent& tangent) {
    constexpr double within = 0.02, often = 0.95, least_range = 1.5;
    for (const bool in_posts : {false, true}) {
        std::vector<double> ratios;
        double least = 0.0, most = 0.0;
        for (const Sample& at : samples) {
            const double steep = steepness(at, in_posts);
            if (steep <= 0.0) continue;
            least = ratios.empty() ? steep : std::min(least, steep);
            most = std::max(most, steep);
            ratios.push_back(tangent(at.value) / steep);
        }
        if (2 * ratios.size() < samples.size() || most < least_range * least) continue;
        const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
        std::ranges::nth_element(ratios, middle);
        const double median = *middle;
        const auto near = std::ranges::count_if(
            ratios, [&](double ratio) { return std::abs(ratio - median) <= within * median; });
        if (median > 0.0 && static_cast<double>(near) >= often * static_cast<double>(ratios.size()))
            return true;
    }
    return false;
}

// Whether values are the compass directions in which the ground falls.
bool is_aspect(const std::vector<Sample>& samples) {
    constexpr double within_deg = 5.0, often = 0.9;
    for (const bool in_posts : {false, true}) {
        std::size_t fits = 0, sloped = 0;
        for (const Sample& at : samples) {
            if (steepness(at, in_posts) <= 0.0) continue;
            const double east = eastward(at) / (in_posts ? 1.0 : at.across);
            const double south = southward(at) / (in_posts ? 1.0 : at.down);
            const double falls_deg = std::atan2(-east, south) * 180.0 / std::numbers::pi;
            ++sloped;
            fits += std::abs(std::remainder(at.value - falls_deg, 360.0)) <= within_deg;
        }
        if (2 * sloped >= samples.size() && static_cast<double>(fits) >= often * static_cast<double>(sloped))
            return true;
    }
    return false;
}

double mean_of_neighbours(const Sample& at) {
    double sum = 0.0;
    for (std::size_t i = 0; i < 9; ++i) sum += i == 4 ? 0.0 : at.around[i];
    return sum / 8.0;
}
double mean_step(const Sample& at) {
    double sum = 0.0;
    for (const double height : at.around) sum += std::abs(height - at.around[4]);
    return sum / 8.0;
}
double root_of_squared_steps(const Sample& at) {
    double sum = 0.0;
    for (const double height : at.around) sum += (height - at.around[4]) * (height - at.around[4]);
    return std::sqrt(sum);
}
double range_around(const Sample& at) {
    const auto [lowest, highest] = std::ranges::minmax(at.around);
    return highest - lowest;
}

// Samples of one row; posts without a height beside them are left out.
void add_samples(const PostBlock& values, const PostBlock& heights, double across, double down,
                 std::vector<Sample>& samples) {
    constexpr int most = 64;
    const PostWindow& window = heights.window;
    const int inner = window.columns - 2;
    for (int i = 0; i < std::min(most, inner); ++i) {
        const int column =
            window.column + 1 + static_cast<int>(std::int64_t{i} * inner / std::min(most, inner));
        Sample at;
        const float value = values.at(window.row + 1, column);
        bool whole = !is_void(value) && static_cast<double>(value) != no_direction;
        at.value = static_cast<double>(value);
        for (int k = 0; k < 9; ++k) {
            const float height = heights.at(window.row + k / 3, column + k % 3 - 1);
            whole = whole && !is_void(height);
            at.around[static_cast<std::size_t>(k)] = static_cast<double>(height);
        }
        at.across = across;
        at.down = down;
        if (whole) samples.push_back(at);
    }
}

std::vector<Sample> samples_of(const Source& source, const Source& heights) {
    constexpr int most_rows = 8, most_columns = 4096;
    const int rows = heights.report.rows, columns = std::min(heights.report.columns, most_columns);
    std::vector<Sample> samples;
    if (rows < 3 || columns < 3) return samples;
    const auto& m = heights.crs_from_post;
    const double middle_deg = 0.5 * (heights.south_deg + heights.north_deg);
    const double flattened = heights.projected ? 1.0 : std::cos(middle_deg * std::numbers::pi / 180.0);
    const double across = std::hypot(m[1], m[4]) * flattened, down = std::hypot(m[2], m[5]);
    if (!(across > 0.0) || !(down > 0.0)) return samples;
    const int places = std::min(most_rows, rows - 2);
    const int first_column = (heights.report.columns - columns) / 2;
    for (int i = 0; i < places; ++i) {
        const int row = static_cast<int>((2 * std::int64_t{i} + 1) * (rows - 2) / (2 * places));
        const auto around = read_posts(heights, {row, first_column, 3, columns});
        const auto values = read_posts(source, {row + 1, first_column, 1, columns});
        if (!around || !values) return {};
        add_samples(*values, *around, across, down, samples);
    }
    return samples;
}

}  // namespace

std::string holds_by_tags(GDALDatasetH dataset) {
    const GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
    const auto item = [](GDALMajorObjectH object, const char* name, const char* domain) {
        const char* const text = GDALGetMetadataItem(object, name, domain);
        return text ? lower_case(text) : std::string();
    };
    if (item(band, "NBITS", "IMAGE_STRUCTURE") == "1") return "one bit for each post: a mask";
    if (GDALGetRasterCategoryNames(band) != nullptr || item(band, "LAYER_TYPE", nullptr) == "thematic")
        return "classes with names";
    return "";
}

std::string holds_by_name_and_values(std::string_view name, GDALDatasetH dataset) {
    const bool whole_bytes = GDALGetRasterDataType(GDALGetRasterBand(dataset, 1)) == GDT_Byte;
    const auto word = std::ranges::find_if(derived, [&](const Derived& kind) {
        return (whole_bytes || !kind.whole_bytes) && is_named(kind, name);
    });
    if (word == derived.end()) return "";
    const auto range = sampled_range(dataset);
    // Alaska's North Slope rises from the sea.
    const bool is_landscape =
        matches_name("*north?slope*|*south?slope*|*east?slope*|*west?slope*", lower_case(name));
    if (!range || !fits(*word, *range, is_landscape)) return "";
    char text[160];
    std::snprintf(text, sizeof text, "%s, by its name and its values from %.4g to %.4g",
                  std::string(word->holds).c_str(), range->lowest, range->highest);
    return text;
}

std::string made_of_heights(const Source& source, const Source& heights) {
    const std::vector<Sample> samples = samples_of(source, heights);
    constexpr std::size_t least_samples = 24;
    if (samples.size() < least_samples) return "";
    const auto [lowest, highest] = std::ranges::minmax(samples, {}, &Sample::value);
    if (lowest.value >= 0.0) {
        const auto of_degrees = [](double value) { return std::tan(value * std::numbers::pi / 180.0); };
        if (highest.value < 90.0 && is_slope(samples, of_degrees)) return "slope";
        if (is_slope(samples, [](double value) { return value; })) return "slope";
        if (highest.value <= 360.0 && is_aspect(samples)) return "aspect";
    }
    // Level ground agrees with all that follow.
    constexpr double least_range = 0.1;
    if (highest.value - lowest.value < least_range) return "";
    if (agree(samples, range_around)) return "roughness";
    if (agree(samples, mean_step) || agree(samples, root_of_squared_steps)) return "ruggedness";
    if (agree(samples, [](const Sample& at) { return at.around[4] - mean_of_neighbours(at); }))
        return "position beside its neighbours";
    return "";
}

bool contradicts_heights(const Source& source, const Source& heights) {
    constexpr double contradiction_m = 16.0;
    constexpr std::size_t least_samples = 24;
    const std::vector<Sample> samples = samples_of(source, heights);
    if (samples.size() < least_samples) return false;
    std::vector<double> differences;
    for (const Sample& at : samples) differences.push_back(at.value - at.around[4]);
    const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
    std::ranges::nth_element(differences, middle);
    const double offset = source.vertical_crs == heights.vertical_crs ? 0.0 : *middle;
    const auto apart = std::ranges::count_if(
        differences, [&](double difference) { return std::abs(difference - offset) > contradiction_m; });
    return 2 * apart > std::ssize(differences);
}

bool on_same_grid(const Source& one, const Source& other) {
    if (one.kind != SourceKind::raster || other.kind != SourceKind::raster) return false;
    if (one.report.rows != other.report.rows || one.report.columns != other.report.columns) return false;
    constexpr double same_post = 0.01;
    const auto& a = one.crs_from_post;
    const auto& b = other.crs_from_post;
    const double x = std::hypot(a[1], a[2]), y = std::hypot(a[4], a[5]);
    const std::array<double, 6> steps{x, x / one.report.columns, x / one.report.rows,
                                      y, y / one.report.columns, y / one.report.rows};
    for (std::size_t i = 0; i < steps.size(); ++i)
        if (!(std::abs(a[i] - b[i]) <= same_post * steps[i])) return false;
    return one.crs_wkt == other.crs_wkt;
}

}  // namespace oro
