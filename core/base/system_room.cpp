#include "core/base/system_room.h"

#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <thread>
#include <vector>

#include "core/base/parallel.h"

namespace oro {

int threads_to_be_had(int count) {
    std::atomic<bool> is_over{false};
    std::vector<std::jthread> threads;
    start_threads(threads, count, [&] { is_over.wait(false); });
    is_over = true;
    is_over.notify_all();
    return static_cast<int>(threads.size());
}

bool address_space_to_be_had(std::size_t bytes) {
    void* const room = mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (room == MAP_FAILED) return false;
    munmap(room, bytes);
    return true;
}

std::optional<std::uint64_t> machine_memory_bytes() {
    const long pages = sysconf(_SC_PHYS_PAGES), page_bytes = sysconf(_SC_PAGESIZE);
    if (pages <= 0 || page_bytes <= 0) return std::nullopt;
    return static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page_bytes);
}

}  // namespace oro
