"""A map of terrain from straight above, in the map's CRS."""

from qgis.core import (
    QgsProcessingException,
    QgsProcessingOutputNumber,
    QgsProcessingParameterCrs,
    QgsProcessingParameterExtent,
    QgsProcessingParameterRasterDestination,
)

from .base import OrographAlgorithm


def crs_words(crs):
    """A CRS as the program takes it: its code, or its definition where it has none."""
    return crs.authid() if crs.authid() and not crs.authid().startswith("USER:") else crs.toWkt()


class OrthoMap(OrographAlgorithm):
    identifier = "orthomap"
    title = "Ortho map"
    about = (
        "Draws a map of terrain from straight above as a GeoTIFF, in the CRS of the map. It covers the extent; where "
        "latitudes and longitudes run askew to the CRS it reaches beyond it."
    )

    def initAlgorithm(self, configuration=None):  # noqa: N802, QGIS's name
        self.add_elevation()
        self.addParameter(QgsProcessingParameterExtent("EXTENT", "Extent (empty: all the data)", optional=True))
        self.addParameter(QgsProcessingParameterCrs("CRS", "CRS of the map", "ProjectCrs"))
        self.add_number("RESOLUTION", "Side of a pixel in units of the CRS (empty: about the data's)", None, 0.0,
                        optional=True)
        self.add_style()
        self.add_options()
        self.addParameter(QgsProcessingParameterRasterDestination("OUTPUT", "Ortho map"))
        self.addOutput(QgsProcessingOutputNumber("COLUMNS", "Columns"))
        self.addOutput(QgsProcessingOutputNumber("ROWS", "Rows"))

    def processAlgorithm(self, parameters, context, feedback):  # noqa: N802
        output = self.parameterAsOutputLayer(parameters, "OUTPUT", context)
        crs = self.parameterAsCrs(parameters, "CRS", context)
        if not crs.isValid():
            raise QgsProcessingException("The map has no CRS: name one.")
        words = [
            "shot",
            *self.elevation(parameters, context),
            "--ortho",
            *self.box(parameters, "EXTENT", context),
            "--crs",
            crs_words(crs),
            *self.number(parameters, "RESOLUTION", context, "--resolution"),
            *self.style(parameters, context),
            *self.options(parameters, context),
            "--out",
            output,
            "--overwrite",
        ]
        report = self.run_program(words, feedback)
        columns, rows = report["size_px"]
        return {"OUTPUT": output, "COLUMNS": columns, "ROWS": rows}
