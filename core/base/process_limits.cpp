#include "core/base/system_room.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>

namespace oro {

std::optional<std::uint64_t> file_size_limit_bytes() {
    struct rlimit limit {};
    if (getrlimit(RLIMIT_FSIZE, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return std::nullopt;
    return limit.rlim_cur;
}

std::optional<std::uint64_t> memory_limit_bytes() {
    struct rlimit limit {};
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return std::nullopt;
    return limit.rlim_cur;
}

bool is_memory_there(const std::byte* byte) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) return true;
    errno = 0;
    const bool faulty = write(ends[1], byte, 1) < 0 && errno == EFAULT;
    close(ends[0]);
    close(ends[1]);
    return !faulty;
}

}  // namespace oro
