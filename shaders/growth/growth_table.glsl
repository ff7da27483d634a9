// The table of a grid's trees. Needs frame.glsl.
#include "shaders/shared_growth.h"

layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer GrowthTables { GrowthTable at; };
layout(push_constant, scalar) uniform Growth { uvec2 growth_table; };
#define GROWTH GrowthTables(growth_table).at
