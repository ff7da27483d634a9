// The views that the eye rested at: back through them, and forward again.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/earth/camera.h"

namespace oro {

// Whether two cameras are at the same place and look the same way, to the last bit; their sizes do not count.
bool is_same_view(const Camera& a, const Camera& b);

// A list of views, the first ones forgotten where they become more than `most`.
class ViewHistory {
  public:
    explicit ViewHistory(std::size_t most = 200) : most_(most) {}

    // Remembers a view where the eye has come to rest, or which it leaves for another one. The last view once
    // more is none. What could be done again after undoing is forgotten where the view is a new one.
    void rested(const Camera& camera);
    // The view before this one, to the last bit, in a picture of the size of `camera`, which is the view that
    // is shown now: it is remembered for again(). Nothing where there is none before.
    std::optional<Camera> undone(const Camera& camera);
    // The view that was undone last, likewise; nothing where the eye has rested elsewhere since.
    std::optional<Camera> again(const Camera& camera);
    // The view that undone() or again() gave last is this one from now on: the ground has become higher.
    void correct(const Camera& camera) { views_[at_] = camera; }

    [[nodiscard]] std::size_t size() const { return views_.size(); }

  private:
    [[nodiscard]] Camera sized(const Camera& camera) const;

    std::size_t most_;
    std::vector<Camera> views_;
    std::size_t at_{};  // the view that is shown, or was when the eye last rested
};

}  // namespace oro
