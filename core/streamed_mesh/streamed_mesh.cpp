#include "core/streamed_mesh/streamed_mesh.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/base/parallel.h"

namespace oro {
namespace {

// No records that are written have more: those of 4,999,122 triangles have 1.9 MB.
constexpr std::uint64_t most_record_bytes = std::uint64_t{1} << 28U;

}  // namespace

bool StreamedMesh::is_in(const Container& container, std::uint32_t number) {
    return container.find(ChunkType::mesh_records, number) != nullptr &&
           container.find(ChunkType::mesh_payloads, number) != nullptr;
}

Result<std::shared_ptr<const StreamedMesh>> StreamedMesh::open(std::shared_ptr<const Container> container,
                                                               std::uint32_t number) {
    std::shared_ptr<StreamedMesh> mesh(new StreamedMesh);
    ORO_TRY(const Chunk records_chunk, container->chunk(ChunkType::mesh_records, number));
    ORO_TRY(mesh->payloads_chunk_, container->chunk(ChunkType::mesh_payloads, number));
    ORO_TRY(const std::vector<std::byte> bytes, container->read(records_chunk, most_record_bytes));
    if (const auto wrong = records_from_bytes(bytes, mesh->payloads_chunk_.bytes, mesh->records_))
        return container->file().damaged(records_chunk.offset, "the mesh " + *wrong);
    mesh->container_ = std::move(container), mesh->number_ = number;
    mesh->place_of_.assign(mesh->records_.payloads.size(), mesh->held_.end());
    return std::shared_ptr<const StreamedMesh>(std::move(mesh));
}

Result<StreamedMesh::Payload> StreamedMesh::read_one(std::uint32_t number) const {
    const MeshRecords::Payload& place = records_.payloads[number];
    const std::uint64_t offset = payloads_chunk_.offset + place.offset;
    std::vector<std::byte> bytes(place.bytes);
    ORO_CHECK(container_->file().read(offset, bytes));
    auto payload = std::make_shared<MeshPayload>();
    if (const auto wrong = payload_of_records(bytes, records_, number, *payload))
        return container_->file().damaged(offset, *wrong);
    return Payload(std::move(payload));
}

StreamedMesh::Payload StreamedMesh::find(std::uint32_t number) const {
    const std::lock_guard lock(mutex_);
    if (place_of_[number] == held_.end()) return nullptr;
    held_.splice(held_.begin(), held_, place_of_[number]);
    return held_.front().payload;
}

void StreamedMesh::let_go() const {
    while (done_.held_bytes > most_bytes_ && !held_.empty()) {
        done_.held_bytes -= held_.back().payload->held_bytes();
        place_of_[held_.back().number] = held_.end();
        held_.pop_back();
    }
}

void StreamedMesh::keep(std::uint32_t number, const Payload& payload) const {
    const std::lock_guard lock(mutex_);
    ++done_.payloads, done_.triangles += payload->triangles.size();
    done_.file_bytes += records_.payloads[number].bytes;
    if (place_of_[number] != held_.end()) return;  // another thread was as fast
    held_.push_front({number, payload});
    place_of_[number] = held_.begin();
    done_.held_bytes += payload->held_bytes();
    let_go();
    done_.most_held_bytes = std::max(done_.most_held_bytes, done_.held_bytes);
}

Result<std::vector<StreamedMesh::Payload>> StreamedMesh::read(std::span<const std::uint32_t> payloads,
                                                              int threads) const {
    std::vector<Payload> found(payloads.size());
    std::vector<std::optional<Error>> faults(payloads.size());
    std::vector<std::size_t> missing;
    for (std::size_t i = 0; i < payloads.size(); ++i)
        if (found[i] = find(payloads[i]); !found[i]) missing.push_back(i);
    in_parallel(static_cast<int>(missing.size()), threads, [&](int i) {
        const std::size_t at = missing[static_cast<std::size_t>(i)];
        Result<Payload> one = read_one(payloads[at]);
        if (one)
            found[at] = std::move(*one);
        else
            faults[at] = one.error();
    });
    for (const std::optional<Error>& fault : faults)
        if (fault) return *fault;
    for (const std::size_t at : missing) keep(payloads[at], found[at]);
    return found;
}

void StreamedMesh::hold_at_most(std::uint64_t bytes) const {
    const std::lock_guard lock(mutex_);
    most_bytes_ = bytes;
    let_go();
}

StreamedMesh::Done StreamedMesh::done() const {
    const std::lock_guard lock(mutex_);
    return done_;
}

}  // namespace oro
