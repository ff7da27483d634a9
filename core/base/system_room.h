// What the system would still give this process, asked by taking it for a moment.
#pragma once

#include <cstddef>

namespace oro {

// Threads beside those that run, up to `count`.
[[nodiscard]] int threads_to_be_had(int count);

// True when so much address space can be had in one piece. Nothing of it is touched.
[[nodiscard]] bool address_space_to_be_had(std::size_t bytes);

}  // namespace oro
