#include "tests/faulty_vulkan/orders.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstdlib>
#include <map>
#include <mutex>
#include <sstream>
#include <string>
#include <vector>

namespace oro::test {
namespace {

// One order from ORO_FAULT.
struct Fault {
    std::string call;
    int number{};  // 0: every one
    VkResult result{};
};

struct Orders {
    std::mutex mutex;
    std::map<std::string, int> calls;
    std::vector<Fault> faults;
    bool lost{false};
};
Orders& orders() {
    static Orders the;
    return the;
}

VkResult result_named(const std::string& name) {
    static const std::map<std::string, VkResult> results{
        {"VK_ERROR_OUT_OF_HOST_MEMORY", VK_ERROR_OUT_OF_HOST_MEMORY},
        {"VK_ERROR_OUT_OF_DEVICE_MEMORY", VK_ERROR_OUT_OF_DEVICE_MEMORY},
        {"VK_ERROR_INITIALIZATION_FAILED", VK_ERROR_INITIALIZATION_FAILED},
        {"VK_ERROR_INCOMPATIBLE_DRIVER", VK_ERROR_INCOMPATIBLE_DRIVER},
        {"VK_ERROR_DEVICE_LOST", VK_ERROR_DEVICE_LOST},
        {"VK_ERROR_SURFACE_LOST_KHR", VK_ERROR_SURFACE_LOST_KHR},
        {"VK_ERROR_OUT_OF_DATE_KHR", VK_ERROR_OUT_OF_DATE_KHR},
        {"VK_SUBOPTIMAL_KHR", VK_SUBOPTIMAL_KHR},
        {"VK_TIMEOUT", VK_TIMEOUT},
    };
    const auto found = results.find(name);
    if (found == results.end()) std::abort();  // a mistake in the test
    return found->second;
}

bool can_lose_device(const std::string& call) {
    return call == "vkQueueSubmit2" || call == "vkWaitForFences" || call == "vkQueueWaitIdle" ||
           call == "vkDeviceWaitIdle" || call == "vkGetQueryPoolResults" || call == "vkAcquireNextImageKHR" ||
           call == "vkQueuePresentKHR" || call == "vkCreateSwapchainKHR";
}

}  // namespace

void log_line(const std::string& line) {
    const char* const file = std::getenv("ORO_FAULT_LOG");
    const int to = file != nullptr ? open(file, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600) : -1;
    if (to < 0) return;
    const std::string text = line + "\n";
    // A line that is not there makes the test that reads it fail.
    if (write(to, text.data(), text.size()) < 0) std::abort();
    close(to);
}

void read_orders() {
    Orders& s = orders();
    const char* const text = std::getenv("ORO_FAULT");
    s.faults.clear();
    std::istringstream all(text != nullptr ? text : "");
    for (std::string order; std::getline(all, order, ';');) {
        std::istringstream words(order);
        Fault fault;
        std::string result;
        if (words >> fault.call >> fault.number >> result) {
            fault.result = result_named(result);
            s.faults.push_back(fault);
        }
    }
}

VkResult ordered(const char* call) {
    Orders& s = orders();
    const std::scoped_lock lock(s.mutex);
    const int number = ++s.calls[call];
    log_line(std::string("call ") + call);
    if (s.lost && can_lose_device(call)) return VK_ERROR_DEVICE_LOST;
    for (const Fault& fault : s.faults) {
        if (fault.call != call || (fault.number != 0 && fault.number != number)) continue;
        log_line(std::string("fault ") + call + " " + std::to_string(number));
        if (fault.result == VK_ERROR_DEVICE_LOST) s.lost = true;
        return fault.result;
    }
    return VK_SUCCESS;
}

bool is_lost() {
    return orders().lost;
}
void device_is_new() {
    orders().lost = false;
}

}  // namespace oro::test
