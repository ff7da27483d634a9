// orograph info: what the sources of a region are, and what is missing.
#include <cstdio>

#include "apps/commands/commands.h"
#include "apps/commands/info_text.h"
#include "apps/report/json_object.h"
#include "apps/report/json_text.h"
#include "apps/report/progress_bar.h"
#include "apps/report/region_json.h"
#include "apps/view/view.h"

namespace oro {
namespace {

// What there is to say of files that make no region together: each by itself. The error stays one.
Error without_region(const InfoOptions& options, const RegionRequest& request, Error fault) {
    const auto sources = sources_too_large(request);
    if (!sources.ok() || sources->empty()) return fault;
    if (options.json) {
        const nlohmann::ordered_json json =
            json_object("sources", sources_json(*sources), "region", nullptr, "error", fault.line());
        std::printf("%s\n", json_text(json, true).c_str());
        return fault;
    }
    std::printf("%s", unread_text(*sources).c_str());
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
    std::printf("%s", info_text(region).c_str());
    if (options.check)
        std::printf("check: %s\n", region.file ? "every page was read, and is as it was written"
                                               : "every post was read, as always without a whole .oro");
    return {};
}

}  // namespace oro
