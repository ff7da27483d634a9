// Made terrain of any size: its posts, and the pages of its levels, made when they are asked for.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "core/frame/known_pictures.h"
#include "core/frame/region_pages.h"
#include "core/made/made_terrain.h"
#include "core/made/post_maker.h"
#include "core/terrain/post_grid.h"

namespace oro {

// Whether such terrain has levels that are made when they are asked for: fbm and ridged.
bool makes_pages(const MadeTerrain& terrain);

// Posts of made terrain on a grid of its spacing, which it holds; each is made with its neighbours when it is
// asked for, and some 60 MB of them are kept. Safe to ask from several threads.
class MadePostSource : public PostSource {
  public:
    // terrain: one that makes_pages(); its outermost posts become the grid's.
    MadePostSource(const MadeTerrain& terrain, const PostGrid& grid);
    ~MadePostSource() override;

    [[nodiscard]] float H_m(int row, int column) const override;
    [[nodiscard]] Result<void> health() const override { return {}; }
    void row_H_m(int row, int first_column, std::span<float> H_m) const override;
    [[nodiscard]] std::optional<Range> range_of_page(int page_row, int page_column) const override;

    // The pages of all levels, whose undulation is the field's, of which this is the source. Heights and
    // nodes' errors are made when they are asked for; errors are measured three levels deep and bounded by
    // proven constants below (core/made_pages/level_bounds.h), so they are never less than those that
    // pages_in_memory() has, and levels are chosen by the same rule. Keeps 64 KB for each block of levels
    // that was asked for. Needs an exaggeration of 1. pictures: all that the pages are
    // for; none: any. They cost less then. The nodes that each of them draws where it may show them are those
    // that it draws without, and their errors are never less than those. Others may have an error of 0. What
    // pages of other pictures have measured is not measured again (64 MB are kept).
    // With light, casters are followed on the levels that pages for any have. Pictures with a sun have one
    // eye.
    [[nodiscard]] std::unique_ptr<RegionPages> pages(const HeightField& field,
                                                     const KnownPictures& pictures = {}) const;
    // The same of which nothing is measured: errors are proven bounds, which are many times as large, so that
    // the same tau takes far more triangles. A page costs its 16,641 posts.
    [[nodiscard]] std::unique_ptr<RegionPages> pages_by_bounds(const HeightField& field) const;

  private:
    struct Tiles;
    MadeTerrain terrain_;
    std::unique_ptr<Tiles> tiles_;
};

// How many blocks of levels were measured so far by pages that the calling thread asked: each takes long.
std::uint64_t blocks_measured_here();

// From here on posts are asked from a maker first, where the pages are a MadePostSource's; it does nothing
// to others. Not while any are asked for.
void make_posts_by(RegionPages& pages, std::shared_ptr<MadePostMaker> maker);

// A field whose posts are those of a made terrain, made when they are asked for.
HeightField made_field(const MadeTerrain& terrain, const PostGrid& grid, const UndulationField& undulation);
// The source of a field's posts where they are made when they are asked for; null where they are in memory or
// in a file. The field owns it.
const MadePostSource* made_posts_of(const HeightField& field);

}  // namespace oro
