// The next tiles of a region, read while the one before them is laid into it.
#pragma once

#include <deque>
#include <future>
#include <optional>

#include "core/base/result.h"
#include "geo/posts/source_sampling.h"
#include "geo/sources/source.h"

namespace oro {

// Threads that read .hgt tiles ahead, each a whole tile (at most 207 MB of heights). Other formats are read
// when they are laid: their files may be of any size. Where no thread is to be had, nothing is read ahead.
class TilesAhead {
  public:
    // The grid outlives this; so do sources that are given to begin().
    explicit TilesAhead(const PostGrid& grid);

    // True while another tile may be begun.
    [[nodiscard]] bool has_room() const;
    // Begins to read what the grid needs of a source, moved by whole turns. Does nothing for what is no tile.
    void begin(const Source& source, int turn);
    // A source with all its posts read, if it was begun. Errors: as SourceOnGrid's.
    std::optional<Result<SourceOnGrid>> take(const Source& source, int turn);

  private:
    struct Tile {
        const Source* source;
        int turn;
        std::future<Result<SourceOnGrid>> read;
    };
    const PostGrid* grid_;
    std::size_t most_;
    std::deque<Tile> tiles_;
};

}  // namespace oro
