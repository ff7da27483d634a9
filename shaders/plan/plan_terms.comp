#version 460
// Makes the tables of a plan's rows and columns and the places of its pages, to the bit as core/frame/frame_tables.cpp and
// core/frame/frame_plan.cpp make them: workgroups of rows of pages, then of columns of pages, then of pages.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#include "shaders/shared.h"
#include "shaders/plan/shared_plan.h"
#include "shaders/plan/exact.glsl"

layout(local_size_x = 64) in;
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer Terms { PlanTerms at; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer RowSources { RowSource at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer ColumnSources { double at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer PageSources { PageSource at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Numbers { uint at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Rows { RowTerms at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Columns { ColumnTerms at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Pages { FramePage at[]; };
layout(push_constant, scalar) uniform Grid { uvec2 terms; };

uint number_of(uint job) { return Numbers(Terms(terms).at.numbers).at[job]; }

RowTerms row_terms(double sine, double cosine, double normal_m, double polar_m, double reference_m, double rho_m, double z_m) {
    precise double from_axis_m = (normal_m + reference_m) * cosine;
    precise double from_eye_m = from_axis_m - rho_m;
    precise double along_axis_m = (polar_m + reference_m) * sine - z_m;
    float C = float(cosine);
    return RowTerms(float(from_eye_m), C, float(sine), float(from_axis_m), float(along_axis_m), C, C);
}

void make_row(uint job, uint post) {
    RowSource row = RowSources(Terms(terms).at.row_sources).at[number_of(job) * page_posts + post];
    Rows(Terms(terms).at.rows).at[job * page_posts + post] =
        row_terms(row.sine, row.cosine, row.normal_m, row.polar_m, Terms(terms).at.reference_m, Terms(terms).at.rho_m, Terms(terms).at.z_m);
}

// The series of core/frame/column_terms.cpp.
double sine_by_series(double x) {
    precise double z = x * x;
    precise double sum = 1.0lf / 355687428096000.0lf;
    sum = sum * z - 1.0lf / 1307674368000.0lf;
    sum = sum * z + 1.0lf / 6227020800.0lf;
    sum = sum * z - 1.0lf / 39916800.0lf;
    sum = sum * z + 1.0lf / 362880.0lf;
    sum = sum * z - 1.0lf / 5040.0lf;
    sum = sum * z + 1.0lf / 120.0lf;
    sum = sum * z - 1.0lf / 6.0lf;
    precise double all = x + x * z * sum;
    return all;
}

dvec2 product_of(dvec2 a, dvec2 b) {
    dvec2 high = product_of(a.x, b.x);
    precise double low = high.y + (a.x * b.y + a.y * b.x);
    return sum_of(high.x, low);
}
dvec2 sum_of(dvec2 a, dvec2 b) {
    dvec2 high = sum_of(a.x, b.x);
    precise double low = high.y + (a.y + b.y);
    return sum_of(high.x, low);
}

// The double that is nearest to the sine, up to 45 degrees: what the processor's library gives. Only where a bound of the
// series does not tell which float is nearest.
double exact_sine(double x) {
    const dvec2 factors[11] = dvec2[11](
        dvec2(-3.868170170630684e-23lf, 8.843177655482344e-40lf), dvec2(1.9572941063391263e-20lf, -1.3643503830087908e-36lf),
        dvec2(-8.22063524662433e-18lf, -2.2141894119604265e-34lf), dvec2(2.8114572543455206e-15lf, 1.6508842730861433e-31lf),
        dvec2(-7.647163731819816e-13lf, -7.03872877733453e-30lf), dvec2(1.6059043836821613e-10lf, 1.2585294588752098e-26lf),
        dvec2(-2.505210838544172e-08lf, 1.448814070935912e-24lf), dvec2(2.7557319223985893e-06lf, -1.858393274046472e-22lf),
        dvec2(-0.0001984126984126984lf, -1.7209558293420705e-22lf), dvec2(0.008333333333333333lf, 1.1564823173178714e-19lf),
        dvec2(-0.16666666666666666lf, -9.25185853854297e-18lf));
    dvec2 z = product_of(x, x), all = factors[0];
    for (int i = 1; i < 11; ++i) all = sum_of(product_of(all, z), factors[i]);
    dvec2 beyond = product_of(product_of(all, z), dvec2(x, 0.0lf));
    dvec2 high = sum_of(x, beyond.x);
    return sum(high.x, sum(high.y, beyond.y));
}

ColumnTerms column_terms(double east_deg) {
    const double sine_slack = 7.105427357601002e-15lf, versine_slack = 2.842170943040401e-14lf;  // 2^-47 and 2^-45
    precise double x = east_deg * 0.017453292519943295lf;
    precise double half_deg = 0.5lf * east_deg;
    precise double half_x = half_deg * 0.017453292519943295lf;
    double sine = sine_by_series(x), half_sine = sine_by_series(half_x);
    precise double versine = 2.0lf * half_sine * half_sine;
    precise double least_V = versine * (1.0lf - versine_slack), most_V = versine * (1.0lf + versine_slack);
    precise double least_W = sine * (1.0lf - sine_slack), most_W = sine * (1.0lf + sine_slack);
    float V = float(least_V), W = float(least_W);
    if (V == float(most_V) && W == float(most_W) && abs(east_deg) >= 1.0e-9lf) return ColumnTerms(V, W);
    double half_exact = exact_sine(half_x);
    precise double exact_V = 2.0lf * half_exact * half_exact;
    return ColumnTerms(float(exact_V), float(exact_sine(x)));
}

void make_column(uint job, uint post) {
    ColumnSources sources = ColumnSources(Terms(terms).at.column_sources);
    double lon_deg = sources.at[number_of(Terms(terms).at.row_count + job) * page_posts + post];
    Columns(Terms(terms).at.columns).at[job * page_posts + post] = column_terms(difference(lon_deg, Terms(terms).at.eye_lon_deg));
}

dvec3 from_eye(double x, double y, double z) {
    return difference(dvec3(x, y, z), dvec3(Terms(terms).at.eye_ecef[0], Terms(terms).at.eye_ecef[1], Terms(terms).at.eye_ecef[2]));
}

void make_page(uint job) {
    PageSources sources = PageSources(Terms(terms).at.page_sources);
    uint number = number_of(Terms(terms).at.row_count + Terms(terms).at.column_count + job);
    Pages pages = Pages(Terms(terms).at.pages);
    dvec3 by[3], columns[3];
    for (int i = 0; i < 3; ++i)
        by[i] = dvec3(Terms(terms).at.view_from_ecef[3 * i], Terms(terms).at.view_from_ecef[3 * i + 1], Terms(terms).at.view_from_ecef[3 * i + 2]);
    for (int i = 0; i < 3; ++i)
        columns[i] = turned(by[0], by[1], by[2], dvec3(sources.at[number].ecef_from_page[3 * i], sources.at[number].ecef_from_page[3 * i + 1],
                                      sources.at[number].ecef_from_page[3 * i + 2]));
    pages.at[job].view_from_page = mat3(vec3(columns[0]), vec3(columns[1]), vec3(columns[2]));
    dvec3 origin = turned(by[0], by[1], by[2], from_eye(sources.at[number].origin_ecef[0], sources.at[number].origin_ecef[1], sources.at[number].origin_ecef[2]));
    dvec3 centre = turned(by[0], by[1], by[2], from_eye(sources.at[number].centre_ecef[0], sources.at[number].centre_ecef[1], sources.at[number].centre_ecef[2]));
    pages.at[job].origin_view = vec3(origin);
    bool inside_all = true;
    for (int i = 0; i < 5; ++i) {
        dvec3 normal = dvec3(Terms(terms).at.planes[4 * i], Terms(terms).at.planes[4 * i + 1], Terms(terms).at.planes[4 * i + 2]);
        double w = Terms(terms).at.planes[4 * i + 3];
        double at_origin_m = sum(along(normal, origin), w), at_centre_m = sum(along(normal, centre), w);
        pages.at[job].planes[i] = vec4(vec3(along(columns[0], normal), along(columns[1], normal), along(columns[2], normal)), float(at_origin_m));
        inside_all = inside_all && at_centre_m > sources.at[number].radius_m;
    }
    dvec3 eye = dvec3(Terms(terms).at.horizon[0], Terms(terms).at.horizon[1], Terms(terms).at.horizon[2]);
    dvec3 page = dvec3(sources.at[number].horizon[0], sources.at[number].horizon[1], sources.at[number].horizon[2]);
    pages.at[job].horizon_direction = vec3(difference(eye, page));
    if (inside_all) pages.at[job].cull &= ~cull_by_frustum;
}

void main() {
    uint group = gl_WorkGroupID.x, lane = gl_LocalInvocationIndex;
    uint row_count = Terms(terms).at.row_count, column_count = Terms(terms).at.column_count;
    // Where the device has chosen the pages, some rows and columns are in none of them.
    if (group < row_count + column_count && number_of(group) == no_page) return;
    if (group < row_count) {
        for (uint post = lane; post < page_posts; post += 64u) make_row(group, post);
    } else if (group < row_count + column_count) {
        for (uint post = lane; post < page_posts; post += 64u) make_column(group - row_count, post);
    } else {
        uint page = (group - row_count - column_count) * plan_pages_per_group + lane;
        if (page < Terms(terms).at.page_count) make_page(page);
    }
}
