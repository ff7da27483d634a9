#include "apps/drawing/known_pictures.h"

#include <algorithm>

namespace oro {

KnownPictures known_pictures(const View& view, const Style& style, std::span<const Camera> cameras,
                             double oversampling) {
    KnownPictures pictures{{}, shadow_request(style.frame)};
    const auto has_other_eye = [&](const Camera& camera) {
        const Geodetic &eye = camera.eye, &first = cameras.front().eye;
        return eye.lat_deg != first.lat_deg || eye.lon_deg != first.lon_deg || eye.h_m != first.h_m;
    };
    const bool has_several_eyes = std::ranges::any_of(cameras, has_other_eye);
    if ((pictures.light.sun_enu && has_several_eyes) || view.map || view.heights == HeightStorage::i16)
        return {};
    pictures.views.reserve(cameras.size());
    for (const Camera& camera : cameras)
        pictures.views.push_back({camera,
                                  {0, 0, camera.width_px, camera.height_px, {0.5, 0.5}},
                                  oversampling * view.tau_px,
                                  view.model});
    return pictures;
}

}  // namespace oro
