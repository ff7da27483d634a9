#include "apps/accuracy/truth.h"

#include "apps/view/model_names.h"
#include "core/baked/file_pages.h"
#include "core/base/parallel.h"

namespace oro {

Camera true_camera(const View& view, const Region& region) {
    Camera camera = view.camera;
    // An empty field is N = 0.
    camera.eye.h_m += region.geoid_left_out.at_m(camera.eye.lat_deg, camera.eye.lon_deg);
    return camera;
}

Sight true_sight(const View& view, const Region& region) {
    return sight_from(true_camera(view, region).eye, view.model.air);
}

std::string light_line(const View& view, const Region& region) {
    return "Light: " + light_words(view.model.air, true_camera(view, region).eye.h_m) + ".\n";
}

Result<std::unique_ptr<TrueScene>> TrueScene::of(const View& view, const Region& region) {
    std::unique_ptr<TrueScene> scene(new TrueScene);
    if (region.file) {
        ORO_TRY(scene->field_, field_in_memory(*region.file));
    } else if (!region.geoid_left_out.N_m.empty()) {
        scene->field_ = region.field;
        scene->field_->undulation = region.geoid_left_out;
        scene->field_->N_of_posts_m = region.N_of_posts_left_out_m;
    }
    scene->surface_.emplace(scene->field_ ? *scene->field_ : region.field, view.exaggeration, thread_count());
    scene->sight_ = true_sight(view, region);
    return scene;
}

}  // namespace oro
