#include "render/shading/air_tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "render/pipelines/shading_pipelines.h"

namespace oro {
namespace {

template <class T>
bool same(const T& a, const T& b) {
    static_assert(std::is_trivially_copyable_v<T> && alignof(T) == 4, "no padding that could differ");
    return std::memcmp(&a, &b, sizeof(T)) == 0;
}

constexpr std::uint32_t entries_a_group = 64;
constexpr std::array<std::uint32_t, 6> entry_counts{
    gpu::air_column_heights * gpu::air_column_angles, gpu::air_light_heights* gpu::air_light_suns,
    gpu::air_light_heights* gpu::air_light_suns,      gpu::lit_heights* gpu::lit_suns,
    gpu::air_sky_rises* gpu::air_sky_turns,           2 * gpu::aerial_rises* gpu::aerial_turns};
static_assert(gpu::air_scattered_first == gpu::air_columns_first + entry_counts[0] &&
              gpu::air_skylight_first == gpu::air_scattered_first + entry_counts[1] &&
              gpu::air_sky_first == gpu::air_skylight_first + entry_counts[2] &&
              gpu::air_exposure_at == gpu::air_sky_first + 3 * entry_counts[4] &&
              gpu::air_entries == gpu::air_exposure_at + 4);
static_assert(gpu::aerial_first * sizeof(gpu::vec4) == gpu::air_entries * sizeof(gpu::vec3) &&
              gpu::aerial_end == gpu::aerial_first + 2 * gpu::aerial_slices * entry_counts[5] &&
              gpu::lit_first == gpu::aerial_end && gpu::lit_end == gpu::lit_first + entry_counts[3]);

}  // namespace

Result<void> AirTables::prepare(const Gpu& gpu, Pipelines& pipelines, gpu::FrameConstants& constants,
                                bool exactly) {
    wanted_.reset();
    constants.air = {};
    if (constants.style.air.on == 0) return {};
    if (!entries_.handle) {
        ORO_TRY(entries_,
                create_buffer(gpu, gpu::lit_end * sizeof(gpu::vec4),
                              VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                  VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                              MemoryKind::device, "air"));
        ORO_CHECK(add_air_pipelines(gpu, pipelines));
    }
    constants.air = address_words(entries_.address);
    wanted_ = Made{constants.style.air, constants.earth_radius_m, constants.eye_h_m, constants.style.sun_enu};
    if (!exactly && made_ && will_do(*made_, *wanted_)) wanted_ = made_;
    return {};
}

// Whether a sky looks alike from both eyes.
bool AirTables::will_do(const Made& made, const Made& wanted) {
    constexpr float share = 0.03F, least_m = 30.0F, radius_m = 1000.0F, sun_cosine = 0.99996F;
    if (!same(made.model, wanted.model)) return false;
    const float height_m = std::abs(made.eye_h_m - wanted.eye_h_m);
    const auto& one = made.sun_enu;
    const auto& other = wanted.sun_enu;
    return std::abs(made.earth_radius_m - wanted.earth_radius_m) <= radius_m &&
           height_m <= std::max(least_m, share * std::abs(made.eye_h_m)) &&
           one.x * other.x + one.y * other.y + one.z * other.z >= sun_cosine;
}

void AirTables::record(VkCommandBuffer commands, const Pipelines& pipelines) {
    if (!wanted_) return;
    const bool model =
        !made_ || !same(made_->model, wanted_->model) || made_->earth_radius_m != wanted_->earth_radius_m;
    const bool sky = model || !same(*made_, *wanted_);
    for (std::uint32_t table = model ? 0 : 4; sky && table < entry_counts.size(); ++table) {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipelines.air[table].get());
        vkCmdDispatch(commands, (entry_counts[table] + entries_a_group - 1) / entries_a_group, 1, 1);
        memory_barrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                       VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT);
    }
    made_ = wanted_;
}

}  // namespace oro
