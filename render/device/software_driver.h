// What a driver that draws on the processor needs of the system, asked before it does: short of threads it
// waits for ever for those that it did not get, short of address space it falls over.
#pragma once

#include <string>

#include "core/base/result.h"
#include "render/device/gpu.h"

namespace oro {

// Errors (no_device): the system gives fewer threads, or less address space, than such a driver takes. `name`
// is the device's. Takes a millisecond.
[[nodiscard]] Result<void> check_room_for_software_driver(const std::string& name);

// Software drivers keep what stands for a GPU's memory in one file (lavapipe in a memfd), and do not look
// whether the file could be made longer: beyond the limit of file sizes the program ends by SIGBUS when it
// touches what it was given. So where there is a limit, so much memory and some for the driver's own needs is
// taken, its end touched in a way that cannot fail but by an error number, and given back. Costs nothing on
// GPUs and without a limit. To be asked before each allocation. Errors: the file cannot become so long.
Result<void> check_room_in_file(const Gpu& gpu, const VkMemoryAllocateInfo& info, const std::string& name);

}  // namespace oro
