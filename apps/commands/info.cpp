// orograph info: what the sources of a region are, and what is missing.
#include <algorithm>
#include <cstdio>

#include "apps/commands/commands.h"
#include "apps/commands/info_json.h"
#include "apps/commands/info_mesh.h"
#include "apps/commands/info_text.h"
#include "apps/drawing/clusters_of_region.h"
#include "apps/drawing/pipeline_choice.h"
#include "apps/report/figures.h"
#include "apps/report/json_object.h"
#include "apps/report/json_text.h"
#include "apps/report/progress_bar.h"
#include "apps/report/region_json.h"
#include "apps/view/view.h"
#include "core/baked/contents_check.h"
#include "core/base/parallel.h"
#include "geo/listing/file_listing.h"
#include "geo/opening/baked_region.h"
#include "geo/opening/open_region.h"
#include "geo/opening/region_sources.h"
#include "geo/region/description_check.h"
#include "geo/together/cut_regions.h"

namespace oro {
namespace {

std::string listed_names(const std::vector<ListedFile>& files) {
    constexpr std::size_t most = 5;
    std::string names;
    std::size_t count = 0;
    for (const ListedFile& file : files) {
        if (file.leave_out.empty()) continue;
        if (++count <= most) names += (names.empty() ? "" : ", ") + file.path;
    }
    return count > most ? names + " and " + std::to_string(count - most) + " more" : names;
}

// What there is to say of files that make no region together: each by itself. The error stays one, and names
// those without which there would be one.
Error without_region(const InfoOptions& options, const FileListing& listing, Error fault) {
    if (listing.files.size() < 2) return fault;
    if (const std::string names = listed_names(listing.files); !names.empty())
        fault.what += "; without " + names + " the others make a region";
    if (!options.json) {
        std::printf("%s", listing_text(listing).c_str());
        return fault;
    }
    nlohmann::ordered_json sources = nlohmann::ordered_json::array(),
                           leave_out = nlohmann::ordered_json::array();
    std::vector<SourceReport> reports;
    for (const ListedFile& file : listing.files) {
        if (file.report) reports.push_back(*file.report);
        if (!file.leave_out.empty())
            leave_out.push_back(json_object("path", file.path, "reason", file.leave_out));
    }
    const nlohmann::ordered_json json =
        json_object("sources", sources_json(reports), "not_opened", files_json(listing.files, true),
                    "passed_over", files_json(listing.files, false), "leave_out", std::move(leave_out),
                    "region", nullptr, "error", fault.line());
    std::printf("%s\n", json_text(json, true).c_str());
    return fault;
}

Result<FileListing> listing_of(const RegionRequest& request, ProgressBar& bar) {
    if (baked_path(request.paths)) return FileListing{};
    return list_files(request, {cache_folder().string(), program_fingerprint()}, bar.progress());
}

std::string checked_words(const Region& region) {
    const RegionGrid& grid = region.grids.front();
    if (!grid.file) return "every post was read, as always without a whole .oro";
    const std::string words = "every page was read, and is as it was written";
    const std::string of_meshes =
        region.meshes ? "; the errors of its meshes were measured again, and are bounds" : "";
    if (!grid.clusters) return words + of_meshes;
    return words + "; so " + counted(grid.clusters->outline().groups, "group", "groups") + " of clusters" +
           of_meshes;
}

// That each grid which is a whole baked file, or one of its grids, is what was written, and what the file
// says.
Result<void> check_grids(const Region& region) {
    int last_rank = 0;
    for (const RegionGrid& grid : region.grids) last_rank = std::max(last_rank, grid.rank);
    for (const RegionGrid& grid : region.grids) {
        if (!grid.file) continue;
        const std::string name = region.grids.size() > 1 ? "grid " + std::to_string(grid.rank) + ": " : "";
        ORO_CHECK(grid.file->verify());
        ORO_CHECK(check_contents(*grid.file, thread_count(), name));
        // Heights go over to those of grids below alone.
        ORO_CHECK(check_description(grid, grid.rank != last_rank, name));
        if (grid.clusters) ORO_CHECK(check_clusters_of_region(grid));
    }
    return {};
}

}  // namespace

Result<void> run_info(const InfoOptions& options) {
    if (names_meshes(options.region.paths)) return run_mesh_info(options);
    ORO_TRY(RegionRequest request, region_request(options.region));
    request.allow_multiple_grids = true;
    ProgressBar bar(options.quiet);
    const auto listed = listing_of(request, bar);
    if (!listed) return listed.error();
    const FileListing& listing = *listed;
    auto opened = listing.error ? Result<Region>(*listing.error) : open_region(request, bar.progress());
    bar.clear();
    if (!opened) return without_region(options, listing, opened.error());
    Region region = std::move(*opened);
    leave_listed_notes_out(region);
    // Of tiles, and of a part of a baked region, all posts are in memory by now.
    if (options.check) {
        ORO_CHECK(check_grids(region));
        ORO_CHECK(check_baked_meshes(region));
    }
    const RegionGrid& first = region.grids.front();
    if (options.json) {
        nlohmann::ordered_json json = info_json(region, options.check);
        if (region.meshes) {
            json["meshes"] = baked_meshes_json(region);
            ORO_TRY(const nlohmann::ordered_json others, meshes_on_ground_json(region, options.region));
            for (const auto& mesh : others) json["meshes"].push_back(mesh);
        }
        json["passed_over"] = files_json(listing.files, false);
        std::printf("%s\n", json_text(json, true).c_str());
        return {};
    }
    if (region.grids.size() > 1)
        std::printf("%zu grids of posts, drawn together; where several have ground, %s is drawn\n\n",
                    region.grids.size(), request.listed_first ? "the one named first" : "the finest");
    for (const RegionGrid& grid : region.grids)
        std::printf("%s%s", &grid == &first ? "" : "\n", info_text(grid).c_str());
    std::printf("%s", baked_meshes_text(region).c_str());
    std::printf("%s", unread_files_text(listing).c_str());
    if (options.check) std::printf("check: %s\n", one_line(checked_words(region)).c_str());
    return {};
}

}  // namespace oro
