// Memory of software drivers under a limit of file sizes (ulimit -f).
#pragma once

#include <string>

#include "core/base/result.h"
#include "render/device/gpu.h"

namespace oro {

// Software drivers keep what stands for a GPU's memory in one file (lavapipe in a memfd), and do not look
// whether the file could be made longer: beyond the limit of file sizes the program ends by SIGBUS when it
// touches what it was given. So where there is a limit, so much memory and some for the driver's own needs is
// taken, its end touched in a way that cannot fail but by an error number, and given back. Costs nothing on
// GPUs and without a limit. To be asked before each allocation. Errors: the file cannot become so long.
Result<void> check_room_in_file(const Gpu& gpu, const VkMemoryAllocateInfo& info, const std::string& name);

}  // namespace oro
