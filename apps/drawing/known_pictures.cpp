#include "apps/drawing/known_pictures.h"

namespace oro {

std::vector<FrameView> known_pictures(const View& view, const Style& style, std::span<const Camera> cameras,
                                      double oversampling) {
    std::vector<FrameView> pictures;
    if (style.frame.shadows != 0 || style.frame.sky_openness != 0 || view.map ||
        view.heights == HeightStorage::i16)
        return pictures;
    pictures.reserve(cameras.size());
    for (const Camera& camera : cameras)
        pictures.push_back({camera,
                            {0, 0, camera.width_px, camera.height_px, {0.5, 0.5}},
                            oversampling * view.tau_px,
                            view.model});
    return pictures;
}

}  // namespace oro
