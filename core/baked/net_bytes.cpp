#include "core/baked/net_bytes.h"

#include <string>

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

}  // namespace

std::vector<std::byte> net_to_bytes(const GridNet& net) {
    const GridNet::Stored stored = net.stored();
    std::vector<std::byte> bytes(net_front_bytes + stored.coefficients.size() * 24);
    std::byte* at = bytes.data();
    auto put = [&at](const auto& number) {
        to_little_endian(number, at);
        at += sizeof(number);
    };
    exchange_front(put, stored);
    for (const glm::dvec3& coefficient : stored.coefficients)
        for (int axis = 0; axis < 3; ++axis) put(coefficient[axis]);
    return bytes;
}

Result<std::shared_ptr<const GridNet>> net_from_bytes(std::span<const std::byte> bytes, int rows,
                                                      int columns) {
    const auto wrong = [](const std::string& what) {
        return Error{ErrorKind::failed, "grid of posts", what};
    };
    if (bytes.size() < net_front_bytes || (bytes.size() - net_front_bytes) % patch_bytes != 0)
        return wrong("it has " + std::to_string(bytes.size()) + " bytes");
    GridNet::Stored stored;
    const std::byte* at = bytes.data();
    auto get = [&at](auto& number) {
        number = from_little_endian<std::remove_reference_t<decltype(number)>>(at);
        at += sizeof(number);
    };
    exchange_front(get, stored);
    if (stored.down.posts != rows || stored.across.posts != columns)
        return wrong("it has " + std::to_string(stored.down.posts) + " x " +
                     std::to_string(stored.across.posts) + " posts, expected " + std::to_string(rows) +
                     " x " + std::to_string(columns));
    stored.coefficients.resize((bytes.size() - net_front_bytes) / 24);
    for (glm::dvec3& coefficient : stored.coefficients)
        for (int axis = 0; axis < 3; ++axis) get(coefficient[axis]);
    return GridNet::from(stored);
}

}  // namespace oro::region_format
