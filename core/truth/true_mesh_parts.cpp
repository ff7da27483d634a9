#include "core/truth/true_mesh_parts.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <limits>
#include <utility>

#include "core/truth/box_walk.h"
#include "core/truth/line_in_air.h"
#include "core/truth/nearest_place.h"

namespace oro {
namespace {

constexpr std::uint64_t bytes_of_a_true_triangle = 60;

}  // namespace

TrueMeshParts::TrueMeshParts(std::shared_ptr<const TriangleSource> source, std::uint32_t number, int threads,
                             std::uint64_t most_bytes)
    : source_(std::move(source)), number_(number), threads_(threads), most_bytes_(most_bytes) {
    const std::span<const TriangleSource::Sphere> spheres = source_->spheres();
    place_of_.assign(spheres.size(), held_.end());
    if (spheres.empty()) return;
    origin_m_ = spheres.front().centre_m;
    build(0, spheres.size());
}

// A tree over parts that are beside each other; gives its node.
std::uint32_t TrueMeshParts::build(std::size_t first, std::size_t last) {
    const auto number = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    if (last - first == 1) {
        const TriangleSource::Sphere& sphere = source_->spheres()[first];
        // From far away a line is rounded as TrueMesh's boxes allow for.
        const double radius_m = sphere.radius_m + LineInAir::rounded_m;
        nodes_[number] = {sphere.centre_m - origin_m_ - radius_m, sphere.centre_m - origin_m_ + radius_m, 0,
                          static_cast<std::uint32_t>(first)};
        return number;
    }
    const std::size_t half = first + (last - first) / 2;
    const std::uint32_t one = build(first, half), other = build(half, last);
    nodes_[number] = {glm::min(nodes_[one].low, nodes_[other].low),
                      glm::max(nodes_[one].high, nodes_[other].high), other, 0};
    return number;
}

std::shared_ptr<const TrueMeshParts::Held> TrueMeshParts::held(std::size_t number) const {
    const std::lock_guard lock(mutex_);
    if (place_of_[number] == held_.end()) return nullptr;
    held_.splice(held_.begin(), held_, place_of_[number]);
    return held_.front();
}

void TrueMeshParts::note_fault(std::size_t number, const Error& fault) const {
    const std::lock_guard lock(mutex_);
    if (fault_ && faulty_part_ <= number) return;
    fault_ = fault, faulty_part_ = number;
}

std::shared_ptr<const TrueMeshParts::Held> TrueMeshParts::part(std::size_t number) const {
    if (auto found = held(number)) return found;
    Result<TriangleSource::Part> read = source_->part(number);
    if (!read) note_fault(number, read.error());
    TriangleSource::Part part = read ? std::move(*read) : TriangleSource::Part{};
    auto mesh = std::make_shared<const TrueMesh>(std::move(part.triangles), number_, 1);
    const auto one = std::make_shared<const Held>(Held{number, std::move(mesh), std::move(part.numbers)});
    const std::lock_guard lock(mutex_);
    if (place_of_[number] != held_.end()) return one;  // another thread was as fast
    held_.push_front(one);
    place_of_[number] = held_.begin();
    held_bytes_ += bytes_of_a_true_triangle * one->mesh->size();
    while (held_bytes_ > most_bytes_ && held_.size() > 1) {
        held_bytes_ -= bytes_of_a_true_triangle * held_.back()->mesh->size();
        place_of_[held_.back()->number] = held_.end();
        held_.pop_back();
    }
    return one;
}

std::optional<TrueMesh::Hit> TrueMeshParts::first_hit(const Ecef& eye, const Refraction& refraction,
                                                      const glm::dvec3& start_m, const glm::dvec3& direction,
                                                      double reach_m) const {
    if (nodes_.empty()) return std::nullopt;
    const LineInAir line(glm::dmat3(1.0), eye.m - origin_m_, refraction, start_m, direction);
    std::optional<TrueMesh::Hit> nearest;
    double most_m = reach_m;
    const auto begin_of = [&](std::uint32_t number) {
        return line.box_begin_m(nodes_[number].low, nodes_[number].high, most_m);
    };
    const auto below_of = below_in_order([&](std::uint32_t number) { return nodes_[number].second; });
    walk_boxes(most_m, begin_of, below_of, [&](std::uint32_t number) {
        const std::shared_ptr<const Held> one = part(nodes_[number].part);
        auto hit = one->mesh->first_hit(eye, refraction, start_m, direction, most_m);
        if (!hit) return;
        most_m = hit->along_m;
        hit->triangle = one->numbers[hit->triangle];
        nearest = hit;
    });
    return nearest;
}

std::optional<glm::dvec3> TrueMeshParts::nearest_m(const glm::dvec3& at_m, double reach_m) const {
    if (nodes_.empty()) return std::nullopt;
    const glm::dvec3 at = at_m - origin_m_;
    std::optional<glm::dvec3> nearest;
    double most_m = reach_m;
    const auto begin_of = [&](std::uint32_t number) {
        return box_away_m(nodes_[number].low, nodes_[number].high, at);
    };
    const auto below_of = below_in_order([&](std::uint32_t number) { return nodes_[number].second; });
    walk_boxes(most_m, begin_of, below_of, [&](std::uint32_t number) {
        const auto place = part(nodes_[number].part)->mesh->nearest_m(at_m, most_m);
        if (!place) return;
        most_m = glm::distance(*place, at_m);
        nearest = place;
    });
    return nearest;
}

const TrueMesh& TrueMeshParts::whole() const {
    std::call_once(reads_whole_, [&] {
        Result<MeshTriangles> all = source_->whole();
        if (!all) {
            note_fault(0, all.error());
            // As many as are asked for, and all at one place.
            MeshTriangles none;
            none.vertices_m.emplace_back(0.0);
            none.triangles.assign(source_->triangles(), {0, 0, 0});
            none.features.assign(source_->triangles(), 0);
            all = std::move(none);
        }
        whole_ = std::make_unique<const TrueMesh>(std::move(*all), number_, threads_);
    });
    return *whole_;
}

Result<void> TrueMeshParts::health() const {
    const std::lock_guard lock(mutex_);
    return fault_ ? Result<void>(*fault_) : Result<void>();
}

}  // namespace oro
