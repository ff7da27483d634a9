// orograph bake: from sources to one file with all levels, which opens at once and is read page by page.
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <span>

#include "apps/baking/bake_place.h"
#include "apps/baking/cluster_bake.h"
#include "apps/baking/mesh_bake.h"
#include "apps/baking/shared_bake.h"
#include "apps/command_line/refusals.h"
#include "apps/commands/commands.h"
#include "apps/options/bake_part_options.h"
#include "apps/options/region_option_table.h"
#include "apps/options/shard.h"
#include "apps/output/overwrite_guard.h"
#include "apps/report/figures.h"
#include "apps/report/json_object.h"
#include "apps/report/json_text.h"
#include "apps/report/progress_bar.h"
#include "apps/report/region_json.h"
#include "apps/view/mesh_request.h"
#include "apps/view/view.h"
#include "core/baked/bake.h"
#include "core/baked/file_pages.h"
#include "core/baked/measured_parts.h"
#include "core/baked/region_file.h"
#include "core/base/checksum.h"
#include "core/base/elapsed.h"
#include "core/base/files_of_job.h"
#include "core/base/files_read.h"
#include "core/base/parallel.h"
#include "geo/files/letter_case.h"
#include "geo/files/source_paths.h"
#include "geo/meshes/placed_mesh.h"
#include "geo/opening/made_world.h"
#include "geo/opening/open_region.h"
#include "geo/region/region_description.h"
#include "geo/region/region_fingerprints.h"
#include "geo/sources/raster_parts.h"
#include "geo/together/baked_parts.h"
#include "geo/together/cut_regions.h"

namespace oro {
namespace {

namespace fs = std::filesystem;

// Files that the paths name or hold, and all that these are made of: for an archive the archive itself; and
// meshes.
Result<std::vector<std::string>> input_files(const RegionOptions& region) {
    const std::vector<std::string> paths = terrain_paths(region);
    std::vector<std::string> files = region.paths;
    files.insert(files.end(), region.mesh_files.begin(), region.mesh_files.end());
    ORO_TRY(const std::vector<SourcePath> sources, find_sources(paths));
    for (const SourcePath& source : sources) {
        files.push_back(local_file_of(source.file));
        if (source.hgt || !source.archive.empty()) continue;
        // What is damaged is told when it is baked.
        if (const auto parts = parts_of_raster(source.file); parts.ok())
            files.insert(files.end(), parts->files.begin(), parts->files.end());
    }
    return files;
}

// Before anything takes time: that the file can be written where it shall be, and is none that is read.
Result<void> check_out(const BakingOptions& options) {
    const std::string& out = options.out;
    if (out.empty()) return refused("--out", "", "is missing: name the file to write (.oro)");
    if (!lower_case(out).ends_with(".oro")) return refused("--out", out, "the file's name must end in .oro");
    // What a bake writes on its way is no less lost than what it replaces.
    std::vector<std::string> written = files_of_bake(out);
    for (const std::string& part : {path_of_clusters(out), path_of_grid(out, 0), path_of_mesh(out, 0)})
        written.push_back(part);
    if (std::ranges::any_of(written, [](const auto& file) { return access(file.c_str(), F_OK) == 0; })) {
        ORO_TRY(const std::vector<std::string> inputs, input_files(options.region));
        ORO_CHECK(spare_inputs(written, {{inputs, "which is to be baked"}}));
    }
    ORO_CHECK(check_may_write(out, options.overwrite));
    return RegionFileWriter::check(out, options.overwrite);
}

// Tells what is baked from all else: heights, their place (the description and the undulation are compared by
// the writer), and the program that measures the levels. Not when files were changed or where they lie: the
// same heights give the same file.
std::uint64_t fingerprint_of(const HeightField& field) {
    std::uint64_t sum = xxh64(std::as_bytes(std::span(std::string_view(OROGRAPH_VERSION))));
    for (const GridAxis& axis : {field.grid.lat, field.grid.lon}) {
        sum = xxh64(std::as_bytes(std::span(&axis.posts_per_deg, 1)), sum);
        sum = xxh64(std::as_bytes(std::span(&axis.phase_deg, 1)), sum);
        sum = xxh64(std::as_bytes(std::span(&axis.first, 1)), sum);
        sum = xxh64(std::as_bytes(std::span(&axis.count, 1)), sum);
    }
    return xxh64(std::as_bytes(std::span(field.H_m)), sum);
}

struct BakeResult {
    std::string file;
    std::uint64_t bytes{};
    std::uint64_t posts{};
    std::size_t grids{1};
    BakeReport report;
    std::optional<ClusterBakeReport> clusters;
    std::vector<std::string> mesh_names;
    std::vector<BakedMeshReport> meshes;
    double read_s{};
    double build_s{};
    std::vector<std::string> notes;  // of the region

    [[nodiscard]] double bytes_per_post() const {
        return static_cast<double>(bytes) / static_cast<double>(posts);
    }
};

nlohmann::ordered_json meshes_json_of(const BakeResult& baked) {
    nlohmann::ordered_json meshes = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < baked.meshes.size(); ++i) {
        const BakedMeshReport& mesh = baked.meshes[i];
        meshes.push_back(json_object("name", baked.mesh_names[i], "triangles", mesh.triangles, "levels",
                                     mesh.levels, "triangles_at_all_levels", mesh.graph_triangles, "bytes",
                                     mesh.bytes, "bytes_of_groups", mesh.group_bytes, "bytes_of_features",
                                     mesh.fact_bytes, "build_s", mesh.build_s, "of_a_bake_broken_off",
                                     mesh.was_there));
    }
    return meshes;
}

void tell(const BakingOptions& options, const BakeResult& baked) {
    const BakeReport& report = baked.report;
    char size[80];
    std::snprintf(size, sizeof size, "%.1f MB, %.2f bytes a post", static_cast<double>(baked.bytes) / 1e6,
                  baked.bytes_per_post());
    if (report.pages_found > 0)
        say(options.quiet, "went on from page " + std::to_string(report.pages_found) + " of " +
                               std::to_string(report.pages) + ", where a bake was broken off");
    const std::string grids = baked.grids > 1 ? std::to_string(baked.grids) + " grids, " : "";
    say(options.quiet,
        "wrote " + baked.file + ": " + grids + std::to_string(report.pages) + " pages, " + size);
    if (baked.clusters) {
        char built[40];
        std::snprintf(built, sizeof built, "built in %.1f s", baked.clusters->build_s);
        say(options.quiet, "with clusters of " + std::to_string(baked.clusters->levels) +
                               " levels above the grid, " + grouped(baked.clusters->triangles) +
                               " triangles, " + built);
    }
    for (std::size_t i = 0; i < baked.meshes.size(); ++i)
        say(options.quiet, words_of(baked.mesh_names[i], baked.meshes[i]));
    if (!options.json) return;
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    json["file"] = baked.file;
    json["bytes"] = baked.bytes;
    json["posts"] = baked.posts;
    if (baked.grids > 1) json["grids"] = baked.grids;
    json["bytes_per_post"] = baked.bytes_per_post();
    json["pages"] = json_object("all", report.pages, "of_a_bake_broken_off", report.pages_found);
    json["triangles"] = report.triangles;
    if (baked.clusters)
        json["clusters"] = json_object("levels", baked.clusters->levels, "triangles",
                                       baked.clusters->triangles, "build_s", baked.clusters->build_s);
    if (!baked.meshes.empty()) json["meshes"] = meshes_json_of(baked);
    json["times_s"] = json_object("read", baked.read_s, "build_and_write", baked.build_s);
    json["notes"] = baked.notes;
    std::printf("%s\n", json_text(json, true).c_str());
}

// Reads the posts of what is baked already, to be baked anew.
Result<void> take_into_memory(Region& region) {
    for (RegionGrid& grid : region.grids) {
        ORO_CHECK(check_not_made_world(grid, "bake"));
        if (!grid.file) continue;
        ORO_TRY(grid.field, field_in_memory(*grid.file));
        grid.posts_hash = posts_hash(grid.field);
    }
    return {};
}

// What one grid is baked with, to `path`.
Result<BakeOptions> options_for(const RegionGrid& grid, const std::string& path, bool overwrite) {
    BakeOptions how;
    how.path = path;
    how.overwrite = overwrite;
    how.fingerprint = fingerprint_of(grid.field);
    how.description = region_description(grid);
    how.threads = thread_count();
    // Not to find out when the file is opened.
    ORO_CHECK(region_from_description(how.description, path));
    return how;
}

void add(BakeReport& sum, const BakeReport& part) {
    sum.pages += part.pages;
    sum.pages_found += part.pages_found;
    sum.triangles += part.triangles;
}

// What one grid is baked from where others have measured it.
Result<std::optional<MeasuredParts>> parts_for(const BakePartOptions& options, const PostGrid& grid,
                                               const BakeOptions& how) {
    std::optional<MeasuredParts> parts;
    if (!options.join) return parts;
    ORO_TRY(parts, MeasuredParts::open(grid, how));
    return parts;
}

// Each grid by itself, then all of them into one file, with the meshes.
Result<BakeReport> bake_grids(const Region& region, const BakePartOptions& options, ProgressBar& bar,
                              std::vector<BakedMeshReport>& reports) {
    const std::vector<RegionGrid>& grids = region.grids;
    BakeReport report;
    ORO_TRY(const BakeHold hold, BakeHold::take(options.out, options.overwrite));
    std::vector<ContainerPart> parts;
    std::vector<MeasuredParts> measured;
    for (std::size_t i = 0; i < grids.size(); ++i) {
        ORO_TRY(BakeOptions how, options_for(grids[i], path_of_grid(options.out, i), true));
        ORO_TRY(std::optional<MeasuredParts> of_grid, parts_for(options, grids[i].field.grid, how));
        how.parts = of_grid ? &*of_grid : nullptr;
        const std::string what =
            "baking grid " + std::to_string(i + 1) + " of " + std::to_string(grids.size());
        ORO_TRY(const BakeReport baked, bake_part(grids[i].field, how, [&](double share) {
                    bar.show(share, what);
                    return true;
                }));
        add(report, baked);
        // Ranks without gaps: a file whose posts are all void had one, and is left out.
        const auto before = [&](const RegionGrid& other) { return other.rank < grids[i].rank; };
        parts.push_back({how.path, static_cast<std::uint32_t>(std::ranges::count_if(grids, before))});
        if (of_grid) measured.push_back(std::move(*of_grid));
    }
    ORO_TRY(MeshBake meshes, bake_meshes(region, options.out));
    parts.insert(parts.end(), meshes.parts.begin(), meshes.parts.end());
    reports = std::move(meshes.reports);
    ORO_CHECK(join_parts(options.out, options.overwrite, parts));
    for (const MeasuredParts& of_grid : measured) remove_parts(of_grid);
    return report;
}

Result<BakeReport> bake_grid(const Region& region, const BakePartOptions& options, ProgressBar& bar,
                             BakeResult& baked) {
    const RegionGrid& grid = region.grids.front();
    ORO_TRY(BakeOptions how, options_for(grid, options.out, options.overwrite));
    const bool has_clusters = options.mesh == "clusters";
    BakeOptions of_parts = how;
    if (has_clusters) of_parts.path = path_of_grid(options.out, 0);
    ORO_TRY(const std::optional<MeasuredParts> parts, parts_for(options, grid.field.grid, of_parts));
    how.parts = parts ? &*parts : nullptr;
    BakeReport report;
    if (has_clusters) {
        ORO_TRY(const BakeHold hold, BakeHold::take(options.out, options.overwrite));
        ORO_TRY(MeshBake meshes, bake_meshes(region, options.out));
        baked.meshes = std::move(meshes.reports);
        ORO_TRY(baked.clusters,
                bake_clusters(
                    grid.field, how, [&](double share, const char* what) { bar.show(share, what); },
                    meshes.parts));
        report = baked.clusters->region;
    } else {
        ORO_TRY(report, bake_region(grid.field, how, [&](double share) {
                    bar.show(share, "baking");
                    return true;
                }));
    }
    if (parts) remove_parts(*parts);
    return report;
}

Result<BakeReport> bake_all(const Region& region, const BakePartOptions& options, ProgressBar& bar,
                            BakeResult& baked) {
    if (region.grids.size() > 1 || (region.meshes && options.mesh != "clusters"))
        return bake_grids(region, options, bar, baked.meshes);
    return bake_grid(region, options, bar, baked);
}

BakePart part_of(const Shard& shard) {
    return {static_cast<std::uint64_t>(shard.number), static_cast<std::uint64_t>(shard.count)};
}

// The files of a part of a bake.
std::vector<std::string> files_of_part(const BakingOptions& options, const Region& region,
                                       const Shard& shard) {
    std::vector<std::string> files;
    const bool is_one = region.grids.size() == 1 && options.mesh != "clusters";
    for (std::size_t i = 0; i < region.grids.size(); ++i)
        files.push_back(
            path_of_measured_part(is_one ? options.out : path_of_grid(options.out, i), part_of(shard)));
    return files;
}

// A part of the work, into files beside the one that will be baked.
Result<void> bake_part_of_region(const BakePartOptions& options, const BakePlace& place, const Region& region,
                                 const Shard& shard, double read_s, ProgressBar& bar) {
    ORO_CHECK(place.fetch_parts(std::to_string(shard.number) + "of" + std::to_string(shard.count)));
    const auto building = Clock::now();
    SharedBakeReport report;
    const std::vector<RegionGrid>& grids = region.grids;
    for (std::size_t i = 0; i < grids.size(); ++i) {
        ORO_TRY(const BakeOptions how,
                options_for(grids[i], grids.size() > 1 ? path_of_grid(options.out, i) : options.out, true));
        ORO_CHECK(bake_shared(
            grids[i].field, how, part_of(shard), options.mesh == "clusters",
            [&](double share, const char* what) { bar.show(share, what); }, report));
    }
    ORO_CHECK(place.send_parts());
    bar.clear();
    for (std::string& file : report.files) file = place.shown(file);
    for (const std::string& file : report.files)
        say(options.quiet, (report.rows > 0 ? "wrote " : "is there already: ") + file);
    if (!options.json) return {};
    nlohmann::ordered_json json =
        json_object("shard", json_object("number", shard.number, "count", shard.count), "files", report.files,
                    "rows", report.rows, "windows", report.windows, "times_s",
                    json_object("read", read_s, "measure", seconds_since(building)));
    std::printf("%s\n", json_text(json, true).c_str());
    return {};
}

// All is in memory: what was read is held against what it was, and against what will be written. From here on
// the program reads files of its own making.
Result<void> end_reading(const BakingOptions& options, const Region& region, const Shard& shard) {
    ORO_CHECK(check_files_unchanged());
    std::vector<std::string> written = files_of_bake(options.out);
    written.push_back(path_of_clusters(options.out));
    for (std::size_t i = 0; i < region.grids.size(); ++i)
        for (const std::string& file : files_of_bake(path_of_grid(options.out, i))) written.push_back(file);
    for (std::string& file : files_of_part(options, region, shard)) written.push_back(std::move(file));
    ORO_CHECK(spare_inputs(written, {files_of_ground(options.region.paths, region)}));
    forget_files_read();
    return {};
}

std::string folder_beside(const std::string& out) {
    const std::string folder = fs::path(out).parent_path().string();
    return folder.empty() ? "." : folder;
}

// options.out is on this machine, and place.path().
Result<void> bake_at(const BakePlace& place, const BakePartOptions& options) {
    ORO_TRY(const Shard shard, parse_shard(options.shard));
    ORO_TRY(RegionRequest request, region_request(options.region));
    request.meshes.most_triangles = most_baked_triangles;
    ORO_CHECK(check_out(options));
    ProgressBar bar(options.quiet);
    BakeResult baked;
    baked.file = place.shown(options.out);
    const auto reading = Clock::now();
    ORO_TRY(Region region, open_region_in_scratch(request, bar.progress(), folder_beside(options.out)));
    if (options.mesh == "clusters") ORO_CHECK(check_clusters(region));
    ORO_CHECK(take_into_memory(region));
    ORO_CHECK(end_reading(options, region, shard));
    baked.read_s = seconds_since(reading);
    bar.clear();
    say_notes(region, options.quiet);
    if (!options.shard.empty()) return bake_part_of_region(options, place, region, shard, baked.read_s, bar);
    if (options.join) ORO_CHECK(place.fetch_parts());
    baked.notes = all_notes(region);
    const auto building = Clock::now();
    ORO_TRY(baked.report, bake_all(region, options, bar, baked));
    if (region.meshes)
        for (const PlacedMesh& mesh : *region.meshes)
            baked.mesh_names.push_back(fs::path(mesh.path).filename().string());
    baked.build_s = seconds_since(building);
    bar.clear();
    for (const RegionGrid& grid : region.grids) baked.posts += grid.field.grid.post_count();
    baked.grids = region.grids.size();
    std::error_code fault;
    baked.bytes = fs::file_size(options.out, fault);
    if (fault)
        return Error{ErrorKind::failed, options.out, "cannot be asked for its size: " + fault.message()};
    ORO_CHECK(place.send_baked());
    note_file_written(baked.file);
    tell(options, baked);
    return {};
}

}  // namespace

Result<void> run_bake(const BakePartOptions& options) {
    if (options.region.cut_under)
        return refused("--cut-under", "", "is of terrain that is read: a .oro file holds it whole");
    ORO_TRY(const BakePlace place, BakePlace::of(options.out, options.overwrite));
    BakePartOptions there = options;
    there.out = place.path();
    // On its way to a network: what is here is of a bake that was broken off.
    there.overwrite = options.overwrite || place.path() != options.out;
    const Result<void> baked = bake_at(place, there);
    if (baked.ok()) return baked;
    return Error{baked.error().kind, place.shown(baked.error().where), baked.error().what};
}

}  // namespace oro
