/*
 * Prints the heights of places: heights PATH LAT,LON...
 *
 *     cc -std=c99 heights.c -o heights $(pkg-config --cflags --libs orograph)
 */
#include <math.h>
#include <orograph.h>
#include <stdio.h>
#include <stdlib.h>

enum { most_places = 64 };

static int report_failure(const char* what) {
    fprintf(stderr, "%s: %s\n", what, oro_error_text());
    return oro_error_code();
}

static int show_reading(double share, const char* step, void* user) {
    (void)user;
    fprintf(stderr, "%3.0f %% %s\n", 100.0 * share, step);
    return 0; /* go on */
}

static int print_heights(oro_region region, int count, char** places) {
    double lat_deg[most_places], lon_deg[most_places], H_m[most_places], h_m[most_places];
    for (int i = 0; i < count; ++i) {
        if (sscanf(places[i], "%lf,%lf", &lat_deg[i], &lon_deg[i]) != 2) {
            fprintf(stderr, "%s: is no place: LAT,LON\n", places[i]);
            return ORO_USAGE;
        }
    }
    if (oro_heights(region, (size_t)count, lat_deg, lon_deg, H_m, h_m) != ORO_OK)
        return report_failure("heights");
    for (int i = 0; i < count; ++i) {
        if (isnan(H_m[i]))
            printf("%s: no ground\n", places[i]);
        else
            printf("%s: H %.17g m, h %.17g m\n", places[i], H_m[i], h_m[i]);
    }
    return 0;
}

int main(int argc, char** argv) {
    if (argc < 3 || argc - 2 > most_places) {
        fprintf(stderr, "usage: heights PATH LAT,LON...\n");
        return ORO_USAGE;
    }
    const char* const paths[] = {argv[1]};
    oro_region region = 0;
    if (oro_open(paths, 1, NULL, show_reading, NULL, &region) != ORO_OK) return report_failure("opening");
    size_t length = 0;
    if (oro_info(region, NULL, 0, &length) != ORO_OK) return report_failure("info");
    char* const info = malloc(length + 1);
    if (info == NULL || oro_info(region, info, length + 1, &length) != ORO_OK) return report_failure("info");
    printf("liborograph %s; %zu bytes of information\n", oro_version(), length);
    free(info);
    const int code = print_heights(region, argc - 2, argv + 2);
    oro_close(region);
    return code;
}
