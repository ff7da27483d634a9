// The programs of the shading pass, each made when it is first asked for: nothing else waits for them to be
// compiled.
#pragma once

#include <array>
#include <cstddef>

#include "render/pipelines/pipelines.h"

namespace oro {

// What a style alone asks of the shading pass.
ShadingKind shading_of(const gpu::FrameStyle& style);

// The program that shades so.
Result<VkPipeline> shading_for(const Gpu& gpu, RasterPath path, const ShadingKind& kind,
                               Pipelines& pipelines);

// The program that then smooths the edges of a picture, where edges_follow.
Result<VkPipeline> edges_for(const Gpu& gpu, RasterPath path, const ShadingKind& kind, Pipelines& pipelines);

// Whether what is much code is divided among programs, for the sake of registers: on GPUs, or where a test
// asks for it. A processor makes each program anew in each process, which takes it 0.2 s.
bool shades_as_gpu(const Gpu& gpu, bool asked);

// Lines to the sun, in two turns with a list between them (shares.comp).
struct ShareOptions {
    RasterPath path{RasterPath::mesh};
    bool both_turns_in_one{false};  // program
};
// The programs of the first turn, of the list and of the second turn, by their numbers there.
std::array<std::size_t, 3> share_programs(const ShareOptions& how);

// What fills the tables that it reads, as far as that is not there: of air,
Result<void> add_air_pipelines(const Gpu& gpu, Pipelines& pipelines);
// Adds the pipelines of what casts shadows and of how open the sky is.
Result<void> add_cast_pipelines(const Gpu& gpu, Pipelines& pipelines);
// Adds the pipelines of what pixels see of the sun, in a frame of one grid.
Result<void> add_share_pipelines(const Gpu& gpu, const ShareOptions& how, bool on_net, bool on_clusters,
                                 Pipelines& pipelines);
// Adds these of a frame of several grids, where the grid casts shadows or only gets them.
Result<void> add_joined_pipelines(const Gpu& gpu, const ShareOptions& how, bool on_net, bool casts,
                                  Pipelines& pipelines);
// Adds the pipelines of the image tiles that a frame wants.
Result<void> add_drape_pipelines(const Gpu& gpu, RasterPath path, bool on_clusters, Pipelines& pipelines);

}  // namespace oro
