// Where a source's own posts lie on the Earth.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "geo/places/geodesic.h"
#include "geo/sources/source.h"

namespace oro {

// A lattice of posts: every `step`-th of the source's, from one on.
struct PostLattice {
    int row{};
    int column{};
    int rows{};
    int columns{};
    int step{1};
};

// The way that source_sampling goes, backwards: from post numbers to WGS84 degrees. From any thread.
class PostPlaces {
  public:
    // The source outlives this. Errors: a CRS that PROJ refuses.
    static Result<PostPlaces> create(const Source& source);
    PostPlaces(PostPlaces&&) noexcept;
    PostPlaces& operator=(PostPlaces&&) noexcept;
    ~PostPlaces();

    // Puts the places of all posts of a lattice into `places`, row by row; not a number where a post has no
    // place. Longitudes may be a whole turn from those of the region. PROJ is asked for 16 posts, and the
    // others lie on the cubics through these; 4 more show whether that is as PROJ has them to 1e-9 degree
    // (0.1 mm). Where it is not, parts are placed by themselves, and small ones post by post.
    void of(const PostLattice& lattice, std::vector<LatLon>& places) const;

  private:
    struct Way;
    PostPlaces();
    void exactly(const std::vector<std::array<double, 2>>& posts, std::vector<LatLon>& places) const;
    void fill(const PostLattice& lattice, int first_row, int rows, int first_column, int columns,
              std::vector<LatLon>& places) const;
    std::unique_ptr<Way> way_;
};

}  // namespace oro
