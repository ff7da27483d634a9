// The structs of shaders/shared.h lie in memory as the compiled shaders expect: SPIR-V's member offsets
// against offsetof.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "shaders/shared.h"
#include "spirv/drape_wants_comp.h"
#include "spirv/live_pages_comp.h"
#include "spirv/raster_comp.h"
#include "spirv/raster_large_comp.h"
#include "spirv/shade_comp.h"
#include "spirv/terrain_mesh.h"
#include "spirv/terrain_task.h"
#include "spirv/tops_comp.h"
#include "spirv/triangles_comp.h"
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
          std::span<const std::uint32_t>(drape_wants_comp_spirv),
          std::span<const std::uint32_t>(triangles_comp_spirv),
          std::span<const std::uint32_t>(tops_comp_spirv)}) {
        all.merge(member_offsets(words));
    }
    return all;
}

// Where C++ puts each member of a shared struct.
const std::map<std::string, std::size_t>& offsets_in_memory() {
#define ORO_MEMBER(type, member) \
    { #type "." #member, offsetof(gpu::type, member) }
    static const std::map<std::string, std::size_t> table = {
        ORO_MEMBER(RowTerms, R),
        ORO_MEMBER(RowTerms, C),
        ORO_MEMBER(RowTerms, S),
        ORO_MEMBER(RowTerms, P),
        ORO_MEMBER(RowTerms, Z),
        ORO_MEMBER(RowTerms, Q),
        ORO_MEMBER(RowTerms, cosine),
        ORO_MEMBER(ColumnTerms, V),
        ORO_MEMBER(ColumnTerms, W),
        ORO_MEMBER(MeshletBounds, centre),
        ORO_MEMBER(MeshletBounds, radius),
        ORO_MEMBER(MeshletBounds, horizon_offset),
        ORO_MEMBER(MeshletBounds, horizon_angle_rad),
        ORO_MEMBER(MeshletBounds, error_m),
        ORO_MEMBER(MeshletBounds, lod_radius),
        ORO_MEMBER(PageBlock, meshlets),
        ORO_MEMBER(PageBlock, row_spacing_m),
        ORO_MEMBER(PageBlock, column_spacing_m),
        ORO_MEMBER(PageBlock, heights),
        ORO_MEMBER(FramePage, view_from_page),
        ORO_MEMBER(FramePage, origin_view),
        ORO_MEMBER(FramePage, planes),
        ORO_MEMBER(FramePage, horizon_direction),
        ORO_MEMBER(FramePage, block),
        ORO_MEMBER(FramePage, means),
        ORO_MEMBER(MeansSquare, normal),
        ORO_MEMBER(MeansSquare, height),
        ORO_MEMBER(MeansSquare, spread),
        ORO_MEMBER(PageMeans, squares),
        ORO_MEMBER(FramePage, cull),
        ORO_MEMBER(FramePage, level),
        ORO_MEMBER(FramePage, first_row),
        ORO_MEMBER(FramePage, first_column),
        ORO_MEMBER(FramePage, row_terms),
        ORO_MEMBER(FramePage, column_terms),
        ORO_MEMBER(FramePage, quarter),
        ORO_MEMBER(FramePage, parent),
        ORO_MEMBER(FramePage, beside),
        ORO_MEMBER(FramePage, children),
        ORO_MEMBER(FramePage, last_column),
        ORO_MEMBER(FramePage, west_column),
        ORO_MEMBER(FramePage, stand_in),
        ORO_MEMBER(FrameCounts, pages_live),
        ORO_MEMBER(FrameCounts, nodes_chosen),
        ORO_MEMBER(FrameCounts, meshlets_beyond_frustum),
        ORO_MEMBER(FrameCounts, meshlets_beyond_horizon),
        ORO_MEMBER(FrameCounts, meshlets_drawn),
        ORO_MEMBER(FrameCounts, triangles_drawn),
        ORO_MEMBER(FrameCounts, mesh_groups),
        ORO_MEMBER(FrameCounts, triangles_not_clipped),
        ORO_MEMBER(LivePages, count),
        ORO_MEMBER(LivePages, task_groups),
        ORO_MEMBER(LivePages, cull_groups),
        ORO_MEMBER(RasterLists, meshlets),
        ORO_MEMBER(RasterLists, meshlet_groups),
        ORO_MEMBER(RasterLists, clips),
        ORO_MEMBER(RasterLists, clip_groups),
        ORO_MEMBER(RasterLists, large),
        ORO_MEMBER(RasterLists, tasks),
        ORO_MEMBER(RasterLists, task_groups),
        ORO_MEMBER(LargeTriangle, ax),
        ORO_MEMBER(LargeTriangle, ay),
        ORO_MEMBER(LargeTriangle, bx),
        ORO_MEMBER(LargeTriangle, by),
        ORO_MEMBER(LargeTriangle, cx),
        ORO_MEMBER(LargeTriangle, cy),
        ORO_MEMBER(LargeTriangle, az),
        ORO_MEMBER(LargeTriangle, bz),
        ORO_MEMBER(LargeTriangle, cz),
        ORO_MEMBER(LargeTriangle, id),
        ORO_MEMBER(DrawnTriangle, at),
        ORO_MEMBER(DrawnTriangle, rows),
        ORO_MEMBER(DrawnTriangle, columns),
        ORO_MEMBER(DrawnTriangle, h_m),
        ORO_MEMBER(LargeTask, triangle),
        ORO_MEMBER(LargeTask, square),
        ORO_MEMBER(TintStop, at),
        ORO_MEMBER(TintStop, colour),
        ORO_MEMBER(FrameStyle, tints),
        ORO_MEMBER(FrameStyle, tint_count),
        ORO_MEMBER(FrameStyle, colour_by),
        ORO_MEMBER(FrameStyle, tints_as_codes),
        ORO_MEMBER(FrameStyle, light),
        ORO_MEMBER(FrameStyle, is_map),
        ORO_MEMBER(FrameStyle, sun_enu),
        ORO_MEMBER(FrameStyle, sun_hidden),
        ORO_MEMBER(FrameStyle, ambient),
        ORO_MEMBER(FrameStyle, relief),
        ORO_MEMBER(FrameStyle, haze_colour),
        ORO_MEMBER(FrameStyle, haze_distance_m),
        ORO_MEMBER(FrameStyle, zenith_colour),
        ORO_MEMBER(FrameStyle, no_data_colour),
        ORO_MEMBER(FrameStyle, sky_scale_height_m),
        ORO_MEMBER(FrameStyle, flat_colour),
        ORO_MEMBER(FrameStyle, relief_light),
        ORO_MEMBER(FrameStyle, contours),
        ORO_MEMBER(FrameStyle, footprint),
        ORO_MEMBER(FrameStyle, smooth_edges),
        ORO_MEMBER(ReliefLight, lit),
        ORO_MEMBER(ReliefLight, lit_share),
        ORO_MEMBER(ReliefLight, shadow),
        ORO_MEMBER(ReliefLight, veil),
        ORO_MEMBER(ReliefLight, low_H_m),
        ORO_MEMBER(ReliefLight, high_H_m),
        ORO_MEMBER(ReliefLight, low_contrast),
        ORO_MEMBER(ReliefLight, low_veil),
        ORO_MEMBER(ContourLines, interval_m),
        ORO_MEMBER(ContourLines, width_px),
        ORO_MEMBER(ContourLines, colour),
        ORO_MEMBER(FrameStyle, air),
        ORO_MEMBER(FrameStyle, cover),
        ORO_MEMBER(SnowLineStop, lat_deg),
        ORO_MEMBER(SnowLineStop, H_m),

        ORO_MEMBER(GroundCover, snow_line),
        ORO_MEMBER(GroundCover, snow_line_count),
        ORO_MEMBER(GroundCover, rock),
        ORO_MEMBER(GroundCover, rock_from_deg),
        ORO_MEMBER(GroundCover, rock_to_deg),
        ORO_MEMBER(GroundCover, forest_m),
        ORO_MEMBER(GroundCover, shade_m),
        ORO_MEMBER(GroundCover, level_m),

        ORO_MEMBER(FrameStyle, water),
        ORO_MEMBER(FrameStyle, voids),
        ORO_MEMBER(WaterModel, on),
        ORO_MEMBER(WaterModel, voids_are_sea),
        ORO_MEMBER(WaterModel, sea_low_H_m),
        ORO_MEMBER(WaterModel, sea_high_H_m),
        ORO_MEMBER(WaterModel, deep),
        ORO_MEMBER(WaterModel, wave_variance),
        ORO_MEMBER(VoidHatch, on),
        ORO_MEMBER(VoidHatch, colour),
        ORO_MEMBER(VoidHatch, lines),
        ORO_MEMBER(EyePost, post),
        ORO_MEMBER(EyePost, per_rad),
        ORO_MEMBER(EyePost, post_m),
        ORO_MEMBER(EyePost, latitude),
        ORO_MEMBER(EyePost, normal_m),
        ORO_MEMBER(EyePost, meridian_m),
        ORO_MEMBER(EyePost, e2),
        ORO_MEMBER(EyePost, turn),
        ORO_MEMBER(FrameStyle, shadows),
        ORO_MEMBER(FrameStyle, sky_openness),
        ORO_MEMBER(CasterLevel, first_row),
        ORO_MEMBER(CasterLevel, first_column),
        ORO_MEMBER(CasterLevel, rows),
        ORO_MEMBER(CasterLevel, columns),
        ORO_MEMBER(CasterLevel, first),
        ORO_MEMBER(CasterPage, block),
        ORO_MEMBER(CasterPage, level),
        ORO_MEMBER(CasterPage, row),
        ORO_MEMBER(CasterPage, column),
        ORO_MEMBER(Casters, levels),
        ORO_MEMBER(Casters, level_count),
        ORO_MEMBER(Casters, row_rad),
        ORO_MEMBER(Casters, column_rad),
        ORO_MEMBER(Casters, page_count),
        ORO_MEMBER(Casters, top_m),
        ORO_MEMBER(Casters, error_per_m),
        ORO_MEMBER(Casters, pages),
        ORO_MEMBER(Casters, table),
        ORO_MEMBER(Casters, nodes),
        ORO_MEMBER(Casters, openness),
        ORO_MEMBER(Casters, sun_shares),
        ORO_MEMBER(CasterNode, top_m),
        ORO_MEMBER(CasterNode, error_m),
        ORO_MEMBER(CasterNode, above_top_m),
        ORO_MEMBER(CasterNode, above_error_m),
        ORO_MEMBER(CasterNode, finer),
        ORO_MEMBER(CasterNode, block),
        ORO_MEMBER(AirModel, on),
        ORO_MEMBER(AirModel, molecules_per_m),
        ORO_MEMBER(AirModel, molecules_scale_m),
        ORO_MEMBER(AirModel, dust_scattering_per_m),
        ORO_MEMBER(AirModel, dust_extinction_per_m),
        ORO_MEMBER(AirModel, dust_scale_m),
        ORO_MEMBER(AirModel, dust_forward),
        ORO_MEMBER(AirModel, ozone_per_m),
        ORO_MEMBER(AirModel, ground_albedo),
        ORO_MEMBER(AirModel, exposure),
        ORO_MEMBER(UndulationTable, N_m),
        ORO_MEMBER(UndulationTable, rows),
        ORO_MEMBER(UndulationTable, columns),
        ORO_MEMBER(UndulationTable, first),
        ORO_MEMBER(UndulationTable, per_post),
        ORO_MEMBER(DrapeTile, name),
        ORO_MEMBER(DrapeTile, row),
        ORO_MEMBER(DrapeTile, column),
        ORO_MEMBER(DrapeTile, texels),
        ORO_MEMBER(DrapeWanted, hash),
        ORO_MEMBER(DrapeWanted, name),
        ORO_MEMBER(DrapeWanted, row),
        ORO_MEMBER(DrapeWanted, column),
        ORO_MEMBER(DrapeTable, tiles),
        ORO_MEMBER(DrapeTable, wanted),
        ORO_MEMBER(DrapeTable, tile_mask),
        ORO_MEMBER(DrapeTable, wanted_seed),
        ORO_MEMBER(DrapeTable, finest),
        ORO_MEMBER(DrapeTable, coarsest),
        ORO_MEMBER(DrapeTable, opacity),
        ORO_MEMBER(DrapeTable, relief),
        ORO_MEMBER(FrameConstants, view_from_eye),
        ORO_MEMBER(FrameConstants, reference_steps),
        ORO_MEMBER(FrameConstants, projection_scale),
        ORO_MEMBER(FrameConstants, projection_shift),
        ORO_MEMBER(FrameConstants, near_m),
        ORO_MEMBER(FrameConstants, horizon_angle_rad),
        ORO_MEMBER(FrameConstants, horizon_stretch),
        ORO_MEMBER(FrameConstants, refraction_per_m),
        ORO_MEMBER(FrameConstants, placing),
        ORO_MEMBER(FrameConstants, view_from_ecef),
        ORO_MEMBER(FrameConstants, view_translation),
        ORO_MEMBER(FrameConstants, eye_high),
        ORO_MEMBER(FrameConstants, eye_low),
        ORO_MEMBER(FrameConstants, eye_meridian),
        ORO_MEMBER(FrameConstants, height_bits),
        ORO_MEMBER(FrameConstants, height_shift),
        ORO_MEMBER(FrameConstants, height_offset),
        ORO_MEMBER(FrameConstants, up_view),
        ORO_MEMBER(FrameConstants, eye_h_m),
        ORO_MEMBER(FrameConstants, earth_radius_m),
        ORO_MEMBER(FrameConstants, width_px),
        ORO_MEMBER(FrameConstants, height_px),
        ORO_MEMBER(FrameConstants, first_x_px),
        ORO_MEMBER(FrameConstants, first_y_px),
        ORO_MEMBER(FrameConstants, pixels_per_tangent),
        ORO_MEMBER(FrameConstants, corner_tangent),
        ORO_MEMBER(FrameConstants, tau_px),
        ORO_MEMBER(FrameConstants, exaggeration),
        ORO_MEMBER(FrameConstants, last_row),
        ORO_MEMBER(FrameConstants, last_column),
        ORO_MEMBER(FrameConstants, cut_column),
        ORO_MEMBER(FrameConstants, page_count),
        ORO_MEMBER(FrameConstants, sample_index),
        ORO_MEMBER(FrameConstants, sample_count),
        ORO_MEMBER(FrameConstants, has_means),
        ORO_MEMBER(FrameConstants, pages),
        ORO_MEMBER(FrameConstants, row_terms),
        ORO_MEMBER(FrameConstants, column_terms),
        ORO_MEMBER(FrameConstants, accepted),
        ORO_MEMBER(FrameConstants, edges),
        ORO_MEMBER(FrameConstants, live),
        ORO_MEMBER(FrameConstants, live_pages),
        ORO_MEMBER(FrameConstants, counts),
        ORO_MEMBER(FrameConstants, depths),
        ORO_MEMBER(FrameConstants, tiles_in_parts),
        ORO_MEMBER(FrameConstants, triangles),
        ORO_MEMBER(FrameConstants, triangle_rows),
        ORO_MEMBER(FrameConstants, recorded),
        ORO_MEMBER(FrameConstants, record_view),
        ORO_MEMBER(FrameConstants, visibility),
        ORO_MEMBER(FrameConstants, lists),
        ORO_MEMBER(FrameConstants, meshlet_list),
        ORO_MEMBER(FrameConstants, clip_list),
        ORO_MEMBER(FrameConstants, large_list),
        ORO_MEMBER(FrameConstants, task_list),
        ORO_MEMBER(FrameConstants, air),
        ORO_MEMBER(FrameConstants, casters),
        ORO_MEMBER(FrameConstants, undulation),
        ORO_MEMBER(FrameConstants, style),
        ORO_MEMBER(FrameConstants, eye_post),
        ORO_MEMBER(FrameConstants, drape),
    };
#undef ORO_MEMBER
    return table;
}

// The structs that shaders/shared.h defines, read from its text: a struct that is added there is looked for
// in the shaders without anyone naming it here.
std::set<std::string> shared_structs() {
    std::ifstream file(test::bundled_data().parent_path() / "shaders/shared.h");
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    static const std::regex definition(R"(struct\s+(\w+)\s*\{)");
    std::set<std::string> names;
    for (std::sregex_iterator at(text.begin(), text.end(), definition), end; at != end; ++at)
        names.insert((*at)[1]);
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
