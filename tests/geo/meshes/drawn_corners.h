// Corners of meshes as they are drawn, against PROJ (by OGR) and GeographicLib.
#pragma once

#include <gtest/gtest.h>
#include <ogr_srs_api.h>

#include <GeographicLib/Geocentric.hpp>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <memory>
#include <random>
#include <string>
#include <type_traits>
#include <utility>

#include "geo/meshes/placed_mesh.h"
#include "geo/together/mesh_surface.h"
#include "tests/geo/vectors/written_vectors.h"

namespace oro::test {

struct EndReference {
    void operator()(OGRSpatialReferenceH reference) const { OSRRelease(reference); }
};
using Reference = std::unique_ptr<std::remove_pointer_t<OGRSpatialReferenceH>, EndReference>;

inline Reference reference_of(int epsg) {
    Reference reference(OSRNewSpatialReference(nullptr));
    EXPECT_EQ(OSRImportFromEPSG(reference.get(), epsg), OGRERR_NONE);
    OSRSetAxisMappingStrategy(reference.get(), OAMS_TRADITIONAL_GIS_ORDER);
    return reference;
}

struct CornerBox {
    int epsg;
    double west, east, south, north;
};

// An OBJ of triangles of some 100 m, and the places of its corners, which are exact in decimals.
inline std::pair<std::string, std::vector<glm::dvec3>> mesh_within(const CornerBox& box,
                                                                   std::mt19937& random) {
    std::string text;
    std::vector<glm::dvec3> places;
    constexpr int triangles = 60;
    for (int i = 0; i < triangles; ++i) {
        const double x = std::floor(std::uniform_real_distribution<double>(box.west, box.east)(random)),
                     y = std::floor(std::uniform_real_distribution<double>(box.south, box.north)(random));
        for (int corner = 0; corner < 3; ++corner) {
            const glm::dvec3 at(x + static_cast<double>(random() % 100000) / 1024.0,
                                y + static_cast<double>(random() % 100000) / 1024.0,
                                static_cast<double>(random() % 4000000) / 1024.0);
            places.push_back(at);
            char line[100];
            std::snprintf(line, sizeof line, "v %.10f %.10f %.10f\n", at.x, at.y, at.z);
            text += line;
        }
        const int first = 3 * i + 1;
        text += "f " + std::to_string(first) + " " + std::to_string(first + 1) + " " +
                std::to_string(first + 2) + "\n";
    }
    return {text, places};
}

// The drawn corner that is farthest from where PROJ (by OGR) and GeographicLib have it.
struct WorstCorner {
    double off_m{};
    std::size_t asked{};  // corners
};

// Places all over the area of use of four projected CRSs, up to 4 km high. N is 0.
inline WorstCorner worst_drawn_corner(unsigned seed) {
    std::mt19937 random(seed);
    const Reference degrees = reference_of(4326);
    WorstCorner worst;
    for (const CornerBox& box :
         {CornerBox{2056, 2500000, 2800000, 1080000, 1290000},
          CornerBox{28992, 20000, 270000, 320000, 610000}, CornerBox{32632, 300000, 700000, 5000000, 6000000},
          CornerBox{27700, 100000, 600000, 100000, 900000}}) {
        const Reference projected = reference_of(box.epsg);
        OGRCoordinateTransformationH to_degrees =
            OCTNewCoordinateTransformation(projected.get(), degrees.get());
        EXPECT_NE(to_degrees, nullptr);
        const auto [text, places] = mesh_within(box, random);
        MeshRequest request;
        request.files = {written("places.obj", text)};
        request.crs = "EPSG:" + std::to_string(box.epsg);
        const auto meshes = open_meshes(request, false, {});
        EXPECT_TRUE(meshes.ok());
        if (to_degrees == nullptr || !meshes.ok()) return {};
        std::vector<glm::dvec3> expected;
        for (const glm::dvec3& at : places) {
            double lon_deg = at.x, lat_deg = at.y;
            EXPECT_NE(OCTTransform(to_degrees, 1, &lon_deg, &lat_deg, nullptr), 0);
            glm::dvec3& ecef = expected.emplace_back();
            GeographicLib::Geocentric::WGS84().Forward(lat_deg, lon_deg, at.z, ecef.x, ecef.y, ecef.z);
        }
        Seam seam;
        add_mesh((*meshes)->front(), {}, 1.0, seam);
        for (const SeamPiece& piece : seam.pieces)
            for (const SeamCorner& corner : piece.corners) {
                double nearest_m = 1.0e9;  // the others are in the middle of long sides
                for (const glm::dvec3& at : expected)
                    nearest_m = std::min(nearest_m, glm::distance(at, corner.at.m));
                if (nearest_m > 0.5) continue;
                worst.off_m = std::max(worst.off_m, nearest_m);
                ++worst.asked;
            }
        OCTDestroyCoordinateTransformation(to_degrees);
    }
    return worst;
}

}  // namespace oro::test
