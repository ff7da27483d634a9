// What orograph panorama found out, and tells with --json.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "apps/panorama/panorama_picture.h"
#include "apps/view/view.h"
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
};

nlohmann::ordered_json panorama_json(const PanoramaReport& report, const std::string& file,
                                     const Style& style);

}  // namespace oro
