#include "apps/commands/export/vertex_facts.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "apps/view/view.h"
#include "core/base/srgb.h"
#include "geo/drape/images_over_ground.h"
#include "geo/posts/source_at.h"
#include "geo/sources/source_words.h"

namespace oro {
namespace {

// What nine heights in ten of SRTM are off at most, metres (LE90). Source: T. Farr and others, The Shuttle
// Radar Topography Mission, Reviews of Geophysics 45, 2007, doi 10.1029/2005RG000183.
constexpr double srtm_le90_m = 16.0;
constexpr std::size_t most_sources = 255;

GroundSource ground_source(const SourceReport& source) {
    const bool is_srtm = source.format == SourceFormat::srtm1_hgt || source.format == SourceFormat::srtm3_hgt;
    return {std::filesystem::path(source.path).filename().string(), source.attribution,
            datum_words(source.vertical_datum), source.spacing_m, is_srtm ? srtm_le90_m : -1.0};
}

}  // namespace

// Its alpha divided out, over the ground's own.
std::array<double, 3> ExportedFacts::colour_of(std::uint32_t texel) const {
    const double alpha = static_cast<double>(texel >> 24U) / 255.0;
    std::array<double, 3> colour = plain_;
    if (alpha <= 0.0) return colour;
    for (std::size_t i = 0; i < colour.size(); ++i) {
        const double code = static_cast<double>(texel >> (8U * i) & 0xFFU) / 255.0;
        colour[i] = std::lerp(colour[i], light_of_srgb(std::min(1.0, code / alpha)), alpha);
    }
    return colour;
}

Result<std::unique_ptr<ExportedFacts>> ExportedFacts::of(const ExportOptions& options, const Region& region,
                                                         std::size_t grid,
                                                         const std::array<double, 3>& plain) {
    std::unique_ptr<ExportedFacts> facts(new ExportedFacts);
    facts->grid_ = &region.grids[grid];
    facts->plain_ = plain;
    for (const SourceReport& source : facts->grid_->sources)
        if (facts->sources_.size() < most_sources) facts->sources_.push_back(ground_source(source));
    std::vector<Fingerprints::OfSource> files;
    if (!options.drape.empty()) {
        ORO_TRY(std::vector<ImageSource> images, open_images(options.drape, ImageValues{}, files));
        std::vector<std::string> outside;
        ORO_TRY(facts->images_, images_over(facts->grid_->field.grid, std::move(images), outside));
        for (const std::string& file : outside)
            facts->notes_.push_back(file + ": lies beside the elevation data");
    }
    if (!options.landcover.empty()) {
        ORO_TRY(CoverChoice choice, cover_choice_from(options.landcover));
        ORO_TRY(facts->cover_, open_cover(choice, files));
        facts->notes_ = facts->cover_->notes();
    }
    for (const Fingerprints::OfSource& file : files)
        facts->key_ += file.name + " " + std::to_string(file.posts.value_or(0)) + "\n";
    return facts;
}

// Of the tile of the pyramid whose texels are some two posts of the level wide.
Result<void> ExportedFacts::add_image_colours(int level, std::span<const VertexPlace> places,
                                              VertexFacts& facts) const {
    constexpr int coarser = 1, texels = 256, stride = texels + 2;
    const int of_image = std::clamp(level + coarser, images_->finest_level(), images_->coarsest_level());
    const double texels_per_post = std::ldexp(2.0, -of_image);
    std::map<ImageTile, std::vector<std::uint32_t>> tiles;
    for (const VertexPlace& place : places) {
        const auto texel_of_axis = [&](double post) {
            return static_cast<int>(std::floor(std::max(0.0, post) * texels_per_post));
        };
        const int row = texel_of_axis(place.row), column = texel_of_axis(place.column);
        const ImageTile tile{of_image, row / texels, column / texels};
        const auto [known, is_new] = tiles.try_emplace(tile);
        std::vector<std::uint32_t>& of_tile = known->second;
        if (is_new) {
            of_tile.resize(gpu::drape_words);
            ORO_TRY(const bool any, images_->load(tile, of_tile));
            if (!any) of_tile.assign(gpu::drape_words, 0);
        }
        facts.colours.push_back(
            colour_of(of_tile[static_cast<std::size_t>((row % texels + 1) * stride + column % texels + 1)]));
    }
    return {};
}

Result<void> ExportedFacts::add_cover_colours(std::span<const VertexPlace> places, VertexFacts& facts) const {
    std::vector<double> lat_deg, lon_deg;
    for (const VertexPlace& place : places) {
        lat_deg.push_back(place.lat_deg);
        lon_deg.push_back(place.lon_deg);
    }
    std::vector<int> codes(places.size(), no_cover_code);
    ORO_CHECK(cover_->codes_at(lat_deg, lon_deg, codes));
    for (const int code : codes) {
        std::array<double, 3> colour = plain_;
        if (const CoverClass* const known = cover_->table().class_of(code))
            for (std::size_t i = 0; i < colour.size(); ++i)
                colour[i] = light_of_srgb(known->colour[i] / 255.0);
        facts.colours.push_back(colour);
    }
    return {};
}

Result<VertexFacts> ExportedFacts::at(int level, std::span<const VertexPlace> places) const {
    VertexFacts facts;
    if (images_) ORO_CHECK(add_image_colours(level, places, facts));
    if (cover_) ORO_CHECK(add_cover_colours(places, facts));
    if (sources_.empty()) return facts;
    for (const VertexPlace& place : places) {
        const SourceReport* const source = source_at(*grid_, place.lat_deg, place.lon_deg);
        const auto number = source == nullptr ? 0 : source - grid_->sources.data();
        facts.sources.push_back(static_cast<std::uint8_t>(
            std::min<std::ptrdiff_t>(number, static_cast<std::ptrdiff_t>(sources_.size()) - 1)));
    }
    return facts;
}

}  // namespace oro
