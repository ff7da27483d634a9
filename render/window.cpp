#include "render/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <cstdlib>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <glm/common.hpp>
#include <utility>

namespace oro {
namespace {

constexpr std::array<std::pair<int, Key>, 13> held_keys{{{GLFW_KEY_W, Key::forward},
                                                         {GLFW_KEY_S, Key::back},
                                                         {GLFW_KEY_A, Key::left},
                                                         {GLFW_KEY_D, Key::right},
                                                         {GLFW_KEY_SPACE, Key::up},
                                                         {GLFW_KEY_LEFT_CONTROL, Key::down},
                                                         {GLFW_KEY_RIGHT_CONTROL, Key::down},
                                                         {GLFW_KEY_LEFT_SHIFT, Key::fast},
                                                         {GLFW_KEY_RIGHT_SHIFT, Key::fast},
                                                         {GLFW_KEY_Q, Key::look_left},
                                                         {GLFW_KEY_E, Key::look_right},
                                                         {GLFW_KEY_R, Key::look_up},
                                                         {GLFW_KEY_F, Key::look_down}}};

WindowInput& input_of(GLFWwindow* window) {
    return *static_cast<WindowInput*>(glfwGetWindowUserPointer(window));
}

void on_key(GLFWwindow* window, int key, int, int action, int) {
    if (action == GLFW_RELEASE) return;
    WindowInput& input = input_of(window);
    if (key == GLFW_KEY_ESCAPE) input.escape = true;
    if ((key == GLFW_KEY_ENTER || key == GLFW_KEY_KP_ENTER) && action == GLFW_PRESS) ++input.enters;
    if (key == GLFW_KEY_BACKSPACE) input.backspace = true;
    if (key == GLFW_KEY_P && action == GLFW_PRESS) input.take_picture = true;
    if (key == GLFW_KEY_G && action == GLFW_PRESS) input.go_to = true;
}

// What a window shows is lost where another covered it, and while it is minimised.
void on_exposed(GLFWwindow* window) {
    input_of(window).exposed = true;
}

// Kept from events: asked for later, the cursor may have moved on from where the button went down.
void on_cursor(GLFWwindow* window, double x, double y) {
    input_of(window).cursor = {x, y};
}

void on_button(GLFWwindow* window, int button, int action, int) {
    if (button != GLFW_MOUSE_BUTTON_RIGHT || action != GLFW_PRESS) return;
    glm::ivec2 size(0), shown_px(0);
    glfwGetWindowSize(window, &size.x, &size.y);
    glfwGetFramebufferSize(window, &shown_px.x, &shown_px.y);
    if (size.x <= 0 || size.y <= 0) return;
    WindowInput& input = input_of(window);
    input.picked_px = glm::floor(input.cursor * glm::dvec2(shown_px) / glm::dvec2(size)) + 0.5;
}

void on_character(GLFWwindow* window, unsigned int code) {
    std::string& typed = input_of(window).typed;
    const auto byte = [&](unsigned int value) { typed += static_cast<char>(value); };
    // Source: RFC 3629, section 3.
    if (code < 0x80) {
        byte(code);
    } else if (code < 0x800) {
        byte(0xC0 | code >> 6), byte(0x80 | (code & 0x3F));
    } else if (code < 0x10000) {
        byte(0xE0 | code >> 12), byte(0x80 | (code >> 6 & 0x3F)), byte(0x80 | (code & 0x3F));
    } else {
        byte(0xF0 | code >> 18), byte(0x80 | (code >> 12 & 0x3F)), byte(0x80 | (code >> 6 & 0x3F)),
            byte(0x80 | (code & 0x3F));
    }
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
    glfwSetInputMode(window->window_, GLFW_STICKY_KEYS,
                     GLFW_TRUE);  // a key tapped during a slow frame counts
    glfwSetKeyCallback(window->window_, on_key);
    glfwSetCharCallback(window->window_, on_character);
    glfwSetCursorPosCallback(window->window_, on_cursor);
    glfwSetMouseButtonCallback(window->window_, on_button);
    glfwSetWindowRefreshCallback(window->window_, on_exposed);
    ORO_CHECK(window->create_surface());
    ORO_TRY(window->commands_, Commands::create(gpu, "present"));
    ORO_TRY(window->acquired_, create_semaphore(gpu, "image acquired"));
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

Result<void> Window::create_swapchain() {
    destroy_swapchain();
    VkSurfaceCapabilitiesKHR capabilities{};
    ORO_VK(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(gpu_->physical(), surface_, &capabilities));
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
    swapchain_extent_ =
        capabilities.currentExtent.width == UINT32_MAX ? extent() : capabilities.currentExtent;
    if (swapchain_extent_.width == 0 || swapchain_extent_.height == 0) return {};
    VkSwapchainCreateInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR;
    info.surface = surface_;
    info.minImageCount = capabilities.maxImageCount == 0
                             ? capabilities.minImageCount + 1
                             : std::min(capabilities.minImageCount + 1, capabilities.maxImageCount);
    info.imageFormat = plain->format;
    info.imageColorSpace = plain->colorSpace;
    info.imageExtent = swapchain_extent_;
    info.imageArrayLayers = 1;
    info.imageUsage = VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    info.preTransform = capabilities.currentTransform;
    info.compositeAlpha = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR;
    info.presentMode = VK_PRESENT_MODE_FIFO_KHR;
    info.clipped = VK_TRUE;
    ORO_VK(vkCreateSwapchainKHR(gpu_->device(), &info, nullptr, &swapchain_));
    gpu_->name(VK_OBJECT_TYPE_SWAPCHAIN_KHR, swapchain_, "window");
    fresh_ = true;
    ORO_VK(vkGetSwapchainImagesKHR(gpu_->device(), swapchain_, &count, nullptr));
    images_.resize(count);
    ORO_VK(vkGetSwapchainImagesKHR(gpu_->device(), swapchain_, &count, images_.data()));
    for (std::uint32_t i = 0; i < count; ++i) {
        ORO_TRY(OwnedSemaphore drawn, create_semaphore(*gpu_, "image drawn"));
        drawn_.push_back(std::move(drawn));
    }
    return {};
}

void Window::destroy_swapchain() {
    if (swapchain_) {
        vkQueueWaitIdle(gpu_->queue());
        vkDestroySwapchainKHR(gpu_->device(), swapchain_, nullptr);
    }
    swapchain_ = VK_NULL_HANDLE;
    images_.clear();
    drawn_.clear();
}

Window::~Window() {
    destroy_swapchain();
    if (surface_) vkDestroySurfaceKHR(gpu_->instance(), surface_, nullptr);
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

WindowInput Window::poll(double wait_s) {
    WindowInput next;
    next.cursor = input_.cursor;
    input_ = std::move(next);
    if (wait_s > 0.0) {
        glfwWaitEventsTimeout(wait_s);
    } else {
        glfwPollEvents();
    }
    for (const auto& [code, key] : held_keys) {
        if (glfwGetKey(window_, code) == GLFW_PRESS) input_.held[static_cast<std::size_t>(key)] = true;
    }
    glm::dvec2 cursor;
    glfwGetCursorPos(window_, &cursor.x, &cursor.y);
    // A drag begins where the button went down, not where the cursor was before.
    const bool pressed = glfwGetMouseButton(window_, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS;
    if (pressed && dragging_) input_.dragged_px = cursor - cursor_;
    dragging_ = pressed;
    cursor_ = cursor;
    input_.closed = glfwWindowShouldClose(window_) != 0;
    const double now = glfwGetTime();
    input_.elapsed_s = now - last_poll_s_;
    last_poll_s_ = now;
    return input_;
}

Result<VkResult> Window::submit_and_present(VkCommandBuffer commands, std::uint32_t index) {
    VkSemaphoreSubmitInfo wait{};
    wait.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO;
    wait.semaphore = acquired_.get();
    wait.stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    VkSemaphoreSubmitInfo signal = wait;
    signal.semaphore = drawn_[index].get();
    VkCommandBufferSubmitInfo submitted{};
    submitted.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO;
    submitted.commandBuffer = commands;
    VkSubmitInfo2 submit{};
    submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2;
    submit.waitSemaphoreInfoCount = submit.commandBufferInfoCount = submit.signalSemaphoreInfoCount = 1;
    submit.pWaitSemaphoreInfos = &wait;
    submit.pCommandBufferInfos = &submitted;
    submit.pSignalSemaphoreInfos = &signal;
    VkFence fence = commands_.fence();
    ORO_VK(vkQueueSubmit2(gpu_->queue(), 1, &submit, fence));
    VkSemaphore drawn = drawn_[index].get();
    VkPresentInfoKHR present{};
    present.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR;
    present.waitSemaphoreCount = present.swapchainCount = 1;
    present.pWaitSemaphores = &drawn;
    present.pSwapchains = &swapchain_;
    present.pImageIndices = &index;
    const VkResult presented = vkQueuePresentKHR(gpu_->queue(), &present);
    ORO_CHECK(wait_for(*gpu_, fence));
    if (presented != VK_ERROR_OUT_OF_DATE_KHR && presented != VK_SUBOPTIMAL_KHR)
        ORO_CHECK(vulkan_checked(presented, "vkQueuePresentKHR("));
    return presented;
}

Result<void> Window::take_pixels(std::span<const std::uint8_t> rgba, VkExtent2D extent) {
    ORO_TRY(pixels_, create_image(*gpu_, VK_FORMAT_R8G8B8A8_UNORM, extent,
                                  VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                                      VK_IMAGE_USAGE_SAMPLED_BIT,
                                  VK_IMAGE_ASPECT_COLOR_BIT, "pixels for a window"));
    ORO_TRY(const Buffer buffer, create_buffer(*gpu_, rgba.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                               MemoryKind::upload, "pixels for a window"));
    std::memcpy(buffer.mapped, rgba.data(), rgba.size());
    return commands_.run(*gpu_, [&](VkCommandBuffer commands) {
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
    });
}

Result<bool> Window::show_pixels(std::span<const std::uint8_t> rgba, VkExtent2D extent) {
    assert(rgba.size() == std::size_t{4} * extent.width * extent.height);
    ORO_CHECK(take_pixels(rgba, extent));
    return show(pixels_);
}

Result<bool> Window::show(const Image& picture) {
    const VkExtent2D now = extent();
    if (!swapchain_ || now.width != swapchain_extent_.width || now.height != swapchain_extent_.height) {
        ORO_CHECK(create_swapchain());
        if (!swapchain_) return false;
    }
    std::uint32_t index = 0;
    const VkResult acquired = vkAcquireNextImageKHR(gpu_->device(), swapchain_, UINT64_MAX, acquired_.get(),
                                                    VK_NULL_HANDLE, &index);
    if (acquired == VK_ERROR_OUT_OF_DATE_KHR) {
        ORO_CHECK(create_swapchain());
        return false;
    }
    if (acquired != VK_SUBOPTIMAL_KHR) ORO_CHECK(vulkan_checked(acquired, "vkAcquireNextImageKHR("));

    ORO_TRY(VkCommandBuffer commands, commands_.begin());
    const ImageUse written{VK_IMAGE_LAYOUT_GENERAL, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                           VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};
    const ImageUse source{VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_PIPELINE_STAGE_2_BLIT_BIT,
                          VK_ACCESS_2_TRANSFER_READ_BIT};
    const ImageUse fresh{VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, 0};
    const ImageUse target{VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_2_BLIT_BIT,
                          VK_ACCESS_2_TRANSFER_WRITE_BIT};
    const ImageUse presented{VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, 0};
    image_barrier(commands, picture.handle.get(), VK_IMAGE_ASPECT_COLOR_BIT, written, source);
    image_barrier(commands, images_[index], VK_IMAGE_ASPECT_COLOR_BIT, fresh, target);
    VkImageBlit blit{};
    blit.srcSubresource = blit.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    blit.srcOffsets[1] = {static_cast<std::int32_t>(picture.extent.width),
                          static_cast<std::int32_t>(picture.extent.height), 1};
    blit.dstOffsets[1] = {static_cast<std::int32_t>(swapchain_extent_.width),
                          static_cast<std::int32_t>(swapchain_extent_.height), 1};
    vkCmdBlitImage(commands, picture.handle.get(), source.layout, images_[index], target.layout, 1, &blit,
                   VK_FILTER_NEAREST);
    image_barrier(commands, images_[index], VK_IMAGE_ASPECT_COLOR_BIT, target, presented);
    image_barrier(commands, picture.handle.get(), VK_IMAGE_ASPECT_COLOR_BIT, source, written);
    ORO_VK(vkEndCommandBuffer(commands));
    ORO_TRY(const VkResult shown, submit_and_present(commands, index));
    // What is suboptimal from its first image on is the best that this window system has.
    const bool first = std::exchange(fresh_, false);
    const bool suboptimal = acquired == VK_SUBOPTIMAL_KHR || shown == VK_SUBOPTIMAL_KHR;
    if (shown != VK_ERROR_OUT_OF_DATE_KHR && (first || !suboptimal)) return true;
    ORO_CHECK(create_swapchain());
    return false;
}

}  // namespace oro
