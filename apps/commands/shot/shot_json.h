// What orograph shot found out, and tells with --json.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "apps/accuracy/beyond_data.h"
#include "apps/accuracy/pixel_check.h"
#include "apps/accuracy/verification.h"
#include "apps/drawing/mesh_cut.h"
#include "apps/drawing/picking.h"
#include "apps/output/picture_file.h"
#include "apps/view/accuracy.h"
#include "apps/view/style.h"
#include "apps/view/view.h"
#include "core/terrain/summit.h"
#include "geo/region/region.h"
#include "render/device/gpu.h"

namespace oro {

// How long each step of a shot took.
struct ShotTimes {
    double read_s{};
    double pages_s{};
    double draw_s{};  // drawing, reading back and writing, which overlap row by row
    double verify_s{};
    double layers_s{};
};

// Of --layers.
struct LayersReport {
    std::uint64_t ground_px{};
    std::uint64_t missed_px{};  // whose rays pass beside what was drawn there
};

// What clusters take in memory, of a picture that is drawn by them.
struct ClustersHeld {
    std::uint64_t on_gpu{};
    std::uint64_t bytes_on_gpu{};
    std::uint64_t groups{};       // in the processor's memory
    std::uint64_t group_bytes{};  // there
};

struct ShotResult {
    View view;
    Region region;
    std::optional<SeenPlace> middle;  // what the picture sees there
    PictureReport picture;
    std::vector<LineLabel> labels;
    NamesInView names;
    OverlayInView overlay;
    std::uint64_t pages{};
    std::uint64_t pages_on_gpu{};
    std::uint64_t page_bytes{};
    std::optional<ClustersHeld> clusters;
    std::optional<DrawnMeshes> meshes;  // where meshes are drawn by clusters
    double height_step_m{};
    bool has_means{};  // pixels have the colour of the mean of the ground that they cover
    std::uint64_t triangles_at_full_resolution{};
    UnseenGround unseen;
    std::optional<Verification> verification;
    std::optional<LayersReport> layers;
    std::optional<AccuracyChoice> choice;  // with --tolerance
    // How the pixels of a picture that is only drawn again and compared differ, where they can be read.
    std::optional<PictureDifference> difference;
    bool same_bytes{};
    ShotTimes times;
    std::optional<MovedToSummit> on_summit;  // how the eye came to stand there, where that was asked for
};

nlohmann::ordered_json shot_json(const ShotResult& shot, const PictureFiles& files, const Gpu& gpu,
                                 const Style& style);

}  // namespace oro
