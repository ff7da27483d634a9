#include "render/pipelines/shading_pipelines.h"

#include <array>
#include <cstddef>
#include <span>

#include "spirv/air_table_0_comp.h"
#include "spirv/air_table_1_comp.h"
#include "spirv/air_table_2_comp.h"
#include "spirv/air_table_3_comp.h"
#include "spirv/air_table_4_comp.h"
#include "spirv/air_table_5_comp.h"
#include "spirv/caster_heights_comp.h"
#include "spirv/edges_clusters_comp.h"
#include "spirv/edges_comp.h"
#include "spirv/join_shares_comp.h"
#include "spirv/list_shares_comp.h"
#include "spirv/list_shares_grids_comp.h"
#include "spirv/openness_comp.h"
#include "spirv/places_comp.h"
#include "spirv/places_net_comp.h"
#include "spirv/shade_air_clusters_comp.h"
#include "spirv/shade_air_comp.h"
#include "spirv/shade_air_net_comp.h"
#include "spirv/shade_clusters_comp.h"
#include "spirv/shade_comp.h"
#include "spirv/shade_map_clusters_comp.h"
#include "spirv/shade_map_comp.h"
#include "spirv/shade_map_net_comp.h"
#include "spirv/shade_net_comp.h"
#include "spirv/shares_clusters_comp.h"
#include "spirv/shares_comp.h"
#include "spirv/shares_grids_comp.h"
#include "spirv/shares_grids_net_comp.h"
#include "spirv/shares_net_comp.h"
#include "spirv/texture_tile_feedback_clusters_comp.h"
#include "spirv/texture_tile_feedback_comp.h"

namespace oro {
namespace {

VkBool32 flag(bool on) {
    return on ? VK_TRUE : VK_FALSE;
}

std::span<const std::uint32_t> shade_words(const ShadingKind& kind) {
    using Words = std::span<const std::uint32_t>;
    if (kind.on_clusters)
        return kind.in_air   ? Words(shade_air_clusters_comp_spirv)
               : kind.as_map ? Words(shade_map_clusters_comp_spirv)
                             : Words(shade_clusters_comp_spirv);
    if (kind.in_air) return kind.on_net ? Words(shade_air_net_comp_spirv) : Words(shade_air_comp_spirv);
    if (kind.as_map) return kind.on_net ? Words(shade_map_net_comp_spirv) : Words(shade_map_comp_spirv);
    return kind.on_net ? Words(shade_net_comp_spirv) : Words(shade_comp_spirv);
}

}  // namespace

ShadingKind shading_of(const gpu::FrameStyle& style) {
    ShadingKind kind;
    kind.in_air = style.air.on != 0;
    kind.of_materials = kind.in_air && style.materials.on != 0;
    kind.as_map = !kind.in_air &&
                  (style.colour_by != gpu::colour_by_height || style.tints_as_codes != 0 ||
                   style.light != gpu::light_sun || style.is_map != 0 || style.contours.interval_m > 0.0F);
    return kind;
}

Result<VkPipeline> shading_for(const Gpu& gpu, RasterPath path, const ShadingKind& kind,
                               Pipelines& pipelines) {
    OwnedPipeline& shade = pipelines.shades[kind];
    if (shade) return shade.get();
    // By constant_id of shade.comp.
    const std::array<VkBool32, 9> values{flag(path == RasterPath::compute),
                                         flag(kind.casts),
                                         flag(kind.opens),
                                         flag(kind.draped),
                                         flag(kind.by_means),
                                         flag(kind.edges_follow),
                                         flag(kind.parts_follow),
                                         flag(kind.parts_alone),
                                         flag(kind.of_materials)};
    std::array<VkSpecializationMapEntry, values.size()> entries{};
    for (std::uint32_t i = 0; i < entries.size(); ++i)
        entries[i] = {i, i * std::uint32_t{sizeof(VkBool32)}, sizeof(VkBool32)};
    const VkSpecializationInfo constants{entries.size(), entries.data(), sizeof(values), values.data()};
    ORO_TRY(shade, create_compute_pipeline(gpu, pipelines, shade_words(kind), "shade", &constants,
                                           VK_PIPELINE_CREATE_DISPATCH_BASE_BIT));
    return shade.get();
}

Result<VkPipeline> edges_for(const Gpu& gpu, RasterPath path, const ShadingKind& kind, Pipelines& pipelines) {
    OwnedPipeline& edges = pipelines.edges[(kind.on_clusters ? 2U : 0U) + (kind.in_air ? 1U : 0U)];
    if (edges) return edges.get();
    // By constant_id of edges.comp.
    const std::array<VkBool32, 2> values{flag(path == RasterPath::compute), flag(kind.in_air)};
    const std::array<VkSpecializationMapEntry, 2> entries{
        {{0, 0, sizeof(values[0])}, {2, sizeof(values[0]), sizeof(values[1])}}};
    const VkSpecializationInfo constants{entries.size(), entries.data(), sizeof(values), values.data()};
    const std::span<const std::uint32_t> words =
        kind.on_clusters ? std::span<const std::uint32_t>(edges_clusters_comp_spirv) : edges_comp_spirv;
    ORO_TRY(edges, create_compute_pipeline(gpu, pipelines, words, "smooth edges", &constants,
                                           VK_PIPELINE_CREATE_DISPATCH_BASE_BIT));
    return edges.get();
}

Result<void> add_air_pipelines(const Gpu& gpu, Pipelines& pipelines) {
    using Words = std::span<const std::uint32_t>;
    const std::array<Words, 6> words{air_table_0_comp_spirv, air_table_1_comp_spirv, air_table_2_comp_spirv,
                                     air_table_3_comp_spirv, air_table_4_comp_spirv, air_table_5_comp_spirv};
    for (std::size_t table = 0; table < words.size(); ++table) {
        if (pipelines.air[table]) continue;
        ORO_TRY(pipelines.air[table], create_compute_pipeline(gpu, pipelines, words[table], "air tables"));
    }
    return {};
}

bool shades_as_gpu(const Gpu& gpu, bool asked) {
    return asked || gpu.report().kind != VK_PHYSICAL_DEVICE_TYPE_CPU;
}

std::array<std::size_t, 3> share_programs(const ShareOptions& how) {
    return how.both_turns_in_one ? std::array<std::size_t, 3>{2, 3, 2} : std::array<std::size_t, 3>{0, 4, 1};
}

namespace {

// shares.comp by `does`, then list_shares.comp by square and by group.
struct ShareWords {
    std::span<const std::uint32_t> lines, lists;
};
Result<void> make_share_pipelines(const Gpu& gpu, const ShareOptions& how, const ShareWords& words,
                                  const Pipelines& pipelines, std::array<OwnedPipeline, 5>& shares) {
    constexpr std::size_t first_list = 3;
    for (const std::size_t program : share_programs(how)) {
        if (shares[program]) continue;
        const bool lists = program >= first_list;
        const std::array<std::uint32_t, 2> values{
            flag(how.path == RasterPath::compute),
            static_cast<std::uint32_t>(lists ? program - first_list : program)};
        const std::array<VkSpecializationMapEntry, 2> entries{
            {{0, 0, sizeof(values[0])}, {1, sizeof(values[0]), sizeof(values[1])}}};
        const VkSpecializationInfo constants{entries.size(), entries.data(), sizeof(values), values.data()};
        ORO_TRY(shares[program],
                create_compute_pipeline(gpu, pipelines, lists ? words.lists : words.lines,
                                        lists ? "list of sun shares" : "sun shares", &constants));
    }
    return {};
}

}  // namespace

Result<void> add_cast_pipelines(const Gpu& gpu, Pipelines& pipelines) {
    if (!pipelines.caster_heights) {
        ORO_TRY(pipelines.caster_heights,
                create_compute_pipeline(gpu, pipelines, caster_heights_comp_spirv, "caster heights"));
    }
    if (!pipelines.openness) {
        ORO_TRY(pipelines.openness,
                create_compute_pipeline(gpu, pipelines, openness_comp_spirv, "sky openness"));
    }
    return {};
}

Result<void> add_share_pipelines(const Gpu& gpu, const ShareOptions& how, bool on_net, bool on_clusters,
                                 Pipelines& pipelines) {
    const std::span<const std::uint32_t> words =
        on_clusters ? std::span<const std::uint32_t>(shares_clusters_comp_spirv)
        : on_net    ? std::span<const std::uint32_t>(shares_net_comp_spirv)
                    : std::span<const std::uint32_t>(shares_comp_spirv);
    return make_share_pipelines(gpu, how, {words, list_shares_comp_spirv}, pipelines,
                                pipelines.sun_shares[on_clusters ? 2
                                                     : on_net    ? 1
                                                                 : 0]);
}

Result<void> add_joined_pipelines(const Gpu& gpu, const ShareOptions& how, bool on_net, bool casts,
                                  Pipelines& pipelines) {
    using Words = std::span<const std::uint32_t>;
    const std::size_t number = on_net ? 1 : 0;
    if (!pipelines.cast_places[number]) {
        const VkBool32 from_compute = flag(how.path == RasterPath::compute);
        const VkSpecializationMapEntry entry{0, 0, sizeof(from_compute)};
        const VkSpecializationInfo constants{1, &entry, sizeof(from_compute), &from_compute};
        ORO_TRY(pipelines.cast_places[number],
                create_compute_pipeline(gpu, pipelines,
                                        on_net ? Words(places_net_comp_spirv) : Words(places_comp_spirv),
                                        "places in shadow", &constants));
    }
    if (!pipelines.join_shares) {
        ORO_TRY(pipelines.join_shares,
                create_compute_pipeline(gpu, pipelines, join_shares_comp_spirv, "join sun shares"));
    }
    if (!casts) return {};
    return make_share_pipelines(gpu, how,
                                {on_net ? Words(shares_grids_net_comp_spirv) : Words(shares_grids_comp_spirv),
                                 list_shares_grids_comp_spirv},
                                pipelines, pipelines.joined_shares[number]);
}

Result<void> add_drape_pipelines(const Gpu& gpu, RasterPath path, bool on_clusters, Pipelines& pipelines) {
    OwnedPipeline& wants = pipelines.texture_tile_feedback[on_clusters ? 1 : 0];
    if (wants) return {};
    const VkBool32 from_compute = flag(path == RasterPath::compute);
    const VkSpecializationMapEntry entry{0, 0, sizeof(from_compute)};
    const VkSpecializationInfo constants{1, &entry, sizeof(from_compute), &from_compute};
    const std::span<const std::uint32_t> words =
        on_clusters ? std::span<const std::uint32_t>(texture_tile_feedback_clusters_comp_spirv)
                    : texture_tile_feedback_comp_spirv;
    ORO_TRY(wants, create_compute_pipeline(gpu, pipelines, words, "wanted image tiles", &constants));
    return {};
}

}  // namespace oro
