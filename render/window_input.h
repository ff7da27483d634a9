// What a window's user does, as events in their order.
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <variant>
#include <vector>

namespace oro {

// Keys by the number that GLFW gives them: letters and digits by their capital's ASCII code, where a US
// keyboard has them. The others that are asked for here have names.
namespace key {
inline constexpr int space = 32, minus = 45, equal = 61, escape = 256, enter = 257, tab = 258,
                     backspace = 259, erase = 261, right = 262, left = 263, down = 264, up = 265,
                     page_up = 266, page_down = 267, home = 268, end = 269, f1 = 290, f11 = 300,
                     keypad_subtract = 333, keypad_add = 334, keypad_enter = 335, left_shift = 340,
                     left_control = 341, left_alt = 342, right_shift = 344, right_control = 345,
                     right_alt = 346, count = 349;
}  // namespace key

enum class MouseButton { left, right, middle };

// Positions are in pixels of what is shown, from its top left corner.
struct PointerMoved {
    glm::dvec2 at_px;
    bool shift{}, control{};
};
struct ButtonChanged {
    MouseButton button{};
    bool down{};
    glm::dvec2 at_px;
    bool shift{}, control{}, alt{};
    double time_s{};  // from an arbitrary start
};
struct WheelTurned {
    glm::dvec2 steps;  // right, and away from the user
    glm::dvec2 at_px;
    bool shift{}, control{};
};
struct KeyChanged {
    int key{};
    bool down{};
    bool repeated{};
    bool shift{}, control{}, alt{}, super{};
};
struct CharacterTyped {
    char32_t code{};
};
struct PathsDropped {
    std::vector<std::string> paths;
};
struct FocusChanged {
    bool has_focus{};
};
using WindowEvent = std::variant<PointerMoved, ButtonChanged, WheelTurned, KeyChanged, CharacterTyped,
                                 PathsDropped, FocusChanged>;

// What happened since the last poll.
struct WindowInput {
    std::vector<WindowEvent> events;
    glm::dvec2 pointer_px{-1.0};  // outside of what is shown where it is not over the window
    bool exposed{false};          // what the window shows was lost: it is to be shown again
    bool closed{false};
    double elapsed_s{};  // since the last poll
};

}  // namespace oro
