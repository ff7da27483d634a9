// Fingerprints of what a region is made of: equal ones mean the same heights at the same places, whatever the
// files are called and whichever format holds them. XXH64 tells swapped and changed data, not forgery.
#pragma once

#include <cstdint>
#include <span>

#include "core/base/checksum.h"
#include "core/terrain/post_grid.h"

namespace oro {

// Of the posts that one source brings: its heights (H, metres, after all that is done to them) as they are
// laid into the grid, row by row, and where they lie. Those count, too, that another source wins over.
class SourceFingerprint {
  public:
    // A rectangle of the grid's posts follows, row by row.
    void begin(const PostGrid& grid, int first_row, int first_column, int rows, int columns);
    void add(std::span<const float> H_m) { sum_.add(std::as_bytes(H_m)); }
    [[nodiscard]] std::uint64_t value() const { return sum_.sum(); }

  private:
    RunningChecksum sum_;
};

// Of a grid alone: where its posts lie, to 1e-7 degree (11 mm), which rounding in a file's georeference does
// not reach.
[[nodiscard]] std::uint64_t grid_fingerprint(const PostGrid& grid);
// Of all posts of a region, as they are in the end. Where they are not in memory they are read row by row:
// it is one only if the field is well afterwards (HeightField::health).
[[nodiscard]] std::uint64_t posts_hash(const HeightField& field);
// Of N over a region.
[[nodiscard]] std::uint64_t undulation_fingerprint(const UndulationField& undulation);

}  // namespace oro
