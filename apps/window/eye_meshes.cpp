#include "apps/window/eye_meshes.h"

#include <utility>

#include "apps/drawing/drape.h"
#include "apps/drawing/mesh_cut.h"
#include "apps/navigation/view_history.h"

namespace oro {
namespace {

bool is_of(const Camera& chosen, double tau_px, MeshParts parts, const View& view, const Camera& camera) {
    return parts == mesh_asked_by(view, {}).parts && is_same_view(chosen, camera) &&
           chosen.width_px == camera.width_px && chosen.height_px == camera.height_px &&
           tau_px == view.tau_px;
}

void give_up(EyeMeshes& meshes) {
    meshes.work.reset();
    meshes.coming.reset();
    meshes.coming_scene.reset();
}

// What is asked of the view is copied: it changes while the work goes on.
void begin_choice(EyeMeshes& meshes, const MeshTarget& target, const Camera& camera) {
    meshes.begun = Clock::now();
    meshes.work = std::make_unique<BackgroundWork<ChosenMeshes>>(
        [detail = meshes.detail, before = meshes.cut, &region = target.region, &cuts = target.cuts, camera,
         tau_px = target.view.tau_px,
         asked = mesh_asked_by(target.view, memory_of_pages(target.view, target.memory)),
         exaggeration = target.view.exaggeration](const auto&,
                                                  const std::stop_token& stop) -> Result<ChosenMeshes> {
            ORO_TRY(MeshCut cut, mesh_cut_of(*detail, asked, std::span(&camera, 1), &before));
            ChosenMeshes chosen{std::move(cut), camera, tau_px};
            chosen.is_new = chosen.cut.meshes != before.meshes;
            if (!chosen.is_new || stop.stop_requested()) return chosen;
            ORO_TRY(chosen.pages, pages_between(region, cuts, exaggeration, chosen.cut.meshes.get()));
            return chosen;
        });
}

// Images lie over what is coming before it is shown.
Result<void> take_choice(EyeMeshes& meshes, const MeshTarget& target) {
    auto done = take_finished(meshes.work);
    if (!done) return {};
    meshes.ended = Clock::now();
    ORO_TRY(ChosenMeshes chosen, std::move(*done));
    if (!chosen.is_new) {
        meshes.cut = std::move(chosen.cut);
        meshes.camera = chosen.camera, meshes.tau_px = chosen.tau_px;
        return {};
    }
    ORO_TRY(meshes.coming_scene,
            scene_between(target.gpu, std::move(chosen.pages), target.scene.grids().front().shared_memory()));
    meshes.coming = std::move(chosen);
    if (!meshes.coming_scene) return {};
    return lay_images(target.view, target.memory, target.gpu, *meshes.coming_scene, true, nullptr,
                      target.region.grids.size());
}

bool may_begin(const EyeMeshes& meshes, bool is_moving) {
    return !is_moving || Clock::now() - meshes.ended >= meshes.ended - meshes.begun;
}

}  // namespace

bool are_chosen_for(const EyeMeshes& meshes, const View& view, const Camera& camera) {
    return !meshes.detail || (!meshes.work && !meshes.coming &&
                              is_of(meshes.camera, meshes.tau_px, meshes.cut.parts, view, camera));
}

Result<bool> follow_with_meshes(EyeMeshes& meshes, const MeshTarget& target, const Camera& camera,
                                bool is_moving) {
    if (are_chosen_for(meshes, target.view, camera)) return false;
    if (meshes.work) ORO_CHECK(take_choice(meshes, target));
    if (meshes.coming) return meshes.coming_scene ? meshes.coming_scene->advance_coarsest_pages() : true;
    if (!meshes.work && may_begin(meshes, is_moving) && !are_chosen_for(meshes, target.view, camera))
        begin_choice(meshes, target, camera);
    return false;
}

void take_coming(EyeMeshes& meshes, Scene& scene) {
    scene.replace_between(std::exchange(meshes.coming_scene, std::nullopt));
    meshes.cut = std::move(meshes.coming->cut);
    meshes.camera = meshes.coming->camera, meshes.tau_px = meshes.coming->tau_px;
    meshes.coming.reset();
}

void forget_drawn(EyeMeshes& meshes) {
    give_up(meshes);
    meshes.cut = {};
    meshes.tau_px = 0.0;
}

Result<bool> choose_cut(EyeMeshes& meshes, const View& view, const MemoryOptions& memory,
                        const Camera& camera) {
    if (!meshes.detail || are_chosen_for(meshes, view, camera)) return false;
    give_up(meshes);
    ORO_TRY(MeshCut cut,
            mesh_cut_of(*meshes.detail, mesh_asked_by(view, memory), std::span(&camera, 1), &meshes.cut));
    const bool is_drawn = cut.meshes == meshes.cut.meshes;
    meshes.cut = std::move(cut);
    meshes.camera = camera, meshes.tau_px = view.tau_px;
    return !is_drawn;
}

Result<void> draw_cut_of(EyeMeshes& meshes, const MeshTarget& target, const Camera& camera,
                         const std::function<Result<void>()>& before) {
    ORO_TRY(const bool is_new,
            choose_cut(meshes, target.view, memory_of_pages(target.view, target.memory), camera));
    if (!is_new) return {};
    ORO_CHECK(before());
    ORO_CHECK(redraw_meshes(target.gpu, target.region, target.cuts, target.view.exaggeration,
                            *meshes.cut.meshes, target.scene));
    return lay_images(target.view, target.memory, target.gpu, target.scene, true);
}

}  // namespace oro
