// Shared work when there is no memory for it, and when there are no threads.
#include "core/base/parallel.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <new>
#include <vector>

namespace {
using oro::in_parallel;

TEST(Parallel, DoesEachPartOnce) {
    std::vector<std::atomic<int>> done(1000);
    in_parallel(1000, 8, [&](int i) { ++done[static_cast<std::size_t>(i)]; });
    for (const auto& times : done) EXPECT_EQ(times, 1);
}

// Thrown in a thread of its own it would end the program.
TEST(Parallel, GivesTheCallerWhatAThreadThrows) {
    for (const int threads : {1, 2, 8}) {
        std::atomic<int> done{0};
        EXPECT_THROW(in_parallel(1000, threads,
                                 [&](int i) {
                                     ++done;
                                     if (i == 20) throw std::bad_alloc();
                                 }),
                     std::bad_alloc);
        EXPECT_GE(done, 21);
    }
}

TEST(Parallel, GoesOnWithTheThreadsThatThereAre) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "a sanitizer needs address space of its own";
#endif
    const pid_t child = fork();
    if (child == 0) {
        // No address space is left for another stack.
        const rlimit none{1, 1};
        if (setrlimit(RLIMIT_AS, &none) != 0) _exit(2);
        std::atomic<int> sum{0};
        in_parallel(100, 8, [&](int i) { sum += i; });
        _exit(sum == 4950 ? 0 : 1);
    }
    int status = -1;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status)) << "a signal ended it";
    EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace
