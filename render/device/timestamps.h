// Pools of timestamps that a device writes.
#pragma once

#include <cstdint>

#include "core/base/result.h"
#include "render/device/gpu.h"
#include "render/device/resources.h"

namespace oro {

// Makes a pool of so many timestamps, 1 or more, under a name for debugging. None is written yet. Errors: the
// device.
Result<OwnedQueryPool> create_timestamps(const Gpu& gpu, std::uint32_t count, const char* name);

}  // namespace oro
