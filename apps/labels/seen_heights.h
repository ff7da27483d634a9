// H of the ground that a picture shows, pixel by pixel.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "core/earth/camera.h"
#include "core/truth/true_ground.h"
#include "render/frame/picture_renderer.h"

namespace oro {

// Heights at nodes: the middles of every step-th pixel, across and down, from the first.
struct SeenHeights {
    int columns{};
    int rows{};
    int step_px{1};
    double steepest{};         // largest share of the distance that may be between nodes side by side
    std::vector<float> H_m;    // row by row: orthometric, not exaggerated
    std::vector<float> far_m;  // along the view axis; 0: no ground

    [[nodiscard]] std::size_t at(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
               static_cast<std::size_t>(column);
    }
    [[nodiscard]] glm::dvec2 place_px(int column, int row) const {
        return {column * step_px + 0.5, row * step_px + 0.5};
    }
    // True where the ground goes on from a node to one beside it: neither ends at an edge with farther ground
    // behind it, nor turns away from the eye by more than 79 degrees.
    [[nodiscard]] bool joined(std::size_t one, std::size_t other) const;
    // Bilinear between four nodes that are joined; nothing elsewhere.
    [[nodiscard]] std::optional<double> H_at(glm::dvec2 place_px) const;
};

// Nodes for a picture of that size without ground: all pixels, or fewer of those of a large picture.
SeenHeights no_heights(const Camera& camera);

// Makes each node the mean of the ground around it, binomial over 3 x 3 nodes, as pixels of fine ground are.
// Nodes beside it count where they are joined to it.
void smooth(SeenHeights& seen);

// What a picture shows: of its triangles, as fine as tau asks for, and each node the mean of the ground
// around it (binomial over 3 x 3 nodes), as pixels are. ground: of the scene's grids. Errors: those of the
// device and of pages.
Result<SeenHeights> seen_heights(const Gpu& gpu, Scene& scene, const Camera& camera,
                                 const PictureOptions& options, const TrueGround& ground);

}  // namespace oro
