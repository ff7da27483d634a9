// Slots for clusters.
#include "render/clusters/cluster_store.h"

#include <memory>

#include "tests/support/gpu_fixture.h"

namespace oro {
namespace {

class ClustersOnGpu : public test::GpuTest {
  protected:
    static void send(ClusterStore& store, std::uint32_t first, std::uint32_t count) {
        const auto block = std::make_unique<gpu::ClusterBlock>();
        std::vector<ClusterStore::Loaded> loaded;
        for (std::uint32_t i = first; i < first + count; ++i) loaded.push_back({i, 0, block.get()});
        ASSERT_TRUE(store.send(loaded).ok());
    }
    static std::vector<std::uint32_t> here(const ClusterStore& store) {
        std::vector<std::uint32_t> numbers;
        for (std::uint32_t i = 0; i < 20; ++i)
            if (store.is_here(i)) numbers.push_back(i);
        return numbers;
    }
};

// ... then those unused for longest; what the frame uses stays.
TEST_F(ClustersOnGpu, EvictHiddenOnesFirst) {
    ClusterStore store(*gpu_, 6 * sizeof(gpu::ClusterBlock));
    for (std::uint32_t i = 0; i < 6; ++i) {
        store.begin_frame();
        send(store, i, 1);
    }
    for (const std::uint32_t cluster : {2U, 4U, 5U, 19U}) store.mark_occluded(cluster, true);
    store.mark_occluded(4, false);
    store.begin_frame();
    store.use(2);
    send(store, 10, 1);
    EXPECT_EQ(here(store), (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 10}));
    send(store, 11, 1);
    EXPECT_EQ(here(store), (std::vector<std::uint32_t>{1, 2, 3, 4, 10, 11}));
    store.begin_frame();
    send(store, 12, 2);
    EXPECT_EQ(here(store), (std::vector<std::uint32_t>{3, 4, 10, 11, 12, 13}));
}

}  // namespace
}  // namespace oro
