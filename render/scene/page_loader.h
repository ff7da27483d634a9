// Pages on their way from their source to the GPU: read, decoded and built by threads in the background.
#pragma once

#include <cstddef>
#include <memory>

#include "core/cache/loader.h"
#include "core/frame/region_pages.h"
#include "render/scene/page_store.h"

namespace oro {

using PageLoader = Loader<PageIndex, LoadedPage>;

// `capacity`: pages that may be under way or ready at a time, at least 1; 80 KB each. `pages` outlives the
// loader. parts: pages come with these, too; means are 222 KB more, places 200 KB. packs: they come with
// packed heights. Errors of take(): a page that could not be read.
std::unique_ptr<PageLoader> page_loader(const RegionPages& pages, int threads, std::size_t capacity,
                                        const PageParts& parts = {}, bool packs = false);

}  // namespace oro
