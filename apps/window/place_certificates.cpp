#include "apps/window/place_certificates.h"

#include <algorithm>
#include <cmath>

#include "apps/navigation/view_history.h"

namespace oro {

Result<std::optional<SampledDetail::Bound>> PlaceCertificates::at(const Scene& scene, std::size_t grid,
                                                                  double lat_deg, double lon_deg,
                                                                  const View& view) {
    using Bound = std::optional<SampledDetail::Bound>;
    if (grid >= scene.grids().size() || scene.grids()[grid].clusters()) return Bound();
    const Camera& camera = view.camera;
    if (!is_same_view(camera, camera_) || camera.width_px != camera_.width_px ||
        camera.height_px != camera_.height_px || view.tau_px != tau_px_ || view.model.air != air_)
        forget();
    camera_ = camera;
    tau_px_ = view.tau_px;
    air_ = view.model.air;
    const RegionPages& pages = scene.grids()[grid].pages();
    details_.resize(std::max(details_.size(), grid + 1));
    if (!details_[grid])
        details_[grid] = std::make_unique<SampledDetail>(pages, camera, view.tau_px,
                                                         Refraction(camera.eye, view.model.air));
    const PostGrid& posts = pages.facts().grid;
    const auto [row, column] = posts.post_at(lat_deg, lon_deg);
    const auto cell = [](double post, int count) {
        return std::clamp(static_cast<int>(std::floor(post)), 0, std::max(count - 2, 0));
    };
    ORO_TRY(const SampledDetail::Bound bound,
            details_[grid]->at(cell(row, posts.rows()), cell(column, posts.columns())));
    return Bound(bound);
}

}  // namespace oro
