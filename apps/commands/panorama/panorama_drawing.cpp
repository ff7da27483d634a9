#include "apps/commands/panorama/panorama_drawing.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "apps/command_line/refusals.h"
#include "apps/drawing/drape.h"
#include "apps/drawing/kept_drawing.h"
#include "apps/drawing/known_pictures.h"
#include "apps/drawing/mesh_cut.h"
#include "apps/options/view_limits.h"
#include "apps/panorama/elevations.h"
#include "apps/report/progress_bar.h"
#include "core/base/parallel.h"
#include "core/lod/ground_means.h"

namespace oro {
namespace {

constexpr double usual_px_per_deg = 20.0;
// Of a scene: it is held as a whole, 3 bytes each.
constexpr double most_scene_pixels = 2.0e8;

// Of the tiles that draw_scene() draws.
KnownPictures pictures_of_panorama(const View& view, const Style& style, const Cylinder& around) {
    const CylinderCut cut = cut_of(style);
    std::vector<Camera> cameras;
    for (const CylinderTile& tile : cylinder_tiles(around, view.camera.eye, cut))
        cameras.push_back(tile.camera);
    return known_pictures(view, style, cameras, cut.oversampling);
}

}  // namespace

Result<bool> set_frame(const AskedFrame& asked, const TrueGround& ground, View& view) {
    bool leaves_out_near = false;
    PanoramaFrame frame = view.panorama.value_or(PanoramaFrame{});
    if (asked.sector) {
        frame.from_deg = asked.sector->first;
        frame.sweep_deg = asked.sector->second;
    }
    if (asked.elevation) {
        frame.low_deg = asked.elevation->first;
        frame.high_deg = asked.elevation->second;
    } else if (!view.panorama) {
        const Elevations found = elevations_for(ground, view.camera.eye, view.model, frame.from_deg,
                                                frame.sweep_deg, thread_count());
        frame.low_deg = found.low_deg;
        frame.high_deg = found.high_deg;
        leaves_out_near = found.leaves_out_near;
    }
    frame.ridges = asked.ridges.value_or(frame.ridges);
    Camera& camera = view.camera;
    if (asked.width_px)
        camera.width_px = *asked.width_px;
    else if (!view.panorama)
        camera.width_px = std::max(static_cast<int>(view_limits::panorama_width_px.low),
                                   static_cast<int>(std::lround(frame.sweep_deg * usual_px_per_deg)));
    camera.attitude = {turned_deg(frame.from_deg + 0.5 * frame.sweep_deg), 0.0, 0.0};
    camera.vertical_fov_deg =
        std::clamp(frame.high_deg - frame.low_deg, view_limits::fov_deg.low, view_limits::fov_deg.high);
    view.panorama = frame;
    const Cylinder around = cylinder_of(view);
    camera.height_px = around.height_px();
    const double pixels = static_cast<double>(around.width_px) * around.height_px();
    if (pixels > most_scene_pixels || !view_limits::side_px.hold(around.height_px()))
        return refused(
            "--width", std::to_string(around.width_px),
            "makes a scene of " + std::to_string(around.width_px) + " x " +
                std::to_string(around.height_px()) +
                " pixels, more than 200,000,000 or 65,500 rows: give a smaller one, or fewer --elevation");
    return leaves_out_near;
}

Result<Style> style_of_panorama(const View& view, const Region& region) {
    const std::vector<CylinderTile> tiles = cylinder_tiles(cylinder_of(view), view.camera.eye, {1.0});
    View part = view;
    part.camera = tiles[tiles.size() / 2].camera;
    // Invented trees would hide mountains that are there, and are named.
    if (!part.trees) part.trees = false;
    return load_style(part, region.grids.front().field, WorldLight::drawn);
}

Result<CylinderPicture> draw_panorama(const View& view, const Region& region, const RegionCuts& cuts,
                                      const TrueGround& ground, const Style& style, const Cylinder& around,
                                      const PanoramaDrawing& drawing, const Progress& progress) {
    ORO_TRY(const std::shared_ptr<const Gpu> gpu, gpu_to_draw_with());
    ORO_TRY(GridPages pages,
            make_grid_pages(
                region, cuts, view.exaggeration, [&](double share) { progress(share, "measuring levels"); },
                drawing.stop, pictures_of_panorama(view, style, around)));
    ORO_TRY(const std::shared_ptr<const MeshDetail> meshes, mesh_detail_of(region, view));
    MeshCut cut;
    if (meshes) {
        std::vector<Camera> cameras;
        // Finer ones are drawn and averaged: what is within tau of these is.
        for (const CylinderTile& tile : cylinder_tiles(around, view.camera.eye, {1.0}))
            cameras.push_back(tile.camera);
        ORO_TRY(cut,
                mesh_cut_of(*meshes, mesh_asked_by(view, memory_of_pages(view, drawing.memory)), cameras));
    }
    ORO_TRY(RegionScene whole,
            scene_of_region(*gpu, region, cuts, std::move(pages),
                            {view.exaggeration, memory_of_pages(view, drawing.memory), view.heights,
                             asks_for_means(style.frame), view.mesh == "clusters" && !meshes, view.mesh_level,
                             cut.meshes}));
    Scene& scene = whole.scene;
    if (const std::string note = note_of_missing_footprints(style.frame, scene.pages()); !note.empty())
        say(drawing.quiet, note);
    ORO_CHECK(lay_images(view, drawing.memory, *gpu, scene, drawing.quiet));
    return draw_scene(
        view, region, ground, around, *gpu, scene, style, [&](double share) { progress(share, "drawing"); },
        drawing.stop);
}

}  // namespace oro
