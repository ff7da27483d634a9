// Which calls are to fail, and how (ORO_FAULT), and the log of what happened (ORO_FAULT_LOG).
#pragma once

#include <vulkan/vulkan.h>

#include <string>

namespace oro::test {

// Adds a line to the log, if one is wanted.
void log_line(const std::string& line);

// Takes the orders from the environment.
void read_orders();
// Counts a call, and tells what it is to give; VK_SUCCESS: what it gives by itself.
VkResult ordered(const char* call);

// Whether the device was lost on order, and that there is another.
bool is_lost();
void device_is_new();

}  // namespace oro::test
