// Memory that lies in files: for arrays that are larger than the machine's own.
#pragma once

#include <cstddef>
#include <map>
#include <memory_resource>
#include <mutex>
#include <optional>
#include <string>

#include "core/base/result.h"

namespace oro {

// For std::pmr containers. What takes 64 KiB or more lies in a file without a name in `folder`, mapped: the
// system writes pages of it there and takes them from memory when others need it. The file's bytes are taken
// on the disk when they are asked for, so a full disk is known then; whatever ends the program leaves nothing
// of them. Less lies in ordinary memory. From any thread.
class ScratchMemory final : public std::pmr::memory_resource {
  public:
    explicit ScratchMemory(std::string folder) : folder_(std::move(folder)) {}
    ~ScratchMemory() override;
    ScratchMemory(const ScratchMemory&) = delete;
    ScratchMemory& operator=(const ScratchMemory&) = delete;

    // Why memory could not be had, std::bad_alloc was thrown then: the folder, and the system's reason.
    [[nodiscard]] std::optional<Error> error() const;
    // No page is this process's any more until it is asked for again. What is in the files stays.
    void drop_pages();

    struct Bytes {
        std::size_t in_files{};
        std::size_t most_in_files{};  // at one time
        std::size_t in_memory{};
        std::size_t most_in_memory{};
    };
    [[nodiscard]] Bytes bytes() const;

  private:
    void* do_allocate(std::size_t bytes, std::size_t alignment) override;
    void do_deallocate(void* memory, std::size_t bytes, std::size_t alignment) override;
    [[nodiscard]] bool do_is_equal(const memory_resource& other) const noexcept override {
        return this == &other;
    }
    // nullptr: error_ says why.
    void* map_file(std::size_t bytes);

    std::string folder_;
    mutable std::mutex mutex_;
    std::map<void*, std::size_t> mapped_;  // and their bytes
    Bytes bytes_;
    std::optional<Error> error_;
};

// Where arrays lie: there, or where there is none, in ordinary memory.
inline std::pmr::memory_resource* array_memory(ScratchMemory* scratch) {
    return scratch != nullptr ? scratch : std::pmr::new_delete_resource();
}

}  // namespace oro
