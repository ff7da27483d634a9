#include "apps/vectors/vectors_in_region.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "apps/report/figures.h"

namespace oro {
namespace {

// What a shape or a grid covers; longitudes go on past 180.
struct DegreeExtent {
    double south_deg{std::numeric_limits<double>::infinity()};
    double north_deg{-std::numeric_limits<double>::infinity()};
    double west_deg{std::numeric_limits<double>::infinity()};
    double east_deg{-std::numeric_limits<double>::infinity()};

    void add(double lat_deg, double lon_deg) {
        south_deg = std::min(south_deg, lat_deg), north_deg = std::max(north_deg, lat_deg);
        west_deg = std::min(west_deg, lon_deg), east_deg = std::max(east_deg, lon_deg);
    }
    [[nodiscard]] bool meets(const DegreeExtent& other) const {
        if (south_deg > other.north_deg || north_deg < other.south_deg) return false;
        const double middle_deg = 0.5 * (west_deg + east_deg),
                     other_middle_deg = 0.5 * (other.west_deg + other.east_deg);
        const double apart_deg = std::abs(std::remainder(middle_deg - other_middle_deg, 360.0));
        return apart_deg <= 0.5 * (east_deg - west_deg + other.east_deg - other.west_deg);
    }
};

DegreeExtent box_of(const VectorShape& shape) {
    DegreeExtent box;
    for (const auto& path : shape.paths) {
        double lon_deg = path.front().lon_deg;
        for (const VectorPlace& place : path) {
            lon_deg += std::remainder(place.lon_deg - lon_deg, 360.0);
            box.add(place.lat_deg, lon_deg);
        }
    }
    return box;
}

// How many features of a file lie in a region, and how many would with their coordinates swapped alone.
struct FeaturesInRegion {
    std::size_t all{}, inside{}, swapped{};
};

FeaturesInRegion features_in(const VectorFile& file, const std::vector<DegreeExtent>& region) {
    FeaturesInRegion count;
    const auto lies_in = [&](const DegreeExtent& box) {
        return std::ranges::any_of(region, [&](const DegreeExtent& grid) { return grid.meets(box); });
    };
    for (const VectorLayer& layer : file.layers) {
        for (std::size_t i = 0; i < layer.shapes.size();) {
            const std::size_t record = layer.shapes[i].record;
            bool is_inside = false, is_swapped = false;
            for (; i < layer.shapes.size() && layer.shapes[i].record == record; ++i) {
                const DegreeExtent box = box_of(layer.shapes[i]);
                is_inside |= lies_in(box);
                is_swapped |= lies_in({box.west_deg, box.east_deg, box.south_deg, box.north_deg});
            }
            ++count.all;
            count.inside += is_inside ? 1 : 0;
            count.swapped += is_swapped && !is_inside ? 1 : 0;
        }
    }
    return count;
}

}  // namespace

std::string note_of_place(const VectorFile& file, const Region& region) {
    std::vector<DegreeExtent> grids;
    DegreeExtent all;
    for (const RegionGrid& grid : region.grids) {
        const PostGrid& posts = grid.field.grid;
        grids.push_back({posts.south_deg(), posts.north_deg(), posts.west_deg(), posts.east_deg()});
        all.add(posts.south_deg(), posts.west_deg());
        all.add(posts.north_deg(), posts.east_deg());
    }
    const FeaturesInRegion count = features_in(file, grids);
    if (count.all == 0) return "";
    const bool most_are_swapped = 2 * count.swapped > count.all;
    if (count.inside > 0 && !most_are_swapped) return "";
    const bool is_one = count.all == 1;
    std::string note = file.file + ": ";
    if (count.inside == 0)
        note += is_one ? "its feature does not lie" : "none of its " + grouped(count.all) + " features lies";
    else
        note += grouped(count.all - count.inside) + " of its " + grouped(count.all) + " features do not lie";
    char box[120];
    std::snprintf(box, sizeof box,
                  " where the elevation data do (%.6g,%.6g,%.6g,%.6g: west,south,east,north)", all.west_deg,
                  all.south_deg, all.east_deg, all.north_deg);
    note += box;
    if (!most_are_swapped) return note;
    return note + "; " + (is_one ? std::string("it") : grouped(count.swapped)) +
           " would with latitude and longitude swapped: is their order right in the file?";
}

}  // namespace oro
