#include "render/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <cstdlib>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <utility>

namespace oro {
namespace {

static_assert(key::space == GLFW_KEY_SPACE && key::minus == GLFW_KEY_MINUS && key::equal == GLFW_KEY_EQUAL);
static_assert(key::escape == GLFW_KEY_ESCAPE && key::enter == GLFW_KEY_ENTER && key::tab == GLFW_KEY_TAB);
static_assert(key::backspace == GLFW_KEY_BACKSPACE);
static_assert(key::erase == GLFW_KEY_DELETE && key::right == GLFW_KEY_RIGHT && key::left == GLFW_KEY_LEFT);
static_assert(key::down == GLFW_KEY_DOWN && key::up == GLFW_KEY_UP && key::home == GLFW_KEY_HOME);
static_assert(key::page_up == GLFW_KEY_PAGE_UP && key::page_down == GLFW_KEY_PAGE_DOWN);
static_assert(key::end == GLFW_KEY_END && key::f1 == GLFW_KEY_F1 && key::f11 == GLFW_KEY_F11);
static_assert(key::keypad_subtract == GLFW_KEY_KP_SUBTRACT && key::keypad_add == GLFW_KEY_KP_ADD);
static_assert(key::keypad_enter == GLFW_KEY_KP_ENTER && key::left_shift == GLFW_KEY_LEFT_SHIFT);
static_assert(key::left_control == GLFW_KEY_LEFT_CONTROL && key::left_alt == GLFW_KEY_LEFT_ALT);
static_assert(key::right_shift == GLFW_KEY_RIGHT_SHIFT && key::count == GLFW_KEY_LAST + 1);
static_assert(key::right_control == GLFW_KEY_RIGHT_CONTROL && key::right_alt == GLFW_KEY_RIGHT_ALT);

WindowInput& input_of(GLFWwindow* window) {
    return *static_cast<WindowInput*>(glfwGetWindowUserPointer(window));
}

void on_key(GLFWwindow* window, int key, int, int action, int mods) {
    if (key < 0 || key >= key::count) return;
    WindowInput& input = input_of(window);
    input.events.push_back(KeyChanged{key, action != GLFW_RELEASE, action == GLFW_REPEAT,
                                      (mods & GLFW_MOD_SHIFT) != 0, (mods & GLFW_MOD_CONTROL) != 0,
                                      (mods & GLFW_MOD_ALT) != 0, (mods & GLFW_MOD_SUPER) != 0});
}

// What a window shows is lost where another covered it, and while it is minimised.
void on_exposed(GLFWwindow* window) {
    input_of(window).exposed = true;
}

// From the window system's own units.
glm::dvec2 pixels_of(GLFWwindow* window, double x, double y) {
    glm::ivec2 size(0), shown_px(0);
    glfwGetWindowSize(window, &size.x, &size.y);
    glfwGetFramebufferSize(window, &shown_px.x, &shown_px.y);
    if (size.x <= 0 || size.y <= 0) return {x, y};
    return glm::dvec2(x, y) * glm::dvec2(shown_px) / glm::dvec2(size);
}

bool is_down(GLFWwindow* window, int left_key, int right_key) {
    return glfwGetKey(window, left_key) == GLFW_PRESS || glfwGetKey(window, right_key) == GLFW_PRESS;
}

bool is_shift_down(GLFWwindow* window) {
    return is_down(window, GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT);
}

bool is_control_down(GLFWwindow* window) {
    return is_down(window, GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL);
}

// Kept from events: asked for later, the pointer may have moved on from where the button went down.
void on_pointer(GLFWwindow* window, double x, double y) {
    WindowInput& input = input_of(window);
    input.pointer_px = pixels_of(window, x, y);
    input.events.push_back(PointerMoved{input.pointer_px, is_shift_down(window), is_control_down(window)});
}

void on_pointer_left(GLFWwindow* window, int entered) {
    if (entered != 0) return;
    // A drag goes on outside.
    for (const int button : {GLFW_MOUSE_BUTTON_LEFT, GLFW_MOUSE_BUTTON_RIGHT, GLFW_MOUSE_BUTTON_MIDDLE})
        if (glfwGetMouseButton(window, button) == GLFW_PRESS) return;
    input_of(window).pointer_px = glm::dvec2(-1.0);
    input_of(window).events.push_back(PointerMoved{glm::dvec2(-1.0)});
}

void on_button(GLFWwindow* window, int button, int action, int mods) {
    if (button < GLFW_MOUSE_BUTTON_LEFT || button > GLFW_MOUSE_BUTTON_MIDDLE) return;
    WindowInput& input = input_of(window);
    // A button may go down before the pointer was seen to move.
    if (input.pointer_px.x < 0.0) {
        glm::dvec2 at;
        glfwGetCursorPos(window, &at.x, &at.y);
        input.pointer_px = pixels_of(window, at.x, at.y);
    }
    input.events.push_back(ButtonChanged{static_cast<MouseButton>(button), action == GLFW_PRESS,
                                         input.pointer_px, (mods & GLFW_MOD_SHIFT) != 0,
                                         (mods & GLFW_MOD_CONTROL) != 0, (mods & GLFW_MOD_ALT) != 0,
                                         glfwGetTime()});
}

void on_wheel(GLFWwindow* window, double right, double away) {
    WindowInput& input = input_of(window);
    input.events.push_back(
        WheelTurned{{right, away}, input.pointer_px, is_shift_down(window), is_control_down(window)});
}

void on_character(GLFWwindow* window, unsigned int code) {
    input_of(window).events.push_back(CharacterTyped{code});
}

void on_paths(GLFWwindow* window, int count, const char** paths) {
    input_of(window).events.push_back(PathsDropped{{paths, paths + count}});
}

void on_focus(GLFWwindow* window, int focused) {
    input_of(window).events.push_back(FocusChanged{focused != 0});
}

std::string glfw_reason() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "no reason given";
}

Result<OwnedSemaphore> create_semaphore(const Gpu& gpu, const char* name) {
    VkSemaphoreCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
    VkSemaphore handle{};
    ORO_VK(vkCreateSemaphore(gpu.device(), &info, nullptr, &handle));
    gpu.name(VK_OBJECT_TYPE_SEMAPHORE, handle, name);
    return OwnedSemaphore(gpu.device(), handle);
}

// The window hides what is behind it, where the window system lets it say so.
VkCompositeAlphaFlagBitsKHR composite_alpha(VkCompositeAlphaFlagsKHR allowed) {
    for (const VkCompositeAlphaFlagBitsKHR one :
         {VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR, VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR,
          VK_COMPOSITE_ALPHA_PRE_MULTIPLIED_BIT_KHR, VK_COMPOSITE_ALPHA_POST_MULTIPLIED_BIT_KHR})
        if ((allowed & one) != 0) return one;
    return VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR;
}

// GLFW from 3.4 on looks for Wayland first, whose library prints a line of its own where there is none.
void choose_display() {
#ifdef GLFW_PLATFORM
    const auto is_set = [](const char* name) {
        const char* const value = std::getenv(name);
        return value != nullptr && *value != '\0';
    };
    const bool may_be_wayland = is_set("WAYLAND_DISPLAY") || is_set("WAYLAND_SOCKET");
    glfwInitHint(GLFW_PLATFORM, may_be_wayland ? GLFW_ANY_PLATFORM : GLFW_PLATFORM_X11);
#endif
}

}  // namespace

Result<std::vector<const char*>> Window::required_extensions() {
    choose_display();
    if (!glfwInit())
        return Error{ErrorKind::failed, "window",
                     "no display to open it on (" + glfw_reason() + "); orograph shot needs none"};
    std::uint32_t count = 0;
    const char** names = glfwGetRequiredInstanceExtensions(&count);
    if (!names)
        return Error{ErrorKind::no_device, "window",
                     "Vulkan cannot draw into windows here (" + glfw_reason() + ")"};
    return std::vector<const char*>(names, names + count);
}

Result<std::unique_ptr<Window>> Window::create(const Gpu& gpu, int width_px, int height_px,
                                               const std::string& title) {
    std::unique_ptr<Window> window(new Window(gpu));
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    window->window_ = glfwCreateWindow(width_px, height_px, title.c_str(), nullptr, nullptr);
    if (!window->window_) return Error{ErrorKind::failed, "window", "cannot be opened: " + glfw_reason()};
    glfwSetWindowUserPointer(window->window_, &window->input_);
    glfwSetKeyCallback(window->window_, on_key);
    glfwSetCharCallback(window->window_, on_character);
    glfwSetCursorPosCallback(window->window_, on_pointer);
    glfwSetCursorEnterCallback(window->window_, on_pointer_left);
    glfwSetMouseButtonCallback(window->window_, on_button);
    glfwSetScrollCallback(window->window_, on_wheel);
    glfwSetDropCallback(window->window_, on_paths);
    glfwSetWindowFocusCallback(window->window_, on_focus);
    glfwSetWindowRefreshCallback(window->window_, on_exposed);
    ORO_CHECK(window->create_surface());
    for (Slot& slot : window->slots_) {
        ORO_TRY(slot.commands, Commands::create(gpu, "present"));
        ORO_TRY(slot.acquired, create_semaphore(gpu, "image acquired"));
    }
    ORO_CHECK(window->choose_format());
    ORO_TRY(window->interface_, InterfaceRenderer::create(gpu, window->format_.format));
    ORO_CHECK(window->create_swapchain());
    window->last_poll_s_ = glfwGetTime();
    return window;
}

Result<void> Window::create_surface() {
    ORO_VK(glfwCreateWindowSurface(gpu_->instance(), window_, nullptr, &surface_));
    VkBool32 presents = VK_FALSE;
    ORO_VK(vkGetPhysicalDeviceSurfaceSupportKHR(gpu_->physical(), gpu_->queue_family(), surface_, &presents));
    if (!presents)
        return Error{ErrorKind::no_device, gpu_->report().name, "cannot show frames in this window system"};
    return {};
}

Result<void> Window::choose_format() {
    std::uint32_t count = 0;
    ORO_VK(vkGetPhysicalDeviceSurfaceFormatsKHR(gpu_->physical(), surface_, &count, nullptr));
    std::vector<VkSurfaceFormatKHR> formats(count);
    ORO_VK(vkGetPhysicalDeviceSurfaceFormatsKHR(gpu_->physical(), surface_, &count, formats.data()));
    // The picture is sRGB-encoded already: a UNORM format takes its bytes as they are.
    const auto plain = std::find_if(formats.begin(), formats.end(), [](const VkSurfaceFormatKHR& f) {
        return f.format == VK_FORMAT_B8G8R8A8_UNORM || f.format == VK_FORMAT_R8G8B8A8_UNORM;
    });
    if (plain == formats.end())
        return Error{ErrorKind::no_device, gpu_->report().name, "has no 8-bit format for windows"};
    format_ = *plain;
    return {};
}

Result<VkSurfaceCapabilitiesKHR> Window::capabilities() const {
    VkSurfaceCapabilitiesKHR capabilities{};
    ORO_VK(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(gpu_->physical(), surface_, &capabilities));
    return capabilities;
}

Result<void> Window::create_swapchain() {
    destroy_swapchain();
    is_stale_ = false;
    ORO_TRY(const VkSurfaceCapabilitiesKHR allowed, capabilities());
    const bool is_fixed = allowed.currentExtent.width != UINT32_MAX;
    swapchain_extent_ = is_fixed ? allowed.currentExtent : extent();
    if (swapchain_extent_.width == 0 || swapchain_extent_.height == 0) return {};
    const VkExtent2D least = allowed.minImageExtent, most = allowed.maxImageExtent;
    if (!is_fixed && least.width <= most.width && least.height <= most.height)
        swapchain_extent_ = {std::clamp(swapchain_extent_.width, least.width, most.width),
                             std::clamp(swapchain_extent_.height, least.height, most.height)};
    transform_ = allowed.currentTransform;
    VkSwapchainCreateInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR;
    info.surface = surface_;
    info.minImageCount = allowed.maxImageCount == 0
                             ? allowed.minImageCount + 1
                             : std::min(allowed.minImageCount + 1, allowed.maxImageCount);
    info.imageFormat = format_.format;
    info.imageColorSpace = format_.colorSpace;
    info.imageExtent = swapchain_extent_;
    info.imageArrayLayers = 1;
    info.imageUsage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    if ((allowed.supportedUsageFlags & info.imageUsage) != info.imageUsage)
        return Error{ErrorKind::no_device, gpu_->report().name,
                     "cannot copy and draw into this window system's images"};
    info.preTransform = transform_;
    info.compositeAlpha = composite_alpha(allowed.supportedCompositeAlpha);
    info.presentMode = VK_PRESENT_MODE_FIFO_KHR;
    info.clipped = VK_TRUE;
    ORO_VK(vkCreateSwapchainKHR(gpu_->device(), &info, nullptr, &swapchain_));
    gpu_->name(VK_OBJECT_TYPE_SWAPCHAIN_KHR, swapchain_, "window");
    return create_images();
}

// What the swapchain draws into.
Result<void> Window::create_images() {
    std::uint32_t count = 0;
    ORO_VK(vkGetSwapchainImagesKHR(gpu_->device(), swapchain_, &count, nullptr));
    images_.resize(count);
    ORO_VK(vkGetSwapchainImagesKHR(gpu_->device(), swapchain_, &count, images_.data()));
    for (std::uint32_t i = 0; i < count; ++i) {
        ORO_TRY(OwnedSemaphore drawn, create_semaphore(*gpu_, "image drawn"));
        drawn_.push_back(std::move(drawn));
        ORO_TRY(OwnedImageView view,
                create_image_view(*gpu_, images_[i], format_.format, VK_IMAGE_ASPECT_COLOR_BIT, "window"));
        views_.push_back(std::move(view));
    }
    return {};
}

void Window::destroy_swapchain() {
    if (swapchain_) {
        gpu_->wait_idle();
        views_.clear();
        vkDestroySwapchainKHR(gpu_->device(), swapchain_, nullptr);
    }
    swapchain_ = VK_NULL_HANDLE;
    to_present_.reset();
    images_.clear();
    drawn_.clear();
}

Window::~Window() {
    gpu_->wait_idle();
    destroy_swapchain();
    if (surface_) vkDestroySurfaceKHR(gpu_->instance(), surface_, nullptr);
    for (GLFWcursor* const pointer : pointers_)
        if (pointer != nullptr) glfwDestroyCursor(pointer);
    if (window_) glfwDestroyWindow(window_);
    glfwTerminate();
}

VkExtent2D Window::extent() const {
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
}

void Window::set_title(const std::string& title) {
    glfwSetWindowTitle(window_, title.c_str());
}

double Window::content_scale() const {
    float x = 1.0F, y = 1.0F;
    glfwGetWindowContentScale(window_, &x, &y);
    return std::max(1.0, 0.5 * static_cast<double>(x + y));
}

void Window::set_pointer(PointerShape shape) {
    if (shape == std::exchange(pointer_, shape)) return;
    constexpr std::array<int, 3> shapes{GLFW_ARROW_CURSOR, GLFW_IBEAM_CURSOR, GLFW_HAND_CURSOR};
    const auto number = static_cast<std::size_t>(shape);
    if (pointers_[number] == nullptr) pointers_[number] = glfwCreateStandardCursor(shapes[number]);
    glfwSetCursor(window_, pointers_[number]);
}

void Window::set_clipboard(const std::string& text) {
    glfwSetClipboardString(window_, text.c_str());
}

std::string Window::clipboard() const {
    const char* const text = glfwGetClipboardString(window_);
    return text != nullptr ? text : "";
}

// On the screen that has the window's middle.
bool Window::is_full_screen() const {
    return glfwGetWindowMonitor(window_) != nullptr;
}

void Window::hide() {
    glfwHideWindow(window_);
}

void Window::toggle_full_screen() {
    if (is_full_screen()) {
        glfwSetWindowMonitor(window_, nullptr, windowed_[0], windowed_[1], windowed_[2], windowed_[3], 0);
        return;
    }
    glfwGetWindowPos(window_, &windowed_[0], &windowed_[1]);
    glfwGetWindowSize(window_, &windowed_[2], &windowed_[3]);
    const int x = windowed_[0] + windowed_[2] / 2, y = windowed_[1] + windowed_[3] / 2;
    int count = 0;
    GLFWmonitor** const monitors = glfwGetMonitors(&count);
    if (count == 0) return;
    GLFWmonitor* chosen = monitors[0];
    for (int i = 0; i < count; ++i) {
        int left = 0, top = 0;
        glfwGetMonitorPos(monitors[i], &left, &top);
        const GLFWvidmode* const mode = glfwGetVideoMode(monitors[i]);
        if (mode != nullptr && x >= left && x < left + mode->width && y >= top && y < top + mode->height)
            chosen = monitors[i];
    }
    if (const GLFWvidmode* const mode = glfwGetVideoMode(chosen); mode != nullptr)
        glfwSetWindowMonitor(window_, chosen, 0, 0, mode->width, mode->height, mode->refreshRate);
}

WindowInput Window::poll(double wait_s) {
    WindowInput next;
    next.pointer_px = input_.pointer_px;
    input_ = std::move(next);
    if (wait_s > 0.0) {
        glfwWaitEventsTimeout(wait_s);
    } else {
        glfwPollEvents();
    }
    input_.closed = glfwWindowShouldClose(window_) != 0;
    const double now = glfwGetTime();
    input_.elapsed_s = now - last_poll_s_;
    last_poll_s_ = now;
    return input_;
}

Result<const Image*> Window::picture_of(std::span<const std::uint8_t> rgba, VkExtent2D extent) {
    assert(rgba.size() == std::size_t{4} * extent.width * extent.height);
    gpu_->wait_idle();
    ORO_TRY(pixels_, create_image(*gpu_, VK_FORMAT_R8G8B8A8_UNORM, extent,
                                  VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                                      VK_IMAGE_USAGE_SAMPLED_BIT,
                                  VK_IMAGE_ASPECT_COLOR_BIT, "pixels for a window"));
    ORO_TRY(const Buffer buffer, create_buffer(*gpu_, rgba.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                               MemoryKind::upload, "pixels for a window"));
    std::memcpy(buffer.mapped, rgba.data(), rgba.size());
    ORO_CHECK(slots_.front().commands.run(*gpu_, [&](VkCommandBuffer commands) {
        const ImageUse fresh{VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, 0};
        const ImageUse target{VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_2_COPY_BIT,
                              VK_ACCESS_2_TRANSFER_WRITE_BIT};
        const ImageUse written{VK_IMAGE_LAYOUT_GENERAL, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                               VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};
        image_barrier(commands, pixels_.handle.get(), VK_IMAGE_ASPECT_COLOR_BIT, fresh, target);
        VkBufferImageCopy copy{};
        copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
        copy.imageExtent = {extent.width, extent.height, 1};
        vkCmdCopyBufferToImage(commands, buffer.handle.get(), pixels_.handle.get(), target.layout, 1, &copy);
        image_barrier(commands, pixels_.handle.get(), VK_IMAGE_ASPECT_COLOR_BIT, target, written);
    }));
    return &pixels_;
}

// Rows of a picture's part into all rows of a window's image, columns into columns; both are ready for it.
void Window::blit(VkCommandBuffer commands, const Image& picture, const VkExtent2D& part,
                  const ShownColumns& columns, std::uint32_t index) const {
    if (columns.is_empty() || part.height == 0) return;
    const bool scaled = columns.from_end_px - columns.from_px != columns.to_end_px - columns.to_px ||
                        part.height != swapchain_extent_.height;
    const auto copy = [&](VkOffset2D from, VkOffset2D from_end, VkOffset2D to, VkOffset2D to_end,
                          VkFilter filter) {
        if (from.x >= from_end.x || from.y >= from_end.y || to.x >= to_end.x || to.y >= to_end.y) return;
        VkImageBlit region{};
        region.srcSubresource = region.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
        region.srcOffsets[0] = {from.x, from.y, 0};
        region.srcOffsets[1] = {from_end.x, from_end.y, 1};
        region.dstOffsets[0] = {to.x, to.y, 0};
        region.dstOffsets[1] = {to_end.x, to_end.y, 1};
        vkCmdBlitImage(commands, picture.handle.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, images_[index],
                       VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region, filter);
    };
    const VkOffset2D from{columns.from_px, 0}, to{columns.to_px, 0};
    const VkOffset2D from_end{columns.from_end_px, static_cast<std::int32_t>(part.height)};
    const VkOffset2D to_end{columns.to_end_px, static_cast<std::int32_t>(swapchain_extent_.height)};
    if (!scaled) return copy(from, from_end, to, to_end, VK_FILTER_NEAREST);
    // A linear filter takes what lies beside the part, too, which nobody has drawn. So the part's last column
    // and row are copied by themselves.
    const VkOffset2D inner_end{from_end.x - 1, from_end.y - 1};
    const auto scaled_px = [](std::int32_t px, std::int32_t source_px, std::int32_t target_px) {
        return static_cast<std::int32_t>(std::int64_t{px} * target_px / source_px);
    };
    const VkOffset2D split{to.x + scaled_px(inner_end.x - from.x, from_end.x - from.x, to_end.x - to.x),
                           to.y + scaled_px(inner_end.y - from.y, from_end.y - from.y, to_end.y - to.y)};
    copy(from, inner_end, to, split, VK_FILTER_LINEAR);
    copy({inner_end.x, 0}, from_end, {split.x, 0}, to_end, VK_FILTER_NEAREST);
    copy({from.x, inner_end.y}, {inner_end.x, from_end.y}, {to.x, split.y}, {split.x, to_end.y},
         VK_FILTER_NEAREST);
}

// The picture, as large as the window or scaled to it, a second one beside it, and what lies over both.
void Window::record(VkCommandBuffer commands, const WindowPicture& shown, std::uint32_t index) const {
    const ImageUse written{VK_IMAGE_LAYOUT_GENERAL, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                           VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};
    const ImageUse source{VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_PIPELINE_STAGE_2_BLIT_BIT,
                          VK_ACCESS_2_TRANSFER_READ_BIT};
    const ImageUse fresh{VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, 0};
    const ImageUse target{VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_2_BLIT_BIT,
                          VK_ACCESS_2_TRANSFER_WRITE_BIT};
    const ImageUse drawn_over{VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                              VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                              VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
    const ImageUse presented{VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, 0};
    const auto barrier_of_pictures = [&](const ImageUse& before, const ImageUse& after) {
        image_barrier(commands, shown.picture.handle.get(), VK_IMAGE_ASPECT_COLOR_BIT, before, after);
        if (shown.beside)
            image_barrier(commands, shown.beside->picture.handle.get(), VK_IMAGE_ASPECT_COLOR_BIT, before,
                          after);
    };
    barrier_of_pictures(written, source);
    image_barrier(commands, images_[index], VK_IMAGE_ASPECT_COLOR_BIT, fresh, target);
    const std::uint32_t width = swapchain_extent_.width;
    const std::uint32_t border = shown.beside ? std::min(shown.beside->begins_px, width) : width;
    const bool is_swiped = shown.beside && shown.beside->is_of_whole_window;
    blit(commands, shown.picture, shown.part, shown_columns(shown.part.width, width, 0, border, is_swiped),
         index);
    if (shown.beside)
        blit(commands, shown.beside->picture, shown.beside->part,
             shown_columns(shown.beside->part.width, width, border, width, is_swiped), index);
    image_barrier(commands, images_[index], VK_IMAGE_ASPECT_COLOR_BIT, target, drawn_over);
    if (shown.over != nullptr)
        interface_.record(commands, *shown.over, views_[index].get(), swapchain_extent_);
    image_barrier(commands, images_[index], VK_IMAGE_ASPECT_COLOR_BIT, drawn_over, presented);
    barrier_of_pictures(source, written);
}

Result<bool> Window::take_result(VkResult result, const char* call) {
    if (result == VK_SUCCESS) return true;
    // A window that nobody sees may have no image to draw into.
    if (result == VK_TIMEOUT || result == VK_NOT_READY) return false;
    if (result == VK_ERROR_OUT_OF_DATE_KHR) {
        is_stale_ = true;
        return false;
    }
    if (result != VK_SUBOPTIMAL_KHR) {
        ORO_CHECK(vulkan_checked(result, call));
    }
    ORO_TRY(const VkSurfaceCapabilitiesKHR now, capabilities());
    const VkExtent2D size = now.currentExtent;
    const bool is_best = best_for_ && best_for_->first.width == size.width &&
                         best_for_->first.height == size.height && best_for_->second == now.currentTransform;
    if (!is_best) is_stale_ = true;
    best_for_ = {size, now.currentTransform};
    return true;
}

Result<bool> Window::show(const WindowPicture& shown) {
    constexpr std::uint64_t longest_ns = 50'000'000;
    ORO_CHECK(present());
    const VkExtent2D now = extent();
    if (!swapchain_ || is_stale_ || now.width != swapchain_extent_.width ||
        now.height != swapchain_extent_.height) {
        ORO_CHECK(create_swapchain());
        if (!swapchain_) return false;
    }
    Slot& slot = slots_[turn_];
    ORO_CHECK(slot.commands.wait());
    std::uint32_t index = 0;
    const VkResult acquired = vkAcquireNextImageKHR(gpu_->device(), swapchain_, longest_ns,
                                                    slot.acquired.get(), VK_NULL_HANDLE, &index);
    ORO_TRY(const bool has_image, take_result(acquired, "vkAcquireNextImageKHR("));
    if (!has_image) return false;
    if (shown.over != nullptr) ORO_CHECK(interface_.prepare(*gpu_, *shown.over, turn_));
    ORO_CHECK(slot.commands.submit(*gpu_, [&](VkCommandBuffer commands) { record(commands, shown, index); },
                                   {slot.acquired.get(), drawn_[index].get()}));
    turn_ = (turn_ + 1) % slots_.size();
    to_present_ = index;
    return gpu_->report().kind == VK_PHYSICAL_DEVICE_TYPE_CPU ? Result<bool>(true) : present();
}

bool Window::has_lost_device() const {
    return vkDeviceWaitIdle(gpu_->device()) == VK_ERROR_DEVICE_LOST;
}

Result<bool> Window::present() {
    if (!to_present_) return true;
    const std::uint32_t index = *std::exchange(to_present_, std::nullopt);
    VkSemaphore drawn = drawn_[index].get();
    VkPresentInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR;
    info.waitSemaphoreCount = info.swapchainCount = 1;
    info.pWaitSemaphores = &drawn;
    info.pSwapchains = &swapchain_;
    info.pImageIndices = &index;
    return take_result(vkQueuePresentKHR(gpu_->queue(), &info), "vkQueuePresentKHR(");
}

}  // namespace oro
