// From a height field to a region file: all levels, built and written page after page.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "core/baked/region_file.h"
#include "core/base/result.h"
#include "core/terrain/post_grid.h"

namespace oro {

class MeasuredParts;  // core/baked/measured_parts.h

struct BakeOptions {
    std::string path;  // of the finished file
    bool overwrite{false};
    std::uint64_t fingerprint{};  // of the sources' state: a broken bake goes on only where it is the same
    std::string description;      // goes into the file, see RegionOutline
    int threads{1};
    // What was measured of the region's nodes, by parts that outlive the bake; null: all is measured here.
    // The file has the same bytes.
    const MeasuredParts* parts{};
};

struct BakeReport {
    std::uint64_t pages{};
    std::uint64_t pages_found{};  // of a bake that was broken off
    std::uint64_t triangles{};    // of the full resolution
};

// Told how far it is, 0..1, from the caller's thread; false breaks the bake off (a later one goes on from
// there).
using BakeProgress = std::function<bool(double share)>;

// Bakes a region with exaggeration 1. The file is written whole or not at all; what there is of it when the
// bake is broken off lies beside it as .partial. Keeps 4 bytes a post and the last two levels' nodes in
// memory. Errors: no triangle in the region (no_data), those of RegionFileWriter, broken off.
Result<BakeReport> bake_region(const HeightField& field, const BakeOptions& options,
                               const BakeProgress& progress = {});
// The same with an outline that is known: it must be the field's own.
Result<BakeReport> bake_region(const HeightField& field, const RegionOutline& outline,
                               const BakeOptions& options, const BakeProgress& progress = {});

}  // namespace oro
