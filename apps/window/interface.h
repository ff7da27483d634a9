// Dear ImGui between a window's events and the lists that are drawn over its picture.
#pragma once

#include <imgui.h>

#include <functional>
#include <memory>
#include <vector>

#include "render/window.h"

namespace oro {

// The one of the program: Dear ImGui keeps what it knows in one place. Of one thread.
class Interface {
  public:
    // Letters and sizes are those of the window's screen. The window outlives it. Errors: the device.
    static Result<std::unique_ptr<Interface>> create(Window& window);
    ~Interface();
    Interface(const Interface&) = delete;
    Interface& operator=(const Interface&) = delete;

    // What a frame of panels is made of, in pixels: called between ImGui::NewFrame() and ImGui::Render().
    using Build = std::function<void()>;
    // What to do with an event that no panel takes; keys that text is typed with are the panels'.
    using Take = std::function<Result<void>(const WindowEvent&)>;
    // Gives the panels one event after the other, with a frame of theirs after each that they may answer to,
    // so that what is typed and clicked during one slow picture is neither lost nor taken in another order.
    // Those that are not the panels' go to `take`. Errors: those of `take`.
    Result<void> feed(const WindowInput& input, const Build& build, const Take& take);
    // A frame of panels as they are now: its lists stay until the next frame.
    const ImDrawData* lists(const Build& build);
    // Whether the pointer is over a panel, or one holds on to it.
    [[nodiscard]] bool has_pointer() const;
    // Whether text is being typed.
    [[nodiscard]] bool takes_text() const;
    // Takes the letters for another screen, where the window has come to one. Errors: the device.
    Result<void> follow_scale();
    // How large letters and panels are, beside the screen's own scale: of the user, 0.5 to 4.
    void set_user_scale(double scale) { user_scale_ = scale; }

  private:
    explicit Interface(Window& window) : window_(&window) {}
    Result<void> take_scale(double scale);
    void frame(const Build& build);

    Window* window_;
    double scale_{};  // of both
    double user_scale_{1.0};
    double elapsed_s_{1.0 / 60.0};  // since the last frame
    int key_{};                     // that went down last
    bool repeats_{};                // it is held, and comes again and again
    int opener_{};  // the key whose letter opened the field that is typed into, while it is held
};

// How large a length of a usual screen is here: panels are laid out by it.
float scaled_px(float px);

// Colours of what is drawn into the panels.
namespace interface_colour {
inline constexpr ImU32 ink = IM_COL32(235, 238, 240, 255), quiet = IM_COL32(235, 238, 240, 150),
                       line = IM_COL32(255, 255, 255, 46), accent = IM_COL32(255, 190, 92, 255),
                       error = IM_COL32(255, 138, 120, 255), good = IM_COL32(140, 214, 160, 255),
                       paper = IM_COL32(22, 26, 30, 205), shadow = IM_COL32(0, 0, 0, 150);
}  // namespace interface_colour

}  // namespace oro
