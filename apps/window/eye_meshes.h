// Meshes at the detail of a window's eye: chosen beside its frames, drawn once they are on the GPU.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "apps/drawing/region_scene.h"
#include "apps/options/options.h"
#include "apps/view/view.h"
#include "apps/window/background_work.h"
#include "core/base/elapsed.h"
#include "core/earth/camera.h"
#include "geo/together/cut_regions.h"
#include "geo/together/mesh_detail.h"
#include "render/scene/scene.h"

namespace oro {

// What an eye needs of the meshes.
struct ChosenMeshes {
    MeshCut cut;
    Camera camera;  // for which it was chosen,
    double tau_px{};
    bool is_new{};      // it is not what was drawn before: `pages` have it
    GridPages pages{};  // none: nothing is drawn beside the grids
};

// Where a view asks for that (--mesh clusters, --mesh-level). Ends before the region that its work reads.
struct EyeMeshes {
    std::shared_ptr<const MeshDetail> detail{};  // null: all of their triangles are drawn
    MeshCut cut{};                               // what is drawn,
    Camera camera{};                             // ... chosen for this one,
    double tau_px{};
    std::unique_ptr<BackgroundWork<ChosenMeshes>> work{};  // what is being chosen
    std::optional<ChosenMeshes> coming{};                  // what was, until it is drawn,
    std::optional<Scene> coming_scene{};                   // ... on its way to the GPU
    Clock::time_point begun{}, ended{};                    // the last choice
};

// What a view's meshes are drawn of and into. The region, its cuts and the scene outlive what is chosen.
struct MeshTarget {
    const Region& region;
    const RegionCuts& cuts;
    const View& view;
    const MemoryOptions& memory;  // of images over them
    const Gpu& gpu;
    Scene& scene;
};

// Whether what is drawn was chosen for that camera with the view's tau, and nothing else is coming.
bool are_chosen_for(const EyeMeshes& meshes, const View& view, const Camera& camera);

// Goes on without waiting towards what a camera with the view's tau needs of the meshes: begins to choose
// it, or looks whether that is done, or loads it onto the GPU. At least as long as a choice took passes until
// the next while the eye moves. True where all is on the GPU: take_coming() draws it. Errors: those of
// mesh_cut_of(); the device.
Result<bool> follow_with_meshes(EyeMeshes& meshes, const MeshTarget& target, const Camera& camera,
                                bool is_moving);
// Draws what follow_with_meshes() has loaded. No frame of the scene is under way.
void take_coming(EyeMeshes& meshes, Scene& scene);

// What is drawn is not known any more.
void forget_drawn(EyeMeshes& meshes);

// Chooses what a camera with the view's tau needs of the meshes, here and now; what was coming is given up.
// True: that is not what is drawn, and the scene is to take it. Errors: those of mesh_cut_of().
Result<bool> choose_cut(EyeMeshes& meshes, const View& view, const MemoryOptions& memory,
                        const Camera& camera);
// choose_cut(), drawn. before: waits until no frame of the scene is under way. Errors: its; the device.
Result<void> draw_cut_of(EyeMeshes& meshes, const MeshTarget& target, const Camera& camera,
                         const std::function<Result<void>()>& before);

}  // namespace oro
