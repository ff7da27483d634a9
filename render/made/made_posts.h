// Heights of made terrain, made by the GPU: the same bits as the CPU makes (core/made).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "core/base/result.h"
#include "core/made/made_terrain.h"
#include "render/device/resources.h"

namespace oro {

// A rectangle of a made terrain's posts; rows count from the north, columns from the west.
struct MadeRectangle {
    int first_row{};
    int rows{};
    int first_column{};
    int columns{};
    [[nodiscard]] std::size_t count() const {
        return static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
    }
};

// Makes posts of one terrain, rectangle by rectangle. The device outlives it.
class MadePosts {
  public:
    // The terrain is one that made_terrain_of() accepts. Places of its rows and columns come to the GPU: 8
    // bytes each. Errors: the device.
    static Result<MadePosts> create(const Gpu& gpu, const MadeTerrain& terrain);

    // Makes the posts of rectangles, one dispatch each, in one submission, and waits. steps: row by row,
    // rectangle after rectangle, H in 2^-11 m; as many as all rectangles have. Gives the seconds that the GPU
    // took, by its timestamps, without the way to the host. Errors: the device.
    Result<double> make(std::span<const MadeRectangle> rectangles, std::span<std::int32_t> steps);

    // Records the making of one rectangle's posts into memory of the device, row by row, H in 2^-11 m; as
    // many dispatches as a device's limit asks for. Whoever records waits for what is written (compute,
    // storage). heights: a device address, a multiple of 4, with room for them.
    void record_rectangle(VkCommandBuffer commands, const MadeRectangle& rectangle,
                          VkDeviceAddress heights) const;
    // Device addresses of the places of all rows (MadeRow) and columns (MadeColumn).
    [[nodiscard]] VkDeviceAddress rows_address() const { return rows_.address; }
    [[nodiscard]] VkDeviceAddress columns_address() const { return columns_.address; }

  private:
    explicit MadePosts(const Gpu& gpu, const MadeTerrain& terrain) : gpu_(&gpu), terrain_(terrain) {}
    Result<void> create_program();
    Result<void> send_places();
    void record(VkCommandBuffer commands, std::span<const MadeRectangle> rectangles) const;

    const Gpu* gpu_;
    MadeTerrain terrain_;
    OwnedPipelineLayout layout_;
    OwnedPipeline program_;
    OwnedQueryPool timestamps_;
    Buffer rule_, rows_, columns_;
    Buffer made_, read_;  // on the device, and for the host
    Commands commands_;
};

}  // namespace oro
