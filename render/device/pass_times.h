// What the passes of a frame take on the GPU, one after the other.
#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "render/device/gpu.h"
#include "render/device/resources.h"

namespace oro {

// A kind of pass. Of a frame's grids and samples those of one name are together.
struct PassTime {
    std::string pass;
    double s{};
};

// Timestamps between the passes of one recording of commands. Each pass waits for those before it where the
// frame has no barrier of its own, so a frame that is timed so takes a little longer.
class PassTimes {
  public:
    // Errors: the device.
    static Result<PassTimes> create(const Gpu& gpu);

    // The first pass begins here. Not within a rendering.
    void begin(VkCommandBuffer commands);
    // What was recorded since the last pass ended, or begin(), is the pass of that name; a string literal.
    // Beyond most_passes of a recording nothing is kept.
    void end_pass(VkCommandBuffer commands, const char* name);
    // Seconds of each kind of pass, in the order in which they were recorded first. The commands have been
    // waited for. Errors: the device.
    [[nodiscard]] Result<std::vector<PassTime>> read(const Gpu& gpu) const;

    static constexpr std::uint32_t most_passes = 255;

  private:
    OwnedQueryPool timestamps_;
    std::vector<const char*> names_;
};

// The same where times are asked for; null: nothing is recorded.
inline void end_pass(PassTimes* times, VkCommandBuffer commands, const char* name) {
    if (times != nullptr) times->end_pass(commands, name);
}

}  // namespace oro
