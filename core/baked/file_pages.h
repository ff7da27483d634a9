// A region file as pages to draw and as posts to ask.
#pragma once

#include <memory>

#include "core/baked/region_file.h"
#include "core/frame/region_pages.h"
#include "core/terrain/post_grid.h"

namespace oro {

// The pages of a region file, read when they are asked for.
std::unique_ptr<RegionPages> pages_of_file(std::shared_ptr<const RegionFile> file);

// The surface of a region file, to the bit the one that was baked: its posts are read page by page when they
// are asked for, and up to memory_bytes of them are kept (at least some pages). A page that cannot be read is
// void, and told by the field's health().
HeightField field_of_file(std::shared_ptr<const RegionFile> file, std::size_t memory_bytes);

// The same with all posts in memory: for what goes through every one of them. Errors: damage.
Result<HeightField> field_in_memory(const RegionFile& file);

}  // namespace oro
