// A second view in a window, of the same eye as the first: beside it, or behind a line that is swiped over
// the picture.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "apps/drawing/region_scene.h"
#include "apps/view/style.h"
#include "apps/window/background_work.h"
#include "apps/window/detail.h"
#include "apps/window/second_choice.h"
#include "apps/window/window_start.h"
#include "core/base/result.h"
#include "geo/together/region_ground.h"
#include "render/frame/frame_renderer.h"
#include "render/window.h"

namespace oro {

struct Viewer;

// Data that the first view has not: another source, or its own without the geoid.
struct OwnRegion {
    View view{};  // as it was opened; of another source alone
    Region region;
    RegionCuts cuts;
};

// What a second view's scene is made of, read and measured beside the window.
struct SecondGround {
    SecondChoice choice;
    double exaggeration{1.0};
    std::shared_ptr<const OwnRegion> own;  // null: the data are the first view's
    GridPages pages;
};

// All that draws it. It ends before the region of the first view does.
struct SecondView {
    SecondChoice choice;  // as it is drawn
    std::shared_ptr<const OwnRegion> own;
    View view;
    Style style;
    bool has_means{}, has_clusters{};              // of the scene
    std::unique_ptr<const RegionGround> ground{};  // once something is written over it
    std::unique_ptr<Scene> scene;
    FrameRenderer renderer;
    EyeMeshes meshes;   // by clusters where the first view's are, and the data are the same
    VkExtent2D part{};  // of the picture that is drawn
    bool has_picture{};
    bool is_missing{};                 // something that the last frame should have had
    bool lacks_memory{}, shows_all{};  // as those of Viewer
    bool images_settled{true};
};

// What of two views is chosen, prepared and shown.
struct TwoViews {
    SecondChoice choice{};  // of the panel
    TwoViewsLayout layout{TwoViewsLayout::side_by_side};
    double line{0.5};  // of a swipe: the share of the window left of it
    PointerOverHalves pointer{};
    bool shares_memory{};  // the first view's scene has half of what the user allows
    std::unique_ptr<BackgroundWork<SecondGround>> work{};
    std::unique_ptr<SecondView> second{};
};

// Shows a second view, or lets the one that is there differ otherwise; what needs other data or levels is
// prepared beside the window first. What is wrong with the choice is told and changes nothing. Errors: the
// device, posts that cannot be read.
Result<void> show_second(Viewer& viewer, const SecondChoice& choice);
// Gives up what is being prepared.
void stop_second(Viewer& viewer);
// Shows one view alone. Errors: the device.
Result<void> close_second(Viewer& viewer);
// One view, two side by side, two with a line, and one again. Errors: as show_second().
Result<void> choose_next_layout(Viewer& viewer);
// Shows the one that was prepared, once it is there. Errors: the device.
Result<void> take_second(Viewer& viewer);
// What has changed in the first view changes in the second, where that has it likewise. Errors: as
// show_second().
Result<void> follow_first_view(Viewer& viewer);

// What the first view's scene may take: half of what the user allows beside a second one.
MemoryOptions memory_of_first(const Viewer& viewer);
// Size of the first view's picture: the window's, or of its half.
VkExtent2D extent_of_first(const Viewer& viewer, const VkExtent2D& window);
// The first view in a picture as large as the window, whether or not it has half of that now.
View view_alone(const Viewer& viewer);
// Where the second view's picture begins in the window, for what the pointer does; 0: both have the same
// places, or there is one alone.
int pointer_border_px(const Viewer& viewer);
// The names of the two views' data.
DifferenceWords source_names(const Viewer& viewer);

// Takes the window's size. No frame is drawn with it before. Errors: the device.
Result<void> take_second_size(Viewer& viewer, const VkExtent2D& window, bool& changed);
// Brings what its last frame lacked: true where some of that is here. Errors: pages that cannot be read.
Result<bool> advance_second(Viewer& viewer);
// Goes on towards what the first view's eye needs of its meshes, as follow_with_meshes() does. Errors: the
// device.
Result<bool> follow_with_second_meshes(Viewer& viewer);
// Whether some are still to come.
bool lacks_second_meshes(const Viewer& viewer);
// Whether it is another picture once the eye rests, where that is whole already: what is written over it.
bool second_changes_at_rest(const Viewer& viewer);
// Draws it from the first view's eye as coarse as the step says, with what is on the GPU: begins it where the
// eye moves (finish_second()), else waits for it and writes over it. Nothing where there is none. Errors:
// the device, posts that cannot be read.
Result<void> submit_second(Viewer& viewer, const DetailStep& step);
Result<void> draw_second_at_rest(Viewer& viewer, const DetailStep& step);
// Waits for its frames that are under way until so many are left, and takes what they tell.
Result<void> finish_second(Viewer& viewer, std::size_t left);
// Its picture for the window, where it has one.
std::optional<PictureBeside> second_to_show(const Viewer& viewer);

}  // namespace oro
