#include "core/baked/net_bytes.h"

#include <algorithm>
#include <string>

#include "core/baked/packed_corrections.h"
#include "core/base/little_endian.h"

namespace oro::region_format {
namespace {

// Shows all numbers of the front, in their order.
template <class Visit, class Stored>
void exchange_front(Visit& visit, Stored& stored) {
    for (auto* axis : {&stored.down, &stored.across}) {
        auto& [first, posts, patch_posts, patches] = *axis;
        visit(first);
        visit(posts);
        visit(patch_posts);
        visit(patches);
    }
    visit(stored.error_m);
}

Error wrong_net(const std::string& what) {
    return {ErrorKind::failed, "grid of posts", what};
}

}  // namespace

std::vector<std::byte> net_to_bytes(const GridNet& net) {
    const GridNet::Stored stored = net.stored();
    NumberWriter put;
    exchange_front(put, stored);
    for (const glm::dvec3& coefficient : stored.coefficients)
        for (int axis = 0; axis < 3; ++axis) put(coefficient[axis]);
    if (!stored.corrections.empty()) {
        const std::vector<std::byte> corrections = pack_corrections(stored);
        put.bytes.insert(put.bytes.end(), corrections.begin(), corrections.end());
    }
    return std::move(put.bytes);
}

Result<std::shared_ptr<const GridNet>> net_from_bytes(std::span<const std::byte> bytes, int rows,
                                                      int columns) {
    if (bytes.size() < net_front_bytes) return wrong_net("it has " + std::to_string(bytes.size()) + " bytes");
    GridNet::Stored stored;
    NumberReader get(bytes);
    exchange_front(get, stored);
    if (stored.down.posts != rows || stored.across.posts != columns)
        return wrong_net("it has " + std::to_string(stored.down.posts) + " x " +
                         std::to_string(stored.across.posts) + " posts, expected " + std::to_string(rows) +
                         " x " + std::to_string(columns));
    // As many patches as it says that it has; what is left then are corrections.
    const std::uint64_t found = (bytes.size() - net_front_bytes) / patch_bytes;
    const auto said = [](const GridNet::Stored::Axis& axis) {
        return static_cast<std::uint64_t>(std::max(axis.patches, 0));
    };
    const std::uint64_t patches = std::min(said(stored.down) * said(stored.across), found);
    stored.coefficients.resize(patches * GridNet::coefficients_a_patch);
    for (glm::dvec3& coefficient : stored.coefficients)
        for (int axis = 0; axis < 3; ++axis) get(coefficient[axis]);
    if (!get.rest().empty()) ORO_CHECK(unpack_corrections(get.rest(), stored));
    return GridNet::from(stored);
}

}  // namespace oro::region_format
