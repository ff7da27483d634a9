#include "geo/posts/value_notes.h"

#include <algorithm>
#include <cstdio>
#include <functional>

#include "geo/posts/mosaic.h"
#include "geo/sources/height_unit.h"
#include "geo/sources/notes.h"
#include "geo/sources/undeclared_voids.h"

namespace oro {
namespace {

// Files of which the same is to be told.
struct NotedPosts {
    std::string first;
    std::size_t files{};
    std::uint64_t posts{};
    std::string about;  // what differs from note to note
};

void tell(std::vector<NotedPosts>& all, const Source& source, std::uint64_t posts,
          const std::string& about = "") {
    const auto known = std::ranges::find(all, about, &NotedPosts::about);
    if (known == all.end()) {
        all.push_back({source.report.path, 1, posts, about});
        return;
    }
    ++known->files;
    known->posts += posts;
}

void put(const std::vector<NotedPosts>& all, std::vector<std::string>& notes,
         const std::function<std::string(const NotedPosts&)>& words) {
    for (const NotedPosts& noted : all)
        add_note(notes, files_words(noted.first, noted.files) + ": " + words(noted));
}

// Implausible values of which each reads like no data, and no others.
bool all_read_like_no_data(const ValueFindings& values) {
    std::uint64_t counted = 0;
    for (const StoredCount& count : values.implausible) {
        if (!reads_like_no_data(count.value)) return false;
        counted += count.posts;
    }
    return counted == values.implausible_posts;
}

void tell_undeclared(const Source& source, std::vector<NotedPosts>& all) {
    const ValueFindings& values = source.values;
    for (const StoredCount& count : values.undeclared)
        if (count.value != blurred_value) tell(all, source, count.posts, value_words(count.value));
    if (!all_read_like_no_data(values)) return;
    for (const StoredCount& count : values.implausible)
        tell(all, source, count.posts, value_words(count.value));
}

void tell_blurred(const Source& source, std::vector<NotedPosts>& all) {
    for (const StoredCount& count : source.values.undeclared)
        if (count.value == blurred_value) tell(all, source, count.posts);
}

// "; 5 of them hold -32678, which no tag declares as no data"
std::string among_implausible(const ValueFindings& values) {
    constexpr std::size_t few = 8;  // more distinct ones are heights in another unit
    std::string words;
    if (values.implausible.size() > few) return words;
    for (const StoredCount& count : values.implausible)
        if (reads_like_no_data(count.value))
            words += "; " + std::to_string(count.posts) + " of them hold " + value_words(count.value) +
                     ", which no tag declares as no data";
    return words;
}

bool unit_is_in_doubt(const Source& source) {
    const std::uint64_t voids_in_file = source.report.voids - source.values.implausible_posts;
    return source.report.height_unit.from != UnitFrom::request &&
           2 * source.values.implausible_posts > source.values.read - voids_in_file;
}

std::string unit_hint() {
    return "--height-unit " + height_unit_words();
}

}  // namespace

std::string files_words(const std::string& first, std::size_t files) {
    if (files < 2) return first;
    return first + " and " + std::to_string(files - 1) + (files == 2 ? " more file" : " more files");
}

void note_values(std::span<const Source> sources, std::vector<std::string>& notes) {
    std::vector<NotedPosts> undeclared, blurred, implausible, unwritten, steep;
    for (const Source& source : sources) {
        const ValueFindings& values = source.values;
        tell_undeclared(source, undeclared);
        tell_blurred(source, blurred);
        if (values.implausible_posts > 0 && !all_read_like_no_data(values))
            tell(implausible, source, values.implausible_posts,
                 among_implausible(values) +
                     (unit_is_in_doubt(source)
                          ? "; if they count in another unit than metres, " + unit_hint() + " tells it"
                          : ""));
        if (values.unwritten > 0) tell(unwritten, source, values.unwritten);
        constexpr std::uint64_t enough = 64;
        if (values.pairs >= enough && 2 * values.steep > values.pairs) {
            char spacing[40];
            std::snprintf(spacing, sizeof spacing, "%.3g", source.report.spacing_m);
            tell(steep, source, 0, spacing);
        }
    }
    put(undeclared, notes, [](const NotedPosts& noted) {
        return std::to_string(noted.posts) + (noted.posts == 1 ? " post holds " : " posts hold ") +
               noted.about + ", which no tag declares as no data; " +
               (noted.posts == 1 ? "it is" : "they are") + " taken as void";
    });
    put(blurred, notes, [](const NotedPosts& noted) {
        return std::to_string(noted.posts) + (noted.posts == 1 ? " post lies" : " posts lie") +
               " between a no-data value and the terrain, as resampling leaves them, and " +
               (noted.posts == 1 ? "is" : "are") + " taken as void; heights beside voids may be blurred, too";
    });
    put(implausible, notes, [](const NotedPosts& noted) {
        return std::to_string(noted.posts) + " heights below -12,000 m or above 9,000 m are taken as void" +
               noted.about;
    });
    put(unwritten, notes, [](const NotedPosts& noted) {
        return std::to_string(noted.posts) +
               " posts have no data: they lie in gaps between the files of a mosaic, or in blocks that were "
               "never written";
    });
    put(steep, notes, [](const NotedPosts& noted) {
        return "more than half of its slopes are steeper than 80 degrees, with posts " + noted.about +
               " m apart: its coordinates or the unit of its heights may be wrong (" + unit_hint() + ")";
    });
}

std::string why_no_height(std::span<const Source> sources) {
    for (const Source& source : sources) {
        const ValueFindings& values = source.values;
        if (values.implausible_posts == 0 || !unit_is_in_doubt(source) || all_read_like_no_data(values))
            continue;
        return "; what " + source.report.path + " holds, " + value_words(values.lowest_stored_m) + " to " +
               value_words(values.highest_stored_m) +
               " m, are heights that no terrain has: if they count in another unit, " + unit_hint() +
               " tells it";
    }
    return "";
}

}  // namespace oro
