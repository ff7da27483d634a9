#include "apps/commands/info_json.h"

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "apps/report/json_object.h"
#include "apps/report/region_json.h"
#include "geo/opening/region_sources.h"

namespace oro {

void leave_listed_notes_out(Region& region) {
    std::erase_if(region.grids.front().notes,
                  [](const std::string& note) { return note.starts_with(passed_over); });
}

nlohmann::ordered_json info_json(const Region& region, bool checked) {
    const RegionGrid& first = region.grids.front();
    nlohmann::ordered_json json = json_object(
        "sources", sources_json(first.sources), "region", region_json(first), "file", file_json(first),
        "checked", checked || !first.file, "passed_over", nlohmann::ordered_json::array());
    for (const RegionGrid& other : std::span(region.grids).subspan(1))
        json["apart"].push_back(
            json_object("sources", sources_json(other.sources), "region", region_json(other)));
    return json;
}

nlohmann::ordered_json files_json(const std::vector<ListedFile>& files, bool damaged) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const ListedFile& file : files)
        if (!file.report && file.damaged == damaged)
            json.push_back(json_object("path", file.path, "reason", file.reason));
    return json;
}

}  // namespace oro
