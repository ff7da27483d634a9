#version 460
// First step of a choice of pages: each page of the region by itself. Whether an eye may see any of it, and which of its quarters are
// good enough, by the rules of core/frame/detail_rule.cpp and core/earth/culling.cpp, to the bit.
#extension GL_GOOGLE_include_directive : require
#include "shaders/plan/choice.glsl"

layout(local_size_x = 64) in;

// How many roots of four halve an angle, so that a short series gives it.
const int halvings = 4;

double quotient(double a, double b) {
    precise double all = a / b;
    return all;
}

// Of two directions, radians, to some 1e-15.
double angle_between(dvec3 a, dvec3 b) {
    dvec3 cross_product = dvec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
    double y = length_of(cross_product), x = along(a, b);
    for (int i = 0; i < halvings; ++i) x += exact_root(x * x + y * y);
    double t = quotient(y, x), z = t * t, sum = 0.0lf;
    for (int i = 14; i > 0; --i) sum = (sum + (i % 2 == 0 ? 1.0lf : -1.0lf) / double(2 * i + 1)) * z;
    return 16.0lf * (t + t * sum);
}

bool beyond_horizon(uint page) {
    const double angle_slack_rad = 1.0e-11lf, chord_slack = 1.0e-5lf, pi = 3.141592653589793lf;
    double reach_rad = sum(sum(Terms(terms).at.horizon_angle_rad, records().at[page].horizon_angle_rad), angle_slack_rad);
    if (!(reach_rad < pi)) return false;
    dvec3 eye = dvec3(Terms(terms).at.horizon[0], Terms(terms).at.horizon[1], Terms(terms).at.horizon[2]);
    dvec3 cone = dvec3(records().at[page].horizon[0], records().at[page].horizon[1], records().at[page].horizon[2]);
    if ((records().at[page].traits & choice_unit_cone) != 0u) {
        double chord = length_of(difference(eye, cone));
        if (chord <= 1.0lf && chord * (1.0lf + chord * chord / 20.0lf) < reach_rad - chord_slack) return false;
        if (chord > reach_rad + chord_slack) return true;
    }
    double angle_rad = angle_between(eye, cone);
    if (abs(angle_rad - reach_rad) < 1.0e-14lf) atomicAdd(counts().at.undecided, 1u);
    return angle_rad > reach_rad;
}

bool beyond_frustum(dvec3 centre_m, double radius_m) {
    for (int i = 0; i < 5; ++i) {
        dvec3 normal = dvec3(Terms(terms).at.planes[4 * i], Terms(terms).at.planes[4 * i + 1], Terms(terms).at.planes[4 * i + 2]);
        double w = Terms(terms).at.planes[4 * i + 3];
        if (sum(along(normal, centre_m), w) < -radius_m) return true;
    }
    return false;
}

// Roots and quotients of floats by doubles: they are rounded as the processor rounds them.
float root(float x) { return float(sqrt(double(x))); }
float quotient(float a, float b) { return float(double(a) / double(b)); }

// projected_error_px() of shaders/choose/levels.glsl.
float projected_px(vec3 centre, float radius, float error_m, float pixels_per_tangent, float corner_tangent) {
    if (error_m <= 0.0) return 0.0;
    precise float across_square = centre.x * centre.x + centre.y * centre.y;
    float across_m = root(across_square);
    precise float distance_square = across_m * across_m + centre.z * centre.z;
    float distance_m = root(distance_square);
    precise float slack_m = 1.0e-6 * distance_m + 1.0e-5 * radius;
    precise float e = error_m * 1.00001;
    float px = 1.0e30;
    precise float z_min_m = -centre.z - radius - slack_m;
    if (z_min_m > e) {
        precise float reach = across_m + radius + slack_m;
        float t = min(quotient(reach, z_min_m), corner_tangent);
        precise float stretch_square = 1.0 + t * t;
        precise float moved = pixels_per_tangent * e * root(stretch_square);
        precise float away_m = z_min_m - e;
        px = min(px, quotient(moved, away_m));
    }
    precise float corner_square = 1.0 + corner_tangent * corner_tangent;
    float stretch = root(corner_square);
    precise float d_min_m = distance_m - radius - slack_m;
    precise float e_stretched = e * stretch;
    if (d_min_m > e_stretched) {
        precise float moved = pixels_per_tangent * e * stretch * stretch;
        precise float away_m = d_min_m - e_stretched;
        px = min(px, quotient(moved, away_m));
    }
    return px;
}

const float unfit_m = 1.0e30;  // unfit_error_m

// Whether two bounds of it say what the whole formula would: 1 good enough, -1 not, 0 nothing.
int decided_by_bounds(double error_m, double radius_m, double distance_m, double pixels_per_tangent, double tau_px, double stretch) {
    precise double error_px_m = pixels_per_tangent * error_m;
    precise double limit = 1.001lf * tau_px * distance_m;
    if (error_px_m > limit) return -1;
    precise double nearest_m = distance_m - radius_m - 2.0e-5lf * (distance_m + radius_m) - 1.001lf * error_m * stretch;
    precise double most = error_px_m * stretch * stretch;
    precise double least = 0.999lf * tau_px * nearest_m;
    return nearest_m > 0.0lf && most < least ? 1 : 0;
}

bool good_enough(float error_m, dvec3 centre_m, double radius_m, double distance_m) {
    if (error_m >= unfit_m) return false;
    float pixels_per_tangent = Terms(terms).at.pixels_per_tangent, tau_px = Terms(terms).at.tau_px;
    if (error_m > 1.0e-20) {
        int decided = decided_by_bounds(double(error_m), radius_m, distance_m, double(pixels_per_tangent), double(tau_px), Terms(terms).at.corner_stretch);
        if (decided != 0) return decided > 0;
    }
    return projected_px(vec3(centre_m), float(radius_m), error_m, pixels_per_tangent, Terms(terms).at.corner_tangent) <= tau_px;
}

bool fine_enough_to_shade(uint page, double radius_m, double distance_m) {
    return Terms(terms).at.spacing_px_m[level_of(page)] <= product(Terms(terms).at.shading_spacing_px, difference(distance_m, radius_m));
}

// Bits of one quarter.
uint rated_quarter(uint page, uint i) {
    if (records().at[page].children[i] == no_page) return 0u;
    float error_m = records().at[page].errors_m[i];
    bool enough = error_m < unfit_m, fine = true;
    double radius_m = records().at[page].quarters[i].lod_radius_m;
    if (radius_m >= 0.0lf) {
        dvec3 centre_m = seen(records().at[page].quarters[i].centre_ecef[0], records().at[page].quarters[i].centre_ecef[1],
                              records().at[page].quarters[i].centre_ecef[2]);
        double distance_m = length_of(centre_m);
        enough = enough && good_enough(error_m, centre_m, radius_m, distance_m);
        fine = fine_enough_to_shade(page, radius_m, distance_m);
    }
    return (enough ? 1u << (rated_enough + i) : 0u) | (enough && fine ? 0u : 1u << (rated_refined + i));
}

uint rating_of(uint page) {
    double reach_m = records().at[page].reach_m;
    if (reach_m < 0.0lf) return 0u;
    dvec3 centre_m = seen(records().at[page].centre_ecef[0], records().at[page].centre_ecef[1], records().at[page].centre_ecef[2]);
    if (Terms(terms).at.gap_reach > 0.0lf) reach_m = grown(reach_m, length_of(centre_m), Terms(terms).at.gap_reach);
    if (beyond_frustum(centre_m, reach_m)) return rated_beyond_frustum;
    if (beyond_horizon(page)) return rated_beyond_horizon;
    uint rating = rated_seen;
    for (uint i = 0u; i < 4u; ++i) rating |= rated_quarter(page, i);
    return rating;
}

void main() {
    uint job = gl_GlobalInvocationID.x;
    if (job < Terms(terms).at.change_count) {
        Changes changes = Changes(Terms(terms).at.changes);
        Blocks(Terms(terms).at.blocks).at[changes.at[job].page] = changes.at[job].block;
    }
    if (job < Terms(terms).at.row_source_count + Terms(terms).at.column_source_count) Words(Terms(terms).at.numbers).at[job] = no_page;
    if (job >= Terms(terms).at.page_count) return;
    Words(Terms(terms).at.slots).at[job] = no_page;
    if (Terms(terms).at.numbers_now != uvec2(0u)) Words(Terms(terms).at.numbers_now).at[job] = no_page;
    Words(Terms(terms).at.ratings).at[job] = rating_of(job);
}
