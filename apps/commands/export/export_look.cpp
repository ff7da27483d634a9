// The colours of what is exported: those of the style `natural`, as light.
#include <array>

#include "apps/commands/export/exported_region.h"
#include "apps/report/region_json.h"
#include "core/base/srgb.h"

namespace oro {
namespace {

// Codes of sRGB. Source: data/styles/natural.json: bare ground below the snow line, and the two colours that
// the materials `built` and `water` lie between.
using Codes = std::array<int, 3>;
constexpr Codes bare_ground{0x91, 0x8B, 0x81};
constexpr std::array<Codes, 2> built_land{{{0x85, 0x7F, 0x78}, {0x95, 0x8E, 0x84}}};
constexpr std::array<Codes, 2> open_water{{{0x0B, 0x2A, 0x3C}, {0x0B, 0x2A, 0x3C}}};

std::array<double, 3> mean_light(const Codes& one, const Codes& other) {
    std::array<double, 3> light{};
    for (std::size_t i = 0; i < light.size(); ++i)
        light[i] = 0.5 * (light_of_srgb(one[i] / 255.0) + light_of_srgb(other[i] / 255.0));
    return light;
}

}  // namespace

GlbLook look_of(const Region& region) {
    GlbLook look;
    look.colour = mean_light(bare_ground, bare_ground);
    look.attribution = attribution_of(region);
    look.generator = "orograph " OROGRAPH_VERSION;
    return look;
}

MeshPalette palette_of_meshes() {
    return {mean_light(bare_ground, bare_ground), mean_light(built_land[0], built_land[1]),
            mean_light(open_water[0], open_water[1])};
}

}  // namespace oro
