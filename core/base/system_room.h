// What the system would still give this process, asked by taking it for a moment; the shell's limit of file
// sizes (ulimit -f); and memory that lies in a file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

namespace oro {

// Threads beside those that run, up to `count`.
[[nodiscard]] int threads_to_be_had(int count);

// True when so much address space can be had in one piece. Nothing of it is touched.
[[nodiscard]] bool address_space_to_be_had(std::size_t bytes);

// So many bytes a file may have that this program writes; nothing where there is no limit.
[[nodiscard]] std::optional<std::uint64_t> file_size_limit_bytes();
// How many bytes of addresses this process may have (ulimit -v); nothing where it may have all.
[[nodiscard]] std::optional<std::uint64_t> memory_limit_bytes();

// The main memory of this machine, all of it; nothing where the system does not say.
[[nodiscard]] std::optional<std::uint64_t> machine_memory_bytes();

// Whether a byte of mapped memory is there: the system reads it, and gives an error number where the program
// itself would end by SIGBUS. True, too, where the system cannot be asked.
[[nodiscard]] bool is_memory_there(const std::byte* byte);

}  // namespace oro
