#include "core/mesh_graph/mesh_groups.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/mesh_graph/longest_axis.h"

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
        const auto before =
            static_cast<std::size_t>(share(triangles.size(), depth) * static_cast<double>(triangles.size()));
        const std::size_t half = std::clamp<std::size_t>(before, 1, triangles.size() - 1);
        divide_along_longest_axis(triangles, middles_, half);
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
