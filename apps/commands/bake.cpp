// orograph bake: from sources to one file with all levels, which opens at once and is read page by page.
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <span>

#include "apps/command_line/refusals.h"
#include "apps/commands/commands.h"
#include "apps/output/overwrite_guard.h"
#include "apps/report/json_object.h"
#include "apps/report/json_text.h"
#include "apps/report/progress_bar.h"
#include "apps/view/view.h"
#include "core/baked/bake.h"
#include "core/baked/file_pages.h"
#include "core/baked/region_file.h"
#include "core/base/checksum.h"
#include "core/base/elapsed.h"
#include "core/base/parallel.h"
#include "geo/files/letter_case.h"
#include "geo/files/source_paths.h"
#include "geo/files/whole_file.h"
#include "geo/region/region_description.h"
#include "geo/region/region_prints.h"
#include "geo/sources/raster_parts.h"

namespace oro {
namespace {

namespace fs = std::filesystem;

// Files that the paths name or hold, and all that these are made of: for an archive the archive itself.
Result<std::vector<std::string>> input_files(const std::vector<std::string>& paths) {
    std::vector<std::string> files = paths;
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
    const std::vector<std::string> written = files_of_bake(out);
    if (std::ranges::any_of(written, [](const auto& file) { return access(file.c_str(), F_OK) == 0; })) {
        ORO_TRY(const std::vector<std::string> inputs, input_files(options.region.paths));
        ORO_CHECK(spare_files(written, inputs, "which is to be baked"));
    }
    std::error_code ignored;
    if (!options.overwrite && access(out.c_str(), F_OK) == 0 && !fs::is_directory(out, ignored))
        return Error{ErrorKind::failed, out, "is there already (--overwrite replaces it)"};
    ORO_CHECK(RegionFileWriter::check(out, options.overwrite));
    if (const auto trial = WholeFile::create(out, options.overwrite); !trial.ok()) return trial.error();
    return {};
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
    BakeReport report;
    double read_s{};
    double build_s{};

    [[nodiscard]] double bytes_per_post() const {
        return static_cast<double>(bytes) / static_cast<double>(posts);
    }
};

void tell(const BakingOptions& options, const BakeResult& baked) {
    const BakeReport& report = baked.report;
    char size[80];
    std::snprintf(size, sizeof size, "%.1f MB, %.2f bytes a post", static_cast<double>(baked.bytes) / 1e6,
                  baked.bytes_per_post());
    if (report.pages_found > 0)
        say(options.quiet, "went on from page " + std::to_string(report.pages_found) + " of " +
                               std::to_string(report.pages) + ", where a bake was broken off");
    say(options.quiet, "wrote " + baked.file + ": " + std::to_string(report.pages) + " pages, " + size);
    if (!options.json) return;
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    json["file"] = baked.file;
    json["bytes"] = baked.bytes;
    json["posts"] = baked.posts;
    json["bytes_per_post"] = baked.bytes_per_post();
    json["pages"] = json_object("all", report.pages, "of_a_bake_broken_off", report.pages_found);
    json["triangles"] = report.triangles;
    json["times_s"] = json_object("read", baked.read_s, "build_and_write", baked.build_s);
    std::printf("%s\n", json_text(json, true).c_str());
}

}  // namespace

Result<void> run_bake(const BakingOptions& options) {
    ORO_TRY(const RegionRequest request, region_request(options.region));
    ORO_CHECK(check_out(options));
    ProgressBar bar(options.quiet);
    BakeResult baked;
    baked.file = options.out;
    const auto reading = Clock::now();
    ORO_TRY(Region region, open_region(request, [&](double share, const std::string& what) {
                bar.show(share, "reading " + what);
            }));
    if (region.file) {
        ORO_TRY(region.field, field_in_memory(*region.file));
        region.posts_print = posts_print(region.field);
    }
    baked.read_s = seconds_since(reading);
    bar.clear();
    for (const std::string& note : region.notes) say(options.quiet, "note: " + note);
    const auto building = Clock::now();
    BakeOptions how;
    how.path = options.out;
    how.overwrite = options.overwrite;
    how.fingerprint = fingerprint_of(region.field);
    how.description = region_description(region);
    how.threads = thread_count();
    // Not to find out when the file is opened.
    ORO_CHECK(region_from_description(how.description, options.out));
    ORO_TRY(baked.report, bake_region(region.field, how, [&](double share) {
                bar.show(share, "baking");
                return true;
            }));
    baked.build_s = seconds_since(building);
    bar.clear();
    baked.posts = region.field.grid.post_count();
    std::error_code fault;
    baked.bytes = fs::file_size(options.out, fault);
    if (fault)
        return Error{ErrorKind::failed, options.out, "cannot be asked for its size: " + fault.message()};
    tell(options, baked);
    return {};
}

}  // namespace oro
