// Which way of drawing is faster on a device: both draw the same small frame, timed by the GPU.
#pragma once

#include "render/device/gpu.h"

namespace oro {

// What one frame of the calibration's terrain took, seconds of GPU timestamps: levels chosen and meshlets
// made triangle ids. The shading pass, which is the same for both, is left out.
struct Calibration {
    double mesh_s{};
    double compute_s{};
    int rounds{};     // frames of each way that the times are the best of
    double took_s{};  // all of it by the clock, pipelines made and terrain sent

    [[nodiscard]] RasterPath faster() const {
        return mesh_s <= compute_s ? RasterPath::mesh : RasterPath::compute;
    }
};

// Draws terrain by a formula from an eye that looks over it, so that most triangles are about a pixel and
// those in front some dozens, with either way in turn: once to warm up, once more, and again until each has
// five frames or the clock says 80 ms. One page of 256 meshlets in 256 x 144 pixels; where both ways draw
// that in less than 1 ms, four by four pages in 1024 x 576 instead. Meant to take less than 0.1 s altogether;
// but a driver that takes long to make pipelines and to draw its first frames cannot be interrupted (with
// nothing in their shader caches, the software driver takes some 1.5 s, NVIDIA's 0.5 s). The device must have
// both ways. Errors: those of the device.
Result<Calibration> calibrate(const Gpu& gpu);

}  // namespace oro
