// The pages of a region, wherever they come from: what is known of each, and the block that the GPU gets of
// it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/lod/data_means.h"
#include "core/lod/pyramid.h"
#include "core/terrain/page.h"
#include "core/terrain/post_grid.h"

namespace oro {

// What holds for a region as a whole.
struct RegionFacts {
    PostGrid grid;
    UndulationField undulation;
    RegionShape shape;
    std::uint64_t triangles{};  // at full resolution
};

// What pages are made of.
enum class PageContents : gpu::uint {
    posts = gpu::contents_posts,
    seam = gpu::contents_seam,      // what lies between grids (core/seam/seam_pages.h)
    meshes = gpu::contents_meshes,  // triangles of meshes (core/seam/mesh_pages.h)
};

class CastMap;       // core/frame/cast_map.h
struct MeshCasters;  // core/seam/mesh_casters.h
struct MadeGround;   // core/made/made_ground.h

// What all triangles of a page and of all pages below it lie in: a sphere and a cone (core/earth/culling.h).
struct PageBound {
    Ecef centre;
    double radius_m{};
    HorizonCone horizon;
};

// Pages of all levels of a region; safe to ask from several threads.
class RegionPages {
  public:
    explicit RegionPages(RegionFacts facts);
    // Of so many levels, the last of which may have several pages.
    RegionPages(RegionFacts facts, int levels);
    virtual ~RegionPages() = default;
    RegionPages(const RegionPages&) = delete;
    RegionPages& operator=(const RegionPages&) = delete;

    [[nodiscard]] const RegionFacts& facts() const { return facts_; }
    [[nodiscard]] int levels() const { return levels_; }
    [[nodiscard]] bool wraps_longitude() const { return wraps_longitude_; }
    // Pages of a level, drawn or not.
    [[nodiscard]] PageLayout layout(int level) const { return level_grid(facts_.grid, level).pages(); }

    // What the choice of pages needs; cheap. The page is one of the layout. Errors: a file that cannot be
    // read.
    [[nodiscard]] virtual Result<PageRecord> record(const PageIndex& page) const = 0;
    // Whether record() takes little time by now. Where it does not, who must not wait asks for the page
    // first, of threads that load it: load() makes the record, too.
    [[nodiscard]] virtual bool knows_record(const PageIndex&) const { return true; }
    // Where the page lies at most, by its place alone. Given where record() takes long, so that who culls
    // need not ask it; WGS84 as it is. One of the layout.
    [[nodiscard]] virtual std::optional<PageBound> bound(const PageIndex&) const { return std::nullopt; }
    // Fills the page's block. Errors: as record().
    virtual Result<void> load(const PageIndex& page, gpu::PageBlock& block) const = 0;
    // The rule that the heights of all pages follow from, where they do: who has it may make them and ask for
    // the rest of a block. Null: load() alone has them.
    [[nodiscard]] const MadeGround* made_ground() const { return made_ground_.get(); }
    // The rule is the grid's; to be given before pages are loaded.
    void set_made_ground(std::shared_ptr<const MadeGround> ground) { made_ground_ = std::move(ground); }
    // As load(), but for the block's heights, which are anything. Where it takes no less it is load().
    virtual Result<void> load_without_heights(const PageIndex& page, gpu::PageBlock& block) const {
        return load(page, block);
    }
    // Loads what pixels that cover many posts are coloured from (core/lod/ground_means.h), where it is
    // known. The first call takes all posts.
    [[nodiscard]] virtual bool knows_means() const { return false; }
    virtual Result<void> load_means(const PageIndex& page, gpu::PageMeans& means) const;
    // Where the page's posts are, of a grid on a net (core/net). Errors: as load(); a page that reaches too
    // far.
    virtual Result<void> load_places(const PageIndex& page, const gpu::PageBlock& block,
                                     gpu::PagePlaces& places) const;
    // What pages hold. Triangles of meshes lie in words of their own in the place of a block's heights.
    [[nodiscard]] virtual PageContents contents() const { return PageContents::posts; }
    [[nodiscard]] bool has_posts() const { return contents() == PageContents::posts; }
    [[nodiscard]] bool has_meshes() const { return contents() == PageContents::meshes; }
    // Whether a page of a seam closes gaps.
    [[nodiscard]] virtual bool is_skirt(const PageIndex&) const { return false; }
    // Those words of a page.
    virtual Result<void> load_words(const PageIndex& page, std::vector<std::uint32_t>& words) const;
    // Triangles of meshes among these, which cast shadows on all grids of a frame; null: there are none.
    [[nodiscard]] virtual const MeshCasters* mesh_casters() const { return nullptr; }
    // Heights above the ellipsoid that nothing of them is below or above, as drawn, where these are known
    // without records that take long.
    struct HeightBounds {
        double lowest_h_m{}, highest_h_m{};
    };
    [[nodiscard]] virtual std::optional<HeightBounds> known_heights() const { return std::nullopt; }
    // What casters need to be for shadows in all pictures that the pages are for, where these and their light
    // were known beforehand; others are not measured. Null: any picture may be planned.
    [[nodiscard]] virtual const CastMap* cast_map() const { return nullptr; }

  private:
    RegionFacts facts_;
    int levels_;
    bool wraps_longitude_;
    std::shared_ptr<const MadeGround> made_ground_;
};

// The pages of each grid of a ground, numbered as it numbers them (core/truth/true_ground.h). Pages by
// themselves are those of one grid. Cheap to copy; the pages outlive it.
class RegionPagesList {
  public:
    RegionPagesList(const RegionPages& pages) : pages_{&pages} {}  // NOLINT: are those of one grid
    explicit RegionPagesList(std::vector<const RegionPages*> pages) : pages_(std::move(pages)) {}
    [[nodiscard]] std::size_t size() const { return pages_.size(); }
    [[nodiscard]] const RegionPages& operator[](std::size_t grid) const { return *pages_[grid]; }

  private:
    std::vector<const RegionPages*> pages_;
};

// Builds all levels of a field with up to `threads` threads (core/lod/pyramid.h) and keeps what load() needs
// of them: 12 KB a page and 4 bytes a post. The field is not needed afterwards. progress is told shares of
// the whole from the caller's thread. stop: nothing is given once it is asked for (within some 0.1 s).
std::unique_ptr<RegionPages> pages_in_memory(const HeightField& field, double exaggeration, int threads,
                                             const std::function<void(double share)>& progress = {},
                                             const std::stop_token& stop = {});
// The same of the data around invented ground: `means` are those of all of the data; null: of the field.
std::unique_ptr<RegionPages> pages_beside_detail(const HeightField& field, double exaggeration,
                                                 std::shared_ptr<const DataMeans> means, int threads,
                                                 const std::function<void(double share)>& progress = {},
                                                 const std::stop_token& stop = {});

}  // namespace oro
