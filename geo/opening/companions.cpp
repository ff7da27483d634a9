#include "geo/opening/companions.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string_view>
#include <tuple>

#include "geo/files/letter_case.h"
#include "geo/files/name_pattern.h"
#include "geo/region/region_grid.h"
#include "geo/sources/known_products.h"
#include "geo/sources/raster_content.h"

namespace oro {
namespace {

// Last words of names of what lies beside heights, and says of them how good they are, or shows them.
constexpr std::string_view words_beside =
    "mask|msk|bitmask|datamask|watermask|wbm|wam|count|counts|num|stk|quality|qa|error|err|hem|uncertainty|"
    "accuracy|sigma|std|stddev|stdev|coherence|coh|amplitude|amp|intensity|browse|preview|thumb|thumbnail|"
    "quicklook|ql|ortho|orthophoto|image|slope*|aspect*|hillshade*|shade*|hs|roughness|ruggedness|tri|tpi|"
    "curvature|flow*|landcover|lcm|day|days|doy|date|dates|mindate|maxdate|matchtag|edm|flm";
// Last words of names of heights themselves.
constexpr std::string_view words_of_heights = "dem|dsm|dtm";

std::string_view file_name_of(std::string_view path) {
    return path.substr(path.rfind('/') + 1);
}

// Which part of a source's box another one covers, 0..1.
double covered_part(const Source& source, const Source& by) {
    const double south = std::max(source.south_deg, by.south_deg);
    const double north = std::min(source.north_deg, by.north_deg);
    const double width = source.lon.east_deg - source.lon.west_deg;
    const double height = source.north_deg - source.south_deg;
    if (north <= south || width <= 0.0 || height <= 0.0) return 0.0;
    if (by.full_circle) return (north - south) / height;
    double across = 0.0;
    for (const int turn : turns_that_meet(by.lon, source.lon.west_deg, source.lon.east_deg)) {
        const double west = std::max(source.lon.west_deg, by.lon.west_deg + 360.0 * turn);
        const double east = std::min(source.lon.east_deg, by.lon.east_deg + 360.0 * turn);
        across += std::max(0.0, east - west);
    }
    return std::min(1.0, across / width) * (north - south) / height;
}

// By which those that may share a grid are found among many: on_same_grid() decides.
using GridKey = std::tuple<SourceKind, int, int, float, float>;
GridKey grid_key(const Source& source) {
    return {source.kind, source.report.rows, source.report.columns,
            static_cast<float>(source.crs_from_post[0]), static_cast<float>(source.crs_from_post[3])};
}

// Of its ground.
constexpr double most_of_it = 0.5;

// A name in small letters without its ending, and without what makes it a copy's.
std::string stem_of(const Source& source) {
    const std::string name = lower_case(file_name_of(source.report.path));
    return std::string(without_copy_marks(std::string_view(name).substr(0, name.rfind('.'))));
}

// A name's last word, and what comes before it; nothing where it has one word.
struct LastWord {
    std::string before, word;
};
std::optional<LastWord> last_word(const Source& source) {
    const std::string stem = stem_of(source);
    const std::size_t at = stem.find_last_of(between_words);
    if (at == std::string::npos || at == 0) return std::nullopt;
    return LastWord{stem.substr(0, at), stem.substr(at + 1)};
}

bool has_word_beside(const Source& source) {
    const auto word = last_word(source);
    return word && matches_name(words_beside, word->word);
}

bool is_named_heights(const Source& source) {
    const auto word = last_word(source);
    return matches_name(words_of_heights, word ? word->word : stem_of(source));
}

bool is_named_beside(const Source& source, const Source& other) {
    const auto word = last_word(source);
    if (!word || has_word_beside(other)) return false;
    return on_same_grid(source, other) || stem_of(other).starts_with(word->before);
}

// Of bytes: why they are no heights; "" where others do not lie over most of their ground.
std::string why_of_bytes(std::size_t number, std::span<const Source> sources) {
    const Source& source = sources[number];
    double covered = 0.0, most = 0.0;
    std::string beside;
    for (const Source& other : sources) {
        if (other.bytes || (source.named && !on_same_grid(source, other))) continue;
        const double part = covered_part(source, other);
        covered += part;
        if (part <= most) continue;
        most = part;
        beside = file_name_of(other.report.path);
    }
    if (covered < most_of_it) return "";
    return "holds whole numbers of 0 to 255 over the ground of " + beside +
           " (a mask, a count or a picture), no elevation";
}

// Of others: what one of those over the same ground shows it to be.
std::string why_of(std::size_t number, std::span<const Source> sources, bool few_share) {
    const Source& source = sources[number];
    const bool has_word = has_word_beside(source);
    for (std::size_t k = 0; k < sources.size(); ++k) {
        const Source& other = sources[k];
        if (k == number || other.bytes) continue;
        const bool same_grid = on_same_grid(source, other);
        if (!same_grid && (source.named || !has_word || covered_part(source, other) < most_of_it)) continue;
        const std::string beside(file_name_of(other.report.path));
        if (has_word && is_named_beside(source, other))
            return "lies beside " + beside + " and by its name holds no elevation";
        if (!same_grid || !few_share) continue;
        if (const std::string made = made_of_heights(source, other); !made.empty())
            return "holds " + made + ", made of the heights of " + beside + ", no elevation";
        if (is_named_heights(other) && !is_named_heights(source) && contradicts_heights(source, other))
            return "differs by more than 16 m at most of its posts from " + beside +
                   ", whose name says that it holds the heights";
    }
    return "";
}

}  // namespace

std::vector<CompanionSource> companions_among(std::span<const Source> sources) {
    // More of one grid are looked at by name and type alone.
    constexpr std::size_t most_of_a_grid = 16;
    std::vector<CompanionSource> companions;
    if (sources.size() < 2) return companions;
    std::map<GridKey, std::size_t> sharing;
    for (const Source& source : sources) ++sharing[grid_key(source)];
    for (std::size_t i = 0; i < sources.size(); ++i) {
        const Source& source = sources[i];
        if (source.kind != SourceKind::raster) continue;
        const std::size_t share = sharing[grid_key(source)];
        std::string why = source.bytes ? why_of_bytes(i, sources) : "";
        if (why.empty() && (share > 1 || has_word_beside(source)))
            why = why_of(i, sources, share <= most_of_a_grid);
        if (!why.empty()) companions.push_back({i, why});
    }
    return companions;
}

std::string note_of_left_out(std::span<const LeftOutFile> files) {
    if (files.empty()) return "";
    constexpr std::size_t most_named = 32;
    std::string note = "left out, because " +
                       (files.size() == 1 ? std::string("it holds") : std::string("they hold")) +
                       " no elevation: ";
    for (std::size_t i = 0; i < std::min(most_named, files.size()); ++i) {
        std::string why = files[i].why;
        if (why.ends_with(", no elevation")) why.erase(why.rfind(", no elevation"));
        note += (i == 0 ? "" : ", ") + std::string(file_name_of(files[i].path)) + " (" + why + ")";
    }
    if (files.size() > most_named)
        note += " and " + std::to_string(files.size() - most_named) + " more files";
    return note;
}

std::string note_of_bytes(std::span<const Source> sources) {
    constexpr std::size_t most_named = 4;
    std::string names;
    std::size_t count = 0;
    for (const Source& source : sources) {
        if (!source.bytes || ++count > most_named) continue;
        names += (names.empty() ? "" : ", ") + source.report.path;
    }
    if (count == 0) return "";
    if (count > most_named) names += " and " + std::to_string(count - most_named) + " more files";
    return names + (count == 1 ? ": holds" : ": hold") +
           " whole numbers of 0 to 255, as masks and pictures do; they are taken for heights in metres";
}

}  // namespace oro
