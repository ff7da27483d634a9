#include "geo/listing/file_listing.h"

#include <algorithm>
#include <atomic>
#include <cinttypes>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <span>

#include "core/base/checksum.h"
#include "core/base/parallel.h"
#include "geo/files/raster_library.h"
#include "geo/files/source_paths.h"
#include "geo/listing/header_cache.h"
#include "geo/opening/companions.h"
#include "geo/opening/made_world.h"
#include "geo/opening/region_files.h"
#include "geo/opening/region_sources.h"
#include "geo/posts/own_posts.h"
#include "geo/region/region_grid.h"
#include "geo/sources/hgt_source.h"
#include "geo/sources/horizontal_datum.h"
#include "geo/sources/raster_parts.h"
#include "geo/together/lattices.h"

namespace oro {
namespace {

// Fewer files are looked at again at once.
constexpr std::size_t worth_keeping = 16;

// What an answer depends on besides the files.
std::string stamp_of(const RegionRequest& request, const ListingCache& cache) {
    std::string stamp = cache.stamp;
    for (const std::string& part : {request.height_unit, request.source_crs, request.source_vertical})
        stamp += '\n' + part;
    for (const std::string& path : request.paths) stamp += '\n' + path;
    return stamp;
}

std::string file_of(const ListingCache& cache, const std::string& stamp) {
    if (cache.folder.empty()) return "";
    char name[40];
    std::snprintf(name, sizeof name, "headers-%016" PRIx64 ".bin",
                  xxh64(std::as_bytes(std::span(std::string_view(stamp)))));
    return (std::filesystem::path(cache.folder) / name).string();
}

// One file as it was found: a source, no source, or damage.
struct Look {
    Finding finding;
    std::optional<Error> damage;
    std::vector<std::pair<std::string, FileState>> before;
    bool known{};  // from an earlier call
};

bool lies_elsewhere(const SourcePath& path, const std::optional<BoundingBox>& box) {
    if (!path.hgt || !box) return false;
    const auto name = name_of_hgt(path);
    return name.ok() && !meets(source_of_cell(name->tile), *box);
}

void probe_all(const std::vector<SourcePath>& paths, const SourceOverrides& overrides,
               const Progress& progress, std::vector<Look>& looks) {
    std::atomic<std::size_t> done{0};
    constexpr int batch = 256;
    for (std::size_t first = 0; first < paths.size(); first += batch) {
        const std::size_t count = std::min<std::size_t>(batch, paths.size() - first);
        in_parallel(static_cast<int>(count), thread_count(), [&](int i) {
            const std::size_t which = first + static_cast<std::size_t>(i);
            Look& look = looks[which];
            if (look.known) return;
            look.before = HeaderCache::states_of({local_file_of(paths[which].file)});
            auto found = probe_file(paths[which], overrides);
            if (found.ok())
                look.finding = std::move(*found);
            else
                look.damage = found.error();
            ++done;
        });
        if (progress && done > 0)
            progress(static_cast<double>(first + count) / static_cast<double>(paths.size()),
                     "reading headers, " + paths[first].shown);
    }
}

// A reason without the name of the file that it is told beside.
std::string reason_of(const Error& error, const std::string& path) {
    const std::string line = error.line(), name = one_line(path) + ": ";
    return line.starts_with(name) ? line.substr(name.size()) : line;
}

std::string away_words(const Source& source, bool fine, double posts_with, double posts_without) {
    char text[240];
    const double apart_m = source.report.spacing_m;
    std::snprintf(
        text, sizeof text,
        "%s (posts %.4g %s apart, from %.4g %.4g on): the region would have %.2g posts, without it %.2g",
        fine ? "has closer posts than the others" : "lies far from the others",
        apart_m < 1000.0 ? apart_m : apart_m / 1000.0, apart_m < 1000.0 ? "m" : "km", source.south_deg,
        source.lon.west_deg, posts_with, posts_without);
    return text;
}

// Takes away what makes a region too large, step by step: the file farthest from the others, or all those
// with the closest posts, whichever saves more. Gives nothing where that leads nowhere, or to less than half
// of the files.
std::vector<std::pair<std::string, std::string>> to_leave_out(std::vector<Source> sources,
                                                              const std::optional<BoundingBox>& box) {
    constexpr int most_steps = 16;
    constexpr double as_close = 1.01;
    // They are copied often: without what says nothing of where they lie.
    for (Source& source : sources) source.crs_wkt = source.report.attribution = "";
    const std::size_t most = sources.size() / 2;
    std::vector<std::pair<std::string, std::string>> away;
    for (int step = 0; step < most_steps; ++step) {
        const auto extent = choose_extent(sources, box);
        if (!extent) return {};
        if (region_grid(sources, *extent).ok()) return away;
        const double closest_deg = sources[finest_of(sources)].lat_spacing_deg * as_close;
        const std::string farthest = sources[farthest_of(sources)].report.path;
        const auto posts_without = [&](const auto& is_away) {
            std::vector<Source> rest = sources;
            std::erase_if(rest, is_away);
            const auto smaller = choose_extent(rest, box);
            return smaller ? posts_of_region(rest, *smaller) : std::numeric_limits<double>::infinity();
        };
        const auto is_fine = [&](const Source& one) { return one.lat_spacing_deg <= closest_deg; };
        const auto is_far = [&](const Source& one) { return one.report.path == farthest; };
        const double posts = posts_of_region(sources, *extent);
        const double without_fine = posts_without(is_fine), without_far = posts_without(is_far);
        if (std::min(without_fine, without_far) >= posts) return {};
        const bool fine = without_fine < without_far;
        const auto is_away = [&](const Source& one) { return fine ? is_fine(one) : is_far(one); };
        for (const Source& source : sources)
            if (is_away(source))
                away.emplace_back(source.report.path,
                                  away_words(source, fine, posts, std::min(without_fine, without_far)));
        if (away.size() > most) return {};
        std::erase_if(sources, is_away);
    }
    return {};
}

// Why some sources make no grid; nothing where they do.
std::optional<Error> fault_of_grid(std::span<const Source> sources, const RegionExtent& extent,
                                   const RegionRequest& request) {
    if (!request.resample && !std::ranges::all_of(sources, &Source::on_degrees)) {
        const auto own = own_posts(sources, request.box);
        if (!own) return own.error();
        if (own->why_not.empty()) return std::nullopt;
    }
    if (is_made_world(sources, extent)) return std::nullopt;
    const auto grid = region_grid(sources, extent);
    if (grid.ok()) return std::nullopt;
    return grid.error();
}

// Takes out what only the others show to be no elevation.
void leave_out_companions_of(FileListing& listing, std::vector<Source>& sources) {
    const std::vector<CompanionSource> companions = companions_among(sources);
    for (auto one = companions.rbegin(); one != companions.rend(); ++one) {
        const auto source = sources.begin() + static_cast<std::ptrdiff_t>(one->source);
        const auto file = std::ranges::find(listing.files, source->report.path, &ListedFile::path);
        if (file != listing.files.end()) {
            file->report.reset();
            file->reason = one->why;
        }
        sources.erase(source);
    }
}

// What stands in the way of a region of these, as far as headers tell.
void find_obstacle(const RegionRequest& request, std::vector<Source> sources, FileListing& listing) {
    const auto damaged = std::ranges::find_if(listing.files, &ListedFile::damaged);
    if (damaged != listing.files.end())
        listing.error = Error{ErrorKind::failed, damaged->path, damaged->reason};
    const auto extent = choose_extent(sources, request.box);
    if (!extent) return;
    const std::vector<std::vector<Source>> groups = grids_of_sources(std::move(sources), request);
    std::vector<std::pair<std::string, std::string>> away;
    bool any_stay = false;
    for (const std::vector<Source>& group : groups) {
        const auto own = groups.size() == 1 ? extent : region_extent(group, request.box);
        if (!own) continue;
        const auto fault = fault_of_grid(group, *own, request);
        if (!fault) {
            any_stay = true;
            continue;
        }
        if (!listing.error) listing.error = *fault;
        const auto of_group = to_leave_out(group, request.box);
        any_stay = any_stay || !of_group.empty();
        away.insert(away.end(), of_group.begin(), of_group.end());
        // A grid that nothing makes small enough goes as a whole, as one huge raster does.
        if (of_group.empty())
            for (const Source& source : group) away.emplace_back(source.report.path, fault->line());
    }
    if (!any_stay) return;
    for (const auto& [path, why] : away) {
        const auto file = std::ranges::find(listing.files, path, &ListedFile::path);
        if (file != listing.files.end()) file->leave_out = why;
    }
}

}  // namespace

Result<FileListing> list_files(const RegionRequest& request, const ListingCache& cache,
                               const Progress& progress) {
    start_gdal();
    ORO_TRY(const SourceOverrides overrides, source_overrides(request));
    std::vector<Error> unreadable;
    Result<std::vector<SourcePath>> searched = find_sources(request.paths, unreadable);
    if (!searched) return with_meshes_of_folder(searched.error());
    std::vector<SourcePath> paths = std::move(*searched);
    std::optional<BoundingBox> box;
    if (request.box) box = unwrapped(*request.box);
    std::erase_if(paths, [&](const SourcePath& path) { return lies_elsewhere(path, box); });
    const std::string stamp = stamp_of(request, cache);
    const std::string kept = paths.size() < worth_keeping ? "" : file_of(cache, stamp);
    HeaderCache headers = HeaderCache::read(kept, stamp);
    std::vector<Look> looks(paths.size());
    for (std::size_t i = 0; i < paths.size(); ++i) {
        auto known = headers.find(paths[i]);
        looks[i].known = known.has_value();
        if (known) looks[i].finding = std::move(*known);
    }
    probe_all(paths, overrides, progress, looks);
    FileListing listing;
    std::vector<Source> sources;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        Look& look = looks[i];
        ListedFile file{paths[i].shown, {}, "", false, ""};
        listing.looked_at += look.known ? 0 : 1;
        if (!look.known && !look.damage) headers.keep(paths[i], look.finding, look.before);
        if (look.damage && look.damage->kind == ErrorKind::usage) return *look.damage;
        if (!look.damage && look.finding.source) {
            sources.push_back(std::move(*look.finding.source));
            file.report.emplace();  // filled below, when its datum is known
        } else {
            file.damaged = look.damage.has_value() || (paths[i].named && !look.finding.companion);
            file.reason = reason_of(look.damage ? *look.damage : look.finding.unfit, paths[i].shown);
        }
        listing.files.push_back(std::move(file));
    }
    if (listing.looked_at > 0) headers.write(kept, stamp);
    leave_out_companions_of(listing, sources);
    std::vector<std::string> notes;
    ORO_CHECK(find_horizontal_datums(sources, false, notes));
    auto next = sources.begin();
    for (ListedFile& file : listing.files)
        if (file.report) file.report = (next++)->report;
    for (const Error& error : unreadable)
        listing.files.push_back({error.where, {}, one_line(error.what), true, ""});
    find_obstacle(request, std::move(sources), listing);
    return listing;
}

}  // namespace oro
