// Allocations and threads that fail by plan.
#include <dlfcn.h>
#include <pthread.h>

#include <cerrno>
#include <cstddef>
#include <cstdlib>

#include "tests/faults/injection.h"

extern "C" {

// glibc's own, under the names that they keep for libraries like this one.
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

void* malloc(std::size_t size) noexcept {
    if (oro::faults::must_fail(oro::faults::Calls::allocation, __builtin_return_address(0))) {
        errno = ENOMEM;
        return nullptr;
    }
    return __libc_malloc(size);
}

void* calloc(std::size_t count, std::size_t size) noexcept {
    if (oro::faults::must_fail(oro::faults::Calls::allocation, __builtin_return_address(0))) {
        errno = ENOMEM;
        return nullptr;
    }
    return __libc_calloc(count, size);
}

void* realloc(void* old, std::size_t size) noexcept {
    if (size > 0 && oro::faults::must_fail(oro::faults::Calls::allocation, __builtin_return_address(0))) {
        errno = ENOMEM;
        return nullptr;
    }
    return __libc_realloc(old, size);
}

void* memalign(std::size_t alignment, std::size_t size) noexcept {
    if (oro::faults::must_fail(oro::faults::Calls::allocation, __builtin_return_address(0))) {
        errno = ENOMEM;
        return nullptr;
    }
    return __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
    if (oro::faults::must_fail(oro::faults::Calls::allocation, __builtin_return_address(0))) {
        errno = ENOMEM;
        return nullptr;
    }
    return __libc_memalign(alignment, size);
}

int posix_memalign(void** memory, std::size_t alignment, std::size_t size) noexcept {
    if (oro::faults::must_fail(oro::faults::Calls::allocation, __builtin_return_address(0))) return ENOMEM;
    *memory = __libc_memalign(alignment, size);
    return *memory ? 0 : ENOMEM;
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*work)(void*),
                   void* argument) noexcept {
    using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
    static const auto create = reinterpret_cast<Create>(dlsym(RTLD_NEXT, "pthread_create"));
    if (oro::faults::must_fail(oro::faults::Calls::thread, __builtin_return_address(0))) return EAGAIN;
    return create(thread, attributes, work, argument);
}

// With FAULT_PROCESSORS: as if there were so many, so that runs are alike on all machines.
int get_nprocs() noexcept {
    using Count = int (*)();
    if (const char* count = std::getenv("FAULT_PROCESSORS")) return std::atoi(count);
    static const auto real = reinterpret_cast<Count>(dlsym(RTLD_NEXT, "get_nprocs"));
    return real();
}

}  // extern "C"
