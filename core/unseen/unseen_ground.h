// The horizon of the data: where in a picture ground that is not loaded could stand, and how far that could
// move what is drawn.
//
// Unknown ground is any ground over places without data that is not higher than a ceiling. A line of sight
// "looks beyond the data" when it comes over such a place below the ceiling before it meets known ground:
// there, and only there, unknown ground could change what is seen. That is taken along true sight lines:
// WGS84, bent as the Refraction bends them. Void posts are no such places; and a line that leaves the data
// lower than all its ground has come through void posts.
//
// All lines of one azimuth, a plane through the eye's vertical. A vertical over a place at the distance g is
// crossed the higher the steeper a line goes up; so a line is below the ceiling there when its elevation is
// at most C(g), that of the ceiling over g, and known ground before g is in its way when its elevation is at
// most K(g), the highest of that ground's. Lines of elevations in (K(g), C(g)] may meet unknown ground at g,
// no others. K grows with g. Over a stretch without data from g1 to g2 K stays K(g1), so the whole stretch
// gives (K(g1), max C]. From an eye below the ceiling C falls with g: the first stretch gives all that the
// others do. From above it C rises up to where the ceiling is its own horizon, and falls beyond: max C is
// there, or at the stretch's end that is nearer to it.
//
// Bound, of a column of the picture. The places of it where unknown ground could be seen come in runs, which
// known ground ends (sky between two of them joins them, and so does a single place of ground). Unknown
// ground is drawn as if it lay below the bottom of its run; in truth its outline may be anywhere up to the
// top of the run. So what is drawn there can be too low by the run's length and no more: the skyline where
// the run lies above known ground, the outline of hidden ground where known ground is drawn behind a gap. The
// column's bound is its longest run.
#pragma once

#include <cstdint>
#include <vector>

#include "core/earth/camera.h"
#include "core/truth/oracle.h"
#include "core/truth/true_surface.h"
#include "core/unseen/known_ground.h"

namespace oro {

// Above sea level. The highest ground is 8,849 m high.
inline constexpr double usual_unseen_ceiling_m = 9000.0;

// What stands at each of a grid of places in a picture: one for each pixel, at its centre, of pictures up to
// 2048 x 1024 pixels, else so many, evenly spread.
struct UnseenPicture {
    static constexpr int data = -1;  // known ground is nearer than any unknown could be
    static constexpr int sky = -2;   // too high for any unknown ground: sky, or known ground
    int columns{};
    int rows{};
    // Row by row; from 0 on: unknown ground could be seen, first in cells[kind].
    std::vector<std::int32_t> kind;
    std::vector<UnseenPlace> cells;

    [[nodiscard]] std::int32_t at(int column, int row) const {
        return kind[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                    static_cast<std::size_t>(column)];
    }
};

// `surface`: the data, with their exaggeration, which the ceiling gets, too; `sight` is the true one, and
// `camera` has its eye where it truly is. Sea level is taken as high as the geoid gets anywhere, 86 m: what N
// is over unknown places is not known, either.
// Azimuths are looked at one pixel apart, so the edges between kinds are right to a pixel up and down
// and to a pixel sideways (two beyond 50 degrees from the picture's middle), where the grid has all pixels.
// A stretch without data is never stepped over, however short: its ends are computed. What shows in less than
// a pixel may be missed. Cost: some 6 sight lines an azimuth.
UnseenPicture unseen_picture(const TrueSurface& surface, const KnownGround& known, const Sight& sight,
                             const Camera& camera, double ceiling_m, int threads);

struct UnseenCell {
    DegreeCell cell;
    double bound_px{};  // the largest of the columns that look into it first
    int columns{};      // how many of those that were looked at do
};
struct UnseenGround {
    double ceiling_m{};
    int columns{};         // of the picture
    int columns_beyond{};  // of them those that look beyond the data: into cells that are missing
    double bound_px{};  // the largest of those columns; never below what any unknown ground could do, but for
                        // what `unseen_picture` may miss; up to two pixels above it
    std::vector<UnseenCell>
        missing;  // largest bound first, then most columns; each without data where it is entered
    // Columns, bound and cells of the columns that look beyond the part of the data that was chosen. A column
    // may look beyond both; its bound then counts for both.
    int columns_beyond_part{};
    double part_bound_px{};
    std::vector<UnseenCell> beyond_part;
    // The picture shows all of the data, and so their end: nobody takes that for a skyline. Told by whoever
    // knows the picture's frame (apps/accuracy/beyond_data.h).
    bool all_in_view{};
    std::vector<float> column_px;  // of each column that was looked at; 0: none
};
// `camera`: that of the picture.
UnseenGround unseen_ground(const UnseenPicture& picture, const Camera& camera, double ceiling_m);

}  // namespace oro
