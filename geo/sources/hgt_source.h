// SRTM .hgt tiles: whole-degree squares of big-endian 16-bit heights, named by the centre of their south-west
// post.
#pragma once

#include <optional>
#include <string_view>

#include "core/base/result.h"
#include "geo/files/source_paths.h"
#include "geo/places/bounding_box.h"
#include "geo/sources/source.h"

namespace oro {

// What an .hgt's file name says: N46E008.hgt, N46E008.SRTMGL3.hgt, n46e008.hgt. Nothing when the name is not
// of that form.
struct HgtName {
    TileName tile;
    int arc_seconds{};  // 1 or 3 when the name states the product, else 0
};
std::optional<HgtName> parse_hgt_name(std::string_view file_name);

// Posts on a side of a tile with that many bytes: 1201, 3601 or 7201 (3, 1 and half a second of arc apart);
// nothing for other sizes.
std::optional<int> hgt_posts_of_size(std::uint64_t bytes);

// Looks at an .hgt's name alone: where it lies. Error: a name that does not say.
Result<HgtName> name_of_hgt(const SourcePath& path);
// Looks at its name and size; reads no heights. Errors: a size that is not 2 x 1201^2, 2 x 3601^2 or
// 2 x 7201^2 bytes, or not the one that the name states.
Result<Source> inspect_hgt(const SourcePath& path);
// Reads a window of its posts.
Result<PostBlock> read_hgt(const Source& source, const PostWindow& window);

}  // namespace oro
