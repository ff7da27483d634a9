// A window that shows frames and tells what its user does.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render/frame/frame_renderer.h"

struct GLFWwindow;

namespace oro {

// The keys that the viewer knows, as they are held down.
enum class Key {
    forward,
    back,
    left,
    right,
    up,
    down,
    fast,
    look_left,
    look_right,
    look_up,
    look_down,
    count
};

// What happened since the last poll.
struct WindowInput {
    std::array<bool, static_cast<std::size_t>(Key::count)> held{};
    glm::dvec2 dragged_px{0.0};  // with the left mouse button held
    glm::dvec2 cursor{0.0};      // in the window system's own units, from the top left corner
    // Centre of the pixel under the cursor when the right mouse button went down, from the top left corner.
    std::optional<glm::dvec2> picked_px;
    std::string typed;  // characters, UTF-8
    int enters{};       // how often Enter was pressed
    bool backspace{false};
    bool escape{false};
    bool take_picture{false};  // P was pressed
    bool go_to{false};         // G was pressed
    bool exposed{false};       // what the window shows was lost: it is to be shown again
    bool closed{false};
    double elapsed_s{};  // since the last poll

    [[nodiscard]] bool is_held(Key key) const { return held[static_cast<std::size_t>(key)]; }
};

class Window {
  public:
    // The instance extensions that a window needs. Errors: no display (says that shot needs none).
    static Result<std::vector<const char*>> required_extensions();
    // Errors: the window system's own reason.
    static Result<std::unique_ptr<Window>> create(const Gpu& gpu, int width_px, int height_px,
                                                  const std::string& title);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    // Collects input; waits up to wait_s for some.
    WindowInput poll(double wait_s);
    // Shows a picture that is in GENERAL layout with its writes done. Returns false when the window changed
    // its size meanwhile.
    Result<bool> show(const Image& picture);
    // Shows pixels from the host: rows of four bytes each, RGBA, sRGB. They fill the window, whatever
    // their number is beside its own.
    Result<bool> show_pixels(std::span<const std::uint8_t> rgba, VkExtent2D extent);
    void set_title(const std::string& title);
    // Size of what is shown, in pixels; 0 x 0 while minimised.
    [[nodiscard]] VkExtent2D extent() const;

  private:
    explicit Window(const Gpu& gpu) : gpu_(&gpu) {}
    Result<void> create_surface();
    Result<void> take_pixels(std::span<const std::uint8_t> rgba, VkExtent2D extent);
    Result<void> create_swapchain();
    void destroy_swapchain();
    // What presenting gave: success, suboptimal or out of date.
    Result<VkResult> submit_and_present(VkCommandBuffer commands, std::uint32_t index);

    const Gpu* gpu_;
    GLFWwindow* window_{nullptr};
    VkSurfaceKHR surface_{VK_NULL_HANDLE};
    VkSwapchainKHR swapchain_{VK_NULL_HANDLE};
    VkExtent2D swapchain_extent_{};
    bool fresh_{true};  // nothing was shown by it yet
    std::vector<VkImage> images_;
    Commands commands_;
    OwnedSemaphore acquired_;
    std::vector<OwnedSemaphore> drawn_;  // one for each image: presenting may still wait for the last one
    Image pixels_;                       // of show_pixels()
    WindowInput input_;
    glm::dvec2 cursor_{0.0};
    bool dragging_{false};
    double last_poll_s_{};
};

}  // namespace oro
