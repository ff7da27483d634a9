"""How high the horizon stands around each post of an extent, and how much of the sky it sees."""

import os

from qgis.core import (
    QgsProcessingOutputNumber,
    QgsProcessingParameterExtent,
    QgsProcessingParameterRasterDestination,
)

from .base import OrographAlgorithm


class Horizon(OrographAlgorithm):
    identifier = "horizon"
    title = "Horizon and sky view"
    about = (
        "Writes the elevation of the horizon around each post of the elevation data, a band for each azimuth clockwise "
        "from north, and the sky-view factor of a level plane (0 to 1), on the grid of the data. Ground within the "
        "radius around the extent counts, too."
    )

    def initAlgorithm(self, configuration=None):  # noqa: N802, QGIS's name
        self.add_elevation()
        self.addParameter(QgsProcessingParameterExtent("EXTENT", "Extent (all of the data without one)", optional=True))
        self.add_number("DIRECTIONS", "Azimuths", 36, 3, 720, whole=True)
        self.add_number("RADIUS", "Radius (kilometres)", 50.0, 0.01, 500.0)
        self.add_number("ABOVE", "Height of the eye over the ground (metres)", 0.0, 0.0)
        self.add_options()
        self.addParameter(QgsProcessingParameterRasterDestination("HORIZON", "Horizon"))
        self.addParameter(QgsProcessingParameterRasterDestination("SKY_VIEW", "Sky view"))
        self.addOutput(QgsProcessingOutputNumber("POSTS", "Posts with a horizon"))
        self.addOutput(QgsProcessingOutputNumber("MEAN_SKY_VIEW", "Mean sky-view factor"))

    def processAlgorithm(self, parameters, context, feedback):  # noqa: N802
        outputs = [self.parameterAsOutputLayer(parameters, name, context) for name in ("HORIZON", "SKY_VIEW")]
        # The program names both files after one.
        stem = os.path.splitext(outputs[0])[0] + "-orograph"
        words = [
            "horizon",
            *self.elevation(parameters, context),
            *self.box(parameters, "EXTENT", context),
            "--directions",
            str(self.parameterAsInt(parameters, "DIRECTIONS", context)),
            *self.number(parameters, "RADIUS", context, "--radius"),
            *self.number(parameters, "ABOVE", context, "--above"),
            *self.options(parameters, context),
            "--out",
            stem + ".tif",
            "--overwrite",
        ]
        report = self.run_program(words, feedback)
        for written, output in zip((report["horizon"], report["sky_view"]), outputs):
            os.replace(written, output)
        for output, style in zip(outputs, ("horizon.qml", "sky-view.qml")):
            self.load_styled(context, output, style)
        return {
            "HORIZON": outputs[0],
            "SKY_VIEW": outputs[1],
            "POSTS": report["posts"],
            "MEAN_SKY_VIEW": report.get("mean_sky_view"),
        }
