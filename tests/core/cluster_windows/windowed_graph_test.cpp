// A region baked window by window: the bytes of one go, whatever the windows, and after any break.
#include "core/cluster_windows/windowed_graph.h"

#include <cstdio>

#include "tests/core/cluster_file/made_cluster_file.h"

namespace oro {
namespace {

using namespace test;

class WindowedGraph : public ::testing::Test {
  protected:
    const fs::path folder_ = scratch_folder();
    const fs::path path_ = folder_ / "region.clusters";

    static WindowedBake how(const fs::path& path, int levels, std::size_t posts, int threads = 2) {
        WindowedBake bake;
        bake.path = path;
        bake.fingerprint = cluster_fingerprint;
        bake.overwrite = true;
        bake.threads = threads;
        bake.stages = {{levels, posts}};
        return bake;
    }
    std::string in_one_go(const ClusterTerrain& terrain) const {
        const fs::path whole = folder_ / "whole.clusters";
        EXPECT_TRUE(
            write_cluster_graph(whole, terrain.graph, posts_of(terrain), cluster_fingerprint, true).ok());
        return bytes_of(whole);
    }
    std::string in_windows(const HeightField& field, const WindowedBake& bake) const {
        const auto done = bake_in_windows(field, bake);
        EXPECT_TRUE(done.ok()) << done.error().line();
        return done.ok() ? bytes_of(bake.path) : "";
    }
    std::size_t files() const {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
    }
};

// The more levels, the farther a window reaches, and the larger a region has to be for several of them.
TEST_F(WindowedGraph, HasTheBytesOfOneGo) {
    const auto hold = [&](HeightField field, const std::vector<WindowSizes>& sizes) {
        const ClusterTerrain terrain(std::move(field));
        const std::string whole = in_one_go(terrain);
        for (const WindowSizes& one : sizes) {
            const WindowedBake bake = how(path_, one.levels, one.posts);
            const std::size_t windows =
                windows_of(terrain.heights.rows, terrain.heights.columns, bake.stages.front()).size();
            EXPECT_GT(windows, 2U);
            EXPECT_TRUE(in_windows(terrain.field, bake) == whole)
                << one.levels << " levels, " << windows << " windows, " << terrain.heights.rows << " rows";
            EXPECT_EQ(files(), 2U) << "windows are gone";
        }
    };
    hold(holed_field(340, 410, 5), {{2, 60'000}, {3, 70'000}});
    hold(holed_field(420, 500, 5), {{4, 100'000}});
    hold(rough_field(47.0, 8.0, 340, 400), {{2, 60'000}, {3, 70'000}});
    hold(rough_field(47.0, 8.0, 400, 520), {{4, 100'000}});
}

// Windows over what other windows have left.
TEST_F(WindowedGraph, HasTheBytesOfOneGoInStages) {
    for (const bool holes : {false, true}) {
        const ClusterTerrain terrain(holes ? holed_field(300, 420, 5) : rough_field(47.0, 8.0, 320, 400));
        const std::string whole = in_one_go(terrain);
        for (const std::vector<WindowSizes>& stages :
             {std::vector<WindowSizes>{{1, 40'000}, {2, 70'000}}, {{2, 40'000}, {3, 60'000}, {5, 110'000}}}) {
            WindowedBake bake = how(path_, 2, 40'000);
            bake.stages = stages;
            EXPECT_TRUE(in_windows(terrain.field, bake) == whole)
                << stages.size() << " stages up to level " << stages.back().levels << ", holes " << holes;
            EXPECT_EQ(files(), 2U) << "windows are gone";
        }
    }
}

// Windows that several machines have built, of the first stage.
TEST_F(WindowedGraph, HasTheBytesOfOneGoFromParts) {
    const ClusterTerrain terrain(rough_field(47.0, 8.0, 320, 400));
    const std::string whole = in_one_go(terrain);
    WindowedBake bake = how(path_, 1, 40'000);
    bake.stages = {{1, 40'000}, {2, 70'000}};
    WindowSizes first = bake.stages.front();
    const std::size_t windows = windows_of(terrain.heights.rows, terrain.heights.columns, first).size();
    ASSERT_GT(windows, 2U);
    std::size_t built = 0;
    for (std::size_t number = 1; number <= 3; ++number) {
        const auto part = bake_windows_of_part(terrain.field, bake, number, 3);
        ASSERT_TRUE(part.ok()) << part.error().line();
        built += *part;
    }
    EXPECT_EQ(built, windows);
    EXPECT_EQ(files(), 1U + windows) << "the whole and all windows";
    const auto times = [&] {
        std::vector<fs::file_time_type> all;
        for (std::size_t i = 0; i < windows; ++i)
            all.push_back(fs::last_write_time(path_of_window(bake.path, i)));
        return all;
    };
    const auto before = times();
    // They are taken: nothing is built again.
    ASSERT_TRUE(bake_windows_of_part(terrain.field, bake, 1, 1).ok());
    EXPECT_EQ(times(), before);
    EXPECT_TRUE(in_windows(terrain.field, bake) == whole);
    EXPECT_EQ(files(), 2U) << "windows are gone";
}

// Flat ground, where groups go on as long as moves cost nothing.
TEST_F(WindowedGraph, HasTheBytesOfOneGoOverASea) {
    const ClusterTerrain terrain(coast_field(420, 560));
    const std::string whole = in_one_go(terrain);
    for (const std::vector<WindowSizes>& stages :
         {std::vector<WindowSizes>{{3, 70'000}}, {{2, 40'000}, {4, 90'000}}}) {
        WindowedBake bake = how(path_, 2, 40'000);
        bake.stages = stages;
        EXPECT_TRUE(in_windows(terrain.field, bake) == whole) << stages.size() << " stages";
        EXPECT_EQ(files(), 2U) << "windows are gone";
    }
}

// On an island in a wide sea of voids the first levels are one group sooner than their lines say.
TEST_F(WindowedGraph, HasTheBytesOfOneGoWhereThereIsLittleGround) {
    HeightField field = rough_field(47.0, 8.0, 300, 400);
    for (int row = 0; row < 300; ++row)
        for (int column = 0; column < 400; ++column)
            if (row < 100 || row > 140 || column < 180 || column > 220)
                field.H_m[static_cast<std::size_t>(row) * 400 + static_cast<std::size_t>(column)] =
                    void_height_m;
    const ClusterTerrain terrain(std::move(field));
    const std::string whole = in_one_go(terrain);
    EXPECT_TRUE(in_windows(terrain.field, how(path_, 4, 60'000)) == whole);
    EXPECT_EQ(files(), 2U);
}

// What is there is taken, what is damaged is built again.
TEST_F(WindowedGraph, GoesOnAfterABreak) {
    const ClusterTerrain terrain(rough_field(47.0, 8.0, 400, 300));
    const std::string whole = in_one_go(terrain);
    WindowedBake bake = how(path_, 3, 50'000, 1);
    const std::size_t windows =
        windows_of(terrain.heights.rows, terrain.heights.columns, bake.stages.front()).size();
    ASSERT_GT(windows, 2U);
    for (std::size_t stop = 1; stop <= windows; ++stop) {
        struct Broken {};
        std::size_t begun = 0;
        bake.progress = [&](double) {
            if (begun++ == stop) throw Broken{};
        };
        if (stop < windows) {
            EXPECT_THROW((void)bake_in_windows(terrain.field, bake), Broken);
        }
        if (stop == 2) {
            std::string bytes = bytes_of(path_of_window(path_, 0));
            bytes[bytes.size() - 5] = static_cast<char>(bytes[bytes.size() - 5] ^ 1);
            put_bytes(path_of_window(path_, 0), bytes);
        }
    }
    bake.progress = {};
    EXPECT_TRUE(in_windows(terrain.field, bake) == whole);
}

// Windows cover the region once by what they own, and reach beyond it.
TEST_F(WindowedGraph, WindowsOwnEachPostOnce) {
    for (const auto& [rows, columns] : {std::pair{400, 520}, {1201, 3601}, {2, 5000}, {9000, 7000}}) {
        const WindowSizes sizes{4, 150'000};
        std::int64_t owned = 0;
        for (const RegionWindow& window : windows_of(rows, columns, sizes)) {
            owned += (window.own.last_row - window.own.first_row + 1) *
                     (window.own.last_column - window.own.first_column + 1);
            EXPECT_LE(window.window.first_row, window.own.first_row);
            EXPECT_GE(window.window.first_row + window.rows - 1, window.own.last_row);
            EXPECT_EQ(window.window.north_open, window.window.first_row > 0);
            EXPECT_EQ(window.window.south_open, window.window.first_row + window.rows < rows);
            EXPECT_EQ(window.window.first_row % leaf_side, 0);
            EXPECT_EQ(window.window.first_column % leaf_side, 0);
        }
        EXPECT_EQ(owned, std::int64_t{rows} * columns);
    }
}

}  // namespace
}  // namespace oro
