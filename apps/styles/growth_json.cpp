#include "apps/styles/growth_json.h"

#include "shaders/shared_growth.h"

namespace oro {

nlohmann::ordered_json growth_json(const Style& style, const std::string& without_trees) {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    const gpu::uint on = style.frame.materials.on;
    if ((on & gpu::materials_with_trees) != 0)
        json["trees"] = "invented, by a rule, where the ground cover is forest";
    else if (!without_trees.empty() && on != 0)
        json["trees"] = without_trees;
    if ((on & gpu::materials_with_grass) != 0)
        json["grass"] = "invented, by a rule, within 60 m where the ground cover is meadow";
    return json;
}

}  // namespace oro
