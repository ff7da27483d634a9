#include "core/made_pages/polar_horizon.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace oro {
namespace {

constexpr float no_limit = std::numeric_limits<float>::infinity();
constexpr double finest_bin_rad = 0.0026;

}  // namespace

PolarHorizon::PolarHorizon(double half_rad, double reach_m, double step_m)
    : is_whole_(half_rad >= std::numbers::pi),
      half_rad_(std::min(half_rad, std::numbers::pi)),
      bin_rad_(finest_bin_rad),
      step_m_(step_m),
      bins_(static_cast<int>(std::ceil(2.0 * half_rad_ / bin_rad_))),
      rings_(static_cast<int>(std::ceil(reach_m / step_m)) + 1) {
    bin_rad_ = 2.0 * half_rad_ / bins_;
    least_.assign(static_cast<std::size_t>(bins_) * static_cast<std::size_t>(rings_), no_limit);
    hidden_.assign(least_.size(), -no_limit);
}

template <class Asked>
void PolarHorizon::each_bin(double from_rad, double to_rad, const Asked& asked) const {
    const double from = std::floor((from_rad + half_rad_) / bin_rad_),
                 to = std::floor((to_rad + half_rad_) / bin_rad_);
    if (!is_whole_) {
        const int last = static_cast<int>(std::min(to, static_cast<double>(bins_ - 1)));
        for (int bin = static_cast<int>(std::max(from, 0.0)); bin <= last; ++bin) asked(bin);
        return;
    }
    const int count = static_cast<int>(std::min(to - from + 1.0, static_cast<double>(bins_)));
    int bin = static_cast<int>(from) % bins_;
    if (bin < 0) bin += bins_;
    for (int i = 0; i < count; ++i, bin = bin + 1 == bins_ ? 0 : bin + 1) asked(bin);
}

void PolarHorizon::take(double azimuth_rad, double around_rad, double nearest_m, double farthest_m,
                        float tangent) {
    const int first = std::max(0, static_cast<int>(std::floor(nearest_m / step_m_)));
    const int last = std::min(rings_ - 1, static_cast<int>(std::floor(farthest_m / step_m_)));
    each_bin(azimuth_rad - around_rad, azimuth_rad + around_rad, [&](int bin) {
        for (int ring = first; ring <= last; ++ring) {
            float& least = least_[at(bin, ring)];
            least = std::min(least, tangent);
        }
    });
}

void PolarHorizon::finish_to(double distance_m) {
    const int end = std::min(rings_ - 1, static_cast<int>(std::floor(distance_m / step_m_)));
    for (; finished_ < end; ++finished_)
        for (int bin = 0; bin < bins_; ++bin) {
            // A cell of which nothing was taken is not known.
            const float least = least_[at(bin, finished_)];
            const float before = hidden_[at(bin, finished_)];
            hidden_[at(bin, finished_ + 1)] = least < no_limit ? std::max(before, least) : before;
        }
}

float PolarHorizon::hidden_below(double from_rad, double to_rad, double distance_m) const {
    const int ring = std::min(finished_, static_cast<int>(std::floor(distance_m / step_m_)));
    if (ring < 0 || (!is_whole_ && (from_rad < -half_rad_ || to_rad > half_rad_))) return -no_limit;
    float least = no_limit;
    each_bin(from_rad, to_rad, [&](int bin) { least = std::min(least, hidden_[at(bin, ring)]); });
    return least;
}

}  // namespace oro
