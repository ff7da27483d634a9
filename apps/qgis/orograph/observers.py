"""Observers as the program takes them: on its command line, or many of them in a table. Knows nothing of QGIS."""

import csv

MOST_ON_COMMAND_LINE = 1000


def observer_words(places, table):
    """Words of the command line for places, each as "latitude,longitude". Many are written to `table`, a path of a .csv."""
    if len(places) <= MOST_ON_COMMAND_LINE:
        return [f"--at={place}" for place in places]
    with open(table, "w", encoding="utf-8", newline="") as to:
        rows = csv.writer(to)
        rows.writerow(["lat", "lon"])
        rows.writerows(place.split(",") for place in places)
    return ["--observers", table]
