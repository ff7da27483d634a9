#include "geo/meshes/texture_colours.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <span>
#include <utility>

#include "core/base/parallel.h"
#include "core/base/srgb.h"
#include "geo/meshes/mesh_words.h"
#include "geo/pixels/picture_rows.h"

namespace oro {
namespace {

struct TextureImage {
    int width_px{};
    int height_px{};
    std::vector<std::uint8_t> rgb;
};

Result<TextureImage> texture_image(const TextureBytes& texture) {
    ORO_TRY(const auto rows, open_picture_bytes(texture.bytes, texture.name, most_texture_pixels));
    TextureImage image{rows->width_px(), rows->height_px(), {}};
    const auto row_bytes = 3 * static_cast<std::size_t>(image.width_px);
    image.rgb.resize(row_bytes * static_cast<std::size_t>(image.height_px));
    for (std::size_t at = 0; at < image.rgb.size(); at += row_bytes)
        ORO_CHECK(rows->read_row(std::span(image.rgb).subspan(at, row_bytes)));
    return image;
}

const std::array<float, 256>& light_of_codes() {
    static const std::array<float, 256> lights = [] {
        std::array<float, 256> all{};
        for (std::size_t code = 0; code < all.size(); ++code)
            all[code] = static_cast<float>(light_of_srgb(static_cast<double>(code) / 255.0));
        return all;
    }();
    return lights;
}

// The pixel of `count` ones that a coordinate lies in.
std::size_t texel_at(double coordinate, TextureWrap wrap, int count) {
    double part = std::clamp(coordinate, 0.0, 1.0);
    if (wrap == TextureWrap::repeat) part = coordinate - std::floor(coordinate);
    if (wrap == TextureWrap::mirror) {
        const double turned = coordinate - 2.0 * std::floor(0.5 * coordinate);
        part = turned > 1.0 ? 2.0 - turned : turned;
    }
    return static_cast<std::size_t>(std::clamp(part * count, 0.0, count - 1.0));
}

// The mean lights of the thirds of a triangle that are nearest to its corners.
using ThirdLights = std::array<glm::dvec3, 3>;

// Takes samples in the middles of the side * side triangles that cut a triangle evenly.
class ThirdSamples {
  public:
    ThirdSamples(const TextureImage& image, const std::array<TextureWrap, 2>& wrap)
        : image_(image), wrap_(wrap), lights_of_(light_of_codes()) {}

    [[nodiscard]] ThirdLights of(const std::array<glm::vec2, 3>& at, int side) const {
        ThirdLights sums{};
        for (int i = 0; i < side; ++i)
            for (int k = 0; i + k < side; ++k) {
                add(at, {3 * i + 1, 3 * k + 1, 3 * (side - i - k) - 2}, sums);
                if (i + k + 1 < side) add(at, {3 * i + 2, 3 * k + 2, 3 * (side - i - k) - 4}, sums);
            }
        // A third of all samples each: those between two corners count half, or a third.
        for (glm::dvec3& sum : sums) sum *= 3.0 / (static_cast<double>(side) * side);
        return sums;
    }

  private:
    void add(const std::array<glm::vec2, 3>& at, const std::array<int, 3>& share, ThirdLights& sums) const {
        const double all = share[0] + share[1] + share[2];
        glm::dvec2 place(0.0);
        for (std::size_t i = 0; i < 3; ++i) place += share[i] / all * glm::dvec2(at[i]);
        const std::size_t x = texel_at(place.x, wrap_[0], image_.width_px),
                          y = texel_at(place.y, wrap_[1], image_.height_px),
                          pixel = 3 * (y * static_cast<std::size_t>(image_.width_px) + x);
        const int most = std::max({share[0], share[1], share[2]});
        const auto nearest = std::ranges::count(share, most);
        const glm::dvec3 light = glm::dvec3(lights_of_[image_.rgb[pixel]], lights_of_[image_.rgb[pixel + 1]],
                                            lights_of_[image_.rgb[pixel + 2]]) /
                                 static_cast<double>(nearest);
        for (std::size_t i = 0; i < 3; ++i)
            if (share[i] == most) sums[i] += light;
    }

    const TextureImage& image_;
    std::array<TextureWrap, 2> wrap_;
    const std::array<float, 256>& lights_of_;
};

// The longest side in texels, and the area.
struct TexelSize {
    double longest{};
    double area{};
};
TexelSize texel_size(const TexturedTriangle& triangle, const TextureImage& image) {
    const glm::dvec2 scale(image.width_px, image.height_px);
    std::array<glm::dvec2, 3> at{};
    for (std::size_t i = 0; i < 3; ++i) at[i] = glm::dvec2(triangle.at[i]) * scale;
    const glm::dvec2 one = at[1] - at[0], other = at[2] - at[0];
    return {std::max({glm::length(one), glm::length(other), glm::length(at[2] - at[1])}),
            0.5 * std::abs(one.x * other.y - one.y * other.x)};
}

// How finely a triangle of a part is cut: by texels, more finely where there are few triangles, and with a
// bound for all.
class SampleCount {
  public:
    SampleCount(std::size_t triangles, const TextureImage& image) {
        constexpr double most_samples = 1.0e9, plenty_of_samples = 2.0e7, samples_of_texel = 16.0;
        const double texels = static_cast<double>(image.width_px) * image.height_px;
        const auto count = static_cast<double>(triangles);
        least_ = std::clamp(std::sqrt(plenty_of_samples / count), 6.0, 48.0);
        most_ = std::max(least_, std::sqrt(std::min(samples_of_texel * texels, most_samples) / count));
    }
    [[nodiscard]] int side(const TexelSize& size) const {
        return static_cast<int>(std::clamp(std::ceil(size.longest), least_, most_));
    }

  private:
    double least_{}, most_{};
};

// Sums of light over the vertices of one part.
class PartLights {
  public:
    explicit PartLights(std::size_t vertices) : slot_of_(vertices, none) {}

    void colour(const TexturedPart& part, const TextureImage& image, SourceMesh& mesh) {
        begin(part, mesh);
        const ThirdSamples samples(image, part.wrap);
        const SampleCount count(part.triangles.size(), image);
        constexpr std::size_t at_once = 65536, of_a_thread = 512;
        std::vector<ThirdLights> lights(std::min(at_once, part.triangles.size()));
        for (std::size_t first = 0; first < part.triangles.size(); first += at_once) {
            const std::size_t end = std::min(first + at_once, part.triangles.size());
            const auto pieces = static_cast<int>((end - first + of_a_thread - 1) / of_a_thread);
            in_parallel(pieces, thread_count(), [&](int piece) {
                const std::size_t begin = first + static_cast<std::size_t>(piece) * of_a_thread;
                for (std::size_t i = begin; i < std::min(begin + of_a_thread, end); ++i)
                    lights[i - first] =
                        samples.of(part.triangles[i].at, count.side(texel_size(part.triangles[i], image)));
            });
            for (std::size_t i = first; i < end; ++i) add(part.triangles[i], lights[i - first], image, mesh);
        }
        end(mesh);
    }

  private:
    static constexpr std::uint32_t none = ~std::uint32_t{0};
    struct Sum {
        glm::dvec3 light{0.0};
        double weight{};
    };

    // One sum for each place that vertices of the part lie at.
    void begin(const TexturedPart& part, const SourceMesh& mesh) {
        vertices_.clear(), sums_.clear();
        for (const TexturedTriangle& triangle : part.triangles)
            for (const std::uint32_t corner : mesh.triangles[triangle.triangle])
                if (slot_of_[corner] == none) slot_of_[corner] = 0, vertices_.push_back(corner);
        const auto place = [&](std::uint32_t vertex) {
            const glm::dvec3& at = mesh.vertices[vertex];
            return std::array{at.x, at.y, at.z};
        };
        // NaN has no order; triangles with such a vertex are not drawn.
        const auto is_finite = [&](std::uint32_t vertex) {
            return std::ranges::all_of(place(vertex), [](double one) { return std::isfinite(one); });
        };
        std::erase_if(vertices_, [&](std::uint32_t vertex) { return !is_finite(vertex) && forget(vertex); });
        std::ranges::sort(vertices_, [&](std::uint32_t a, std::uint32_t b) {
            return std::pair(place(a), a) < std::pair(place(b), b);
        });
        for (std::size_t i = 0; i < vertices_.size(); ++i) {
            if (i == 0 || place(vertices_[i]) != place(vertices_[i - 1])) sums_.emplace_back();
            slot_of_[vertices_[i]] = static_cast<std::uint32_t>(sums_.size() - 1);
        }
    }
    bool forget(std::uint32_t vertex) {
        slot_of_[vertex] = none;
        return true;
    }

    void add(const TexturedTriangle& textured, const ThirdLights& lights, const TextureImage& image,
             SourceMesh& mesh) {
        const SourceTriangle& corners = mesh.triangles[textured.triangle];
        const glm::dvec3& first = mesh.vertices[corners[0]];
        const double area =
            glm::length(glm::cross(mesh.vertices[corners[1]] - first, mesh.vertices[corners[2]] - first));
        // One without an area counts where there is no other.
        constexpr double least = std::numeric_limits<double>::min() * 1.0e8, most = 1.0e200;
        const double weight = std::isfinite(area) ? std::clamp(area, least, most) : least;
        for (std::size_t i = 0; i < 3; ++i) {
            if (slot_of_[corners[i]] == none) continue;
            Sum& sum = sums_[slot_of_[corners[i]]];
            sum.light += weight * lights[i], sum.weight += weight;
        }
        mesh.texels += texel_size(textured, image).area;
    }

    void end(SourceMesh& mesh) {
        for (const std::uint32_t vertex : vertices_) {
            const Sum& sum = sums_[slot_of_[vertex]];
            std::array<double, 3> light = light_of_colour(mesh.colours[vertex]);
            for (int i = 0; i < 3; ++i) light[static_cast<std::size_t>(i)] *= sum.light[i] / sum.weight;
            mesh.colours[vertex] = colour_of_light(light);
            slot_of_[vertex] = none;
        }
        mesh.textured_vertices += vertices_.size();
    }

    std::vector<std::uint32_t> slot_of_;  // of each vertex of the mesh: its sum, or none
    std::vector<std::uint32_t> vertices_;
    std::vector<Sum> sums_;
};

}  // namespace

Result<void> colour_by_textures(const std::vector<TextureBytes>& textures,
                                const std::vector<TexturedPart>& parts, SourceMesh& mesh) {
    if (parts.empty()) return {};
    std::vector<std::vector<const TexturedPart*>> parts_of(textures.size());
    for (const TexturedPart& part : parts)
        if (!part.triangles.empty()) parts_of[part.texture].push_back(&part);
    PartLights lights(mesh.vertices.size());
    for (std::size_t number = 0; number < textures.size(); ++number) {
        if (parts_of[number].empty()) continue;
        const Result<TextureImage> image = texture_image(textures[number]);
        if (!image.ok())
            return Error{ErrorKind::failed, "",
                         "its texture " + shown_word(image.error().where) + ": " + image.error().what};
        mesh.textures.push_back({textures[number].name, image->width_px, image->height_px});
        for (const TexturedPart* const part : parts_of[number]) lights.colour(*part, *image, mesh);
    }
    return {};
}

void UnreadTextures::add(const std::string& name, const std::string& why) {
    if (std::ranges::find(names_, name) != names_.end()) return;
    if (names_.empty()) first_ = shown_word(name) + " " + why;
    names_.push_back(name);
}

void UnreadTextures::note_in(SourceMesh& mesh) const {
    if (names_.empty()) return;
    mesh.notes.push_back(names_.size() == 1 ? "its texture " + first_ + ": drawn without it"
                                            : std::to_string(names_.size()) +
                                                  " of its textures are not read: the first, " + first_);
}

}  // namespace oro
