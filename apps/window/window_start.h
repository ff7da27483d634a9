// What a window begins with.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "apps/drawing/region_scene.h"
#include "apps/styles/style.h"
#include "apps/view/view.h"
#include "apps/window/eye_meshes.h"
#include "core/base/progress.h"
#include "core/earth/camera.h"
#include "render/device/device_report.h"

namespace oro {

// The data, and the view that the flight begins with. Errors: those of open_view().
Result<void> open_flight(const WindowOptions& options, const Progress& progress, View& view, Region& region);

// All levels of a region, or where measuring them takes long, those of every n-th post, or by proven bounds
// (is_drawn_by_bounds()). cuts: of all grids.
Result<GridPages> first_pages(const Region& region, const RegionCuts& cuts, const View& view,
                              const RenderProgress& progress);

// What a scene of a window is made with, beside its view.
struct SceneChoice {
    MemoryOptions memory;
    bool quiet{};        // what a user must know of images is not said
    bool keeps_means{};  // it has means of the ground, which some styles ask for
    bool clusters{};     // its ground is drawn by clusters
    // What is drawn in the place of the region's meshes; null: themselves.
    std::shared_ptr<const std::vector<PlacedMesh>> meshes{};
};
// A scene of pages with the view's images over it. Errors: the device, posts, images.
Result<Scene> scene_with_images(const Gpu& gpu, const Region& region, const RegionCuts& cuts, GridPages pages,
                                const View& view, const SceneChoice& choice);

// What a window draws first of a region.
struct OpenedScene {
    Scene scene;
    bool is_coarse{};    // every n-th post, or without means of the ground: a finer one is to come
    bool keeps_means{};  // the finer one has them
    EyeMeshes meshes{};
    bool is_of_bounds{};  // WorldLevels
};
// A scene of first_pages() as scene_with_images() makes it, but without means that take long. Clusters are
// chosen here, as the view asks for. Errors: as scene_with_images() and draws_clusters().
Result<OpenedScene> first_scene(const Gpu& gpu, const Region& region, const RegionCuts& cuts, GridPages pages,
                                View& view, SceneChoice choice);
// All of a region, or what can be shown soon, with pages made here. Errors: as first_pages() and
// first_scene().
Result<OpenedScene> open_scene(const Gpu& gpu, const Region& region, const RegionCuts& cuts, View& view,
                               SceneChoice choice, const RenderProgress& progress);

// What paths are called in a title: the file or the folder that is named first.
std::string name_of_paths(const std::vector<std::string>& paths);

// A window is drawn in one piece, where a picture has tiles. Errors (usage): it is too large for that.
Result<void> check_window_size(const Camera& camera, const DeviceReport& device);

// The next free name for a picture of the window, from the time: orograph-20261121T090000Z.png, then -2, -3
// ...
std::string free_picture_name(std::int64_t time_utc_s, const std::string& ending = ".png");

}  // namespace oro
