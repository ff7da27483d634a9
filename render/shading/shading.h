// The programs of the shading pass, each made when it is first asked for: nothing else waits for them to be
// compiled.
#pragma once

#include "render/frame/pipelines.h"

namespace oro {

// What a style alone asks of the shading pass.
ShadingKind shading_of(const gpu::FrameStyle& style);

// The program that shades so.
Result<VkPipeline> shading_for(const Gpu& gpu, RasterPath path, const ShadingKind& kind,
                               Pipelines& pipelines);

// The program that then smooths the edges of a picture, where edges_follow.
Result<VkPipeline> edges_for(const Gpu& gpu, RasterPath path, const ShadingKind& kind, Pipelines& pipelines);

// Whether pixels that need lines to the sun are listed for the whole picture before they have them: on
// processors, whose drivers take long for barriers, and not on GPUs, whose workgroups would wait for each
// other.
bool lists_pixels_together(const Gpu& gpu);

// What fills the tables that it reads, as far as that is not there: of air,
Result<void> add_air_pipelines(const Gpu& gpu, Pipelines& pipelines);
// ... of what casts shadows and of how open the sky is,
Result<void> add_cast_pipelines(const Gpu& gpu, Pipelines& pipelines);
// ... of what pixels see of the sun: in a frame of one grid,
Result<void> add_share_pipelines(const Gpu& gpu, RasterPath path, bool on_net, bool on_clusters,
                                 Pipelines& pipelines);
// ... and in one of several, where the grid casts shadows or only gets them,
Result<void> add_joined_pipelines(const Gpu& gpu, RasterPath path, bool on_net, bool casts,
                                  Pipelines& pipelines);
// ... and of the image tiles that a frame wants.
Result<void> add_drape_pipelines(const Gpu& gpu, RasterPath path, bool on_clusters, Pipelines& pipelines);

}  // namespace oro
