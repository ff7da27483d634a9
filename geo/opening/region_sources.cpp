#include "geo/opening/region_sources.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "geo/opening/baked_region.h"
#include "geo/opening/companions.h"
#include "geo/posts/value_notes.h"
#include "geo/region/region_grid.h"
#include "geo/sources/hgt_source.h"
#include "geo/sources/known_products.h"
#include "geo/sources/made_source.h"
#include "geo/sources/made_words.h"
#include "geo/sources/raster_source.h"

namespace oro {
namespace {

constexpr std::size_t no_limit_notes = 8;

// In the order of the paths that they were found by; those of one path stay in the order of their names.
void number_as_listed(RegionSources& found) {
    std::vector<std::size_t> order(found.sources.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return found.named_by[i]; });
    for (std::size_t i = 0; i < order.size(); ++i)
        found.sources[order[i]].report.listed = static_cast<int>(i) + 1;
}

// The same of several files is one line, with the first one's name.
class Doubts {
  public:
    void add(const std::string& path, const std::string& doubt) {
        const std::string name = path + ": ";
        const std::string what = doubt.starts_with(name) ? doubt.substr(name.size()) : doubt;
        const auto known = std::ranges::find(all_, what, &Doubt::what);
        if (known != all_.end())
            ++known->files;
        else
            all_.push_back({path, what, 1});
    }
    void into(std::vector<std::string>& notes) const {
        for (const Doubt& doubt : all_)
            notes.push_back(files_words(doubt.path, doubt.files) + ": " + doubt.what);
    }

  private:
    struct Doubt {
        std::string path, what;
        std::size_t files;
    };
    std::vector<Doubt> all_;
};

// Takes out what only the others show to be no elevation, and tells of all that was left out.
void leave_out_companions(RegionSources& found, std::vector<LeftOutFile>& left_out) {
    const std::vector<CompanionSource> companions = companions_among(found.sources);
    for (const CompanionSource& one : companions)
        left_out.push_back({found.sources[one.source].report.path, one.why});
    for (auto one = companions.rbegin(); one != companions.rend(); ++one) {
        const auto place = static_cast<std::ptrdiff_t>(one->source);
        found.sources.erase(found.sources.begin() + place);
        found.named_by.erase(found.named_by.begin() + place);
    }
    for (std::string note : {note_of_left_out(left_out), note_of_bytes(found.sources)})
        if (!note.empty()) found.notes.push_back(std::move(note));
}

}  // namespace

Result<Finding> probe_file(const SourcePath& path, const SourceOverrides& overrides) {
    if (is_made(path.file)) {
        ORO_TRY(Source made, inspect_made(path));
        overrides.heights_of(made);
        return Finding{std::move(made), {}, {}, false};
    }
    // By its name alone: it may be large, or damaged.
    if (const auto known = known_file(path.name); known && !known->holds.empty()) {
        const std::string what =
            "holds " + std::string(known->holds) + " of " + std::string(known->product) + ", no elevation";
        return Finding{{}, {ErrorKind::failed, path.shown, what}, {}, true};
    }
    if (!path.hgt) return inspect_raster(path, overrides);
    ORO_TRY(Source tile, inspect_hgt(path));
    overrides.heights_of(tile);
    return Finding{std::move(tile), {}, {}, false};
}

Source source_of_cell(const TileName& cell) {
    Source tile;
    tile.lon = {static_cast<double>(cell.lon_deg), cell.lon_deg + 1.0};
    tile.south_deg = cell.lat_deg;
    tile.north_deg = cell.lat_deg + 1.0;
    return tile;
}

Result<RegionSources> probe_files(const RegionFiles& files, const RegionRequest& request,
                                  const Progress& progress) {
    RegionSources found;
    if (!files.baked.empty()) {
        ORO_TRY(found.baked, open_baked_grids(files.baked, request));
        return found;
    }
    const std::vector<SourcePath>& paths = files.sources;
    std::optional<BoundingBox> box;
    if (request.box) box = unwrapped(*request.box);
    ORO_TRY(const SourceOverrides overrides, source_overrides(request));
    std::vector<LeftOutFile> left_out;
    std::optional<Error> refused_alone;
    std::size_t skipped = 0;
    Doubts doubts;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        const SourcePath& path = paths[i];
        if (progress && i % 64 == 0)
            progress(0.1 * static_cast<double>(i) / static_cast<double>(paths.size()),
                     "looking at " + path.shown);
        if (path.hgt && box) {
            ORO_TRY(const HgtName name, name_of_hgt(path));
            if (!meets(source_of_cell(name.tile), *box)) continue;
        }
        ORO_TRY(Finding finding, probe_file(path, overrides));
        for (const std::string& doubt : finding.doubts) doubts.add(path.shown, doubt);
        if (finding.source) {
            found.sources.push_back(std::move(*finding.source));
            found.named_by.push_back(path.path);
            continue;
        }
        if (finding.companion) {
            if (path.named && !refused_alone) refused_alone = finding.unfit;
            if (found.first_skipped.empty()) found.first_skipped = finding.unfit.line();
            left_out.push_back({path.shown, finding.unfit.what});
            continue;
        }
        if (path.named) return finding.unfit;
        if (++skipped <= no_limit_notes) found.notes.push_back(passed_over + finding.unfit.line());
        if (found.first_skipped.empty()) found.first_skipped = finding.unfit.line();
    }
    doubts.into(found.notes);
    if (found.sources.empty() && refused_alone) return *refused_alone;
    leave_out_companions(found, left_out);
    if (request.listed_first) number_as_listed(found);
    if (skipped > no_limit_notes)
        found.notes.push_back(passed_over + std::to_string(skipped - no_limit_notes) +
                              " more files that hold no elevation");
    return found;
}

std::vector<std::string> cells_without(std::span<const Source> sources, const PostGrid& grid) {
    constexpr double line_deg = 1e-7;
    std::vector<std::string> missing;
    const auto first_lat = static_cast<int>(std::floor(grid.south_deg() + line_deg));
    const auto last_lat = static_cast<int>(std::ceil(grid.north_deg() - line_deg)) - 1;
    const auto first_lon = static_cast<int>(std::floor(grid.west_deg() + line_deg));
    const auto last_lon = static_cast<int>(std::ceil(grid.east_deg() - line_deg)) - 1;
    // What the sources cover, cell by cell; a source's box is all that is asked, whatever shape it has
    // inside.
    std::set<std::pair<int, int>> covered;
    for (const Source& source : sources) {
        const auto south = std::max(first_lat, static_cast<int>(std::floor(source.south_deg + line_deg)));
        const auto north = std::min(last_lat, static_cast<int>(std::ceil(source.north_deg - line_deg)) - 1);
        for (int lat = south; lat <= north; ++lat) {
            for (int lon = first_lon; lon <= last_lon; ++lon) {
                if (source.full_circle || !turns_that_meet(source.lon, lon, lon + 1.0).empty())
                    covered.insert({lat, lon});
            }
        }
    }
    for (int lat = first_lat; lat <= last_lat; ++lat) {
        for (int lon = first_lon; lon <= last_lon; ++lon) {
            if (!covered.contains({lat, lon}))
                missing.push_back(tile_name(lat, lon >= 180 ? lon - 360 : lon));
        }
    }
    return missing;
}

}  // namespace oro
