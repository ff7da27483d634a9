// A shot from its view to what is drawn of it.
#pragma once

#include <memory>
#include <string>

#include "apps/commands/shot/shot_json.h"
#include "apps/drawing/region_scene.h"
#include "apps/options/options.h"
#include "apps/view/style.h"
#include "core/base/progress.h"
#include "geo/together/cut_regions.h"
#include "geo/together/region_ground.h"
#include "render/device/gpu.h"
#include "render/scene/scene.h"

namespace oro {

// What a region's grids leave of each other, and the ground that they make.
struct ShotGround {
    RegionCuts cuts;
    std::unique_ptr<const RegionGround> grids;
};
// Holds on to the shot's region. Errors: those of cut_regions() and RegionGround::of().
Result<ShotGround> ground_of_shot(const ShotResult& shot);

// A picture that explains a frame has a legend, if nobody wants it without, and it is not too narrow for one.
// A view that was written without one is drawn again without.
void choose_legend(const ShotOptions& options, View& view);

// A shot's scene, and its key where it can be left to the next one (leave_scene()); "" where it cannot.
struct ShotScene {
    RegionScene whole;
    std::string key;
};

// The region of a shot, ready to be drawn; what --tolerance chooses is chosen. ceiling_m: unseen_ceiling().
// Errors: those of levels, of choosing, of images, and of the device.
Result<ShotScene> scene_of_shot(const ShotOptions& options, double ceiling_m, const Gpu& gpu,
                                const Style& style, const ShotGround& ground, const Progress& progress,
                                ShotResult& shot);

// Before a picture is drawn. Errors: nothing of the region can be in view, and the eye is not over it
// (nothing_in_view()).
Result<void> check_in_view(const ShotResult& shot, const std::string& view_file, Scene& scene);

}  // namespace oro
