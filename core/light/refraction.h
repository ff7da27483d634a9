// How the air bends the sun's light: between the elevation at which the sun would stand without air and the
// one at which it is seen.
#pragma once

namespace oro {

// The air at the place, which bends the sun's light. Default: what almanacs take.
struct Weather {
    double pressure_hpa{1010.0};
    double temperature_c{10.0};
};

// What to add to an elevation without air, in degrees. Source: T. Saemundsson, Atmospheric Refraction, Sky
// and Telescope 72, 1986, p. 70 (Meeus 1998, eq. 16.4), scaled by pressure and temperature as there. Within
// 0.1 minute of arc of Bennett's formula (1982) from the horizon up, both for average air: true air differs
// by several minutes of arc at the horizon. Below -1 degree nothing is published: from there it falls in a
// straight line to 0 at -3 degrees, so that the sun sinks without a jump.
double refraction_deg(double airless_elevation_deg, const Weather& weather);

// The share of the sea's air density that is left at a height: 1 at 0, 0.74 at 3,000 m, nothing in space.
// Source: Manual of the ICAO Standard Atmosphere, Doc 7488/3, 1993. Below -1,000 m as there.
double air_share(double h_m);

// The elevation at which an eye at a height sees what would stand at `airless_deg` without air, and the
// inverse of it, right to 1e-9 degree. Above the level plane refraction_deg() in almanacs' weather, thinned
// with the air's density. An eye on a height sees farther down than level, through denser air and out again
// on the other side: there a light ray is symmetric about its lowest point, so that what it is bent by is
// twice the refraction at a level eye there, less that of the same angle upwards at the eye. Source: A. T.
// Young, Understanding Astronomical Refraction, The Observatory 126, 2006; the lowest point by Bouguer's
// n r cos(elevation) = constant, with n - 1 = 2.8e-4 at sea level. At 3,000 m the sea's horizon lies 1.6
// degrees below level and the sun that is seen there 2.5: 0.06 degree from the navigators' rule of 2.076
// minutes of arc a root of a metre. Below what any ground leaves free the lift falls to 0 within 3 degrees.
// h_m: of the eye above the ellipsoid (as good as above the sea here).
double seen_elevation_deg(double airless_deg, double h_m);
double airless_elevation_deg(double seen_deg, double h_m);

// How much of the sun's disc, 0 to 1, is above a level line when its middle is seen at an elevation. The
// disc's radius is the mean one, 0.2666 degree, and refraction does not flatten it.
double share_of_disc(double elevation_deg);

}  // namespace oro
