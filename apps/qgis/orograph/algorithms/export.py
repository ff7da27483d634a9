"""Heights in formats of others."""

import os

from qgis.core import (
    QgsProcessing,
    QgsProcessingContext,
    QgsProcessingException,
    QgsProcessingOutputRasterLayer,
    QgsProcessingParameterEnum,
    QgsProcessingParameterExtent,
    QgsProcessingParameterFileDestination,
    QgsProcessingParameterFolderDestination,
)

from ..export_formats import ENDINGS, is_folder, with_ending
from .base import OrographAlgorithm


class Export(OrographAlgorithm):
    identifier = "export"
    title = "Export heights"
    about = (
        "Writes the ground in formats of others. cog: a Cloud Optimized GeoTIFF of the data's own samples, or of the "
        "slope at each. terrain-rgb: a folder of PNG tiles for web maps whose colours are heights. 3dtiles: 3D Tiles "
        "with levels whose error is proven. gltf: one model (.glb). quantized-mesh: tiles of terrain for globes."
    )

    LAYERS = ["H", "slope"]

    def initAlgorithm(self, configuration=None):  # noqa: N802, QGIS's name
        self.add_elevation()
        self.addParameter(QgsProcessingParameterExtent("EXTENT", "Extent (empty: all the data)", optional=True))
        self.addParameter(
            QgsProcessingParameterEnum(
                "FORMAT", "Format", list(ENDINGS), defaultValue="cog", usesStaticStrings=True
            )
        )
        self.addParameter(
            QgsProcessingParameterEnum(
                "CONTENT", "What cog has at each sample: height above sea level, or slope", self.LAYERS,
                defaultValue="H", usesStaticStrings=True
            )
        )
        self.add_options()
        self.addParameter(
            QgsProcessingParameterFileDestination(
                "OUTPUT", "File (of cog and gltf)", "GeoTIFF (*.tif);;glTF (*.glb)", optional=True, createByDefault=True
            )
        )
        self.addParameter(
            QgsProcessingParameterFolderDestination(
                "FOLDER_OUTPUT", "Folder (of terrain-rgb, 3dtiles and quantized-mesh)", optional=True,
                createByDefault=False
            )
        )
        self.addOutput(QgsProcessingOutputRasterLayer("LAYER", "Heights or slope"))

    def output(self, kind, parameters, context):
        """The parameter that names what is written, and its path."""
        name = "FOLDER_OUTPUT" if is_folder(kind) else "OUTPUT"
        if not self.has(parameters, name):
            raise QgsProcessingException(f"Name a {'folder' if is_folder(kind) else 'file'} for {kind}.")
        path = self.parameterAsFileOutput(parameters, name, context)
        # QGIS names a file of its own by the first of the endings.
        if parameters[name] == QgsProcessing.TEMPORARY_OUTPUT and not is_folder(kind):
            path = with_ending(kind, path)
        return name, path

    def processAlgorithm(self, parameters, context, feedback):  # noqa: N802
        kind = self.parameterAsEnumString(parameters, "FORMAT", context)
        layer = self.parameterAsEnumString(parameters, "CONTENT", context)
        name, path = self.output(kind, parameters, context)
        words = [
            "export",
            *self.elevation(parameters, context),
            "--to",
            kind,
            *(["--layer", layer] if layer != "H" else []),
            *self.box(parameters, "EXTENT", context),
            *self.options(parameters, context),
            "--out",
            path,
            "--overwrite",
        ]
        self.run_program(words, feedback)
        results = {name: path}
        if kind == "cog":
            results["LAYER"] = path
            self.load(context, path, layer)
        return results

    def load(self, context, path, layer):
        """Lets the file be a layer of the map once the algorithm is done."""
        if context.project() is None:
            return
        name = os.path.splitext(os.path.basename(path))[0]
        context.addLayerToLoadOnCompletion(
            path, QgsProcessingContext.LayerDetails(name, context.project(), "LAYER")
        )
        if layer == "slope":
            self.load_styled(context, path, "slope.qml")
