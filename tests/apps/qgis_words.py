"""What the plugin of QGIS gives the program and its layers, without QGIS: formats, observers and styles.

    qgis_words.py FOLDER_OF_THE_PLUGIN PROGRAM DATA FOLDER

Prints a line for each of what follows; tests/apps/qgis_plugin_test.cpp compares them.
"""

import glob
import json
import os
import re
import subprocess
import sys
from xml.etree import ElementTree

sys.dont_write_bytecode = True
plugin, program, data, folder = sys.argv[1:]
sys.path.insert(0, plugin)
import export_formats  # noqa: E402
import observers  # noqa: E402

BOX = "--bbox=-84.26,36.54,-84.24,36.56"


def told(*words):
    said = subprocess.run([program, *words, "-q", "--json"], capture_output=True, text=True, timeout=300, check=False)
    if said.returncode != 0:
        sys.exit(said.stderr)
    return json.loads(said.stdout)


# Each format of the program, written to what the plugin takes for it.
help_text = subprocess.run([program, "export", "--help"], capture_output=True, text=True, timeout=60, check=True).stdout
formats = re.search(r"^  --to (\S+)$", help_text, re.M)[1].split("|")
print("formats of the program:", sorted(formats) == sorted(export_formats.ENDINGS))
for kind, ending in export_formats.ENDINGS.items():
    path = os.path.join(folder, kind)
    if not export_formats.is_folder(kind):
        path = export_formats.with_ending(kind, path + ".tif")
    report = told("export", data, BOX, "--to", kind, "--out", path)
    written = report["folder" if export_formats.is_folder(kind) else "file"]
    print(kind, os.path.basename(written), os.path.isdir(path))

# Few observers and many.
places = [f"{36.545 + 0.0001 * (i % 40):.9f},{-84.255 + 0.0001 * (i // 40):.9f}" for i in range(1001)]
table = os.path.join(folder, "observers.csv")
print(observers.observer_words(places[:2], table), os.path.exists(table))
few = observers.observer_words(places[:1000], table)
print(len(few), os.path.exists(table))
many = observers.observer_words(places, table)
print(many[0], many[1] == table)
report = told("viewshed", data, *many, "--radius", "0.2", "--out", os.path.join(folder, "seen.tif"))
print(len(report["observers"]), "observers;", "the last at %.6f,%.6f" % tuple(report["observers"][-1][key] for key in ("lat_deg", "lon_deg")))

# Each style is of QGIS, and one of a layer.
named = set()
for path in glob.glob(os.path.join(plugin, "algorithms", "*.py")):
    with open(path, encoding="utf-8") as source:
        named |= set(re.findall(r'"([\w-]+\.qml)"', source.read()))
styles = sorted(os.listdir(os.path.join(plugin, "styles")))
print("each style is loaded by an algorithm:", sorted(named) == styles)
for style in styles:
    root = ElementTree.parse(os.path.join(plugin, "styles", style)).getroot()
    renderer = root.find("renderer-v2") if root.find("pipe") is None else root.find("pipe/rasterrenderer")
    fields = {option.get("value") for option in root.iter("Option") if option.get("name") in ("field", "expression")}
    names = sorted(set(re.findall(r"\bH_m\b|\bheading_deg\b", " ".join(fields))) | ({renderer.get("attr")} - {None}))
    print(style, renderer.get("type"), *names)
