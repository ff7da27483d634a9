// orograph info: what the sources of a region are, and what is missing.
#include <cstdio>

#include "apps/commands/commands.h"
#include "apps/report/json_object.h"
#include "apps/report/json_text.h"
#include "apps/report/progress_bar.h"
#include "apps/report/region_json.h"
#include "apps/view/view.h"
#include "core/baked/region_format.h"

namespace oro {
namespace {

enum class Posts { read, not_read };

void print_source(const SourceReport& s, Posts posts) {
    std::printf("%s\n", one_line(s.path).c_str());
    std::printf("  format      %s, posts are %s\n", one_line(s.format).c_str(),
                one_line(s.posts_are).c_str());
    std::printf("  CRS         %s\n", one_line(s.crs).c_str());
    std::printf("  heights     %s, in %s\n", one_line(s.vertical_datum).c_str(),
                one_line(s.height_unit).c_str());
    std::printf("  posts       %d x %d, every %.6g x %.6g degrees (%.4g m)\n", s.columns, s.rows,
                s.lon_spacing_deg, s.lat_spacing_deg, s.spacing_m);
    std::printf("  box         west %.6f south %.6f east %.6f north %.6f\n", s.box.west_deg, s.box.south_deg,
                s.box.east_deg, s.box.north_deg);
    const char* const attribution = s.attribution.empty() ? "not stated" : s.attribution.c_str();
    if (posts == Posts::not_read) {
        std::printf("  H           not read\n  attribution %s\n", one_line(attribution).c_str());
        return;
    }
    std::printf("  H           %.6g .. %.6g m, %llu voids", s.lowest_m, s.highest_m,
                static_cast<unsigned long long>(s.voids));
    if (s.implausible > 0)
        std::printf(" (%llu of them implausible heights)", static_cast<unsigned long long>(s.implausible));
    std::printf("\n  placement   %s\n", one_line(s.placement).c_str());
    std::printf(
        "  seams       %llu of its posts are also those of a source that wins, %llu disagree by up to %.4g "
        "m\n",
        static_cast<unsigned long long>(s.seams.shared_posts),
        static_cast<unsigned long long>(s.seams.disagreeing_posts), s.seams.largest_difference_m);
    std::printf("  attribution %s\n", one_line(attribution).c_str());
}

void print_region(const Region& region) {
    const PostGrid& grid = region.field.grid;
    const HeightRange range = height_range(region.field);
    std::printf("region: %zu sources\n", region.sources.size());
    std::printf("  box         west %.6f south %.6f east %.6f north %.6f\n", grid.west_deg(),
                grid.south_deg(), grid.east_deg(), grid.north_deg());
    std::printf("  posts       %d x %d, every %.6g x %.6g degrees\n", grid.columns(), grid.rows(),
                grid.lon.spacing_deg(), grid.lat.spacing_deg());
    std::printf("  H           %.6g .. %.6g m above the geoid %s\n", static_cast<double>(range.lowest_m),
                static_cast<double>(range.highest_m), one_line(region.geoid).c_str());
    std::printf("  voids       %llu, %llu filled (%s)\n",
                static_cast<unsigned long long>(region.void_posts()),
                static_cast<unsigned long long>(region.filled), one_line(region.void_method).c_str());
    std::printf("  outside     %llu posts beyond the rims of all sources, %llu in missing cells\n",
                static_cast<unsigned long long>(region.outside),
                static_cast<unsigned long long>(region.in_missing));
    std::printf(
        "  seams       %llu shared posts, %llu disagree by up to %.4g m; the finer spacing wins, among "
        "equals the first by file name\n",
        static_cast<unsigned long long>(region.seams.shared_posts),
        static_cast<unsigned long long>(region.seams.disagreeing_posts), region.seams.largest_difference_m);
    std::string missing;
    for (const std::string& cell : region.missing_cells) missing += " " + one_line(cell);
    std::printf("  missing    %s\n", missing.empty() ? " no cell" : missing.c_str());
    for (const std::string& note : region.notes) std::printf("  note        %s\n", one_line(note).c_str());
}

void print_file(const RegionFile& file) {
    const auto posts = static_cast<double>(file.outline().grid.post_count());
    std::printf("%s\n", one_line(file.path()).c_str());
    std::printf("  format      baked region (.oro), version %u\n", region_format::version);
    std::printf("  levels      %d, %llu pages, %llu triangles at full resolution\n", file.order().levels(),
                static_cast<unsigned long long>(file.order().count()),
                static_cast<unsigned long long>(file.outline().triangles));
    std::printf("  bytes       %llu, %.2f a post\n", static_cast<unsigned long long>(file.bytes()),
                static_cast<double>(file.bytes()) / posts);
}

// What there is to say of files that make no region together: each by itself. The error stays one.
Error without_region(const InfoOptions& options, const RegionRequest& request, Error fault) {
    const auto sources = sources_too_large(request);
    if (!sources.ok() || sources->empty()) return fault;
    if (options.json) {
        const nlohmann::ordered_json json = {
            {"sources", sources_json(*sources)}, {"region", nullptr}, {"error", fault.line()}};
        std::printf("%s\n", json_text(json, true).c_str());
        return fault;
    }
    for (const SourceReport& source : *sources) print_source(source, Posts::not_read);
    return fault;
}

}  // namespace

Result<void> run_info(const InfoOptions& options) {
    ORO_TRY(const RegionRequest request, region_request(options.region));
    ProgressBar bar(options.quiet);
    auto opened = open_region(
        request, [&](double share, const std::string& what) { bar.show(share, "reading " + what); });
    bar.clear();
    if (!opened) return without_region(options, request, opened.error());
    const Region region = std::move(*opened);
    // Of tiles, and of a part of a baked region, all posts are in memory by now.
    if (options.check && region.file) ORO_CHECK(region.file->verify());
    if (options.json) {
        const nlohmann::ordered_json json =
            json_object("sources", sources_json(region.sources), "region", region_json(region), "file",
                        file_json(region), "checked", options.check || !region.file);
        std::printf("%s\n", json_text(json, true).c_str());
        return {};
    }
    if (region.file) print_file(*region.file);
    for (const SourceReport& source : region.sources) print_source(source, Posts::read);
    print_region(region);
    if (options.check)
        std::printf("check: %s\n", region.file ? "every page was read, and is as it was written"
                                               : "every post was read, as always without a whole .oro");
    return {};
}

}  // namespace oro
