"""Heights in formats of others."""

import os

from qgis.core import (
    QgsProcessingException,
    QgsProcessingOutputRasterLayer,
    QgsProcessingParameterEnum,
    QgsProcessingParameterExtent,
    QgsProcessingParameterFileDestination,
    QgsProcessingParameterFolderDestination,
)

from .base import OrographAlgorithm


class Export(OrographAlgorithm):
    identifier = "export"
    title = "Export heights"
    about = (
        "Writes the heights of elevation data as a Cloud Optimized GeoTIFF of the data's own samples, or as a folder "
        "of PNG tiles for web maps whose colours are heights (terrain-rgb)."
    )

    FORMATS = ["cog", "terrain-rgb"]

    def initAlgorithm(self, configuration=None):  # noqa: N802, QGIS's name
        self.add_elevation()
        self.addParameter(QgsProcessingParameterExtent("EXTENT", "Extent (empty: all the data)", optional=True))
        self.addParameter(
            QgsProcessingParameterEnum(
                "FORMAT", "Format", self.FORMATS, defaultValue="cog", usesStaticStrings=True
            )
        )
        self.add_options()
        self.addParameter(
            QgsProcessingParameterFileDestination(
                "OUTPUT", "GeoTIFF (of cog)", "GeoTIFF (*.tif)", optional=True, createByDefault=True
            )
        )
        self.addParameter(
            QgsProcessingParameterFolderDestination(
                "FOLDER_OUTPUT", "Folder (of terrain-rgb)", optional=True, createByDefault=False
            )
        )
        self.addOutput(QgsProcessingOutputRasterLayer("LAYER", "Heights"))

    def processAlgorithm(self, parameters, context, feedback):  # noqa: N802
        kind = self.parameterAsEnumString(parameters, "FORMAT", context)
        is_raster = kind == "cog"
        name = "OUTPUT" if is_raster else "FOLDER_OUTPUT"
        output = self.parameterAsString(parameters, name, context)
        if not output:
            raise QgsProcessingException("Name a GeoTIFF for cog, or a folder for terrain-rgb.")
        if is_raster:
            output = self.parameterAsFileOutput(parameters, name, context)
        words = [
            "export",
            *self.elevation(parameters, context),
            "--to",
            kind,
            *self.box(parameters, "EXTENT", context),
            *self.options(parameters, context),
            "--out",
            output,
            "--overwrite",
        ]
        self.run(words, feedback)
        results = {name: output}
        if is_raster:
            results["LAYER"] = output
            self.load(context, output)
        return results

    @staticmethod
    def load(context, path):
        """Lets the file be a layer of the map once the algorithm is done."""
        from qgis.core import QgsProcessingContext

        if context.project() is None:
            return
        name = os.path.splitext(os.path.basename(path))[0]
        context.addLayerToLoadOnCompletion(
            path, QgsProcessingContext.LayerDetails(name, context.project(), "LAYER")
        )
