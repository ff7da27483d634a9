// A cache's bookkeeping: none over another, the least recently used is evicted first, nothing of a frame in
// flight.
#include "core/cache/gpu_cache.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <tuple>

namespace oro::test {
struct ItemWithHash {
    int number{};
    bool operator==(const ItemWithHash&) const = default;
};
}  // namespace oro::test
template <>
struct std::hash<oro::test::ItemWithHash> {
    std::size_t operator()(const oro::test::ItemWithHash& item) const noexcept {
        return static_cast<std::size_t>(item.number % 7);
    }
};

namespace oro {
namespace {

using Cache = GpuCache<std::uint32_t>;

std::unique_ptr<Cache> cache_of(std::size_t bytes) {
    auto cache = std::make_unique<Cache>(std::make_shared<MemoryBudget>(bytes));
    cache->add_bin(bytes);
    return cache;
}

std::vector<std::uint32_t> keys_of(const Cache& cache) {
    std::vector<std::uint32_t> keys;
    cache.for_each([&](const Cache::Slot& slot) { keys.push_back(slot.key); });
    std::ranges::sort(keys);
    return keys;
}

TEST(GpuCache, EvictsTheLowestRankThenTheLeastRecentlyUsed) {
    const auto cache = cache_of(60);
    for (std::uint32_t i = 0; i < 6; ++i) {
        cache->begin_frame();
        cache->set_rank(cache->insert(i, 10), i == 4 || i == 2 ? 0 : 1);
    }
    cache->begin_frame();
    cache->use(cache->find(2));
    cache->use(cache->find(1));
    EXPECT_EQ(cache->fitting(10), 4U);
    cache->evict(10, 10);
    EXPECT_EQ(keys_of(*cache), (std::vector<std::uint32_t>{0, 1, 2, 3, 5, 10}));
    cache->use(cache->find(0));  // after the order was found
    cache->evict(11, 10);
    EXPECT_EQ(keys_of(*cache), (std::vector<std::uint32_t>{0, 1, 2, 5, 10, 11}));
    cache->evict(12, 10);
    EXPECT_EQ(cache->evict(13, 10), Cache::none) << "the frame uses all";
}

// 50 bytes take those of the two of 30 that lie beside each other and have not been shown longest.
TEST(GpuCache, EvictsNeighboursForALargeItem) {
    const auto cache = cache_of(150);
    for (std::uint32_t i = 0; i < 5; ++i) cache->insert(i, 30);
    for (const std::uint32_t i : {2U, 4U, 1U, 0U, 3U}) {  // each a frame later
        cache->begin_frame();
        cache->use(cache->find(i));
        cache->set_rank(cache->find(i), cache->frame());
    }
    EXPECT_EQ(cache->fitting(30), 4U) << "the frame uses 3";
    EXPECT_EQ(cache->fitting(50), 1U);
    EXPECT_EQ(cache->evict(9, 100), Cache::none) << "90 bytes before the one in use";
    EXPECT_EQ(cache->evict(9, 50, 64), Cache::none) << "all were shown in the last 64 frames";
    EXPECT_EQ(cache->at(cache->evict(5, 50)).offset, 30U) << "1 and 2 were shown last before 0";
    EXPECT_EQ(keys_of(*cache), (std::vector<std::uint32_t>{0, 3, 4, 5}));
    EXPECT_TRUE(cache->has_free(10));
}

TEST(GpuCache, WaitsForFramesInFlight) {
    const auto cache = cache_of(20);
    cache->begin_frame(10, 0);
    cache->insert(0, 10);
    cache->begin_frame(11, 0);
    cache->insert(1, 10);
    cache->begin_frame(12, 9);
    EXPECT_EQ(cache->evict(2, 10), Cache::none) << "10 and 11 are in flight";
    cache->erase(1);
    EXPECT_EQ(cache->insert(2, 10), Cache::none) << "11 still reads what was erased";
    EXPECT_FALSE(cache->has_free(10));
    EXPECT_EQ(cache->fitting(10), 0U);
    EXPECT_EQ(cache->release_unused(), (std::vector<bool>{true}));
    cache->begin_frame(13, 10);
    EXPECT_EQ(cache->insert(2, 10), Cache::none);
    EXPECT_EQ(cache->at(cache->evict(2, 10)).offset, 0U);
    cache->begin_frame(14, 11);
    EXPECT_EQ(cache->at(cache->insert(3, 10)).offset, 10U);
}

TEST(GpuCache, ReleasesWholeBinsToItsBudget) {
    const auto budget = std::make_shared<MemoryBudget>(200);
    Cache cache(budget);
    for (std::uint32_t i = 0; i < 3; ++i) {
        cache.add_bin(60);
        for (const std::uint32_t key : {2 * i, 2 * i + 1}) cache.insert(key, 30);
    }
    EXPECT_EQ(budget->left(), 20U);
    EXPECT_EQ(cache.release_unused(), (std::vector<bool>{true, true, true}));
    cache.begin_frame();
    cache.use(cache.find(3));
    EXPECT_EQ(cache.release_unused(), (std::vector<bool>{false, true, false}));
    EXPECT_EQ(budget->left(), 140U);
    EXPECT_EQ(keys_of(cache), (std::vector<std::uint32_t>{2, 3}));
    EXPECT_EQ(cache.at(cache.find(3)).bin, 0U) << "numbered anew";
    EXPECT_EQ(cache.at(cache.find(3)).offset, 30U);
    const Cache other = std::move(cache);
    EXPECT_EQ(budget->left(), 140U);
}

// The same by looking at each byte of each bin.
struct Model {
    struct Byte {
        int owner{-1};
        std::uint64_t used{};
    };
    struct Piece {
        std::size_t bin, begin, end;
        int owner;
    };
    using Place = std::pair<std::size_t, std::size_t>;  // bin, offset

    std::vector<std::vector<Byte>> bins;
    std::vector<std::uint64_t> rank;  // by item
    std::uint64_t frame{1}, completed{0};

    [[nodiscard]] std::vector<Piece> pieces() const {
        std::vector<Piece> all;
        for (std::size_t bin = 0; bin < bins.size(); ++bin)
            for (std::size_t at = 0; at < bins[bin].size(); ++at)
                if (at == 0 || bins[bin][at].owner != bins[bin][at - 1].owner)
                    all.push_back({bin, at, at + 1, bins[bin][at].owner});
                else
                    all.back().end = at + 1;
        return all;
    }
    [[nodiscard]] std::uint64_t used(const Piece& piece) const {
        std::uint64_t last = 0;
        for (std::size_t at = piece.begin; at < piece.end; ++at)
            last = std::max(last, bins[piece.bin][at].used);
        return last;
    }
    [[nodiscard]] bool may_go(const Piece& piece, std::uint64_t spared) const {
        if (used(piece) > completed) return false;
        const std::uint64_t shown = piece.owner < 0 ? 0 : rank[static_cast<std::size_t>(piece.owner)];
        return spared == 0 || shown == 0 || shown + spared < frame;
    }
    void put(const Place& place, int owner, std::size_t bytes) {
        for (std::size_t at = place.second; at < place.second + bytes; ++at) {
            EXPECT_EQ(bins[place.first][at].owner, -1);
            EXPECT_LE(bins[place.first][at].used, completed) << "a frame in flight reads it";
            bins[place.first][at] = {owner, frame};
        }
        rank[static_cast<std::size_t>(owner)] = 0;
    }
    void erase(int owner) {
        for (auto& bin : bins)
            for (Byte& byte : bin)
                if (byte.owner == owner) byte.owner = -1;
    }
    std::optional<Place> insert(int owner, std::size_t bytes) {
        for (const Piece& piece : pieces()) {
            if (piece.owner >= 0 || piece.end - piece.begin < bytes || used(piece) > completed) continue;
            put({piece.bin, piece.begin}, owner, bytes);
            return Place(piece.bin, piece.begin);
        }
        return std::nullopt;
    }
    std::optional<Place> evict(int owner, std::size_t bytes, std::uint64_t spared) {
        const std::vector<Piece> all = pieces();
        std::optional<std::tuple<std::uint64_t, std::uint64_t, std::size_t, std::size_t>> best;
        for (std::size_t first = 0; first < all.size(); ++first) {
            std::pair<std::uint64_t, std::uint64_t> age{0, 0};
            std::size_t end = first;
            for (; end < all.size() && all[end].bin == all[first].bin && may_go(all[end], spared); ++end) {
                if (all[end].owner >= 0)
                    age = std::max(age, {rank[static_cast<std::size_t>(all[end].owner)], used(all[end])});
                if (all[end].end - all[first].begin < bytes) continue;
                const std::tuple run(age.first, age.second, first, end + 1);
                if (!best || run < *best) best = run;
                break;
            }
        }
        if (!best) return std::nullopt;
        const auto [highest, last, first, end] = *best;
        for (std::size_t i = first; i < end; ++i)
            if (all[i].owner >= 0) erase(all[i].owner);
        put({all[first].bin, all[first].begin}, owner, bytes);
        return Place(all[first].bin, all[first].begin);
    }
    [[nodiscard]] std::size_t fitting(std::size_t bytes) const {
        std::size_t count = 0, length = 0, bin = 0;
        for (const Piece& piece : pieces()) {
            if (piece.bin != std::exchange(bin, piece.bin)) count += std::exchange(length, 0) / bytes;
            if (may_go(piece, 0))
                length += piece.end - piece.begin;
            else
                count += std::exchange(length, 0) / bytes;
        }
        return count + length / bytes;
    }
    void release_unused() {
        std::erase_if(bins, [&](const auto& bin) {
            return std::ranges::all_of(bin, [&](const Byte& byte) { return byte.used <= completed; });
        });
    }
};

// Each item of the cache is where the model has it, nothing else is in the cache, and the budget is kept.
template <class Key, class KeyOf>
void expect_as_in_model(const GpuCache<Key>& cache, const MemoryBudget& budget, const Model& model,
                        const KeyOf& key_of, int step) {
    std::size_t size = 0, held = 0;
    for (const Model::Piece& piece : model.pieces()) {
        if (piece.owner < 0) continue;
        ++size;
        const auto handle = cache.find(key_of(piece.owner));
        ASSERT_NE(handle, cache.none) << "step " << step;
        const auto& slot = cache.at(handle);
        ASSERT_EQ(std::tuple(slot.bin, slot.offset, slot.offset + slot.bytes),
                  std::tuple(piece.bin, piece.begin, piece.end));
    }
    for (const auto& bin : model.bins) held += bin.size();
    ASSERT_EQ(cache.size(), size);
    ASSERT_EQ(budget.left(), budget.bytes() - held) << "the budget is kept";
}

// Now and then a next frame begins, a bin is added, and what is unused or all is released.
template <class Key>
void change_frame_or_bins(GpuCache<Key>& cache, const MemoryBudget& budget, Model& model,
                          std::mt19937& random) {
    if (random() % 6 == 0) {
        const std::uint64_t last = std::exchange(model.frame, model.frame + 1 + random() % 2);
        model.completed = std::max(model.completed, last - std::min<std::uint64_t>(last, random() % 4));
        cache.begin_frame(model.frame, model.completed);
    }
    if (const std::size_t bytes = 20 + random() % 40; random() % 50 == 0 && budget.left() >= bytes) {
        cache.add_bin(bytes);
        model.bins.emplace_back(bytes);
    }
    if (random() % 200 == 0) {
        cache.release_unused();
        model.release_unused();
    }
    if (random() % 500 == 0) {
        cache.clear();
        for (std::size_t i = 0; i < model.rank.size(); ++i) model.erase(static_cast<int>(i));
    }
}

// Random use by frames of which up to three are in flight. most_bytes: of an item; 0: all take 7.
template <class Key, class KeyOf>
void follow_model(unsigned seed, std::size_t most_bytes, const KeyOf& key_of) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    constexpr int items = 40, steps = 3000;
    std::mt19937 random(seed);
    const auto budget = std::make_shared<MemoryBudget>(170);
    GpuCache<Key> cache(budget);
    Model model;
    model.rank.resize(items);
    int placed = 0, evicted = 0, refused = 0;
    for (int step = 0; step < steps && !testing::Test::HasFailure(); ++step) {
        change_frame_or_bins(cache, *budget, model, random);
        const int item = static_cast<int>(random() % items);
        const Key key = key_of(item);
        const std::size_t bytes = most_bytes == 0 ? 7 : 1 + random() % most_bytes;
        if (const auto here = cache.find(key); here != cache.none && random() % 4 == 0) {
            cache.erase(key);
            model.erase(item);
        } else if (here != cache.none) {
            cache.use(here);
            for (auto& bin : model.bins)
                for (Model::Byte& byte : bin)
                    if (byte.owner == item) byte.used = model.frame;
            model.rank[static_cast<std::size_t>(item)] = random() % 2 ? model.frame : random() % 3;
            cache.set_rank(here, model.rank[static_cast<std::size_t>(item)]);
        } else {
            const std::uint64_t spared = random() % 3 ? 0 : 5;
            auto handle = cache.insert(key, bytes);
            auto place = model.insert(item, bytes);
            if (handle == cache.none) {
                handle = cache.evict(key, bytes, spared);
                ASSERT_FALSE(place);
                place = model.evict(item, bytes, spared);
                ++(place ? evicted : refused);
            } else {
                ++placed;
            }
            ASSERT_EQ(handle != cache.none, place.has_value()) << "step " << step;
            if (place) {
                ASSERT_EQ(Model::Place(cache.at(handle).bin, cache.at(handle).offset), *place)
                    << "step " << step;
            }
        }
        expect_as_in_model(cache, *budget, model, key_of, step);
        ASSERT_EQ(cache.fitting(bytes), model.fitting(bytes));
    }
    EXPECT_GT(placed, 200);
    EXPECT_GT(evicted, 200);
    EXPECT_GT(refused, 50);
    std::printf("seed %u: %d placed, %d by eviction, %d refused\n", seed, placed, evicted, refused);
}

TEST(GpuCache, IsThatOfAModelOfBytes) {
    for (const unsigned seed : {481U, 482U, 483U}) {
        const auto number = [](int item) { return static_cast<std::uint32_t>(item); };
        follow_model<std::uint32_t>(seed, 0, number);
        follow_model<std::pair<int, int>>(seed, 14, [](int item) { return std::pair(item % 5, item / 5); });
        follow_model<test::ItemWithHash>(seed, 14, [](int item) { return test::ItemWithHash{item}; });
    }
}

}  // namespace
}  // namespace oro
