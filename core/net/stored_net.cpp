// Nets as numbers for files, and parts of nets.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <string>

#include "core/net/lattice_georeference.h"

namespace oro {
namespace {

Error no_net(const std::string& what) {
    return {ErrorKind::failed, "grid of posts", what};
}

}  // namespace

bool LatticeGeoreference::Stored::Axis::fits() const {
    if (posts < 2 || patch_posts < 2 || first < 0 || first >= patch_posts) return false;
    const std::int64_t end = std::int64_t{first} + posts;
    return patches == (end + patch_posts - 1) / patch_posts;
}

LatticeGeoreference::Stored LatticeGeoreference::stored() const {
    Stored stored{down_, across_, error_m_, {}, corrections_};
    stored.coefficients.reserve(patches_.size() * coefficients_a_patch);
    for (const Patch& patch : patches_)
        stored.coefficients.insert(stored.coefficients.end(), patch.coefficients.begin(),
                                   patch.coefficients.end());
    return stored;
}

Result<std::shared_ptr<const LatticeGeoreference>> LatticeGeoreference::from(const Stored& stored) {
    if (!stored.down.fits() || !stored.across.fits())
        return no_net("its posts and patches do not fit each other");
    const auto patches =
        static_cast<std::size_t>(stored.down.patches) * static_cast<std::size_t>(stored.across.patches);
    if (stored.coefficients.size() / coefficients_a_patch != patches ||
        stored.coefficients.size() % coefficients_a_patch != 0)
        return no_net("it has " + std::to_string(stored.coefficients.size()) + " coefficients, expected " +
                      std::to_string(patches) + " times " + std::to_string(coefficients_a_patch));
    if (!(stored.error_m >= 0.0 && stored.error_m <= largest_error_m))
        return no_net("its places are " + std::to_string(stored.error_m) + " m off, expected at most " +
                      std::to_string(largest_error_m) + " m");
    for (const glm::dvec3& coefficient : stored.coefficients) {
        // What a normal's parts can have: none is larger than 1 anywhere.
        constexpr double largest = 2.0;
        for (int axis = 0; axis < 3; ++axis)
            if (!(std::abs(coefficient[axis]) <= largest))
                return no_net("a coefficient is not within -2 .. 2");
    }
    std::shared_ptr<LatticeGeoreference> net(new LatticeGeoreference({stored.down}, {stored.across}));
    for (std::size_t i = 0; i < patches; ++i)
        std::copy_n(stored.coefficients.begin() + static_cast<std::ptrdiff_t>(i * coefficients_a_patch),
                    coefficients_a_patch, net->patches_[i].coefficients.begin());
    net->error_m_ = stored.error_m;
    ORO_CHECK(net->take_corrections(stored.corrections));
    if (!net->patches_are_whole()) return no_net("its normals are not of length 1, or do not meet");
    ORO_CHECK(net->measure());
    return std::shared_ptr<const LatticeGeoreference>(std::move(net));
}

Result<std::shared_ptr<const LatticeGeoreference>> LatticeGeoreference::part(int first_row, int first_column,
                                                                             int rows, int columns) const {
    assert(first_row >= 0 && first_column >= 0 && rows >= 2 && columns >= 2);
    assert(rows <= down_.posts - first_row && columns <= across_.posts - first_column);
    // The patches that it touches, and where among them it begins.
    const auto touched = [](const Cut& axis, int first, int posts, int& patch) {
        const int from = axis.first + first;
        patch = from / axis.patch_posts;
        const int last = (from + posts - 1) / axis.patch_posts;
        return Cut{{from - patch * axis.patch_posts, posts, axis.patch_posts, last - patch + 1}};
    };
    int top = 0, left = 0;
    const Cut down = touched(down_, first_row, rows, top),
              across = touched(across_, first_column, columns, left);
    std::shared_ptr<LatticeGeoreference> net(new LatticeGeoreference(down, across));
    for (int row = 0; row < down.patches; ++row) {
        for (int column = 0; column < across.patches; ++column) {
            const Patch& of = patch(top + row, left + column);
            const int number = row * across.patches + column;
            net->patches_[static_cast<std::size_t>(number)] = of;
            if (of.correction != Patch::none)
                net->add_correction({number, corrections_[static_cast<std::size_t>(of.correction)].posts});
        }
    }
    net->error_m_ = error_m_;
    ORO_CHECK(net->measure());
    return std::shared_ptr<const LatticeGeoreference>(std::move(net));
}

}  // namespace oro
