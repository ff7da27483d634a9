#include "apps/view/truth.h"

#include "apps/view/model_names.h"

namespace oro {

Camera true_camera(const View& view, const Region& region) {
    Camera camera = view.camera;
    // An empty field is N = 0.
    camera.eye.h_m += region.grids.front().geoid_left_out.at_m(camera.eye.lat_deg, camera.eye.lon_deg);
    return camera;
}

Sight true_sight(const View& view, const Region& region) {
    return sight_from(true_camera(view, region).eye, view.model.air);
}

std::string light_line(const View& view, const Region& region) {
    return "Light: " + light_words(view.model.air, true_camera(view, region).eye.h_m) + ".\n";
}

Result<std::unique_ptr<TrueScene>> TrueScene::of(const View& view, const Region& region,
                                                 const RegionCuts& cuts) {
    std::unique_ptr<TrueScene> scene(new TrueScene);
    ORO_TRY(scene->ground_, RegionGround::of(region, cuts, view.exaggeration, GroundHeights::true_ones));
    scene->sight_ = true_sight(view, region);
    return scene;
}

Result<std::unique_ptr<TrueScene>> TrueScene::of(const View& view, const Region& region) {
    ORO_TRY(const RegionCuts cuts, cut_regions(region));
    return of(view, region, cuts);
}

}  // namespace oro
