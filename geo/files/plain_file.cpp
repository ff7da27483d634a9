#include "geo/files/plain_file.h"

#include <cerrno>
#include <cstdio>
#include <system_error>

namespace oro {

Result<void> write_plain_file(const std::string& path, std::span<const std::uint8_t> bytes) {
    const auto failed = [&](int why) {
        return Error{ErrorKind::failed, path, "cannot be written: " + std::generic_category().message(why)};
    };
    std::FILE* const file = std::fopen(path.c_str(), "wbxe");
    if (file == nullptr) return failed(errno);
    const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
    const int why = errno;
    if (std::fclose(file) != 0) return failed(errno);
    return written ? Result<void>() : failed(why);
}

}  // namespace oro
