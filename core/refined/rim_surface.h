// What invented ground becomes towards the rim of its part.
#pragma once

#include <algorithm>

#include "core/refined/taken_posts.h"
#include "core/terrain/grid_part.h"

namespace oro {

// The smooth surface of a part: a bicubic through its posts whose slope at each post is that of the posts
// beside it, as shading takes the data's. On the rim it is straight from post to post, so that nothing gapes,
// and it keeps its slope across the rim, so that light has no edge there. Places are rows and columns from
// the part's first post, in posts of the data. What it is made of outlives it. Source: E. Catmull, R. Rom, A
// class of local interpolating splines, Computer Aided Geometric Design, 1974.
class RimSurface {
  public:
    RimSurface(const TakenPosts& taken, const GridPart& part);

    // How much of the noise a place has: 0 on the rim, 1 from 6 posts or a quarter of the part on.
    [[nodiscard]] double noise_share(double row, double column) const;
    // Nothing may be void within two posts of the place.
    [[nodiscard]] double H_m(double row, double column) const;

  private:
    // How far the bicubic is from the straight way between two posts of the rim, beside a void post 0.
    [[nodiscard]] double bulge_of_row_m(int row, double column) const;
    [[nodiscard]] double bulge_of_column_m(double row, int column) const;
    // Beyond the last posts the ground goes on straight.
    [[nodiscard]] double post_m(int row, int column) const;

    const TakenPosts& taken_;
    int rows_, columns_;
    int first_row_, first_column_;  // of the part, among those that were taken
    double noise_rows_, noise_columns_;
    double straight_rows_, straight_columns_;
};

}  // namespace oro
