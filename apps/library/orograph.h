/*
 * liborograph: elevation data at their true place on the Earth, and what is seen over them, from C.
 *
 * The library answers with the functions of the program `orograph`: the same data and the same question have
 * the same answer, to the last digit. docs/LIBRARY.md has examples.
 *
 * Units and frames. Latitudes and longitudes are geodetic, in degrees, on the ellipsoid WGS84; a latitude is
 * -90 to 90 and a longitude -180 to 180. H is the height above the geoid (about sea level), h the height
 * above the ellipsoid; both are in metres. Names end with their unit.
 *
 * Errors. Each function that can fail returns an oro_status. Where it is not ORO_OK, oro_error_text() tells
 * the reason to the thread that called, in one line. A function that fails writes nothing to the caller's
 * buffers, unless its comment says otherwise.
 *
 * Threads. Each function may be called from any thread, and several threads may ask about one region at a
 * time. A region that is closed while another thread's call uses it stays until that call has returned.
 *
 * Strings are UTF-8 and end with a zero byte. The library keeps no pointer of the caller's after a call.
 *
 * The process. The library reads rasters by GDAL, and opening a region sets GDAL up for the whole process:
 * docs/LIBRARY.md says how. It prints nothing, installs no handler of signals, and never ends the process,
 * but where GDAL itself reports a fatal error.
 */
#ifndef OROGRAPH_H
#define OROGRAPH_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define ORO_API __attribute__((visibility("default")))
#else
#define ORO_API
#endif

/* The number of this interface. It grows when something is added; what is there stays as it is. */
#define ORO_API_VERSION 3

/*
 * Errors.
 */

/* The first five values are the exit codes of the program. */
typedef int oro_status;
enum {
    ORO_OK = 0,
    ORO_FAILED = 1,    /* A file, a disk or a driver did not do what was asked. */
    ORO_USAGE = 2,     /* An argument cannot mean anything. */
    ORO_NO_DATA = 3,   /* There are no elevation data where the question is. */
    ORO_NO_DEVICE = 4, /* No suitable GPU was found. */
    ORO_CANCELLED = 5, /* The caller's progress function asked the library to stop. */
    ORO_TOO_SMALL = 6  /* The caller's buffer is too small; the needed size was written. */
};

/* Returns the status of the calling thread's last call that can fail. */
ORO_API oro_status oro_error_code(void);

/*
 * Returns the reason of the calling thread's last failed call in one line, or "" where its last call
 * succeeded. It is never NULL. The text stays valid until the thread's next call, but for calls of this
 * function and of oro_error_code().
 */
ORO_API const char* oro_error_text(void);

/*
 * The type of the function that long calls report their progress to: `share` is how much is done, 0 to 1;
 * `step` is what is done, as in "reading N46E008.hgt"; `user` is the pointer that the call was given. The
 * function returns 0 to go on, and any other value to stop: the call then returns ORO_CANCELLED soon. The
 * library calls it from any thread, but never from two at a time for one call. It must not call the library
 * and must not throw.
 */
typedef int (*oro_progress)(double share, const char* step, void* user);

/*
 * The library.
 */

/* Returns the version of the library, as in "0.1.0". */
ORO_API const char* oro_version(void);

/* Returns the ORO_API_VERSION that the library was built with. */
ORO_API int oro_api_version(void);

/*
 * Regions.
 */

/*
 * An open region. It is a number, and no pointer: 0 is no region, and the number of a closed region is never
 * given again, so that its use is an error and harms nothing.
 */
typedef uint64_t oro_region;

/*
 * How a region is opened. Each member is an option of the program with the same meaning and the same refusals
 * (docs/commands/options.md). To be initialized with ORO_OPEN_OPTIONS. A string that is NULL or "" is not
 * given.
 */
typedef struct oro_open_options {
    size_t size;                 /* The size of this structure. */
    const char* bbox;            /* "west,south,east,north" in degrees: the part that is wanted. */
    const char* tile;            /* One tile or a range of tiles instead, as in "N46E008". */
    const char* height_unit;     /* "m", "ft", "us-ft", "cm", "dm" or "mm": it overrides the files. */
    const char* source_crs;      /* Where files lie that do not say so, as in "EPSG:2056". */
    const char* source_vertical; /* What the heights of such files refer to, as in "EPSG:5728". */
    const char* order;           /* "finest" or "listed": which grid is the ground where several have some. */
    double feather_m; /* Within so many metres of a finer grid's rim heights go over; 0: they do not. */
    int strict_datum; /* Nonzero refuses a geoid that stands in for another one. */
    int fill_voids;   /* Nonzero fills void posts from their neighbours. */
    int resample;     /* Nonzero brings posts in a projected CRS onto latitudes and longitudes. */
    const char* const* landcover; /* Rasters of land cover, each "FILE" or "FILE,TABLE". */
    size_t landcover_count;
    const char* const*
        canopy; /* Rasters of canopy heights, or "class" alone, which takes it from land cover. */
    size_t canopy_count;
    double canopy_held; /* The share of the canopy that the heights hold, 0 to 1; negative: not given. */
} oro_open_options;
#define ORO_OPEN_OPTIONS \
    { sizeof(oro_open_options), NULL, NULL, NULL, NULL, NULL, NULL, 0.0, 0, 0, 0, NULL, 0, NULL, 0, -1.0 }

/*
 * Opens the elevation data in `count` files, folders or archives as one region, which the caller closes with
 * oro_close(). `options` may be NULL. `progress` may be NULL. Where the call fails *region becomes 0. Errors:
 * ORO_FAILED for a file that is damaged or not there, ORO_NO_DATA for a box without data, ORO_USAGE for an
 * option.
 */
ORO_API oro_status oro_open(const char* const* paths, size_t count, const oro_open_options* options,
                            oro_progress progress, void* user, oro_region* region);

/* Closes a region. Errors: ORO_USAGE for a number that is no open region, 0 among them. */
ORO_API oro_status oro_close(oro_region region);

/*
 * Writes what the region is made of as JSON, the text of `orograph info --json`, to `text`, which has room
 * for `capacity` bytes, with a zero byte at its end. *length becomes the length of the text without that
 * byte, also where the room is too small (ORO_TOO_SMALL): to ask for it alone give NULL and 0.
 */
ORO_API oro_status oro_info(oro_region region, char* text, size_t capacity, size_t* length);

/*
 * Writes the heights of the ground at `count` places: H_m[i] and h_m[i] at lat_deg[i], lon_deg[i]; NaN where
 * the region has no ground. Either H_m or h_m may be NULL. Between posts the ground is the two triangles of a
 * cell, as in all that the program computes. Errors: ORO_USAGE for a place that is none, before anything is
 * written; ORO_FAILED for posts of a baked file that cannot be read, with heights that are then worth
 * nothing.
 */
ORO_API oro_status oro_heights(oro_region region, size_t count, const double* lat_deg, const double* lon_deg,
                               double* H_m, double* h_m);

/*
 * As oro_heights(), for many places: `progress`, which may be NULL, is told how far it is after some thousand
 * places each. Where it stops the call, heights that are written are worth nothing. Since ORO_API_VERSION 3.
 */
ORO_API oro_status oro_heights_with_progress(oro_region region, size_t count, const double* lat_deg,
                                             const double* lon_deg, double* H_m, double* h_m,
                                             oro_progress progress, void* user);

/*
 * Points and light.
 */

/* What the height of an oro_point is above. */
enum {
    ORO_ABOVE_GROUND = 0,   /* The ground under the point, which is 0.001 m above it at least. */
    ORO_ABOVE_GEOID = 1,    /* H. */
    ORO_ABOVE_ELLIPSOID = 2 /* h. */
};

/* A point as a caller asks for it. */
typedef struct oro_point {
    double lat_deg;
    double lon_deg;
    double height_m;
    int above; /* ORO_ABOVE_... */
} oro_point;

/* A point as the library answers it. Where there is none its members are NaN. */
typedef struct oro_position {
    double lat_deg;
    double lon_deg;
    double H_m;
    double h_m;
} oro_position;

/* How light bends in the air. */
enum {
    ORO_AIR_STANDARD =
        0, /* By the standard atmosphere: the coefficient of refraction falls with the eye's height. */
    ORO_AIR_CONSTANT = 1 /* By the coefficient of refraction that is given; 0: light goes straight. */
};

/*
 * Lines of sight.
 */

/* How a line of sight is asked for. To be initialized with ORO_SIGHT_OPTIONS. */
typedef struct oro_sight_options {
    size_t size;         /* The size of this structure. */
    int air;             /* ORO_AIR_... */
    double refraction_k; /* The coefficient of refraction of ORO_AIR_CONSTANT, -1 to 0.9. */
    int on_summit;       /* Nonzero moves the eye to the highest post near its place. */
} oro_sight_options;
#define ORO_SIGHT_OPTIONS \
    { sizeof(oro_sight_options), ORO_AIR_STANDARD, 0.13, 0 }

/* What a line of sight comes to: the figures of `orograph sight --json`. */
typedef struct oro_sight_answer {
    size_t size;                  /* The size of this structure, which the caller sets. */
    int visible;                  /* 1 where the target is seen, else 0. */
    oro_position from;            /* The eye. */
    oro_position to;              /* The target. */
    oro_position obstacle;        /* The first that hides it. */
    double obstacle_distance_m;   /* From the eye over the ellipsoid; NaN where the target is seen. */
    double target_deficit_m;      /* How much higher the target must be to be seen; NaN: no height will do. */
    double eye_deficit_m;         /* How much higher the eye must be; NaN: no height will do. */
    double least_clearance_m;     /* Of the line over the ground; NaN where it is over no data at all. */
    oro_position least_clearance; /* The ground there. */
    double distance_m;            /* Over the ellipsoid. */
    double azimuth_deg;           /* Clockwise from true north, at the eye. */
    double elevation_deg;         /* At which the target is seen, or would be. */
    double slant_m;               /* The straight distance. */
    double without_data_m;        /* The length of the line that lies over no data. */
} oro_sight_answer;
#define ORO_SIGHT_ANSWER_SIZE sizeof(oro_sight_answer)

/*
 * Finds whether `to` is seen from `from`, and writes to *answer, whose size the caller has set. `options` may
 * be NULL. Errors: ORO_NO_DATA for a point over the ground where there is none, ORO_USAGE for a point that is
 * none or that lies under the ground, and for two points that are one.
 */
ORO_API oro_status oro_sight(oro_region region, const oro_point* from, const oro_point* to,
                             const oro_sight_options* options, oro_sight_answer* answer);

/*
 * Profiles.
 */

/* A place of a profile. */
typedef struct oro_profile_point {
    double distance_m; /* From the line's begin, along it, over the ellipsoid. */
    double lat_deg;
    double lon_deg;
    double H_m; /* NaN where there is no ground. */
    double h_m; /* NaN where there is no ground. */
} oro_profile_point;

/* How a profile is asked for. To be initialized with ORO_PROFILE_OPTIONS. */
typedef struct oro_profile_options {
    size_t size;   /* The size of this structure. */
    double step_m; /* From point to point; 0: all places where the line crosses an edge of the ground. */
    double climb_threshold_m; /* The rises and falls that count as such, 0 to 10,000. */
} oro_profile_options;
#define ORO_PROFILE_OPTIONS \
    { sizeof(oro_profile_options), 0.0, 10.0 }

/* What a profile comes to: the figures of `orograph profile --json`. */
typedef struct oro_profile_sums {
    size_t size;            /* The size of this structure, which the caller sets. */
    double length_m;        /* Of the line, over the ellipsoid. */
    double ascent_m;        /* The sum of every rise. */
    double descent_m;       /* The sum of every fall, 0 or more. */
    double ascent_over_m;   /* The sum of rises of climb_threshold_m or more. */
    double descent_over_m;  /* The sum of falls of climb_threshold_m or more. */
    double without_data_m;  /* The length that lies over no data; no sum has it. */
    size_t highest, lowest; /* The numbers of the highest and of the lowest point. */
} oro_profile_sums;

/*
 * Follows the line through `places` places, each joined to the next by the shortest way over the ellipsoid,
 * and writes its points to `points`, which has room for `capacity` of them. *count becomes the number of
 * points, also where the room is too small (ORO_TOO_SMALL): to ask for it alone give NULL and 0. `sums`,
 * whose size the caller has set, may be NULL, and `options` may be NULL. Errors: ORO_USAGE for fewer than two
 * places, for a line without a length and for more than 10,000,000 steps; ORO_NO_DATA for a line that has no
 * ground at all.
 */
ORO_API oro_status oro_profile(oro_region region, size_t places, const double* lat_deg, const double* lon_deg,
                               const oro_profile_options* options, oro_profile_point* points, size_t capacity,
                               size_t* count, oro_profile_sums* sums);

/*
 * As oro_profile(), for long lines: `progress`, which may be NULL, is told how far along the line it is after
 * some thousand points each. Where it stops the call nothing is written. Since ORO_API_VERSION 3.
 */
ORO_API oro_status oro_profile_with_progress(oro_region region, size_t places, const double* lat_deg,
                                             const double* lon_deg, const oro_profile_options* options,
                                             oro_profile_point* points, size_t capacity, size_t* count,
                                             oro_profile_sums* sums, oro_progress progress, void* user);

/*
 * Viewsheds.
 */

/* How a viewshed is asked for. To be initialized with ORO_VIEWSHED_OPTIONS. */
typedef struct oro_viewshed_options {
    size_t size;           /* The size of this structure. */
    double radius_km;      /* Around each eye over the ellipsoid, 0.01 to 1,000. */
    double target_m;       /* The height of targets over the ground of their posts, 0 or more. */
    int air;               /* ORO_AIR_... */
    double refraction_k;   /* The coefficient of refraction of ORO_AIR_CONSTANT, -1 to 0.9. */
    int on_summit;         /* Nonzero moves each eye to the highest post near its place. */
    int targets_on_canopy; /* Nonzero: targets stand on the canopy, and not on the ground under it. */
} oro_viewshed_options;
#define ORO_VIEWSHED_OPTIONS \
    { sizeof(oro_viewshed_options), 20.0, 0.0, ORO_AIR_STANDARD, 0.13, 0, 0 }

/* The posts that a viewshed has values of: a part of one grid of the region. */
typedef struct oro_window {
    size_t size;       /* The size of this structure, which the caller sets. */
    size_t grid;       /* The number of the grid, for oro_grid_crs(). */
    int64_t first_row; /* The rows and columns of the grid that the window begins with. */
    int64_t first_column;
    size_t rows; /* From the north to the south. */
    size_t columns;
    /*
     * Where cells lie in the grid's CRS, as GDAL counts: x = t[0] + t[1] column + t[2] row and
     * y = t[3] + t[4] column + t[5] row, of the corner of a cell whose middle is a post.
     */
    double transform[6];
    size_t known; /* After oro_viewshed(): the posts within the radius that have ground. */
    size_t seen;  /* After oro_viewshed(): those of them that are seen. */
} oro_window;

/* The value of a post that is void or beyond the radius. */
#define ORO_UNKNOWN (-9999.0f)

/*
 * Writes the window of a viewshed from `count` eyes to *window, whose size the caller has set, and looks at
 * nothing yet. `options` may be NULL. Errors: those of oro_viewshed(), but for the buffers.
 */
ORO_API oro_status oro_viewshed_window(oro_region region, size_t count, const oro_point* eyes,
                                       const oro_viewshed_options* options, oro_window* window);

/*
 * Finds which posts of the window of oro_viewshed_window() are seen from `count` eyes. For each post, row by
 * row, clearance_deficit_m becomes 0 where a target over it is seen from one of the eyes, else how much
 * higher it must be, infinite where no height will do; observers becomes the number of eyes that see it; both
 * become ORO_UNKNOWN beyond the radius and over void posts. Each has room for `capacity` values; what each
 * eye sees is put straight into them, as the program puts it into its own. *window becomes what
 * oro_viewshed_window() writes, also where the room is too small (ORO_TOO_SMALL). What a call that fails has
 * written to the buffers is worth nothing. Errors: ORO_NO_DATA for no ground under an eye or within the
 * radius; ORO_USAGE for an eye that is none, and for more than 200,000,000 posts.
 */
ORO_API oro_status oro_viewshed(oro_region region, size_t count, const oro_point* eyes,
                                const oro_viewshed_options* options, float* clearance_deficit_m,
                                float* observers, size_t capacity, oro_window* window, oro_progress progress,
                                void* user);

/*
 * Horizons. Since ORO_API_VERSION 2.
 */

/* How horizons are asked for. To be initialized with ORO_HORIZON_OPTIONS. */
typedef struct oro_horizon_options {
    size_t size;      /* The size of this structure. */
    const char* bbox; /* "west,south,east,north" in degrees: the posts that are asked; NULL: all of the grid
                         that has the most. */
    int directions;   /* Azimuths, evenly spaced clockwise from true north, 3 to 720. */
    double radius_km; /* Ground farther away does not count, 0.01 to 500. */
    double above_m;   /* Of the eyes over the ground, 0 or more. */
    int air;          /* ORO_AIR_... */
    double refraction_k; /* The coefficient of refraction of ORO_AIR_CONSTANT, -1 to 0.9. */
} oro_horizon_options;
#define ORO_HORIZON_OPTIONS \
    { sizeof(oro_horizon_options), NULL, 36, 50.0, 0.0, ORO_AIR_STANDARD, 0.13 }

/*
 * Writes which posts oro_horizon() with the same options answers for to *window, whose size the caller has
 * set, and looks at nothing yet. `options` may be NULL. Errors: those of oro_horizon(), but for the buffers.
 */
ORO_API oro_status oro_horizon_window(oro_region region, const oro_horizon_options* options,
                                      oro_window* window);

/*
 * Finds how high the horizon stands around the posts of the window of oro_horizon_window(), and how much of
 * the sky they see, as `orograph horizon` does. The region must hold the ground within the radius around
 * these posts: ground that it does not hold does not count.
 *
 * elevation_deg becomes the horizon's elevation over the level plane of each eye: all posts in the first
 * azimuth, row by row, then all in the next one; it has room for directions times `capacity` values. sky_view
 * becomes the sky-view factor of a level plane, 0 to 1, weighted by cosine, and has room for `capacity`
 * values. Either may be NULL. A value is ORO_UNKNOWN for a void post and in an azimuth without ground.
 * *window becomes what oro_horizon_window() writes, also where the room is too small (ORO_TOO_SMALL);
 * afterwards window->known is the number of posts with a horizon, and window->seen of those with a sky-view
 * factor. What a call that fails has written to the buffers is worth nothing. Errors: ORO_NO_DATA for a box
 * without posts; ORO_USAGE for an option, and for more than 500,000,000 values.
 */
ORO_API oro_status oro_horizon(oro_region region, const oro_horizon_options* options, float* elevation_deg,
                               float* sky_view, size_t capacity, oro_window* window, oro_progress progress,
                               void* user);

/*
 * Writes the CRS of a grid of the region, which a window names, as text for GDAL or PROJ: "EPSG:4326" with
 * the longitude first, or WKT. The room for it is as for oro_info().
 */
ORO_API oro_status oro_grid_crs(oro_region region, size_t grid, char* text, size_t capacity, size_t* length);

/*
 * Pictures.
 */

/*
 * Draws a picture of the region on the GPU, as `orograph shot` does: the same options give the same pixels.
 * `count` words say what is wanted, as on a command line: "--at", "46.67,8.06", "--heading", "90", "--size",
 * "800x600" (docs/commands/options.md). What names data or files to write is refused: --bbox, --view, --out
 * and the like.
 *
 * The pixels go to `rgba`, row by row from the top, 4 bytes each: red, green and blue as in sRGB, and
 * opacity, which is 255 but where a map (--ortho) has no ground. The buffer has room for `capacity` bytes.
 * *width_px and *height_px become the picture's size, also where the room is too small (ORO_TOO_SMALL), which
 * is found before anything is drawn: to ask for the size alone give NULL and 0 and take ORO_TOO_SMALL. What a
 * call that fails has written to the buffer is worth nothing. Pictures are drawn one at a time: a second
 * thread waits. Errors: ORO_USAGE for words, ORO_NO_DATA for an eye over no ground or a view that nothing of
 * the region can be in, ORO_NO_DEVICE.
 */
ORO_API oro_status oro_shot(oro_region region, size_t count, const char* const* options, uint8_t* rgba,
                            size_t capacity, size_t* width_px, size_t* height_px, oro_progress progress,
                            void* user);

/*
 * Where oro_shot_layers() writes what each pixel shows, row by row from the top, NaN where it shows no
 * ground. A layer that is NULL is not wanted. `size` is the size of this structure; begin with
 * {sizeof(oro_layers)}.
 */
typedef struct oro_layers {
    size_t size;
    size_t capacity; /* How many values each layer has room for. */
    double* longitude_deg;
    double* latitude_deg;
    float* H_m;
    float* h_m;
    float* distance_m; /* From the eye along the line of sight. */
    float* slope_deg;
    float* source; /* The number of the source in oro_info(), from 0. */
    float* shadow; /* The share of the sun's light that comes past the terrain, 0 to 1. */
    float* cover;  /* The code of the land cover; of views with some alone. */
} oro_layers;

/*
 * Finds what the pixels of a picture show, as `orograph shot --layers` does: the same options as for
 * oro_shot() give the same values, without the strip of a legend. *width_px and *height_px become the layers'
 * size, also where the room is too small (ORO_TOO_SMALL), which is found before anything is drawn. Errors:
 * those of oro_shot(); ORO_USAGE for a map, and for a picture of too many pixels.
 */
ORO_API oro_status oro_shot_layers(oro_region region, size_t count, const char* const* options,
                                   const oro_layers* layers, size_t* width_px, size_t* height_px,
                                   oro_progress progress, void* user);

/*
 * Draws a panorama of the region with rulers and names, as `orograph panorama` does: "--at", "46.67,8.06",
 * "--sector", "90,200", "--width", "2000". All else is as oro_shot() has it. The size follows from the data,
 * and to find it takes about as long as to look for the skyline.
 */
ORO_API oro_status oro_panorama(oro_region region, size_t count, const char* const* options, uint8_t* rgba,
                                size_t capacity, size_t* width_px, size_t* height_px, oro_progress progress,
                                void* user);

#ifdef __cplusplus
}
#endif

#endif /* OROGRAPH_H */
