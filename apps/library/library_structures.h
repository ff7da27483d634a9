// The structures of the library's callers, as the program's own.
#pragma once

#include <string>
#include <vector>

#include "apps/eye/standpoint.h"
#include "apps/library/orograph.h"
#include "core/base/result.h"
#include "core/earth/world_model.h"
#include "core/terrain/grid_part.h"
#include "geo/region/region.h"

namespace oro {

// A point as options would say it. `name` is what errors call it. Errors (usage): a place that is none, a
// height that is no number, an `above` that is none.
Result<Standing> standing_at(const char* name, const oro_point& point, bool on_summit);

// The air of an ORO_AIR_... Errors (usage): none of them, a coefficient of refraction beyond its limits.
Result<Air> air_of(int air, double refraction_k);

// Strings of a caller. Errors (usage): NULL, one that is NULL, more than 10,000,000.
Result<std::vector<std::string>> strings_of(const char* name, const char* const* texts, std::size_t count);

// Errors (usage): NULL, a structure that is too short.
Result<void> check_window(const oro_window* window);
// Where a part of a grid's posts lies. Nothing is known or seen of it yet.
void fill_window(std::size_t grid_number, const RegionGrid& grid, const GridPart& part, oro_window& window);

// A text with a zero byte at its end, where the caller has room for it; else throws TooSmall. *length becomes
// the text's. NULL and 0 ask for the length alone.
Result<void> give_text(const std::string& from, char* text, std::size_t capacity, std::size_t* length);

}  // namespace oro
