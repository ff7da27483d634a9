// What orograph panorama found out, and tells with --json.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "apps/panorama/panorama_picture.h"
#include "apps/view/view.h"
#include "core/terrain/summit.h"
#include "geo/region/region.h"

namespace oro {

struct PanoramaReport {
    View view;
    Region region;
    PanoramaSheet laid;
    CylinderPicture scene;
    double read_s{};
    double layout_s{};  // names asked of the oracle
    double draw_s{};
    std::optional<MovedToSummit> on_summit{};  // how the eye came to stand there, where that was asked for
};

nlohmann::ordered_json panorama_json(const PanoramaReport& report, const std::string& file,
                                     const Style& style);

}  // namespace oro
