// The surface that a picture is measured against, in double precision: no levels, no rounding to steps, no
// GPU.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "core/ellipsoid.h"
#include "core/post_grid.h"

namespace oro {

// The full-resolution surface of a height field: each post at (latitude, longitude, H * exaggeration + N) on
// WGS84, each cell two triangles split from its north-west to its south-east post, h linear over each in
// latitude and longitude (so a triangle is as curved as the ellipsoid). Safe to ask from several threads.
class TrueSurface {
  public:
    // `field` outlives the surface. Reads every post once where they are in memory, shared between `threads`;
    // posts of a file are read when they are asked for.
    TrueSurface(const HeightField& field, double exaggeration, int threads);
    ~TrueSurface();
    TrueSurface(const TrueSurface&) = delete;
    TrueSurface& operator=(const TrueSurface&) = delete;

    // Height of the surface above the ellipsoid at a place; nothing outside the region and on triangles with
    // a void post. Error: rounding, below 1e-8 m for slopes up to 45 degrees and posts 1 m apart or more.
    [[nodiscard]] std::optional<double> h_m(double lat_deg, double lon_deg) const;

    // Height above the ellipsoid of a post; nothing where it is void. Posts that are one point have one
    // height.
    [[nodiscard]] std::optional<double> post_h_m(int row, int column) const;

    // Heights between which a part of the surface lies; lowest > highest where there is no surface.
    struct Layer {
        double lowest_h_m;
        double highest_h_m;
        [[nodiscard]] bool empty() const { return lowest_h_m > highest_h_m; }
    };
    // A square of cells: 4 * 2^level of them along each side, numbered from the north-west, fewer where the
    // grid ends.
    struct Block {
        int level;
        int row;
        int column;
    };
    static constexpr int block_cells = 4;
    // The level with one block only.
    [[nodiscard]] int levels() const { return levels_; }
    [[nodiscard]] Layer layer(const Block& block) const;
    [[nodiscard]] int blocks_down(int level) const;
    [[nodiscard]] int blocks_across(int level) const;

    [[nodiscard]] const HeightField& field() const { return field_; }
    [[nodiscard]] double exaggeration() const { return exaggeration_; }

  private:
    struct Chunk;
    [[nodiscard]] const Chunk& chunk(int row, int column) const;
    void read_chunk(int row, int column, Chunk& chunk) const;

    const HeightField& field_;
    double exaggeration_;
    int levels_;
    bool goes_round_;
    std::vector<UndulationField::Between> N_row_;
    std::vector<UndulationField::Between> N_column_;
    mutable std::vector<std::unique_ptr<Chunk>> chunks_;
    std::vector<std::vector<Layer>> above_;  // layers of the levels above the chunks'
};

}  // namespace oro
