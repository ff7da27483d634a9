// Ground between the posts of a grid, where the data say nothing: a smooth surface through the posts, and
// noise of the size that the ground itself has at such distances.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/terrain/grid_part.h"
#include "core/terrain/post_grid.h"

namespace oro {

// How far the ground leaves the straight way between two posts half way between them, as the data tell at one
// of them: from second differences at lags of 1, 2 and 4 posts within 10 posts, which grow as a power of the
// distance. In metres; all 0 where that cannot be told.
struct BetweenPosts {
    float by_row_m{};     // half way to the next row: r.m.s. from the straight way
    float by_column_m{};  // half way to the next column
    // What is left of them beside the smooth surface: r.m.s. of the noise half way, and in a cell's middle.
    float row_noise_m{};
    float column_noise_m{};
    float middle_noise_m{};
    // By how much half the distance lowers the r.m.s., 0.29 to 1.
    float halved{1.0F};
};

// Estimates that for the posts of a part, row by row. still: by post of the part, nonzero where nothing is
// invented; such posts tell nothing of the others. Costs some 0.3 us a post.
std::vector<BetweenPosts> between_posts(const HeightField& field, const GridPart& part,
                                        std::span<const char> still);

// The posts of a part on level ground: of 3 x 3 posts of one height, as lakes and the sea have. By post of
// the part, 1 where it is one.
std::vector<char> level_posts(const HeightField& field, const GridPart& part);

// A part of a grid with ground between its posts.
struct RefinedPosts {
    HeightField field;  // of 2^halvings posts in place of one; with the undulation of the whole
    double rms_m{};     // by which posts between those of the data are off the data's surface
    double largest_m{};
    std::uint64_t posts{};  // so many of them
    std::uint64_t still{};  // that are on the data's surface
};

// Makes ground between the posts of a part of a field, which has at least 2 x 2 posts and lies in the grid.
// Each halving puts posts half way between those that are there: on the cubic through the 4 x 4 posts around,
// and off that by noise whose r.m.s. is that of between_posts(), and for each halving as much less as the
// ground has it. Posts of the data keep their place and their height, to the bit. Heights follow from the
// data around and from numbers of posts in the world alone: what is 20 posts inside of the part's rim has the
// same bits in any part, and posts of few halvings have theirs of many. Towards the rim, over 6 posts or a
// quarter of the part, the noise ends; on the rim the ground is that of the data, and as steep across it as
// the data are shaded (core/refined/rim_surface.h). It is the data's, too, beside `still` posts (see above)
// and within 2 posts of void ones. Triangles with a void corner stay as they are. Source:
// midpoint displacement: A. Fournier, D. Fussell, L. Carpenter, Computer rendering of stochastic models,
// CACM 25(6), 1982; the cubic: R. Keys (core/terrain/cell_diagonal.h).
// halvings: 1 to 6. Errors: a net with corrections of its places, which has none between its posts; posts
// that cannot be read.
Result<RefinedPosts> refined_posts(const HeightField& field, const GridPart& part, int halvings,
                                   std::span<const char> still);

}  // namespace oro
