/*
 * Writes what is seen from a place as a picture: viewshed PATH LAT LON RADIUS_KM OUT.pgm
 * What is seen is white, what is hidden is dark, and what is not known is black.
 *
 *     cc -std=c99 viewshed.c -o viewshed $(pkg-config --cflags --libs orograph)
 */
#include <orograph.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>

static volatile sig_atomic_t is_interrupted = 0;

static void interrupt(int number) {
    (void)number;
    is_interrupted = 1;
}

/* Ctrl-C ends the search: the call then returns ORO_CANCELLED. */
static int show_share(double share, const char* step, void* user) {
    (void)user;
    fprintf(stderr, "\r%s: %3.0f %%", step, 100.0 * share);
    return is_interrupted;
}

static int write_picture(const char* name, const oro_window* window, const float* observers) {
    FILE* const file = fopen(name, "wb");
    if (file == NULL) return 0;
    fprintf(file, "P5\n%zu %zu\n255\n", window->columns, window->rows);
    for (size_t i = 0; i < window->rows * window->columns; ++i)
        fputc(observers[i] == ORO_UNKNOWN ? 0 : observers[i] > 0.0f ? 255 : 64, file);
    return fclose(file) == 0;
}

/* Finds the window, makes room for it, and looks around. */
static oro_status look_around(oro_region region, const oro_point* eye, const oro_viewshed_options* options,
                              oro_window* window, float** observers) {
    oro_status status = oro_viewshed_window(region, 1, eye, options, window);
    if (status != ORO_OK) return status;
    const size_t posts = window->rows * window->columns;
    float* const deficit_m = malloc(posts * sizeof *deficit_m);
    *observers = malloc(posts * sizeof **observers);
    status =
        deficit_m == NULL || *observers == NULL
            ? ORO_FAILED
            : oro_viewshed(region, 1, eye, options, deficit_m, *observers, posts, window, show_share, NULL);
    free(deficit_m);
    return status;
}

int main(int argc, char** argv) {
    if (argc != 6) {
        fprintf(stderr, "usage: viewshed PATH LAT LON RADIUS_KM OUT.pgm\n");
        return ORO_USAGE;
    }
    signal(SIGINT, interrupt);
    const char* const paths[] = {argv[1]};
    const oro_point eye = {strtod(argv[2], NULL), strtod(argv[3], NULL), 2.0, ORO_ABOVE_GROUND};
    oro_viewshed_options options = ORO_VIEWSHED_OPTIONS;
    options.radius_km = strtod(argv[4], NULL);
    oro_region region = 0;
    oro_window window = {0};
    window.size = sizeof window;
    float* observers = NULL;
    oro_status status = oro_open(paths, 1, NULL, NULL, NULL, &region);
    if (status == ORO_OK) status = look_around(region, &eye, &options, &window, &observers);
    if (status == ORO_OK) {
        fprintf(stderr, "\n");
        printf("%zu of %zu posts are seen; a cell is %.9f degrees wide\n", window.seen, window.known,
               window.transform[1]);
        if (!write_picture(argv[5], &window, observers)) status = ORO_FAILED;
    } else {
        fprintf(stderr, "\n%s\n", oro_error_text());
    }
    free(observers);
    if (region != 0) oro_close(region);
    return status;
}
