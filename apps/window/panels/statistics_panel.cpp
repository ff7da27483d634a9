#include <cstdio>

#include "apps/report/figures.h"
#include "apps/window/panels/panel_parts.h"
#include "apps/window/panels/panels.h"
#include "core/frame/frame_plan.h"

namespace oro {
namespace {

std::string milliseconds(double time_s) {
    char text[40];
    std::snprintf(text, sizeof text, "%.1f ms", 1e3 * time_s);
    return text;
}

std::string megabytes(std::uint64_t bytes) {
    char text[40];
    std::snprintf(text, sizeof text, "%.1f MB", static_cast<double>(bytes) / 1e6);
    return text;
}

}  // namespace

void build_statistics_panel(Viewer& viewer) {
    bool& is_open = viewer.panels.statistics;
    if (!is_open) return;
    if (begin_panel("Statistics", is_open, PanelCorner::upper_right, 300.0F)) {
        const FrameReport& report = viewer.report;
        const gpu::FrameCounts& counts = report.counts;
        value_line("Frame", milliseconds(viewer.frame_s),
                   "From the choice of what is drawn, or from the picture before, to the picture");
        value_line("GPU", milliseconds(report.gpu_s()), "What of that the GPU drew");
        value_line("  choosing", milliseconds(report.choose_s), "Levels of the ground, as fine as tau asks");
        value_line("  triangles", milliseconds(report.raster_s),
                   "From pages of posts to the triangle in each pixel");
        value_line("  colours", milliseconds(report.shade_s), "From triangles to light");
        ImGui::Separator();
        value_line("Triangles", grouped(counts.triangles_drawn), "That were drawn");
        value_line("Meshlets", grouped(counts.meshlets_drawn),
                   "Groups of up to 128 triangles that were drawn");
        value_line("  beside", grouped(counts.meshlets_beyond_frustum), "Left out: not in the picture");
        value_line("  beyond", grouped(counts.meshlets_beyond_horizon),
                   "Left out: behind the Earth's horizon");
        value_line("  hidden", grouped(counts.meshlets_hidden), "Left out: behind other ground");
        value_line("Pages", grouped(report.pages), "Blocks of 128 x 128 quads that the frame is made of");
        ImGui::Separator();
        std::uint64_t pages = 0, images = 0;
        for (const GridScene& grid : viewer.scene->grids()) {
            pages += grid.store().bytes();
            if (grid.drape() != nullptr) images += grid.drape()->bytes();
        }
        value_line("GPU memory", megabytes(pages), "That the ground takes");
        if (images > 0) value_line("  images", megabytes(images), "That images over it take");
        value_line("Device", viewer.gpu.report().name, "What draws the picture");
    }
    ImGui::End();
}

}  // namespace oro
