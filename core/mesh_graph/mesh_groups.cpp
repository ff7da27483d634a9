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
            const std::function<bool(std::span<const std::uint32_t>)>& fits,
            const std::function<void(std::span<const std::uint32_t>)>& take)
        : middles_(middles), full_(full), level_(level), fits_(fits), take_(take) {}

    void halve(std::span<std::uint32_t> triangles, int depth) {
        if (triangles.size() <= 1 || fits_(triangles)) {
            std::sort(triangles.begin(), triangles.end());
            take_(triangles);
            return;
        }
        const auto before =
            static_cast<std::size_t>(share(triangles.size(), depth) * static_cast<double>(triangles.size()));
        const std::size_t half = std::clamp<std::size_t>(before, 1, triangles.size() - 1);
        divide_along_longest_axis(triangles, middles_, half);
        halve(triangles.first(half), depth + 1);
        halve(triangles.subspan(half), depth + 1);
    }

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
    const std::function<void(std::span<const std::uint32_t>)>& take_;
};

}  // namespace

void halve_in_place(std::span<const glm::dvec3> middles, std::span<std::uint32_t> triangles, std::size_t full,
                    int level, const std::function<bool(std::span<const std::uint32_t>)>& fits,
                    const std::function<void(std::span<const std::uint32_t>)>& take) {
    if (!triangles.empty()) Halving(middles, full, level, fits, take).halve(triangles, 0);
}

HalvedParts halved(std::span<const glm::dvec3> middles, std::vector<std::uint32_t> triangles,
                   std::size_t full, int level,
                   const std::function<bool(std::span<const std::uint32_t>)>& fits) {
    HalvedParts parts;
    halve_in_place(middles, triangles, full, level, fits, [&](std::span<const std::uint32_t> part) {
        parts.emplace_back(part.begin(), part.end());
    });
    return parts;
}

}  // namespace oro
