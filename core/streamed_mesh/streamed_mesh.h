// A mesh of a file whose triangles are read group by group, as they are asked for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/base/container.h"
#include "core/base/result.h"
#include "core/mesh_file/mesh_leaves.h"
#include "core/streamed_mesh/mesh_records.h"

namespace oro {

// Opening reads the records alone. Payloads that were read stay as long as all together take no more than
// they may; those least recently asked for give way first. For any number of threads at once.
class StreamedMesh {
  public:
    using Payload = std::shared_ptr<const MeshPayload>;

    // The mesh of that number in a file. Errors: it has no such mesh; damage; records that are none.
    static Result<std::shared_ptr<const StreamedMesh>> open(std::shared_ptr<const Container> container,
                                                            std::uint32_t number);
    // Whether a file has that mesh group by group.
    [[nodiscard]] static bool is_in(const Container& container, std::uint32_t number);

    [[nodiscard]] const MeshRecords& records() const { return records_; }
    [[nodiscard]] const Container& container() const { return *container_; }
    [[nodiscard]] std::uint32_t number() const { return number_; }

    // Payloads by their numbers (MeshRecords); those that they are told by are read for it, too. The result,
    // and the error of several, do not depend on `threads`. Errors: damage, with the file and the byte; those
    // of reading.
    [[nodiscard]] Result<std::vector<Payload>> read(std::span<const std::uint32_t> payloads,
                                                    int threads) const;
    // The triangles of the mesh itself. Errors: as read().
    [[nodiscard]] Result<MeshLeaves> leaves(int threads) const;
    // Bytes of memory that payloads may take between calls.
    void hold_at_most(std::uint64_t bytes) const;

    // What was done since it was opened.
    struct Done {
        std::uint64_t payloads{};    // read and decoded, each time that it was
        std::uint64_t triangles{};   // in these
        std::uint64_t file_bytes{};  // of these, without the records
        std::uint64_t held_bytes{};  // by payloads now
        std::uint64_t most_held_bytes{};
    };
    [[nodiscard]] Done done() const;

    static constexpr std::uint64_t usual_bytes = 32'000'000;

  private:
    StreamedMesh() = default;
    struct Held {
        std::uint32_t number;
        Payload payload;
    };
    // By their numbers.
    using Payloads = std::unordered_map<std::uint32_t, Payload>;
    [[nodiscard]] Result<Payload> read_one(std::uint32_t number, const Payloads& known) const;
    [[nodiscard]] Result<void> read_into(Payloads& known, std::vector<std::uint32_t> missing,
                                         int threads) const;
    [[nodiscard]] std::vector<std::uint32_t> missing_below(std::span<const std::uint32_t> payloads,
                                                           Payloads& known) const;
    [[nodiscard]] Payload find(std::uint32_t number) const;
    void keep(std::uint32_t number, const Payload& payload) const;
    void let_go() const;

    std::shared_ptr<const Container> container_;
    std::uint32_t number_{};
    Chunk payloads_chunk_{};
    MeshRecords records_;
    mutable std::mutex mutex_;                                 // of all that follows
    mutable std::list<Held> held_;                             // last asked for first
    mutable std::vector<std::list<Held>::iterator> place_of_;  // by payload; the end: it is not held
    mutable std::uint64_t most_bytes_{usual_bytes};
    mutable Done done_;
};

}  // namespace oro
