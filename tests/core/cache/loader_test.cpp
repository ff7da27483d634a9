// Items that are loaded in the background: order, limits, cancelling, errors, and threads that end.
#include "core/cache/loader.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <new>
#include <numeric>
#include <random>
#include <set>
#include <string>

namespace oro {
namespace {

constexpr int too_large = 7000, unreadable = 8000;

// Numbers that load as themselves, and a count of how many do at a time.
class Loaders : public ::testing::Test {
  protected:
    using Numbers = Loader<int, int>;
    std::atomic<int> at_a_time_{0}, most_at_a_time_{0}, loaded_{0};

    std::unique_ptr<Numbers> loader(int threads, std::size_t capacity) {
        return std::make_unique<Numbers>(
            [this](const Numbers::Request& request) -> Result<int> {
                most_at_a_time_ = std::max(most_at_a_time_.load(), ++at_a_time_);
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
                --at_a_time_;
                ++loaded_;
                if (request.key == too_large) throw std::bad_alloc();
                if (request.key == unreadable) return Error{ErrorKind::failed, "made.oro", "damaged"};
                return request.key;
            },
            threads, capacity);
    }
    static std::vector<int> numbers(int first, int count) {
        std::vector<int> all(static_cast<std::size_t>(count));
        std::iota(all.begin(), all.end(), first);
        return all;
    }
};

// A load takes a millisecond: those that are under way may come, the queue may not.
TEST_F(Loaders, EndWithoutLoadingTheirQueue) {
    auto stream = loader(2, 500);
    stream->request(numbers(1, 500));
    while (loaded_ == 0) std::this_thread::yield();
    const int before = loaded_;
    stream.reset();
    EXPECT_LE(loaded_, before + 20);
}

TEST_F(Loaders, LoadWhatIsRequestedOnce) {
    const auto stream = loader(4, 3);
    stream->request(numbers(1, 12));
    std::set<int> came;
    while (came.size() < 12) {
        auto some = stream->take(true);
        ASSERT_TRUE(some.ok());
        ASSERT_FALSE(some->empty());
        EXPECT_LE(some->size(), 3U);
        for (const int number : *some) EXPECT_TRUE(came.insert(number).second) << "came twice";
    }
    EXPECT_EQ(loaded_, 12);
    EXPECT_LE(most_at_a_time_, 3);
    auto none = stream->take(true);
    ASSERT_TRUE(none.ok());
    EXPECT_TRUE(none->empty()) << "does not wait for what will never come";
}

// In a thread of its own it would end the program.
TEST_F(Loaders, ThrowToTheirCallerWhatAThreadThrew) {
    const auto stream = loader(2, 3);
    stream->request(numbers(too_large, 1));
    EXPECT_THROW((void)stream->take(true), std::bad_alloc);
    stream->request(numbers(1, 1));
    EXPECT_TRUE(stream->take(true).ok()) << "goes on afterwards";
}

TEST_F(Loaders, CancelWhatIsNoLongerRequested) {
    const auto stream = loader(1, 2);
    stream->request(numbers(1, 500));
    stream->request(numbers(1001, 3));
    for (int came = 0; came < 3;) {
        auto some = stream->take(true);
        ASSERT_TRUE(some.ok());
        for (const int number : *some) came += number > 1000 ? 1 : 0;
    }
    EXPECT_LE(loaded_, 3 + 3) << "at most what was under way besides";
    stream->request(numbers(1, 500));
    stream->cancel();
    while (!stream->take(true)->empty()) continue;
    EXPECT_LE(loaded_, 3 + 3 + 2);
}

TEST_F(Loaders, TellAnErrorOnceAndGoOn) {
    const auto stream = loader(2, 8);
    stream->request(numbers(unreadable, 1));
    const auto failed = stream->take(true);
    ASSERT_FALSE(failed.ok());
    EXPECT_EQ(failed.error().line(), "made.oro: damaged");
    stream->request(numbers(1, 2));
    for (std::size_t came = 0; came < 2;) {
        const auto some = stream->take(true);
        ASSERT_TRUE(some.ok());
        came += some->size();
    }
}

TEST_F(Loaders, EndWhileTheyAreBusy) {
    for (int i = 0; i < 20; ++i) {
        const auto stream = loader(3, 50);
        stream->request(numbers(10'000 + 1000 * i, 200));
        if (i % 2 == 0) {
            ASSERT_TRUE(stream->take(true).ok());
        }
    }
    EXPECT_LT(loaded_, 20 * 200);
}

// Without threads take() loads one thing a time, so that the order can be held against a list of what is to
// come. Some numbers lead to others while they are loaded.
TEST_F(Loaders, LoadInTheOrderOfPriorities) {
    constexpr unsigned seed = 484;
    std::mt19937 random(seed);
    using Numbered = Loader<int, int>;
    std::vector<Numbered::Request> to_come;
    std::set<int> known;
    const auto add = [&](const std::vector<int>& keys, int priority) {
        auto end = to_come.begin();
        while (end != to_come.end() && end->priority <= priority) ++end;
        std::vector<Numbered::Request> more;
        for (const int key : keys)
            if (!known.contains(key)) more.push_back({key, priority});
        to_come.insert(end, more.begin(), more.end());
    };
    std::unique_ptr<Numbered> stream;
    const auto load = [&](const Numbered::Request& request) -> Result<int> {
        if (request.key % 3 == 0)
            stream->add(std::vector{request.key + 1, request.key + 30}, request.priority);
        return request.key;
    };
    stream = std::make_unique<Numbered>(load, 0, 1);
    std::size_t taken = 0;
    for (int step = 0; step < 3000; ++step) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", step " + std::to_string(step));
        if (random() % 10 == 0) {
            std::vector<Numbered::Request> requests;
            for (int i = 0; i < 8; ++i)
                requests.push_back({static_cast<int>(random() % 100), static_cast<int>(random() % 3)});
            known.clear();
            to_come.clear();
            for (const auto& one : requests) add({one.key}, one.priority);
            stream->request(requests, random() % 2 == 0);
        }
        while (!to_come.empty() && known.contains(to_come.front().key)) to_come.erase(to_come.begin());
        std::vector<int> expected;
        if (!to_come.empty()) {
            const Numbered::Request next = to_come.front();
            to_come.erase(to_come.begin());
            expected = {next.key};
            known.insert(next.key);
            if (next.key % 3 == 0) add({next.key + 1, next.key + 30}, next.priority);
        }
        const auto some = stream->take(false);
        ASSERT_TRUE(some.ok());
        ASSERT_EQ(*some, expected);
        taken += some->size();
    }
    EXPECT_GT(taken, 1000U);
    std::printf("seed %u: %zu items in order\n", seed, taken);
}

}  // namespace
}  // namespace oro
