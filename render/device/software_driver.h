// What a driver that draws on the processor needs of the system, asked before it does: short of threads it
// waits for ever for those that it did not get, short of address space it falls over.
#pragma once

#include <string>

#include "core/base/result.h"

namespace oro {

// Errors (no_device): the system gives fewer threads, or less address space, than such a driver takes. `name`
// is the device's. Takes a millisecond.
[[nodiscard]] Result<void> check_room_for_software_driver(const std::string& name);

}  // namespace oro
