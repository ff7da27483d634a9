#include "core/base/scratch_memory.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <new>
#include <utility>

namespace oro {
namespace {

constexpr std::size_t least_in_file = std::size_t{1} << 16U;

// A file without a name, or -1.
int open_scratch(const std::string& folder) {
    const int nameless = open(folder.c_str(), O_RDWR | O_TMPFILE | O_CLOEXEC, 0600);
    if (nameless >= 0 || (errno != EOPNOTSUPP && errno != EISDIR && errno != EINVAL)) return nameless;
    // Where the file system has none: the name is gone at once.
    std::string path = folder + "/.orograph-scratch-XXXXXX";
    const int named = mkstemp(path.data());
    if (named >= 0) unlink(path.c_str());
    return named;
}

}  // namespace

ScratchMemory::~ScratchMemory() {
    for (const auto& [memory, bytes] : mapped_) munmap(memory, bytes);
}

std::optional<Error> ScratchMemory::error() const {
    const std::scoped_lock lock(mutex_);
    return error_;
}

ScratchMemory::Bytes ScratchMemory::bytes() const {
    const std::scoped_lock lock(mutex_);
    return bytes_;
}

void ScratchMemory::drop_pages() {
    const std::scoped_lock lock(mutex_);
    for (const auto& [memory, bytes] : mapped_) madvise(memory, bytes, MADV_DONTNEED);
}

void* ScratchMemory::map_file(std::size_t bytes) {
    const int file = open_scratch(folder_);
    int why = file < 0 ? errno : posix_fallocate(file, 0, static_cast<off_t>(bytes));
    void* memory = MAP_FAILED;
    if (why == 0) {
        memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
        if (memory == MAP_FAILED) why = errno;
    }
    if (file >= 0) close(file);
    if (memory != MAP_FAILED) return memory;
    error_ =
        Error{ErrorKind::failed, folder_,
              "no room for a scratch file of " + std::to_string(bytes) + " bytes: " + std::strerror(why)};
    return nullptr;
}

void* ScratchMemory::do_allocate(std::size_t bytes, std::size_t alignment) {
    const std::scoped_lock lock(mutex_);
    if (bytes < least_in_file) {
        void* const memory = std::pmr::new_delete_resource()->allocate(bytes, alignment);
        bytes_.in_memory += bytes;
        bytes_.most_in_memory = std::max(bytes_.most_in_memory, bytes_.in_memory);
        return memory;
    }
    void* const memory = map_file(bytes);
    if (memory == nullptr) throw std::bad_alloc();
    mapped_.emplace(memory, bytes);
    bytes_.in_files += bytes;
    bytes_.most_in_files = std::max(bytes_.most_in_files, bytes_.in_files);
    return memory;
}

void ScratchMemory::do_deallocate(void* memory, std::size_t bytes, std::size_t alignment) {
    const std::scoped_lock lock(mutex_);
    const auto found = mapped_.find(memory);
    if (found == mapped_.end()) {
        bytes_.in_memory -= bytes;
        std::pmr::new_delete_resource()->deallocate(memory, bytes, alignment);
        return;
    }
    munmap(memory, found->second);
    bytes_.in_files -= found->second;
    mapped_.erase(found);
}

}  // namespace oro
