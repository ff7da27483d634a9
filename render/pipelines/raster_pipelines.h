// The programs of the compute rasteriser.
#pragma once

#include "render/pipelines/pipelines.h"

namespace oro {

// Adds them: raster_clear and those that follow it in Pipelines. Errors: the device.
Result<void> add_raster_pipelines(const Gpu& gpu, const PipelineWants& wants, Pipelines& pipelines);

// Adds those of clusters, once these are there. Errors: the device.
Result<void> add_cluster_raster(const Gpu& gpu, Pipelines& pipelines);

}  // namespace oro
