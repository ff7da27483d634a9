// A window that shows frames and tells what its user does.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "render/interface/interface_renderer.h"
#include "render/window_columns.h"
#include "render/window_input.h"

struct GLFWwindow;
struct GLFWcursor;

namespace oro {

// A second picture in the columns of a window from one on, like the first in GENERAL layout: its top left
// part, scaled to these columns, or of a picture of the whole window what lies there.
struct PictureBeside {
    const Image& picture;
    VkExtent2D part{};
    std::uint32_t begins_px{};
    bool is_of_whole_window{};
};

// What a window shows: the top left part of a picture, as large as the window or scaled to it, and what lies
// over it (null: nothing). With a second picture beside it the first has the columns before that, in the same
// way.
struct WindowPicture {
    const Image& picture;
    VkExtent2D part{};
    const ImDrawData* over{};
    std::optional<PictureBeside> beside{};
};

enum class PointerShape { arrow, text, hand };

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
    // Shows a picture that is in GENERAL layout, written by what was submitted before. Does not wait for
    // that, but for the picture that was shown frames_in_flight ago. False where it is to be shown again: the
    // window changed its size meanwhile, or nobody sees it now. Errors: the device, the window system.
    Result<bool> show(const WindowPicture& shown);
    // Where a processor draws, presenting a picture waits until that is drawn: show() leaves it to whoever
    // comes first, the next show() or this, so that a frame can be begun meanwhile. False where the picture
    // is to be shown again; true where nothing was left. Errors: as show().
    Result<bool> present();
    // Whether its device was lost: nothing can be done with that any more. Waits until nothing is under way.
    [[nodiscard]] bool has_lost_device() const;
    // Pixels from the host as a picture: rows of four bytes each, RGBA, sRGB. It belongs to the window, until
    // the next one.
    Result<const Image*> picture_of(std::span<const std::uint8_t> rgba, VkExtent2D extent);
    // From now on what lies over pictures is drawn with these letters.
    Result<void> take_fonts(ImFontAtlas& fonts) { return interface_.take_fonts(*gpu_, fonts); }
    void set_title(const std::string& title);
    void set_pointer(PointerShape shape);
    void toggle_full_screen();
    [[nodiscard]] bool is_full_screen() const;
    // Takes it off the screen: of a user who leaves, while what is under way ends.
    void hide();
    void set_clipboard(const std::string& text);
    [[nodiscard]] std::string clipboard() const;
    // Size of what is shown, in pixels; 0 x 0 while minimised.
    [[nodiscard]] VkExtent2D extent() const;
    // How many times larger than on a screen of usual fineness letters are to be; 1 or more.
    [[nodiscard]] double content_scale() const;

  private:
    explicit Window(const Gpu& gpu) : gpu_(&gpu) {}
    Result<void> create_surface();
    Result<void> choose_format();
    Result<VkSurfaceCapabilitiesKHR> capabilities() const;
    Result<void> create_swapchain();
    Result<void> create_images();
    void blit(VkCommandBuffer commands, const Image& picture, const VkExtent2D& part,
              const ShownColumns& columns, std::uint32_t index) const;
    void record(VkCommandBuffer commands, const WindowPicture& shown, std::uint32_t index) const;
    void destroy_swapchain();
    // Told what acquiring or presenting an image gave: whether that is of any use. Errors: others than these.
    Result<bool> take_result(VkResult result, const char* call);

    const Gpu* gpu_;
    GLFWwindow* window_{nullptr};
    VkSurfaceKHR surface_{VK_NULL_HANDLE};
    VkSwapchainKHR swapchain_{VK_NULL_HANDLE};
    VkExtent2D swapchain_extent_{};
    VkSurfaceTransformFlagBitsKHR transform_{};  // of the swapchain
    bool is_stale_{false};                       // it is to be made anew
    // For this size and transform it was made anew and is suboptimal all the same: no better one can be had.
    std::optional<std::pair<VkExtent2D, VkSurfaceTransformFlagBitsKHR>> best_for_;
    std::vector<VkImage> images_;
    std::vector<OwnedImageView> views_;  // of them
    VkSurfaceFormatKHR format_{};
    InterfaceRenderer interface_;
    std::vector<OwnedSemaphore> drawn_;  // one for each image: presenting may still wait for the last one
    Image pixels_;                       // of picture_of()
    struct Slot {
        OwnedSemaphore acquired;
        Commands commands;
    };
    std::array<Slot, frames_in_flight> slots_;  // by turns
    std::size_t turn_{};
    std::optional<std::uint32_t> to_present_;  // the image that present() is for
    WindowInput input_;
    std::array<GLFWcursor*, 3> pointers_{};  // by PointerShape, made when they are first asked for
    PointerShape pointer_{};
    std::array<int, 4> windowed_{};  // place and size before full screen
    double last_poll_s_{};
};

}  // namespace oro
