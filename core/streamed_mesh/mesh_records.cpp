#include "core/streamed_mesh/mesh_records.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "core/base/checksum.h"
#include "core/base/little_endian.h"
#include "core/base/parallel.h"
#include "core/mesh_file/mesh_bytes.h"
#include "core/streamed_mesh/made_payload.h"

// The order of the bytes: RecordNumbers; groups of each level, 4 bytes each; of each leaf its triangles and
// its user; of each group its error, its sphere, what it made and where its payloads are; of versions 2 and 4
// the cells of the ground. Without ground the version is 1 or 3. Payloads of versions 2 and 4 are those of a
// town; those of 3 and 4 are told from below (PayloadForm).
namespace oro {
namespace {

constexpr std::uint32_t records_version = 1, latest_version = 4, most_record_levels = 80, most_used = 4096;
// What is added to the version.
constexpr std::uint32_t of_ground = 1, of_payloads_from_below = 2;
// Three new vertices, their colours and a label take less for each triangle.
constexpr std::uint32_t most_payload_bytes = 256 * most_used;

struct RecordNumbers {
    std::uint32_t version{records_version};
    LatticeSteps origin{}, least{};
    std::uint32_t triangles{}, labels{}, colours{}, leaves{}, clusters{}, levels{};
    std::uint64_t ground_fingerprint{};
};

template <class Visit>
void visit_record_numbers(Visit& visit, auto& numbers) {
    visit(numbers.version);
    for (auto& step : numbers.origin) visit(step);
    for (auto& step : numbers.least) visit(step);
    visit(numbers.triangles), visit(numbers.labels), visit(numbers.colours), visit(numbers.leaves);
    visit(numbers.clusters), visit(numbers.levels), visit(numbers.ground_fingerprint);
}

template <class Visit>
void visit_cluster(Visit& visit, auto& cluster) {
    auto triangles = static_cast<std::uint8_t>(cluster.triangles);
    visit(triangles), visit(cluster.used_by);
    if constexpr (!Visit::writes) cluster.triangles = triangles;
}

template <class Visit>
void visit_group(Visit& visit, auto& group) {
    visit(group.error_m);
    for (int axis = 0; axis < 3; ++axis) visit(group.centre.m[axis]);
    visit(group.radius_m), visit(group.made);
}

constexpr std::size_t bytes_of_a_cluster = 5, bytes_of_a_group = 44, bytes_of_a_place = 12;

template <class Visit>
void visit_payload(Visit& visit, auto& payload) {
    visit(payload.bytes), visit(payload.checksum);
}

std::string implausible_numbers(const RecordNumbers& numbers) {
    constexpr std::int64_t most_steps = 6600000LL * 2048;  // the Earth and 100 km around it
    if (numbers.version < records_version || numbers.version > latest_version)
        return "has records of version " + std::to_string(numbers.version) + ", expected 1 to 4";
    for (const LatticeSteps& at : {numbers.origin, numbers.least})
        for (const std::int64_t step : at)
            if (step < -2 * most_steps || step > most_steps) return "lies outside of the Earth";
    if (numbers.triangles == 0 || numbers.triangles > most_stored_triangles)
        return "has " + std::to_string(numbers.triangles) + " triangles, expected 1 to 100,000,000";
    if (numbers.levels == 0 || numbers.levels > most_record_levels)
        return "has " + std::to_string(numbers.levels) + " levels, expected 1 to 80";
    if (numbers.leaves == 0 || numbers.leaves > numbers.triangles || numbers.clusters < numbers.leaves ||
        numbers.clusters > most_graph_triangles)
        return "has " + std::to_string(numbers.clusters) + " clusters, which its triangles do not fill";
    if (numbers.labels > numbers.triangles + 1U + 2U * most_stored_triangles) return "has too many labels";
    if (numbers.colours > 1) return "has colours that are none";
    return "";
}

// Reads the graph from behind its numbers.
class RecordsReader {
  public:
    RecordsReader(NumberReader& reader, const RecordNumbers& numbers, MeshRecords& records)
        : reader_(reader), numbers_(numbers), records_(records) {}

    // "" where all is well.
    std::string read() {
        if (std::string wrong = levels(); !wrong.empty()) return wrong;
        for (std::uint32_t i = 0; i < numbers_.leaves; ++i)
            if (std::string wrong = cluster(no_group, 0); !wrong.empty()) return "has a leaf " + wrong;
        if (triangles_ != numbers_.triangles)
            return "has " + std::to_string(triangles_) + " triangles in its leaves, expected " +
                   std::to_string(numbers_.triangles);
        std::uint32_t first_group = 0;
        for (std::uint32_t level = 0; level < numbers_.levels; ++level) {
            for (std::uint32_t i = 0; i < groups_[level]; ++i)
                if (std::string wrong = group(level); !wrong.empty())
                    return "has a group " + std::to_string(first_group + i) + " " + wrong;
            first_group += groups_[level];
        }
        if (graph().clusters.size() != numbers_.clusters)
            return "has " + std::to_string(graph().clusters.size()) + " clusters, expected " +
                   std::to_string(numbers_.clusters);
        return find_members();
    }

  private:
    [[nodiscard]] ClusterGraph& graph() { return records_.graph.clusters; }
    std::string levels();
    std::string cluster(std::uint32_t made_by, std::uint32_t user_level);
    std::string group(std::uint32_t level);
    std::string find_members();
    std::string growth(std::uint32_t number);

    NumberReader& reader_;
    const RecordNumbers& numbers_;
    MeshRecords& records_;
    std::vector<std::uint32_t> groups_, first_of_level_;
    std::uint32_t triangles_{};
};

std::string RecordsReader::levels() {
    std::uint64_t all = 0;
    for (std::uint32_t i = 0; i < numbers_.levels; ++i) {
        std::uint32_t count = 0;
        reader_(count);
        if (count == 0 || count > numbers_.clusters)
            return "has a level of " + std::to_string(count) + " groups";
        first_of_level_.push_back(static_cast<std::uint32_t>(all));
        groups_.push_back(count);
        all += count;
    }
    first_of_level_.push_back(static_cast<std::uint32_t>(all));
    groups_.push_back(0);
    // Nothing is allocated for what the bytes do not hold.
    if (!reader_.has(numbers_.clusters, bytes_of_a_cluster) || !reader_.has(all, bytes_of_a_group))
        return "is cut off in its records";
    graph().clusters.reserve(numbers_.clusters);
    return "";
}

// user_level: of the groups that may use it.
std::string RecordsReader::cluster(std::uint32_t made_by, std::uint32_t user_level) {
    Cluster cluster{triangles_, 0, 0, made_by, no_group};
    visit_cluster(reader_, cluster);
    cluster.made_by = made_by;
    if (cluster.triangles == 0 || cluster.triangles > most_cluster_triangles)
        return "of " + std::to_string(cluster.triangles) + " triangles";
    const std::uint32_t first = first_of_level_[user_level], count = groups_[user_level];
    if (count == 0 ? cluster.used_by != no_group
                   : cluster.used_by < first || cluster.used_by - first >= count)
        return "whose clusters a group of another level uses";
    if (cluster.triangles > most_graph_triangles - triangles_) return "of too many triangles";
    triangles_ += cluster.triangles;
    graph().clusters.push_back(cluster);
    return "";
}

std::string RecordsReader::group(std::uint32_t level) {
    ClusterGroup group{};
    group.level = level + 1, group.complete = true;
    visit_group(reader_, group);
    group.first_made = static_cast<std::uint32_t>(graph().clusters.size());
    constexpr double most_m = 1.0e7;
    if (!std::isfinite(group.error_m) || group.error_m < 0.0 || group.error_m > most_m)
        return "with an error that is none";
    if (!(glm::length(group.centre.m) <= 2.0 * most_m) || !(group.radius_m > 0.0) || group.radius_m > most_m)
        return "around a place that is none";
    if (group.made > numbers_.clusters - graph().clusters.size()) return "of more clusters than it states";
    const auto number = static_cast<std::uint32_t>(graph().groups.size());
    for (std::uint32_t i = 0; i < group.made; ++i)
        if (std::string wrong = cluster(number, level + 1); !wrong.empty()) return wrong;
    graph().groups.push_back(group);
    return "";
}

// Errors and spheres of a group beside those of the groups below it.
std::string RecordsReader::growth(std::uint32_t number) {
    const ClusterGroup& group = graph().groups[number];
    const std::string name = "has a group " + std::to_string(number) + " ";
    if (group.error_m < largest_member_error_m(graph(), group))
        return name + "with a smaller error than one below it";
    std::size_t used = 0, made = 0;
    for (const std::uint32_t member : graph().members_of(group)) {
        const Cluster& cluster = graph().clusters[member];
        used += cluster.triangles;
        if (cluster.made_by == no_group) continue;
        const ClusterGroup& below = graph().groups[cluster.made_by];
        if (glm::distance(group.centre.m, below.centre.m) + below.radius_m > group.radius_m)
            return name + "whose sphere does not hold that of one below it";
    }
    for (std::uint32_t i = 0; i < group.made; ++i) made += graph().clusters[group.first_made + i].triangles;
    if (used == 0 || used > most_used)
        return name + "of " + std::to_string(used) + " triangles, expected 1 to 4,096";
    if (made > used) return name + "that makes more triangles than it uses";
    GraphLevel& facts = graph().levels[group.level - 1];
    ++facts.groups, facts.triangles_in += used, facts.triangles_out += made;
    facts.clusters_out += group.made;
    facts.largest_group = std::max(facts.largest_group, used);
    facts.stuck_groups += static_cast<double>(made) > stuck_share * static_cast<double>(used) ? 1U : 0U;
    facts.largest_error_m = std::max(facts.largest_error_m, group.error_m);
    return "";
}

// What each group uses, in the order of the clusters' numbers.
std::string RecordsReader::find_members() {
    ClusterGraph& all = graph();
    for (const Cluster& cluster : all.clusters)
        if (cluster.used_by != no_group) ++all.groups[cluster.used_by].members;
    std::uint32_t first = 0;
    for (ClusterGroup& group : all.groups) group.first_member = first, first += group.members;
    all.members.resize(first);
    std::vector<std::uint32_t> next;
    for (const ClusterGroup& group : all.groups) next.push_back(group.first_member);
    for (std::uint32_t i = 0; i < all.clusters.size(); ++i)
        if (all.clusters[i].used_by != no_group) all.members[next[all.clusters[i].used_by]++] = i;
    all.levels.resize(numbers_.levels);
    for (std::uint32_t i = 0; i < all.groups.size(); ++i)
        if (std::string wrong = growth(i); !wrong.empty()) return wrong;
    return "";
}

std::vector<std::uint32_t> triangles_of_clusters(const MeshRecords& records, std::uint32_t payload) {
    std::vector<std::uint32_t> counts;
    for (const std::uint32_t cluster : records.clusters_of(payload))
        counts.push_back(records.graph.clusters.clusters[cluster].triangles);
    return counts;
}

// clusters: as triangles_of_clusters() has them.
PayloadShape shape_of(const MeshRecords& records, std::span<const std::uint32_t> clusters) {
    return {records.least, records.label_count, records.has_colours, clusters, records.is_town()};
}

// The triangles of some clusters by themselves.
MeshPayload payload_in(const StoredMeshView& mesh, std::span<const VertexColour> colours,
                       std::span<const std::uint32_t> clusters) {
    MeshPayload payload;
    std::vector<std::pair<std::uint32_t, std::uint16_t>>
        known;  // vertices of the mesh, and their numbers here
    std::vector<std::uint32_t> corners;
    for (const std::uint32_t one : clusters)
        for (const VertexTriangle& triangle : mesh.triangles_of(mesh.clusters.clusters[one]))
            corners.insert(corners.end(), triangle.begin(), triangle.end());
    std::vector<std::uint32_t> vertices = corners;
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    constexpr std::uint32_t not_met = ~std::uint32_t{0};
    std::vector<std::uint32_t> number(vertices.size(), not_met);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const auto at =
            static_cast<std::size_t>(std::ranges::lower_bound(vertices, corners[i]) - vertices.begin());
        if (number[at] == not_met) {
            number[at] = static_cast<std::uint32_t>(payload.places.size());
            payload.places.push_back(mesh.places[corners[i]]);
            if (!colours.empty()) payload.colours.push_back(colours[corners[i]]);
        }
        if (i % 3 == 0) payload.triangles.emplace_back();
        payload.triangles.back()[i % 3] = static_cast<std::uint16_t>(number[at]);
    }
    if (mesh.label_count > 0)
        for (const std::uint32_t one : clusters) {
            const Cluster& cluster = mesh.clusters.clusters[one];
            for (std::uint32_t i = 0; i < cluster.triangles; ++i)
                payload.labels.push_back(mesh.labels[mesh.original_of[cluster.first_triangle + i]]);
        }
    return payload;
}

// What a group made, told by what it uses.
std::vector<std::byte> bytes_of_made(const StoredMeshView& mesh, const ClusterGroup& group) {
    std::vector<std::uint32_t> vertices;
    const auto members = mesh.clusters.members_of(group);
    for (const std::uint32_t one : members)
        for (const VertexTriangle& triangle : mesh.triangles_of(mesh.clusters.clusters[one]))
            vertices.insert(vertices.end(), triangle.begin(), triangle.end());
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    const auto numbered = [&](const VertexTriangle& triangle) {
        GroupMaps::Triangle here{};
        for (std::size_t k = 0; k < 3; ++k)
            here[k] = static_cast<std::uint32_t>(std::ranges::lower_bound(vertices, triangle[k]) -
                                                 vertices.begin());
        return here;
    };
    std::vector<GroupMaps::Triangle> used;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> numbers;  // in `used`, by the mesh's triangles
    for (const std::uint32_t one : members) {
        const Cluster& cluster = mesh.clusters.clusters[one];
        for (std::uint32_t i = cluster.first_triangle; i < cluster.first_triangle + cluster.triangles; ++i) {
            numbers.emplace_back(mesh.original_of[i], static_cast<std::uint32_t>(used.size()));
            used.push_back(numbered(mesh.triangles[i]));
        }
    }
    std::ranges::sort(numbers);
    std::vector<GroupMaps::Left> left;
    for (std::uint32_t made = 0; made < group.made; ++made) {
        const Cluster& cluster = mesh.clusters.clusters[group.first_made + made];
        for (std::uint32_t i = cluster.first_triangle; i < cluster.first_triangle + cluster.triangles; ++i) {
            const auto found = std::ranges::lower_bound(numbers, std::pair{mesh.original_of[i], 0U});
            if (found == numbers.end() || found->first != mesh.original_of[i]) return {};
            left.push_back({found->second, numbered(mesh.triangles[i]), made});
        }
    }
    std::ranges::sort(left, {}, &GroupMaps::Left::number);
    return made_to_bytes(used, group.made, std::move(left));
}

std::vector<std::byte> bytes_of_payload(const StoredMeshView& mesh, std::span<const VertexColour> colours,
                                        const MeshRecords& records, std::uint32_t number) {
    if (records.levels_below(number) > 0) return bytes_of_made(mesh, records.group_around(number));
    const std::vector<std::uint32_t> counts = triangles_of_clusters(records, number);
    return payload_to_bytes(shape_of(records, counts),
                            payload_in(mesh, colours, records.clusters_of(number)));
}

// What the group of a payload uses. sources: as sources_of() has them.
MeshPayload used_for(const MeshRecords& records, std::uint32_t payload,
                     std::span<const MeshPayload* const> sources) {
    const std::vector<std::uint32_t> numbers = records.sources_of(payload);
    JoinedPayload used;
    for (const std::uint32_t one : records.graph.clusters.members_of(records.group_around(payload))) {
        const Cluster& cluster = records.graph.clusters.clusters[one];
        const auto at = std::ranges::lower_bound(numbers, records.payload_of(cluster)) - numbers.begin();
        used.add(*sources[static_cast<std::size_t>(at)], records.first_in_payload(one), cluster.triangles);
    }
    return used.payload();
}

// A stored mesh's records, without where its payloads lie.
MeshRecords records_of(const StoredMeshView& mesh, bool has_colours) {
    MeshRecords records;
    records.origin = mesh.origin, records.label_count = mesh.label_count;
    records.has_colours = has_colours, records.ground_fingerprint = mesh.ground_fingerprint;
    constexpr std::int64_t far = std::numeric_limits<std::int64_t>::max();
    records.least = {far, far, far};
    for (const LatticeSteps& at : mesh.places)
        for (std::size_t i = 0; i < 3; ++i) records.least[i] = std::min(records.least[i], at[i]);
    ClusterGraph& graph = records.graph.clusters;
    graph.clusters = mesh.clusters.clusters, graph.groups = mesh.clusters.groups;
    graph.members = mesh.clusters.members, graph.levels = mesh.clusters.levels;
    for (const Cluster& cluster : graph.clusters) {
        if (cluster.made_by != no_group) break;
        records.triangles += cluster.triangles;
    }
    records.payloads.resize(graph.groups.size() + graph.levels.front().groups);
    return records;
}

std::vector<std::byte> bytes_of_records(const MeshRecords& records) {
    const ClusterGraph& graph = records.graph.clusters;
    RecordNumbers numbers;
    const bool has_cells = records.is_town();
    if (has_cells) numbers.version += of_ground;
    if (records.form == PayloadForm::from_below) numbers.version += of_payloads_from_below;
    numbers.origin = records.origin, numbers.least = records.least;
    numbers.triangles = records.triangles, numbers.labels = records.label_count;
    numbers.colours = records.has_colours ? 1 : 0;
    numbers.clusters = static_cast<std::uint32_t>(graph.clusters.size());
    numbers.levels = static_cast<std::uint32_t>(graph.levels.size());
    numbers.ground_fingerprint = records.ground_fingerprint;
    for (const Cluster& cluster : graph.clusters) numbers.leaves += cluster.made_by == no_group ? 1U : 0U;
    NumberWriter writer;
    visit_record_numbers(writer, numbers);
    for (const GraphLevel& level : graph.levels) writer(static_cast<std::uint32_t>(level.groups));
    for (std::uint32_t i = 0; i < numbers.leaves; ++i) visit_cluster(writer, graph.clusters[i]);
    for (const ClusterGroup& group : graph.groups) {
        visit_group(writer, group);
        for (std::uint32_t i = 0; i < group.made; ++i)
            visit_cluster(writer, graph.clusters[group.first_made + i]);
    }
    for (const MeshRecords::Payload& payload : records.payloads) visit_payload(writer, payload);
    if (has_cells) {
        const std::vector<std::byte> cells = ground_cells_to_bytes(records.ground_cells);
        writer.bytes.insert(writer.bytes.end(), cells.begin(), cells.end());
    }
    return std::move(writer.bytes);
}

}  // namespace

std::vector<std::uint32_t> MeshRecords::clusters_of(std::uint32_t payload) const {
    const ClusterGroup& group = group_around(payload);
    std::vector<std::uint32_t> numbers;
    if (payload < leaf_payloads()) {
        const auto members = graph.clusters.members_of(group);
        numbers.assign(members.begin(), members.end());
    } else {
        for (std::uint32_t i = 0; i < group.made; ++i) numbers.push_back(group.first_made + i);
    }
    return numbers;
}

std::size_t MeshRecords::first_in_payload(std::uint32_t cluster) const {
    std::size_t first = 0;
    for (const std::uint32_t one : clusters_of(payload_of(graph.clusters.clusters[cluster]))) {
        if (one == cluster) break;
        first += graph.clusters.clusters[one].triangles;
    }
    return first;
}

std::vector<std::uint32_t> MeshRecords::sources_of(std::uint32_t payload) const {
    std::vector<std::uint32_t> sources;
    if (levels_below(payload) == 0) return sources;
    for (const std::uint32_t member : graph.clusters.members_of(group_around(payload)))
        sources.push_back(payload_of(graph.clusters.clusters[member]));
    std::ranges::sort(sources);
    sources.erase(std::unique(sources.begin(), sources.end()), sources.end());
    return sources;
}

StreamedBytes streamed_bytes_of(const StoredMeshView& mesh, std::span<const VertexColour> colours,
                                int threads, const GroundCells* cells, ScratchMemory* scratch,
                                PayloadForm form) {
    StreamedBytes bytes{{}, std::pmr::vector<std::byte>(array_memory(scratch))};
    MeshRecords records = records_of(mesh, !colours.empty());
    if (cells != nullptr) records.ground_cells = *cells;
    records.form = form;
    const auto count = static_cast<std::uint32_t>(records.payloads.size());
    constexpr std::uint32_t at_a_time = 256;
    for (std::uint32_t first = 0; first < count; first += at_a_time) {
        const std::uint32_t some = std::min(at_a_time, count - first);
        std::vector<std::vector<std::byte>> coded(some);
        in_parallel(static_cast<int>(some), threads, [&](int i) {
            const std::uint32_t number = first + static_cast<std::uint32_t>(i);
            coded[static_cast<std::size_t>(i)] = bytes_of_payload(mesh, colours, records, number);
        });
        for (std::uint32_t i = 0; i < some; ++i) {
            records.payloads[first + i] = {bytes.payloads.size(), static_cast<std::uint32_t>(coded[i].size()),
                                           xxh64(coded[i], first + i)};
            bytes.payloads.insert(bytes.payloads.end(), coded[i].begin(), coded[i].end());
        }
        if (scratch != nullptr) scratch->drop_pages();
    }
    bytes.records = bytes_of_records(records);
    return bytes;
}

std::optional<std::string> records_from_bytes(std::span<const std::byte> bytes, std::uint64_t payload_bytes,
                                              MeshRecords& records) {
    records = {};
    NumberReader reader(bytes);
    RecordNumbers numbers;
    visit_record_numbers(reader, numbers);
    if (std::string wrong = implausible_numbers(numbers); !wrong.empty()) return wrong;
    records.origin = numbers.origin, records.least = numbers.least;
    records.triangles = numbers.triangles, records.label_count = numbers.labels;
    records.has_colours = numbers.colours != 0, records.ground_fingerprint = numbers.ground_fingerprint;
    records.form = ((numbers.version - records_version) & of_payloads_from_below) != 0
                       ? PayloadForm::from_below
                       : PayloadForm::alone;
    if (std::string wrong = RecordsReader(reader, numbers, records).read(); !wrong.empty()) return wrong;
    const ClusterGraph& graph = records.graph.clusters;
    const std::size_t count = graph.groups.size() + graph.levels.front().groups;
    if (!reader.has(count, bytes_of_a_place)) return "is cut off in its records";
    records.payloads.resize(count);
    std::uint64_t offset = 0;
    for (MeshRecords::Payload& payload : records.payloads) {
        visit_payload(reader, payload);
        if (payload.bytes > most_payload_bytes)
            return "has a group of " + std::to_string(payload.bytes) + " bytes, expected 1,048,576 at most";
        payload.offset = offset;
        offset += payload.bytes;
    }
    const bool has_cells = ((numbers.version - records_version) & of_ground) != 0;
    if (has_cells != (numbers.ground_fingerprint != 0)) return "has ground without a place";
    if (has_cells) {
        if (auto wrong = ground_cells_from_bytes(reader.rest(), records.ground_cells)) return wrong;
    } else if (reader.is_wrong()) {
        return "has records that go on after their last group, or are cut off";
    }
    if (offset != payload_bytes)
        return "has groups of " + std::to_string(offset) + " bytes, and the file has " +
               std::to_string(payload_bytes);
    return std::nullopt;
}

std::optional<std::string> payload_of_records(std::span<const std::byte> bytes, const MeshRecords& records,
                                              std::uint32_t number,
                                              std::span<const MeshPayload* const> sources,
                                              MeshPayload& payload) {
    const std::uint32_t leaves = records.leaf_payloads();
    const std::string name = number < leaves
                                 ? "level 0 below group " + std::to_string(number) + " of the mesh "
                                 : "group " + std::to_string(number - leaves) + " of the mesh ";
    if (xxh64(bytes, number) != records.payloads[number].checksum)
        return name + other_checksum(xxh64(bytes, number), records.payloads[number].checksum);
    const std::vector<std::uint32_t> counts = triangles_of_clusters(records, number);
    const auto wrong = records.levels_below(number) > 0
                           ? made_from_bytes(bytes, used_for(records, number, sources), counts, payload)
                           : payload_from_bytes(bytes, shape_of(records, counts), payload);
    if (wrong) return name + *wrong;
    const ClusterGroup& group = records.group_around(number);
    constexpr double rounded_m = 1.0e-6;
    for (const LatticeSteps& at : payload.places) {
        const glm::dvec3 place_m =
            glm::dvec3(static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])) /
            lattice_steps_per_m;
        if (glm::distance(place_m, group.centre.m) > group.radius_m + rounded_m)
            return name + "lies outside of its sphere";
    }
    return std::nullopt;
}

}  // namespace oro
