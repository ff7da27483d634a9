"""The formats that the program exports to, and what each is written to. Knows nothing of QGIS."""

import os

# The ending of the file that is written; None: a folder.
ENDINGS = {"cog": ".tif", "terrain-rgb": None, "3dtiles": None, "gltf": ".glb", "quantized-mesh": None}


def is_folder(kind):
    return ENDINGS[kind] is None


def with_ending(kind, path):
    """The path of a file that nobody has named, with the ending of its format."""
    return os.path.splitext(path)[0] + ENDINGS[kind]
