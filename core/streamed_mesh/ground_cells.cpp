#include "core/streamed_mesh/ground_cells.h"

#include <cmath>

#include "core/base/little_endian.h"
#include "core/cluster_file/number_code.h"

// The order of the bytes: the box; how many grids; of each what tells its posts, and how many runs it has;
// then the runs of all, by a range coder.
namespace oro {
namespace {

template <class Visit>
void visit_box(Visit& visit, auto& cells) {
    visit(cells.south_deg), visit(cells.north_deg), visit(cells.west_deg), visit(cells.east_deg);
}

// Both ways: each run beside the one before it, or where it begins a row beside the first of the last row.
template <class Coder>
class RunCode {
  public:
    explicit RunCode(Coder& coder) : coder_(coder) {}

    GroundCells::Run code(const GroundCells::Run& there) {
        GroundCells::Run run;
        const std::uint32_t down = down_.code(coder_, there.row - last_.row);
        run.row = last_.row + down;
        if (down == 0 && !is_first_) {
            const std::uint32_t end = last_.column + last_.count;
            run.column = end + gap_.code(coder_, there.column - end);
        } else {
            run.column =
                first_column_ + static_cast<std::uint32_t>(column_.code(
                                    coder_, static_cast<std::int32_t>(there.column - first_column_)));
            first_column_ = run.column;
        }
        run.count = last_.count + static_cast<std::uint32_t>(count_.code(
                                      coder_, static_cast<std::int32_t>(there.count - last_.count)));
        last_ = run, is_first_ = false;
        return run;
    }
    void begin_grid() { last_ = {}, first_column_ = 0, is_first_ = true; }

  private:
    Coder& coder_;
    SmallNumber down_, gap_;
    NearZero column_, count_;
    GroundCells::Run last_;
    std::uint32_t first_column_{};
    bool is_first_{true};
};

constexpr std::uint32_t most_number = 1U << 30U;

// Whether a run lies in a grid, behind the one before it.
bool is_sound(const GroundCells::Run& run, const GroundCells::Run* before) {
    if (run.row > most_number || run.column > most_number || run.count == 0 || run.count > most_ground_cells)
        return false;
    return before == nullptr || run.row > before->row ||
           (run.row == before->row && run.column > before->column + before->count);
}

}  // namespace

std::size_t GroundCells::count() const {
    std::size_t all = 0;
    for (const Grid& grid : grids)
        for (const Run& run : grid.runs) all += run.count;
    return all;
}

std::vector<std::byte> ground_cells_to_bytes(const GroundCells& cells) {
    NumberWriter writer;
    visit_box(writer, cells);
    writer(static_cast<std::uint32_t>(cells.grids.size()));
    RangeEncoder coder;
    RunCode<RangeEncoder> code(coder);
    for (const GroundCells::Grid& grid : cells.grids) {
        writer(grid.posts), writer(static_cast<std::uint32_t>(grid.runs.size()));
        code.begin_grid();
        for (const GroundCells::Run& run : grid.runs) code.code(run);
    }
    const std::vector<std::byte> runs = coder.finish();
    writer.bytes.insert(writer.bytes.end(), runs.begin(), runs.end());
    return std::move(writer.bytes);
}

std::optional<std::string> ground_cells_from_bytes(std::span<const std::byte> bytes, GroundCells& cells) {
    cells = {};
    NumberReader reader(bytes);
    visit_box(reader, cells);
    const bool is_box = cells.south_deg <= cells.north_deg && cells.west_deg <= cells.east_deg &&
                        std::abs(cells.south_deg) <= 90.0 && std::abs(cells.north_deg) <= 90.0 &&
                        std::abs(cells.west_deg) <= 360.0 && std::abs(cells.east_deg) <= 360.0;
    std::uint32_t grids = 0;
    reader(grids);
    constexpr std::size_t bytes_before_grids = 36, bytes_of_a_grid = 12;
    if (bytes.size() < bytes_before_grids || !is_box || grids == 0 || grids > most_ground_grids ||
        !reader.has(grids, bytes_of_a_grid))
        return "has ground of a place that is none";
    std::vector<std::uint32_t> counts(grids);
    for (std::uint32_t& count : counts) reader(cells.grids.emplace_back().posts), reader(count);
    RangeDecoder coder(reader.rest());
    RunCode<RangeDecoder> code(coder);
    std::size_t all = 0;
    for (std::size_t i = 0; i < grids; ++i) {
        code.begin_grid();
        std::vector<GroundCells::Run>& runs = cells.grids[i].runs;
        for (std::uint32_t k = 0; k < counts[i]; ++k) {
            const GroundCells::Run run = code.code({});
            if (coder.is_wrong() || !is_sound(run, runs.empty() ? nullptr : &runs.back()) ||
                (all += run.count) > most_ground_cells)
                return "has ground of cells that are none";
            runs.push_back(run);
        }
    }
    if (coder.is_wrong() || !coder.at_end()) return "has ground that goes on after its last cell";
    return std::nullopt;
}

}  // namespace oro
