// What a file begins with, to tell what it is.
#pragma once

#include <cstdint>
#include <string>

namespace oro {

// A file's first bytes, at most so many; "" where it cannot be read.
std::string begin_of_file(const std::string& path, std::uint64_t most_bytes);

}  // namespace oro
