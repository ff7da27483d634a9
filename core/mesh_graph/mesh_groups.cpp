#include "core/mesh_graph/mesh_groups.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <limits>

namespace oro {
namespace {

class Halving {
  public:
    Halving(std::span<const glm::dvec3> middles, std::size_t full, int level,
            const std::function<bool(std::span<const std::uint32_t>)>& fits)
        : middles_(middles), full_(full), level_(level), fits_(fits) {}

    void halve(std::span<std::uint32_t> triangles, int depth) {
        if (triangles.size() <= 1 || fits_(triangles)) {
            parts.emplace_back(triangles.begin(), triangles.end());
            std::sort(parts.back().begin(), parts.back().end());
            return;
        }
        constexpr double endless = std::numeric_limits<double>::infinity();
        glm::dvec3 low(endless), high(-endless);
        for (const std::uint32_t triangle : triangles)
            low = glm::min(low, middles_[triangle]), high = glm::max(high, middles_[triangle]);
        const glm::dvec3 size = high - low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const auto before =
            static_cast<std::size_t>(share(triangles.size(), depth) * static_cast<double>(triangles.size()));
        const std::size_t half = std::clamp<std::size_t>(before, 1, triangles.size() - 1);
        std::nth_element(triangles.begin(), triangles.begin() + static_cast<std::ptrdiff_t>(half),
                         triangles.end(), [&](std::uint32_t a, std::uint32_t b) {
                             const double one = middles_[a][axis], other = middles_[b][axis];
                             return one != other ? one < other : a < b;
                         });
        halve(triangles.first(half), depth + 1);
        halve(triangles.subspan(half), depth + 1);
    }

    HalvedParts parts;

  private:
    // Where borders of one level lie, those of the next do not.
    [[nodiscard]] double share(std::size_t count, int depth) const {
        constexpr std::array shares{0.5, 0.38, 0.62};
        const std::size_t pieces = (count + full_ - 1) / full_;
        if (pieces <= 2) return 0.5 + 0.1 * ((level_ % 3) - 1);
        return shares[static_cast<std::size_t>(level_ + depth) % 3];
    }

    std::span<const glm::dvec3> middles_;
    std::size_t full_;
    int level_;
    const std::function<bool(std::span<const std::uint32_t>)>& fits_;
};

}  // namespace

HalvedParts halved(std::span<const glm::dvec3> middles, std::vector<std::uint32_t> triangles,
                   std::size_t full, int level,
                   const std::function<bool(std::span<const std::uint32_t>)>& fits) {
    Halving halving(middles, full, level, fits);
    if (!triangles.empty()) halving.halve(triangles, 0);
    return std::move(halving.parts);
}

}  // namespace oro
