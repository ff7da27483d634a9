// What one job leaves to the next, of a program that draws many pictures one after the other: the GPU with
// its programs, and the scene that was drawn last.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "apps/drawing/region_scene.h"
#include "apps/options/options.h"
#include "apps/view/view.h"
#include "render/device/gpu.h"

namespace oro {

// From now on gpu_to_draw_with() gives the same device each time, and a scene may be left to the next job. To
// be called by the thread that draws, as all here.
void keep_drawing();
[[nodiscard]] bool keeps_drawing();
// The last scene is given up; the device stays. For what needs the GPU's memory itself.
void keep_no_scene();
// No longer: what was kept is given up, the scene first.
void keep_no_drawing();

// The device that the environment asks for: a new one, unless one is kept. Errors: those of Gpu::create().
Result<std::shared_ptr<const Gpu>> gpu_to_draw_with();

// All that decides a view's scene: its region, detail, images and memory, but neither eye nor light. means:
// its style asks for means of the ground. Views of the same key have scenes that draw the same.
std::string scene_key(const View& view, const MemoryOptions& memory, bool means, bool clusters);
// The scene of that key, ready for a first frame; nothing where the last one was another, which is then given
// up.
std::optional<RegionScene> take_kept_scene(const std::string& key);
// Leaves a scene to the next job, where scenes are kept. Its device is that of gpu_to_draw_with().
void leave_scene(const std::string& key, RegionScene scene);

}  // namespace oro
