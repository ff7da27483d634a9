#include "geo/posts/tiles_ahead.h"

#include <algorithm>
#include <new>
#include <system_error>

#include "core/base/parallel.h"

namespace oro {
namespace {

Result<SourceOnGrid> placed_and_read(const Source& source, const PostGrid& grid, int turn) {
    ORO_TRY(SourceOnGrid placed, SourceOnGrid::create(source, grid, turn));
    const GridRect& rect = placed.rect();
    if (rect.rows > 0 && rect.columns > 0) ORO_CHECK(placed.read(rect.first_row, rect.rows));
    return placed;
}

}  // namespace

TilesAhead::TilesAhead(const PostGrid& grid)
    : grid_(&grid), most_(static_cast<std::size_t>(std::clamp(thread_count() - 1, 1, 4))) {}

bool TilesAhead::has_room() const {
    return tiles_.size() < most_;
}

void TilesAhead::begin(const Source& source, int turn) {
    if (source.kind != SourceKind::hgt) return;
    const auto read = [&source, grid = grid_, turn] { return placed_and_read(source, *grid, turn); };
    try {
        tiles_.push_back({&source, turn, std::async(std::launch::async, read)});
    } catch (const std::system_error&) {
    } catch (const std::bad_alloc&) {
    }
}

std::optional<Result<SourceOnGrid>> TilesAhead::take(const Source& source, int turn) {
    const auto tile = std::ranges::find_if(
        tiles_, [&](const Tile& begun) { return begun.source == &source && begun.turn == turn; });
    if (tile == tiles_.end()) return std::nullopt;
    Result<SourceOnGrid> placed = tile->read.get();
    tiles_.erase(tile);
    return placed;
}

}  // namespace oro
