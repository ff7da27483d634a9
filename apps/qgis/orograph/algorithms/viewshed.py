"""Which places are seen from one or several others."""

from qgis.core import (
    QgsCoordinateTransform,
    QgsGeometry,
    QgsProcessing,
    QgsProcessingException,
    QgsProcessingOutputNumber,
    QgsProcessingParameterFeatureSource,
    QgsProcessingParameterPoint,
    QgsProcessingParameterRasterDestination,
    QgsProcessingUtils,
)

from ..observers import observer_words
from .base import OrographAlgorithm, place_words, wgs84


class Viewshed(OrographAlgorithm):
    identifier = "viewshed"
    title = "Viewshed"
    about = (
        "Writes which places are seen from an observer, or by any of several, on the grid of the elevation data. Band "
        "1 is 1 where a place is seen and 0 where it is hidden, band 2 by how many metres it is missed, and band 3 how "
        "many of several observers see it. Of more than 1,000 observers those without elevation data are left out."
    )

    def initAlgorithm(self, configuration=None):  # noqa: N802, QGIS's name
        self.add_elevation()
        self.addParameter(QgsProcessingParameterPoint("AT", "Observer", optional=True))
        self.addParameter(
            QgsProcessingParameterFeatureSource(
                "OBSERVERS", "Layer of observers", [QgsProcessing.TypeVectorPoint], optional=True
            )
        )
        self.add_number("ABOVE", "Height of observers over the ground (metres)", 2.0, 0.0)
        self.add_number("TARGET", "Height of what is looked at over the ground (metres)", 0.0, 0.0)
        self.add_number("RADIUS", "Radius (kilometres)", 20.0, 0.01, 1000.0)
        self.add_options()
        self.addParameter(QgsProcessingParameterRasterDestination("OUTPUT", "Viewshed"))
        self.addOutput(QgsProcessingOutputNumber("SEEN", "Cells that are seen"))
        self.addOutput(QgsProcessingOutputNumber("CELLS", "Cells within the radius"))

    def observers(self, parameters, context):
        """Words that name a place for each observer."""
        places = [self.place(parameters, "AT", context)] if self.has(parameters, "AT") else []
        source = self.parameterAsSource(parameters, "OBSERVERS", context)
        if source is not None:
            to_wgs84 = QgsCoordinateTransform(source.sourceCrs(), wgs84(), context.transformContext())
            for feature in source.getFeatures():
                geometry = QgsGeometry(feature.geometry())
                geometry.transform(to_wgs84)
                places += [place_words(vertex) for vertex in geometry.vertices()]
        if not places:
            raise QgsProcessingException("Name an observer, or a layer of observers.")
        return observer_words(places, QgsProcessingUtils.generateTempFilename("observers.csv"))

    def processAlgorithm(self, parameters, context, feedback):  # noqa: N802
        output = self.parameterAsOutputLayer(parameters, "OUTPUT", context)
        words = [
            "viewshed",
            *self.elevation(parameters, context),
            *self.observers(parameters, context),
            *self.number(parameters, "ABOVE", context, "--above"),
            *self.number(parameters, "TARGET", context, "--target"),
            *self.number(parameters, "RADIUS", context, "--radius"),
            *self.options(parameters, context),
            "--out",
            output,
            "--overwrite",
        ]
        report = self.run_program(words, feedback)
        self.load_styled(context, output, "viewshed.qml")
        return {"OUTPUT": output, "SEEN": report["seen"], "CELLS": report["cells"]}
