#include "render/device/software_driver.h"

#include <cstddef>

#include "core/base/parallel.h"
#include "core/base/system_room.h"

namespace oro {
namespace {

// Seen in lavapipe: a thread for each processor, and queues beside them.
constexpr unsigned most_processors = 32;
constexpr int other_threads = 5;
// Lavapipe falls over where it has less than this, on two processors.
constexpr std::size_t address_space_bytes = std::size_t{3} << 28;

}  // namespace

Result<void> check_room_for_software_driver(const std::string& name) {
    const int needed = thread_count(most_processors) + other_threads;
    if (const int given = threads_to_be_had(needed); given < needed)
        return Error{ErrorKind::no_device, name,
                     "draws on the processor and takes " + std::to_string(needed) +
                         " threads for that; the system gives " + std::to_string(given) +
                         " (ulimit -u or -v, or a container's limits)"};
    if (!address_space_to_be_had(address_space_bytes))
        return Error{ErrorKind::no_device, name,
                     "draws on the processor, and there is not enough memory for that (ulimit -v)"};
    return {};
}

}  // namespace oro
