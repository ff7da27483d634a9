// orograph-bench-repeat: a region of thousands of tiles for benchmarks, made by repeating one. Links core
// alone.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>

#include "core/baked/bake.h"
#include "core/baked/file_pages.h"
#include "core/base/parallel.h"

namespace oro {
namespace {

// Every n-th post of a tile, over and over; the last row and column of each copy give way to the first of the
// next.
class RepeatedPosts : public PostSource {
  public:
    RepeatedPosts(HeightField tile, int every)
        : tile_(std::move(tile)),
          every_(every),
          rows_((tile_.grid.rows() - 1) / every),
          columns_((tile_.grid.columns() - 1) / every) {}
    [[nodiscard]] float H_m(int row, int column) const override {
        const int tile_row = row % rows_ * every_, tile_column = column % columns_ * every_;
        return tile_.H_m[static_cast<std::size_t>(tile_row) * static_cast<std::size_t>(tile_.grid.columns()) +
                         static_cast<std::size_t>(tile_column)];
    }
    // They are in memory.
    [[nodiscard]] Result<void> health() const override { return {}; }

  private:
    HeightField tile_;
    int every_;
    int rows_;
    int columns_;
};

// `down` x `across` copies, so that one of them, as near the middle as may be, lies where the tile lies.
HeightField repeated(HeightField tile, int down, int across, int every) {
    HeightField field;
    field.grid = tile.grid;
    const int rows = (tile.grid.rows() - 1) / every, columns = (tile.grid.columns() - 1) / every;
    field.grid.lat.posts_per_deg /= every;
    field.grid.lon.posts_per_deg /= every;
    field.grid.lat.first /= every;
    field.grid.lon.first /= every;
    const double room_deg = 89.0 - tile.grid.north_deg();
    const int above = std::min(down / 2, static_cast<int>(room_deg * field.grid.lat.posts_per_deg / rows));
    field.grid.lat.first += std::int64_t{above} * rows;
    field.grid.lon.first -= std::int64_t{across / 2} * columns;
    field.grid.lat.count = down * rows + 1;
    field.grid.lon.count = across * columns + 1;
    field.range = height_range(tile);
    field.posts = std::make_shared<RepeatedPosts>(std::move(tile), every);
    return field;
}

Result<void> run(const std::string& from, int down, int across, int every, const std::string& to) {
    ORO_TRY(const RegionFile file, RegionFile::open(from));
    ORO_TRY(HeightField tile, field_in_memory(file));
    if (tile.grid.net)
        return Error{ErrorKind::usage, from, "has posts in a CRS of their own; a tile of degrees is needed"};
    tile.undulation = {};
    if (file.outline().voids > 0)
        return Error{ErrorKind::failed, from, "has voids; a tile without any is needed"};
    const PostGrid& grid = tile.grid;
    if ((grid.rows() - 1) % every != 0 || (grid.columns() - 1) % every != 0 || grid.lat.first % every != 0 ||
        grid.lon.first % every != 0)
        return Error{ErrorKind::usage, "EVERY", "does not divide the tile"};
    const HeightField field = repeated(std::move(tile), down, across, every);
    RegionOutline outline;
    outline.grid = field.grid;
    const double diagonal_m = 1.5 * wgs84_a_m * radians_from_deg(field.grid.lat.spacing_deg()).rad;
    outline.shape = {occluder_below(std::min(0.0, static_cast<double>(field.range->lowest_m)), diagonal_m),
                     1.0};
    outline.lowest_H_m = field.range->lowest_m;
    outline.highest_H_m = field.range->highest_m;
    outline.triangles = std::uint64_t{2} * static_cast<std::uint64_t>(field.grid.rows() - 1) *
                        static_cast<std::uint64_t>(field.grid.columns() - 1);
    outline.description = "{}";
    BakeOptions options;
    options.path = to;
    options.overwrite = true;
    options.threads = thread_count(64);
    ORO_TRY(const BakeReport report, bake_region(field, outline, options));
    std::printf("%s: %d x %d tiles, %llu posts, %llu pages\n", to.c_str(), down, across,
                static_cast<unsigned long long>(field.grid.post_count()),
                static_cast<unsigned long long>(report.pages));
    return {};
}

}  // namespace
}  // namespace oro

int main(int argc, char** argv) {
    if (argc != 6) {
        std::fprintf(stderr,
                     "usage: orograph-bench-repeat TILE.oro ROWS COLUMNS EVERY OUT.oro\n"
                     "ROWS x COLUMNS copies of a tile, of every EVERYth of its posts along each side\n");
        return 2;
    }
    const int down = std::atoi(argv[2]), across = std::atoi(argv[3]), every = std::atoi(argv[4]);
    if (down < 1 || across < 1 || every < 1 || down > 170 || across > 359) {
        std::fprintf(stderr,
                     "orograph-bench-repeat: 1 to 170 rows and 1 to 359 columns of tiles, EVERY 1 or more\n");
        return 2;
    }
    const auto done = oro::run(argv[1], down, across, every, argv[5]);
    if (done.ok()) return 0;
    std::fprintf(stderr, "orograph-bench-repeat: %s\n", done.error().line().c_str());
    return static_cast<int>(done.error().kind);
}
