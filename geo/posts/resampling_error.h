// How far a region's surface is from the posts of a source that was resampled or interpolated.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/terrain/cell_diagonal.h"
#include "core/terrain/post_grid.h"
#include "geo/measures/post_places.h"
#include "geo/posts/source_sampling.h"
#include "geo/sources/source.h"
#include "geo/sources/source_report.h"

namespace oro {

// Turns heights of a source's own datum into H at posts along one row, as they are laid.
using ToH =
    std::function<Result<void>(double lat_deg, std::span<const double> lon_deg, std::span<float> H_m)>;

// A part of a block of posts with the range of its heights.
struct PartRange {
    PostLattice posts;
    float lowest, highest;
};

// Of one source: told what is laid, asked to compare while its posts are in memory, and again when the
// surface is whole. All posts are compared; of more than four million every step-th of each row and column,
// at least a million; where PROJ is asked for each height and there are more than 100,000, every fourth. The
// highest and the lowest always are. The surface: linear over the triangles of the region's grid, in double.
// Posts whose triangle has a height of another source do not count.
class ResamplingError {
  public:
    // All outlive this. H_m: of the region, row by row. Errors: a CRS that PROJ refuses.
    static Result<ResamplingError> create(const Source& source, const PostGrid& grid,
                                          const std::vector<float>& H_m);

    // These posts of the region follow, row by row.
    void begin(const GridRect& rect);
    // A row of them was laid with these heights of the source; `beyond`, up to half a cell outside its posts,
    // count only where nobody has others.
    void laid(int row, std::span<const float> heights, std::span<const float> beyond);
    // The source's posts that were read, after the rows that they are needed for. Posts of blocks that were
    // there before do not count again. Errors: those of to_H.
    Result<void> compare(const PostBlock& block, const ToH& to_H);
    // When the region's surface is as it will be.
    [[nodiscard]] Resampling finish();

  private:
    struct OwnPost {
        LatLon place;
        float H_m;
    };
    // Whether the height of posts in a rectangle of the region is this source's.
    struct Own {
        GridRect rect;
        std::vector<bool> posts;
    };
    struct Beyond {
        int row, column;
        float H_m;
    };
    enum class Ground { none, open, others, own };
    struct Shown {
        Ground ground;
        double H_m;
    };

    // What was found of some posts.
    struct Tally {
        std::uint64_t compared{}, hidden{};
        double squares_m2{};
        std::optional<PostShown> worst;
        std::vector<OwnPost> open;  // without ground yet

        void add(double own_H_m, double shown_H_m, const LatLon& place);
        void add(const Tally& other);
    };

    ResamplingError(const Source& source, const PostGrid& grid, const std::vector<float>& H_m,
                    PostPlaces places);
    [[nodiscard]] Shown shown_at(const LatLon& place, bool is_whole) const;
    [[nodiscard]] std::optional<Diagonal> diagonal_at(int row, int column, bool is_whole) const;
    [[nodiscard]] bool in_region(const LatLon& place) const;
    [[nodiscard]] bool is_own(int row, int column) const;
    void take_beyond();
    [[nodiscard]] std::uint64_t new_posts(const PostBlock& block) const;
    [[nodiscard]] Result<Tally> compare_part(const PostBlock& block, const PostLattice& part,
                                             const ToH& to_H) const;
    Result<void> find_extreme(const PostBlock& block, const std::vector<PartRange>& ranges, float upwards,
                              const ToH& to_H, std::optional<OwnPost>& found) const;
    [[nodiscard]] std::optional<PostShown> compared_post(const std::optional<OwnPost>& post) const;

    const PostGrid* grid_;
    const std::vector<float>* H_m_;
    PostPlaces places_;
    int step_{1};
    std::vector<Own> own_;
    std::vector<Beyond> beyond_;
    std::vector<PostWindow> seen_;
    std::uint64_t posts_{};
    Tally so_far_;
    std::optional<OwnPost> highest_, lowest_;
};

}  // namespace oro
