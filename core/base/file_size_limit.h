// The shell's limit of file sizes (ulimit -f), and memory that lies in a file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

namespace oro {

// So many bytes a file may have that this program writes; nothing where there is no limit.
[[nodiscard]] std::optional<std::uint64_t> file_size_limit_bytes();

// Whether a byte of mapped memory is there: the system reads it, and gives an error number where the program
// itself would end by SIGBUS. True, too, where the system cannot be asked.
[[nodiscard]] bool is_memory_there(const std::byte* byte);

}  // namespace oro
