// The surface that a picture is measured against, in double precision: no levels, no rounding to steps, no
// GPU.
#pragma once

#include <atomic>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/earth/ellipsoid.h"
#include "core/terrain/cell_diagonal.h"
#include "core/terrain/post_grid.h"

namespace oro {

// The full-resolution surface of a height field: each post at (latitude, longitude, H * exaggeration + N) on
// WGS84, each cell two triangles (core/terrain/cell_diagonal.h), h linear over each in latitude and longitude
// (so a triangle is as curved as the ellipsoid). Safe to ask from several threads.
class TrueSurface {
  public:
    // `field` outlives the surface. Reads every post once where they are in memory, shared between `threads`;
    // posts of a file are read when they are asked for. Keeps 0.8 byte for each post that was looked at, on a
    // net 1.5 bytes more. masked: by post, 1 where another grid covers what this one has, so that it
    // decides no diagonal (geo/together/grid_clip.h); outlives the surface.
    TrueSurface(const HeightField& field, double exaggeration, int threads,
                const std::vector<char>* masked = nullptr);
    ~TrueSurface();
    TrueSurface(const TrueSurface&) = delete;
    TrueSurface& operator=(const TrueSurface&) = delete;

    // Height of the surface above the ellipsoid at a place; nothing outside the region and on triangles with
    // a void post. Error: rounding, below 1e-8 m for slopes up to 45 degrees.
    [[nodiscard]] std::optional<double> h_m(double lat_deg, double lon_deg) const;

    // The height above the ellipsoid at a fractional row and column of the grid, without a place's rounding.
    [[nodiscard]] std::optional<double> h_at_m(double row, double column) const;

    // How steep the triangle there is, metres of height a metre along the ellipsoid. Nothing where h_at_m()
    // has none; near a pole the parallel counts as at least a millimetre between posts.
    struct Slope {
        double north;
        double east;
        [[nodiscard]] double steepness() const { return std::hypot(north, east); }
    };
    [[nodiscard]] std::optional<Slope> slope_at(double row, double column) const;

    // The diagonal of a cell, by its north-west post.
    [[nodiscard]] Diagonal diagonal_at(int row, int column) const;
    // The diagonal for who asks for most cells of a part: this looks at 128 x 128 of them at once.
    [[nodiscard]] Diagonal diagonal_of_many(int row, int column) const;

    // Height above the ellipsoid of a post; nothing where it is void. Posts that are one point (a meridian's
    // two columns, a pole) have one height.
    [[nodiscard]] std::optional<double> post_h_m(int row, int column) const;
    // The same bits of the posts of a row, from first_column on; no number where one is void. For who asks
    // for most posts of a part.
    void row_h_m(int row, int first_column, std::span<double> h_m) const;

    // Heights between which a part of the surface lies; lowest > highest where there is none.
    struct Layer {
        double lowest_h_m;
        double highest_h_m;
        [[nodiscard]] bool empty() const { return lowest_h_m > highest_h_m; }
    };
    // A square of cells, 4 * 2^level along each side, fewer where the grid ends. Numbered from the
    // north-west.
    struct Block {
        int level;
        int row;
        int column;
    };
    static constexpr int block_cells = 4;
    // Levels of blocks; the last has one block. 0 when there is no cell.
    [[nodiscard]] int levels() const { return levels_; }
    [[nodiscard]] Layer layer(const Block& block) const;
    // Number of blocks of a level, (rows, columns).
    [[nodiscard]] std::pair<int, int> blocks(int level) const;

    // The ellipsoid's normals at the corners of level 0's blocks, row by row, of a grid on a net; else empty.
    struct Corners {
        int rows{}, columns{};
        std::vector<glm::dvec3> normals;
    };
    [[nodiscard]] const Corners& corners() const { return corners_; }

    [[nodiscard]] const HeightField& field() const { return field_; }
    [[nodiscard]] double exaggeration() const { return exaggeration_; }

  private:
    // What is known of 128 x 128 cells, once they were looked at: heights of their blocks, and, as a sweep
    // needs them alone, their diagonals.
    struct Chunk;
    struct ChunkDiagonals;
    [[nodiscard]] const Chunk& chunk(int row, int column) const;
    [[nodiscard]] Chunk* new_chunk(int row, int column) const;
    [[nodiscard]] const ChunkDiagonals& chunk_diagonals(int row, int column) const;
    [[nodiscard]] ChunkDiagonals* new_chunk_diagonals(int row, int column) const;
    struct ChunkSlot;
    [[nodiscard]] ChunkSlot& slot_of(int row, int column) const;
    [[nodiscard]] std::optional<Layer> layer_of_source(int chunk_row, int chunk_column) const;
    [[nodiscard]] Layer scanned_layer(int chunk_row, int chunk_column) const;
    void measure_above(int threads);
    void place_corners(int threads);

    const HeightField& field_;
    double exaggeration_;
    const std::vector<char>* masked_;
    int levels_{0};
    Layer N_range_m_{0.0, 0.0};
    Corners corners_;
    std::vector<UndulationField::Between> N_rows_;
    std::vector<UndulationField::Between> N_columns_;
    std::vector<std::vector<Layer>> above_;  // of the chunks' level and those above it
    struct ChunkSlot {
        std::atomic<Chunk*> layers{nullptr};
        std::atomic<ChunkDiagonals*> diagonals{nullptr};
    };
    // Of each row of chunks, those that were looked at.
    struct ChunkRow {
        explicit ChunkRow(std::size_t chunks) : slots(chunks) {}
        std::vector<ChunkSlot> slots;
    };
    mutable std::vector<std::atomic<ChunkRow*>> chunk_rows_;
};

}  // namespace oro
