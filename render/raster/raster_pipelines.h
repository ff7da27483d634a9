// The programs of the compute rasteriser.
#pragma once

#include "render/frame/pipelines.h"

namespace oro {

// Adds them: raster_clear and those that follow it in Pipelines. Errors: the device.
Result<void> add_raster_pipelines(const Gpu& gpu, const PipelineWants& wants, Pipelines& pipelines);

}  // namespace oro
