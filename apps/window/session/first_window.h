// A window that is there before the first region is.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "apps/report/progress_bar.h"
#include "apps/window/interface.h"
#include "apps/window/region_opening.h"
#include "core/earth/camera.h"
#include "render/device/gpu.h"
#include "render/window.h"

namespace oro {

// A device, a window on it and its panels. They end in the opposite order.
struct FirstWindow {
    std::unique_ptr<Gpu> gpu{};
    std::unique_ptr<Window> window{};
    std::unique_ptr<Interface> interface {};
};

// The GPU that can show a window. Errors: no display, no device.
Result<std::unique_ptr<Gpu>> device_of_window();

// Opens a window of the camera's size on a device, which can draw that (check_window_size()). It shows a
// plain sheet. Errors: the window system, the device.
Result<void> show_sheet(FirstWindow& first, const Camera& camera, const std::string& name);

// What came of waiting for a region: nothing where the user left before it was read.
struct AwaitedRegion {
    std::optional<OpenedRegion> region;
    std::optional<FirstWindow> window;  // nothing where the region was read too soon for one
};

// Waits for a region that is being read. Reading that takes longer than a moment is shown by a window with a
// bar, where `camera` says how large it is, and on the terminal. `scale` is the user's scale of letters.
// Errors: those of the reading. A window that cannot be opened is left to whoever shows the region.
Result<AwaitedRegion> await_region(RegionOpening& opening, const std::optional<Camera>& camera, double scale,
                                   ProgressBar& bar);

}  // namespace oro
