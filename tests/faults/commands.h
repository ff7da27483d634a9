// The commands that faults are let into: small ones, so that a run takes a tenth of a second.
#pragma once

#include "tests/faults/disturbed_program.h"

namespace oro::test {

// info of a GeoTIFF, of one with a mesh on it (glTF) and of a baked region, without and with a mesh; bake,
// with a mesh, too; shot of both, with a picture there already or none; what is seen from a place and from
// each of a table (two files), horizons (two files), a line's profile, and heights as a Cloud Optimized
// GeoTIFF, with files there already.
Command info_of_tiles();
Command info_of_baked();
Command info_of_mesh();
Command info_of_baked_mesh();
Command bake_new();
Command bake_with_mesh();
Command bake_again();
Command shot_of_tiles();
Command shot_of_baked();
Command viewshed_of_tiles();
Command viewshed_of_table();
Command horizon_of_tiles();
Command profile_of_tiles();
Command export_of_tiles();
Command shot_with_labels();  // one, of four figures at most

}  // namespace oro::test
