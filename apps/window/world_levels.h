// The levels of a world that nobody stores (made terrain of any size): a window draws it by proven bounds at
// once, and measures levels on other threads for the view where its eye rests.
#pragma once

#include <memory>
#include <vector>

#include "apps/window/background_work.h"
#include "core/base/elapsed.h"
#include "core/base/result.h"
#include "core/frame/known_pictures.h"
#include "core/frame/region_pages.h"
#include "render/scene/scene.h"

namespace oro {

struct Region;
struct View;
struct Viewer;

// Whether a region is drawn so: one grid of such terrain and nothing else, not exaggerated.
bool is_drawn_by_bounds(const Region& region, const View& view);

struct WorldLevels {
    using Work = BackgroundWork<std::unique_ptr<RegionPages>>;
    bool on{};                                     // the window's region is such a world
    bool is_begun{};                               // levels were asked for, of these pictures:
    KnownPictures of{};                            //
    std::unique_ptr<Work> work{};                  // that measures them
    std::vector<std::unique_ptr<Work>> stopped{};  // of other views, until its threads have noticed
    std::unique_ptr<Scene> measured{};             // of them, until all that the view needs is on the GPU
    Clock::time_point measured_since{};
    std::unique_ptr<Scene> by_bounds{};  // while measured levels are shown in its place

    // Whether what the window shows are bounds.
    [[nodiscard]] bool shows_bounds() const { return on && !by_bounds; }
    // Times the view's tau, for what is drawn by bounds: they are many times what levels are off by.
    [[nodiscard]] double tau_factor() const { return shows_bounds() ? 32.0 : 1.0; }
};

// Whether a plan by bounds is too coarse for a first picture: a page is missing whose posts are wide apart.
bool is_too_coarse(const Viewer& viewer, const FramePlan& plan);

// Once a turn: goes on with measuring, shows measured levels in the place of bounds once all is there, and
// bounds again where the view is another. changed: set where there is another frame to draw. Waits for no
// measuring. Errors: the device, a file of images.
Result<void> follow_with_levels(Viewer& viewer, bool& changed);

// A scene of a picture that is asked for, all of it measured: waits for it. Null where what is shown does.
Result<std::unique_ptr<Scene>> scene_of_picture(Viewer& viewer, const View& view);

}  // namespace oro
