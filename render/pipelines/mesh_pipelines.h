// The programs of the mesh path.
#pragma once

#include "render/pipelines/pipelines.h"

namespace oro {

// Adds them: terrain, terrain_ties and the sizes of their workgroups in Pipelines. Errors: the device.
Result<void> add_mesh_pipelines(const Gpu& gpu, const PipelineWants& wants, Pipelines& pipelines);

// Draws clusters; ties: as Pipelines.terrain_ties. Errors: the device.
Result<OwnedPipeline> create_cluster_terrain(const Gpu& gpu, const Pipelines& pipelines, bool ties);

}  // namespace oro
