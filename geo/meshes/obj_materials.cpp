#include "geo/meshes/obj_materials.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "geo/meshes/mesh_words.h"

namespace oro {
namespace {

// The rest of a line, without blanks around it.
std::string_view rest_of_line(std::string_view words) {
    constexpr std::string_view blanks = " \t\v\f\r";
    const std::size_t begin = words.find_first_not_of(blanks);
    if (begin == std::string_view::npos) return {};
    return words.substr(begin, words.find_last_not_of(blanks) - begin + 1);
}

// Kd r g b; one number is for all three. Those of spectra (`spectral`, `xyz`) are passed over.
Result<void> read_kd(std::string_view words, std::size_t line, ObjMaterial& material) {
    glm::dvec3 colour(0.0);
    for (int part = 0; part < 3; ++part) {
        const std::string_view word = take_word(words);
        if (word == "spectral" || word == "xyz") return {};
        if (part > 0 && word.empty()) {
            colour[part] = colour[0];
            continue;
        }
        if (!mesh_number(word, colour[part]) || !std::isfinite(colour[part]))
            return mesh_fault("line", line, shown_word(word) + " is no number of a colour");
    }
    material.colour = glm::dvec3(std::clamp(colour.x, 0.0, 1.0), std::clamp(colour.y, 0.0, 1.0),
                                 std::clamp(colour.z, 0.0, 1.0));
    return {};
}

// Up to three numbers, of which the first two are taken.
Result<void> read_pair(std::string_view& words, std::size_t line, glm::dvec2& pair) {
    for (int part = 0; part < 3; ++part) {
        std::string_view after = words;
        double number = 0.0;
        if (const std::string_view word = take_word(after); word.empty() || !mesh_number(word, number)) break;
        words = after;
        if (!std::isfinite(number)) return mesh_fault("line", line, "an option of map_Kd is not finite");
        if (part < 2) pair[part] = number;
    }
    return {};
}

// map_Kd -option values ... name. The name may hold blanks.
Result<void> read_map(std::string_view words, std::size_t line, ObjMaterial& material) {
    constexpr std::array<std::pair<std::string_view, int>, 9> passed_over{{{"-blendu", 1},
                                                                           {"-blendv", 1},
                                                                           {"-bm", 1},
                                                                           {"-boost", 1},
                                                                           {"-cc", 1},
                                                                           {"-imfchan", 1},
                                                                           {"-mm", 2},
                                                                           {"-texres", 1},
                                                                           {"-type", 1}}};
    for (std::string_view after = words; !after.empty(); after = words) {
        const std::string_view option = take_word(after);
        const auto known = std::ranges::find(passed_over, option, [](const auto& one) { return one.first; });
        glm::dvec2 turbulence(0.0);
        if (known != passed_over.end()) {
            for (int i = 0; i < known->second; ++i) take_word(after);
        } else if (option == "-clamp") {
            material.wrap = take_word(after) == "on" ? TextureWrap::clamp : TextureWrap::repeat;
        } else if (option == "-o" || option == "-s" || option == "-t") {
            ORO_CHECK(read_pair(after, line,
                                option == "-o"   ? material.offset
                                : option == "-s" ? material.scale
                                                 : turbulence));
        } else {
            break;
        }
        words = after;
    }
    material.texture = std::string(rest_of_line(words));
    if (material.texture.empty()) return mesh_fault("line", line, "map_Kd names no file");
    // As programs of Windows write folders.
    std::ranges::replace(material.texture, '\\', '/');
    return {};
}

}  // namespace

Result<void> read_obj_materials(std::string_view text,
                                std::map<std::string, ObjMaterial, std::less<>>& materials) {
    ObjMaterial unnamed;
    ObjMaterial* material = &unnamed;
    for (std::size_t number = 1; !text.empty(); ++number) {
        std::string_view words = take_line(text);
        words = words.substr(0, words.find('#'));
        const std::string_view key = take_word(words);
        if (key == "newmtl") {
            const auto [found, is_new] = materials.try_emplace(std::string(rest_of_line(words)));
            material = is_new ? &found->second : &unnamed;
        }
        if (key == "Kd") ORO_CHECK(read_kd(words, number, *material));
        if (key == "map_Kd") ORO_CHECK(read_map(words, number, *material));
    }
    return {};
}

}  // namespace oro
