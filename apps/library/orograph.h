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
#define ORO_API_VERSION 1

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
    const char* height_unit;     /* "m", "ft", "us-ft" or "cm": it overrides what the files say. */
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

#ifdef __cplusplus
}
#endif

#endif /* OROGRAPH_H */
