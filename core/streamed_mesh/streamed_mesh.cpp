#include "core/streamed_mesh/streamed_mesh.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "core/base/parallel.h"
#include "core/streamed_mesh/joined_leaves.h"

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

// known: has what it is told by.
Result<StreamedMesh::Payload> StreamedMesh::read_one(std::uint32_t number, const Payloads& known) const {
    const MeshRecords::Payload& place = records_.payloads[number];
    const std::uint64_t offset = payloads_chunk_.offset + place.offset;
    std::vector<std::byte> bytes(place.bytes);
    ORO_CHECK(container_->file().read(offset, bytes));
    std::vector<const MeshPayload*> sources;
    for (const std::uint32_t one : records_.sources_of(number)) sources.push_back(known.at(one).get());
    auto payload = std::make_shared<MeshPayload>();
    if (const auto wrong = payload_of_records(bytes, records_, number, sources, *payload))
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

// What these are told by and is not known; what is held becomes known.
std::vector<std::uint32_t> StreamedMesh::missing_below(std::span<const std::uint32_t> payloads,
                                                       Payloads& known) const {
    std::vector<std::uint32_t> missing;
    for (const std::uint32_t payload : payloads)
        for (const std::uint32_t source : records_.sources_of(payload)) {
            const auto [place, is_new] = known.try_emplace(source);
            if (is_new && !(place->second = find(source))) missing.push_back(source);
        }
    std::ranges::sort(missing);
    return missing;
}

// missing: told by as many levels of others, which are read before them.
Result<void> StreamedMesh::read_into(Payloads& known, std::vector<std::uint32_t> missing, int threads) const {
    if (missing.empty()) return {};
    ORO_CHECK(read_into(known, missing_below(missing, known), threads));
    std::vector<Payload> found(missing.size());
    std::vector<std::optional<Error>> faults(missing.size());
    in_parallel(static_cast<int>(missing.size()), threads, [&](int i) {
        const auto at = static_cast<std::size_t>(i);
        Result<Payload> one = read_one(missing[at], known);
        if (one)
            found[at] = std::move(*one);
        else
            faults[at] = one.error();
    });
    for (const std::optional<Error>& fault : faults)
        if (fault) return *fault;
    for (std::size_t i = 0; i < missing.size(); ++i) {
        known[missing[i]] = found[i];
        keep(missing[i], found[i]);
    }
    return {};
}

Result<std::vector<StreamedMesh::Payload>> StreamedMesh::read(std::span<const std::uint32_t> payloads,
                                                              int threads) const {
    std::vector<Payload> found(payloads.size());
    std::vector<std::size_t> missing;
    for (std::size_t i = 0; i < payloads.size(); ++i)
        if (found[i] = find(payloads[i]); !found[i]) missing.push_back(i);
    // What they are told by is in memory for so many at a time.
    constexpr std::size_t at_a_time = 256;
    for (std::size_t first = 0; first < missing.size(); first += at_a_time) {
        const auto some = std::span(missing).subspan(first, std::min(at_a_time, missing.size() - first));
        Payloads known;
        constexpr std::uint32_t most_levels_below = 2;
        for (std::uint32_t below = 0; below <= most_levels_below; ++below) {
            std::vector<std::uint32_t> numbers;
            for (const std::size_t at : some)
                if (records_.levels_below(payloads[at]) == below && !known.contains(payloads[at]))
                    numbers.push_back(payloads[at]);
            std::ranges::sort(numbers);
            numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
            ORO_CHECK(read_into(known, std::move(numbers), threads));
        }
        for (const std::size_t at : some) found[at] = known.at(payloads[at]);
    }
    return found;
}

Result<MeshLeaves> StreamedMesh::leaves(int threads) const {
    const ClusterGraph& graph = records_.graph.clusters;
    const auto leaves = static_cast<std::size_t>(
        std::ranges::find_if(graph.clusters, [](const Cluster& one) { return one.made_by != no_group; }) -
        graph.clusters.begin());
    JoinedLeaves joined(leaves, records_.label_count > 0);
    constexpr std::uint32_t at_a_time = 256;
    for (std::uint32_t first = 0; first < records_.leaf_payloads(); first += at_a_time) {
        std::vector<std::uint32_t> numbers(std::min(at_a_time, records_.leaf_payloads() - first));
        std::iota(numbers.begin(), numbers.end(), first);
        ORO_TRY(const std::vector<Payload> payloads, read(numbers, threads));
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            std::size_t at = 0;
            for (const std::uint32_t one : records_.clusters_of(numbers[i])) {
                joined.add(one, *payloads[i], at, graph.clusters[one].triangles);
                at += graph.clusters[one].triangles;
            }
        }
    }
    return joined.take();
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
