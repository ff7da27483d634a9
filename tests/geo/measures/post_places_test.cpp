#include "geo/measures/post_places.h"

#include <cpl_conv.h>
#include <gtest/gtest.h>

#include <cmath>

#include "geo/files/raster_library.h"

namespace oro {
namespace {

Source source_in(const char* crs, double left, double top, double post, int side, double turned = 0.0) {
    start_gdal();
    Source source;
    const SpatialReference reference(OSRNewSpatialReference(nullptr));
    OSRSetFromUserInput(reference.get(), crs);
    char* text = nullptr;
    OSRExportToWkt(reference.get(), &text);
    source.crs_wkt = text;
    CPLFree(text);
    source.crs_from_post = {left, post * std::cos(turned), post * std::sin(turned),
                            top,  post * std::sin(turned), -post * std::cos(turned)};
    source.report.rows = source.report.columns = side;
    return source;
}

// Each post by PROJ itself: 1e-9 degree is what PostPlaces promises, 2e-9 leaves room for where it looked.
void expect_as_by_proj(const Source& source, const PostLattice& lattice) {
    const auto places = PostPlaces::create(source);
    ASSERT_TRUE(places.ok()) << places.error().line();
    std::vector<LatLon> found;
    places->of(lattice, found);
    ASSERT_EQ(found.size(),
              static_cast<std::size_t>(lattice.rows) * static_cast<std::size_t>(lattice.columns));
    const SpatialReference crs = spatial_reference(source.crs_wkt);
    const CoordinateTransformation way(OCTNewCoordinateTransformation(crs.get(), wgs84_degrees().get()));
    const auto& m = source.crs_from_post;
    for (int r = 0; r < lattice.rows; ++r) {
        for (int c = 0; c < lattice.columns; ++c) {
            const int row = lattice.row + r * lattice.step, column = lattice.column + c * lattice.step;
            double x = m[0] + m[1] * column + m[2] * row, y = m[3] + m[4] * column + m[5] * row;
            int done = 0;
            OCTTransformEx(way.get(), 1, &x, &y, nullptr, &done);
            const LatLon& place =
                found[static_cast<std::size_t>(r) * static_cast<std::size_t>(lattice.columns) +
                      static_cast<std::size_t>(c)];
            ASSERT_EQ(done != 0, !std::isnan(place.lat_deg)) << r << " " << c;
            if (!done) continue;
            ASSERT_NEAR(place.lat_deg, y, 2e-9) << r << " " << c;
            ASSERT_NEAR(std::remainder(place.lon_deg - x, 360.0), 0.0, 2e-9) << r << " " << c;
        }
    }
}

TEST(PostPlaces, AreThoseOfProj) {
    expect_as_by_proj(source_in("EPSG:2056", 2600000.0, 1200000.0, 90.0, 700), {10, 20, 64, 64, 1});
    expect_as_by_proj(source_in("EPSG:21781", 600000.0, 200000.0, 25.0, 700, 0.35), {0, 0, 64, 61, 3});
    expect_as_by_proj(source_in("EPSG:32632", 166000.0, 5100000.0, 1000.0, 700), {0, 0, 64, 64, 10});
}

TEST(PostPlaces, AtThePoleAcrossTheAntimeridianAndFarApart) {
    expect_as_by_proj(source_in("EPSG:3413", -32000.0, 32000.0, 1000.0, 64), {0, 0, 64, 64, 1});
    expect_as_by_proj(source_in("EPSG:3031", -3000000.0, 3000000.0, 100000.0, 61), {0, 0, 61, 61, 1});
    expect_as_by_proj(source_in("EPSG:3460", 1800000.0, 4200000.0, 4000.0, 300), {0, 0, 64, 64, 4});
}

// Posts outside what the projection can show have no place.
TEST(PostPlaces, BeyondTheProjectionThereIsNone) {
    expect_as_by_proj(source_in("+proj=ortho +lat_0=45 +lon_0=8 +datum=WGS84", -7e6, 7e6, 2e5, 70),
                      {0, 0, 64, 64, 1});
}

}  // namespace
}  // namespace oro
