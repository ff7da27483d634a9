// The structs of shaders/shared.h lie in memory as the compiled shaders expect: SPIR-V's member offsets
// against offsetof.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "shaders/shared.h"
#include "spirv/caster_heights_comp.h"
#include "spirv/choose_clusters_comp.h"
#include "spirv/cluster_raster_comp.h"
#include "spirv/live_pages_comp.h"
#include "spirv/places_comp.h"
#include "spirv/raster_comp.h"
#include "spirv/raster_large_comp.h"
#include "spirv/shade_air_comp.h"
#include "spirv/shade_comp.h"
#include "spirv/shade_map_comp.h"
#include "spirv/shade_net_comp.h"
#include "spirv/terrain_mesh.h"
#include "spirv/terrain_task.h"
#include "spirv/texture_tile_feedback_comp.h"
#include "spirv/triangles_comp.h"
#include "tests/render/shared_members.h"
#include "tests/support/found_texts.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

// Offsets by "Struct.member", read from a module's OpName, OpMemberName and OpMemberDecorate Offset
// instructions. Source: SPIR-V Specification 1.6, sections 2.3 and 3.
std::map<std::string, std::uint32_t> member_offsets(std::span<const std::uint32_t> words) {
    constexpr std::uint32_t op_name = 5, op_member_name = 6, op_member_decorate = 72, offset_decoration = 35;
    std::map<std::uint32_t, std::string> names;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::string> members;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> offsets;
    for (std::size_t i = 5; i < words.size(); i += words[i] >> 16U) {
        const std::uint32_t op = words[i] & 0xffffU;
        const auto text = [&](std::size_t at) {
            return std::string(reinterpret_cast<const char*>(&words[at]));
        };
        if (op == op_name) names[words[i + 1]] = text(i + 2);
        if (op == op_member_name) members[{words[i + 1], words[i + 2]}] = text(i + 3);
        if (op == op_member_decorate && words[i + 3] == offset_decoration)
            offsets[{words[i + 1], words[i + 2]}] = words[i + 4];
    }
    std::map<std::string, std::uint32_t> by_name;
    for (const auto& [key, offset] : offsets) by_name[names[key.first] + "." + members[key]] = offset;
    return by_name;
}

std::map<std::string, std::uint32_t> offsets_of_all_shaders() {
    std::map<std::string, std::uint32_t> all;
    for (const std::span<const std::uint32_t> words :
         {std::span<const std::uint32_t>(terrain_task_spirv),
          std::span<const std::uint32_t>(terrain_mesh_spirv),
          std::span<const std::uint32_t>(live_pages_comp_spirv),
          std::span<const std::uint32_t>(raster_comp_spirv),
          std::span<const std::uint32_t>(raster_large_comp_spirv),
          std::span<const std::uint32_t>(shade_comp_spirv),
          std::span<const std::uint32_t>(shade_net_comp_spirv),
          std::span<const std::uint32_t>(shade_map_comp_spirv),
          std::span<const std::uint32_t>(shade_air_comp_spirv),
          std::span<const std::uint32_t>(texture_tile_feedback_comp_spirv),
          std::span<const std::uint32_t>(triangles_comp_spirv),
          std::span<const std::uint32_t>(caster_heights_comp_spirv),
          std::span<const std::uint32_t>(places_comp_spirv),
          std::span<const std::uint32_t>(cluster_raster_comp_spirv),
          std::span<const std::uint32_t>(choose_clusters_comp_spirv)}) {
        all.merge(member_offsets(words));
    }
    return all;
}

// The structs that shaders/shared.h defines, read from its text: a struct that is added there is looked for
// in the shaders without anyone naming it here.
std::set<std::string> shared_structs() {
    std::string text;
    for (const char* const name :
         {"shaders/shared.h", "shaders/shared_rounds.h", "shaders/shared_clusters.h",
          "shaders/shared_heights.h", "shaders/shared_places.h", "shaders/shared_mesh_looks.h"}) {
        std::ifstream file(test::bundled_data().parent_path() / name);
        text += std::string((std::istreambuf_iterator<char>(file)), {});
    }
    std::set<std::string> names;
    for (const auto& found : test::found_texts(text, R"(struct\s+(\w+)\s*\{)")) names.insert(found[1]);
    return names;
}

// Members of the shared structs that a compiled shader has and `table` lacks or puts elsewhere.
std::vector<std::string> members_amiss(const std::map<std::string, std::uint32_t>& spirv,
                                       const std::set<std::string>& structs,
                                       const std::map<std::string, std::size_t>& table) {
    std::vector<std::string> amiss;
    for (const auto& [name, offset] : spirv) {
        if (!structs.contains(name.substr(0, name.find('.')))) continue;
        const auto found = table.find(name);
        if (found == table.end() || found->second != offset) amiss.push_back(name);
    }
    return amiss;
}

TEST(SharedLayout, SpirvOffsetsEqualOffsetof) {
    const auto spirv = offsets_of_all_shaders();
    const std::set<std::string> structs = shared_structs();
    ASSERT_GE(structs.size(), 10U) << "shaders/shared.h was not read";
    EXPECT_EQ(members_amiss(spirv, structs, offsets_in_memory()), std::vector<std::string>{});
    for (const auto& [name, offset] : offsets_in_memory())
        EXPECT_TRUE(spirv.contains(name)) << name << " is in no shader";
}

// The check can fail: a field that the table forgets, and one that lies elsewhere, are told.
TEST(SharedLayout, AForgottenFieldIsFound) {
    auto table = offsets_in_memory();
    table.erase("FrameConstants.tau_px");
    table.at("PageBlock.heights") += 4;
    EXPECT_EQ(members_amiss(offsets_of_all_shaders(), shared_structs(), table),
              (std::vector<std::string>{"FrameConstants.tau_px", "PageBlock.heights"}));
}

// The array strides: what follows an array must start where the C++ array ends.
TEST(SharedLayout, StridesFollowFromOffsets) {
    EXPECT_EQ(offsetof(gpu::PageBlock, row_spacing_m), 256 * sizeof(gpu::MeshletBounds));
    EXPECT_EQ(sizeof(gpu::PageBlock), offsetof(gpu::PageBlock, heights) + 4 * gpu::page_heights);
}

}  // namespace
}  // namespace oro
