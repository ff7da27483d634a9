#include "apps/window/session/first_window.h"

#include <chrono>
#include <cstdint>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "apps/report/json_text.h"
#include "apps/window/loading_picture.h"
#include "apps/window/panels/panels.h"
#include "apps/window/window_start.h"

namespace oro {
namespace {

// The sheet of a window, made again where that has another size. The window owns its picture.
struct LoadingSheet {
    const Image* picture{nullptr};
    VkExtent2D extent{};
};

Result<void> show_sheet_with(LoadingSheet& sheet, Window& window, const ImDrawData* over) {
    const VkExtent2D extent = window.extent();
    if (extent.width == 0 || extent.height == 0) return {};
    if (sheet.picture == nullptr || sheet.extent.width != extent.width ||
        sheet.extent.height != extent.height) {
        ORO_TRY(const std::vector<std::uint8_t> pixels,
                loading_picture(static_cast<int>(extent.width), static_cast<int>(extent.height)));
        ORO_TRY(sheet.picture, window.picture_of(pixels, extent));
        sheet.extent = extent;
    }
    ORO_CHECK(window.show({*sheet.picture, extent, over}));
    ORO_CHECK(window.present());
    return {};
}

// One turn of a window that waits. False when its user leaves.
Result<bool> wait_in_window(const FirstWindow& first, const RegionOpening& opening, LoadingSheet& sheet) {
    const auto build = [&] { build_opening_bar(opening); };
    ORO_CHECK(first.interface->follow_scale());
    ORO_CHECK(show_sheet_with(sheet, *first.window, first.interface->lists(build)));
    constexpr double turn_s = 0.05;
    const WindowInput input = first.window->poll(turn_s);
    bool stays = !input.closed;
    ORO_CHECK(first.interface->feed(input, build, [&](const WindowEvent& event) -> Result<void> {
        const auto* const key = std::get_if<KeyChanged>(&event);
        if (key != nullptr && key->down && key->control && key->key == 'Q') stays = false;
        return {};
    }));
    return stays;
}

Result<FirstWindow> window_of_waiting(const Camera& camera, const RegionOpening& opening, double scale) {
    FirstWindow first;
    ORO_TRY(first.gpu, device_of_window());
    ORO_CHECK(check_window_size(camera, first.gpu->report()));
    ORO_CHECK(show_sheet(first, camera, opening.name()));
    first.interface->set_user_scale(scale);
    // A panel is as large as its words from its second frame on.
    ORO_CHECK(first.interface->follow_scale());
    first.interface->lists([&] { build_opening_bar(opening); });
    return first;
}

}  // namespace

Result<std::unique_ptr<Gpu>> device_of_window() {
    GpuOptions options = gpu_options_from_environment();
    ORO_TRY(options.instance_extensions, Window::required_extensions());
    options.presents = true;
    return Gpu::create(options);
}

Result<void> show_sheet(FirstWindow& first, const Camera& camera, const std::string& name) {
    ORO_TRY(first.window,
            Window::create(*first.gpu, camera.width_px, camera.height_px, one_line("Orograph - " + name)));
    LoadingSheet sheet;
    ORO_CHECK(show_sheet_with(sheet, *first.window, nullptr));
    ORO_TRY(first.interface, Interface::create(*first.window));
    return {};
}

Result<AwaitedRegion> await_region(RegionOpening& opening, const std::optional<Camera>& camera, double scale,
                                   ProgressBar& bar) {
    using namespace std::chrono_literals;
    constexpr auto moment = 400ms;
    const auto begun = std::chrono::steady_clock::now();
    AwaitedRegion awaited;
    LoadingSheet sheet;
    bool may_show = camera.has_value();
    while (!opening.ready()) {
        bar.show(opening.share(), opening.step());
        if (awaited.window) {
            const Result<bool> stays = wait_in_window(*awaited.window, opening, sheet);
            if (stays.ok() && !stays.value()) {
                awaited.window->window->hide();  // what is read ends with its file
                return awaited;
            }
            if (!stays.ok()) awaited.window.reset();
        } else if (may_show && std::chrono::steady_clock::now() - begun > moment) {
            may_show = false;
            Result<FirstWindow> first = window_of_waiting(*camera, opening, scale);
            if (first.ok()) awaited.window = std::move(first).value();
        } else {
            std::this_thread::sleep_for(5ms);
        }
    }
    ORO_TRY(awaited.region, opening.wait());
    return awaited;
}

}  // namespace oro
