#include "apps/window/interface.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "apps/text/font_file.h"

namespace oro {
namespace {

constexpr float letters_px = 14.0F;

// Keys that Dear ImGui edits text by, and letters of its short cuts.
constexpr std::array<std::pair<int, ImGuiKey>, 18> editing_keys{{{key::tab, ImGuiKey_Tab},
                                                                 {key::left, ImGuiKey_LeftArrow},
                                                                 {key::right, ImGuiKey_RightArrow},
                                                                 {key::up, ImGuiKey_UpArrow},
                                                                 {key::down, ImGuiKey_DownArrow},
                                                                 {key::page_up, ImGuiKey_PageUp},
                                                                 {key::page_down, ImGuiKey_PageDown},
                                                                 {key::home, ImGuiKey_Home},
                                                                 {key::end, ImGuiKey_End},
                                                                 {key::erase, ImGuiKey_Delete},
                                                                 {key::backspace, ImGuiKey_Backspace},
                                                                 {key::enter, ImGuiKey_Enter},
                                                                 {key::escape, ImGuiKey_Escape},
                                                                 {'A', ImGuiKey_A},
                                                                 {'C', ImGuiKey_C},
                                                                 {'V', ImGuiKey_V},
                                                                 {'X', ImGuiKey_X},
                                                                 {'Z', ImGuiKey_Z}}};

const char* clipboard_text(void* window) {
    static std::string text;
    text = static_cast<Window*>(window)->clipboard();
    return text.c_str();
}

void set_clipboard_text(void* window, const char* text) {
    static_cast<Window*>(window)->set_clipboard(text);
}

// Dark panels that the ground shows through, calm, readable over snow as over rock.
void choose_looks(float scale) {
    ImGuiStyle& style = ImGui::GetStyle();
    style = ImGuiStyle();
    ImGui::StyleColorsDark(&style);
    style.WindowRounding = 6.0F;
    style.ChildRounding = style.PopupRounding = 5.0F;
    style.FrameRounding = style.GrabRounding = 4.0F;
    style.WindowBorderSize = style.PopupBorderSize = 1.0F;
    style.FrameBorderSize = 0.0F;
    style.WindowPadding = {12.0F, 10.0F};
    style.FramePadding = {8.0F, 4.0F};
    style.ItemSpacing = {8.0F, 6.0F};
    style.ItemInnerSpacing = {6.0F, 4.0F};
    style.ScrollbarSize = 10.0F;
    style.GrabMinSize = 12.0F;
    style.WindowTitleAlign = {0.0F, 0.5F};
    style.WindowMenuButtonPosition = ImGuiDir_None;
    ImVec4* const colours = style.Colors;
    const auto colour = [](int r, int g, int b, float a) {
        return ImVec4(static_cast<float>(r) / 255.0F, static_cast<float>(g) / 255.0F,
                      static_cast<float>(b) / 255.0F, a);
    };
    colours[ImGuiCol_Text] = colour(235, 238, 240, 1.0F);
    colours[ImGuiCol_TextDisabled] = colour(235, 238, 240, 0.58F);
    colours[ImGuiCol_WindowBg] = colours[ImGuiCol_PopupBg] = colour(22, 26, 30, 0.9F);
    colours[ImGuiCol_Border] = colour(255, 255, 255, 0.12F);
    colours[ImGuiCol_TitleBg] = colours[ImGuiCol_TitleBgActive] = colours[ImGuiCol_TitleBgCollapsed] =
        colour(22, 26, 30, 0.9F);
    colours[ImGuiCol_FrameBg] = colour(255, 255, 255, 0.09F);
    colours[ImGuiCol_FrameBgHovered] = colour(255, 255, 255, 0.15F);
    colours[ImGuiCol_FrameBgActive] = colour(255, 255, 255, 0.20F);
    colours[ImGuiCol_Button] = colour(255, 255, 255, 0.10F);
    colours[ImGuiCol_ButtonHovered] = colour(255, 255, 255, 0.20F);
    colours[ImGuiCol_ButtonActive] = colour(255, 190, 92, 0.55F);
    colours[ImGuiCol_Header] = colour(255, 255, 255, 0.12F);
    colours[ImGuiCol_HeaderHovered] = colour(255, 255, 255, 0.18F);
    colours[ImGuiCol_HeaderActive] = colour(255, 190, 92, 0.45F);
    colours[ImGuiCol_CheckMark] = colours[ImGuiCol_SliderGrabActive] = colour(255, 190, 92, 1.0F);
    colours[ImGuiCol_SliderGrab] = colour(255, 190, 92, 0.85F);
    colours[ImGuiCol_PlotLines] = colour(255, 190, 92, 1.0F);
    colours[ImGuiCol_TextSelectedBg] = colour(255, 190, 92, 0.40F);
    colours[ImGuiCol_ResizeGrip] = colour(255, 255, 255, 0.0F);
    style.ScaleAllSizes(scale);
}

// Latin, Greek, Cyrillic letters of names, and the signs that panels write.
constexpr std::array<ImWchar, 17> letter_ranges{0x0020, 0x024F, 0x0370, 0x052F, 0x1E00, 0x1EFF,
                                                0x2010, 0x2044, 0x2070, 0x209F, 0x2190, 0x21FF,
                                                0x2200, 0x22FF, 0x25A0, 0x26FF, 0};

void set_key(int code, bool down) {
    ImGuiIO& io = ImGui::GetIO();
#if IMGUI_VERSION_NUM >= 18900
    for (const auto& [ours, theirs] : editing_keys)
        if (ours == code || (ours == key::enter && code == key::keypad_enter)) io.AddKeyEvent(theirs, down);
#else
    io.KeysDown[code == key::keypad_enter ? key::enter : code] = down;
#endif
}

// The modifiers that a modifier's own event names are those from before it (X11).
void set_modifiers(KeyChanged event) {
    ImGuiIO& io = ImGui::GetIO();
    if (event.key == key::left_control || event.key == key::right_control) event.control = event.down;
    if (event.key == key::left_shift || event.key == key::right_shift) event.shift = event.down;
    if (event.key == key::left_alt || event.key == key::right_alt) event.alt = event.down;
#if IMGUI_VERSION_NUM >= 18900
    io.AddKeyEvent(ImGuiMod_Ctrl, event.control);
    io.AddKeyEvent(ImGuiMod_Shift, event.shift);
    io.AddKeyEvent(ImGuiMod_Alt, event.alt);
#else
    io.KeyCtrl = event.control;
    io.KeyShift = event.shift;
    io.KeyAlt = event.alt;
#endif
}

void set_pointer_at(glm::dvec2 at_px) {
    ImGuiIO& io = ImGui::GetIO();
    const ImVec2 at = at_px.x < 0.0 ? ImVec2(-FLT_MAX, -FLT_MAX)
                                    : ImVec2(static_cast<float>(at_px.x), static_cast<float>(at_px.y));
#if IMGUI_VERSION_NUM >= 18900
    io.AddMousePosEvent(at.x, at.y);
#else
    io.MousePos = at;
#endif
}

void set_button(MouseButton button, bool down) {
    ImGuiIO& io = ImGui::GetIO();
#if IMGUI_VERSION_NUM >= 18900
    io.AddMouseButtonEvent(static_cast<int>(button), down);
#else
    io.MouseDown[static_cast<int>(button)] = down;
#endif
}

void turn_wheel(glm::dvec2 steps) {
    ImGuiIO& io = ImGui::GetIO();
#if IMGUI_VERSION_NUM >= 18900
    io.AddMouseWheelEvent(static_cast<float>(steps.x), static_cast<float>(steps.y));
#else
    io.MouseWheelH += static_cast<float>(steps.x);
    io.MouseWheel += static_cast<float>(steps.y);
#endif
}

// Dear ImGui says so a frame longer than it is.
bool is_typing() {
    return ImGui::GetIO().WantTextInput && ImGui::IsAnyItemActive();
}

bool is_panels_key(const KeyChanged& event) {
    return event.down && is_typing() && event.key != key::f1 && event.key != key::f11 &&
           !(event.control && (event.key == 'Q' || event.key == 'O' || event.key == 'L'));
}

}  // namespace

float scaled_px(float px) {
    return std::round(px * ImGui::GetFontSize() / letters_px);
}

Result<std::unique_ptr<Interface>> Interface::create(Window& window) {
    ImGui::CreateContext();
    std::unique_ptr<Interface> made(new Interface(window));
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = io.LogFilename = nullptr;
    io.ConfigWindowsMoveFromTitleBarOnly = true;
    io.BackendPlatformName = io.BackendRendererName = "orograph";
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset | ImGuiBackendFlags_HasMouseCursors;
    io.GetClipboardTextFn = clipboard_text;
    io.SetClipboardTextFn = set_clipboard_text;
    io.ClipboardUserData = &window;
#if IMGUI_VERSION_NUM < 18900
    for (const auto& [ours, theirs] : editing_keys) io.KeyMap[theirs] = ours;
#endif
    set_pointer_at(glm::dvec2(-1.0));
    ORO_CHECK(made->follow_scale());
    return made;
}

Interface::~Interface() {
    ImGui::DestroyContext();
}

Result<void> Interface::follow_scale() {
    const double scale = window_->content_scale() * user_scale_;
    return scale == scale_ ? Result<void>() : take_scale(scale);
}

Result<void> Interface::take_scale(double scale) {
    scale_ = scale;
    const auto factor = static_cast<float>(scale);
    choose_looks(factor);
    ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
    fonts.Clear();
    ImFontConfig config;
    config.FontDataOwnedByAtlas = false;
    config.OversampleH = 2;
    // The atlas reads the file and never writes it.
    fonts.AddFontFromMemoryTTF(const_cast<unsigned char*>(font_file), static_cast<int>(font_file_bytes),
                               std::round(letters_px * factor), &config, letter_ranges.data());
    return window_->take_fonts(fonts);
}

void Interface::frame(const Build& build) {
    ImGuiIO& io = ImGui::GetIO();
    const VkExtent2D extent = window_->extent();
    io.DisplaySize = {static_cast<float>(std::max(extent.width, 1U)),
                      static_cast<float>(std::max(extent.height, 1U))};
    io.DeltaTime = static_cast<float>(std::clamp(std::exchange(elapsed_s_, 0.0), 1e-4, 0.1));
    ImGui::NewFrame();
    build();
    ImGui::Render();
}

Result<void> Interface::feed(const WindowInput& input, const Build& build, const Take& take) {
    elapsed_s_ += input.elapsed_s;
    for (const WindowEvent& event : input.events) {
        bool is_panels = false;
        if (const auto* const moved = std::get_if<PointerMoved>(&event)) {
            set_pointer_at(moved->at_px);
            is_panels = ImGui::GetIO().WantCaptureMouse;
        } else if (const auto* const button = std::get_if<ButtonChanged>(&event)) {
            set_pointer_at(button->at_px);
            frame(build);
            set_button(button->button, button->down);
            frame(build);
            // What began on the ground ends there.
            is_panels = button->down && ImGui::GetIO().WantCaptureMouse;
        } else if (const auto* const wheel = std::get_if<WheelTurned>(&event)) {
            turn_wheel(wheel->steps);
            frame(build);
            is_panels = ImGui::GetIO().WantCaptureMouse;
        } else if (const auto* const pressed = std::get_if<KeyChanged>(&event)) {
            is_panels = is_panels_key(*pressed);
            if (pressed->down) key_ = pressed->key;
            repeats_ = pressed->down && pressed->repeated;
            if (opener_ == pressed->key && !pressed->repeated) opener_ = 0;
            set_modifiers(*pressed);
            set_key(pressed->key, pressed->down);
            if (is_panels) {
                frame(build);
                frame(build);
            }
        } else if (const auto* const typed = std::get_if<CharacterTyped>(&event)) {
            // A letter that is held opens a field once, and is not typed into what it opened.
            if (repeats_ && (!is_typing() || key_ == opener_)) continue;
            is_panels = is_typing();
            if (is_panels) {
                ImGui::GetIO().AddInputCharacter(typed->code);
                frame(build);
            }
        }
        if (is_panels) continue;
        ORO_CHECK(take(event));
        // A key may have opened a field: what follows it is typed into it.
        if (std::holds_alternative<KeyChanged>(event) || std::holds_alternative<CharacterTyped>(event)) {
            frame(build);
            frame(build);
        }
        if (std::holds_alternative<CharacterTyped>(event)) opener_ = key_;
    }
    return {};
}

const ImDrawData* Interface::lists(const Build& build) {
    frame(build);
    switch (ImGui::GetMouseCursor()) {
        case ImGuiMouseCursor_TextInput:
            window_->set_pointer(PointerShape::text);
            break;
        case ImGuiMouseCursor_Hand:
            window_->set_pointer(PointerShape::hand);
            break;
        default:
            window_->set_pointer(PointerShape::arrow);
    }
    return ImGui::GetDrawData();
}

bool Interface::has_pointer() const {
    return ImGui::GetIO().WantCaptureMouse;
}

bool Interface::takes_text() const {
    return is_typing();
}

}  // namespace oro
