// A bake that several machines share: each measures a part of a region's nodes into a file of its own, and
// the bake that joins them measures nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/baked/bake.h"
#include "core/base/container.h"
#include "core/base/result.h"
#include "core/lod/row_deviations.h"

namespace oro {

// Part `number` of `count`, from 1.
struct BakePart {
    std::uint64_t number{1};
    std::uint64_t count{1};
};

// The name of a part's file, beside the baked file `path`: "alps.oro.part-2of4".
std::string path_of_measured_part(const std::string& path, const BakePart& part);
// The parts of `path` that are there, by their names: any of any count, in the order of their counts and
// numbers.
std::vector<BakePart> measured_parts_there(const std::string& path);

// Measures every part.count-th row of nodes of all levels, from row part.number - 1 on in the order of
// PageOrder, so that parts take about as long as each other. how: as for bake_region(); `path` is that of the
// baked file. A part that is there, whole and of the same region, is not measured again. The file appears
// whole or not at all. Gives the rows that were measured. Errors: those of writing; somebody else's file of
// that name; broken off.
Result<std::uint64_t> measure_part(const HeightField& field, const BakeOptions& how, const BakePart& part,
                                   const BakeProgress& progress = {});

// All parts of a region, to bake it from. Rows are read when they are asked for, by any number of threads.
class MeasuredParts {
  public:
    // how: as measure_part() got it. Errors: no part; parts of several counts; one that is missing; one of
    // another region, or that another version measured; damage.
    static Result<MeasuredParts> open(const PostGrid& grid, const BakeOptions& how);
    // Errors: damage.
    Result<void> row(const PageIndex& page, int row, RowDeviations& deviations) const;
    // The files, by their names.
    [[nodiscard]] std::vector<std::string> files() const;

  private:
    MeasuredParts(PageOrder order, std::vector<std::shared_ptr<const Container>> parts,
                  std::vector<std::uint64_t> offsets)
        : order_(std::move(order)), parts_(std::move(parts)), offsets_(std::move(offsets)) {}
    PageOrder order_;
    std::vector<std::shared_ptr<const Container>> parts_;
    std::vector<std::uint64_t> offsets_;  // of the rows, in each
};

}  // namespace oro
