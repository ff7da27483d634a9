#include "render/scene/page_store.h"

#include "core/made_pages/page_sources.h"
#include "core/packed/packed_heights.h"

namespace oro {

std::unique_ptr<PageLoader> page_loader(const RegionPages& pages, int threads, std::size_t capacity,
                                        const PageParts& parts, bool packs, bool with_sources) {
    std::shared_ptr<const PageSources> sources;
    if (with_sources)
        sources = std::make_shared<const PageSources>(pages.facts().grid, pages.facts().undulation,
                                                      *pages.made_ground());
    const auto load = [&pages, parts, packs,
                       sources](const PageLoader::Request& request) -> Result<LoadedPage> {
        const PageIndex& page = request.key;
        LoadedPage loaded{page, std::make_unique<gpu::PageBlock>(), nullptr, nullptr, false};
        if (sources) {
            ORO_CHECK(pages.load_without_heights(page, *loaded.block));
            loaded.source = std::make_unique<gpu::MadePageSource>();
            sources->set(page, *loaded.source);
        } else {
            ORO_CHECK(pages.load(page, *loaded.block));
        }
        if (parts.means) {
            loaded.means = std::make_unique<gpu::PageMeans>();
            ORO_CHECK(pages.load_means(page, *loaded.means));
        }
        if (parts.places) {
            loaded.places = std::make_unique<gpu::PagePlaces>();
            ORO_CHECK(pages.load_places(page, *loaded.block, *loaded.places));
        }
        if (pages.has_meshes()) {
            ORO_CHECK(pages.load_words(page, loaded.heights));
        } else if (packs) {
            loaded.heights = packed_heights(loaded.block->heights, pages.facts().shape.exaggeration);
        }
        return loaded;
    };
    return std::make_unique<PageLoader>(load, threads, capacity);
}

}  // namespace oro
