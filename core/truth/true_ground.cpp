#include "core/truth/true_ground.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

namespace oro {

TrueGround::TrueGround(std::vector<Grid> grids, std::shared_ptr<const GroundBeside> beside)
    : grids_(std::move(grids)), by_rank_(grids_.size()), beside_(std::move(beside)) {
    assert(!grids_.empty());
    std::iota(by_rank_.begin(), by_rank_.end(), std::size_t{0});
    std::ranges::stable_sort(by_rank_, {}, [&](std::size_t grid) { return grids_[grid].rank; });
}

const std::vector<SurfaceTriangle>& TrueGround::pieces() const {
    static const std::vector<SurfaceTriangle> none;
    return beside_ ? beside_->pieces : none;
}

std::span<const TrueMesh> TrueGround::meshes() const {
    return beside_ ? std::span<const TrueMesh>(beside_->meshes) : std::span<const TrueMesh>();
}

std::optional<std::size_t> TrueGround::grid_at(double lat_deg, double lon_deg) const {
    for (const std::size_t grid : by_rank_)
        if (surface(grid).h_m(lat_deg, lon_deg)) return grid;
    return std::nullopt;
}

std::optional<std::size_t> TrueGround::data_grid_at(double lat_deg, double lon_deg) const {
    for (const std::size_t grid : by_rank_)
        if (!grids_[grid].is_invented && surface(grid).h_m(lat_deg, lon_deg)) return grid;
    return std::nullopt;
}

bool TrueGround::shows(std::size_t grid, double lat_deg, double lon_deg) const {
    for (const std::size_t before : by_rank_) {
        if (before == grid || grids_[before].rank >= grids_[grid].rank) return true;
        if (surface(before).h_m(lat_deg, lon_deg)) return false;
    }
    return true;
}

std::optional<double> TrueGround::h_m(double lat_deg, double lon_deg) const {
    for (const std::size_t grid : by_rank_)
        if (const auto h_m = surface(grid).h_m(lat_deg, lon_deg)) return h_m;
    return std::nullopt;
}

double TrueGround::N_m(double lat_deg, double lon_deg) const {
    return surface(grid_at(lat_deg, lon_deg, 0)).field().undulation.at_m(lat_deg, lon_deg);
}

Result<void> TrueGround::health() const {
    for (const Grid& grid : grids_) ORO_CHECK(grid.surface->field().health());
    for (const TrueMesh& mesh : meshes()) ORO_CHECK(mesh.health());
    return {};
}

}  // namespace oro
