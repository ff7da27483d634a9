"""A picture all around a place."""

from qgis.core import (
    QgsProcessingOutputNumber,
    QgsProcessingParameterFeatureSource,
    QgsProcessingParameterFileDestination,
    QgsProcessingParameterPoint,
    QgsProcessingParameterString,
    QgsProcessing,
    QgsProcessingUtils,
    QgsVectorFileWriter,
)

from .base import OrographAlgorithm, wgs84
from .camera import LAYERS, add_camera_parameters, add_pose_parameter, pose_words, write_camera


class Panorama(OrographAlgorithm):
    identifier = "panorama"
    title = "Panorama"
    about = (
        "Draws a picture all around a place, with rulers of azimuth and elevation. Points of a layer that are seen "
        "from there are named. A layer of its camera can be written: a point where it stands, with the middle of what "
        "it shows as its heading."
    )

    def initAlgorithm(self, configuration=None):  # noqa: N802, QGIS's name
        self.add_elevation()
        self.addParameter(QgsProcessingParameterPoint("AT", "Eye"))
        self.add_number("ABOVE", "Height of the eye over the ground (metres)", 2.0, 0.0)
        self.addParameter(
            QgsProcessingParameterString(
                "SECTOR", "Azimuths FROM,TO (degrees from north; empty: all around)", "", optional=True
            )
        )
        self.add_number("WIDTH", "Width (pixels; empty: 20 for each degree)", None, 100, 50000, optional=True,
                        whole=True)
        self.addParameter(
            QgsProcessingParameterFeatureSource(
                "NAMES", "Points to name", [QgsProcessing.TypeVectorPoint], optional=True
            )
        )
        self.addParameter(QgsProcessingParameterString("NAMES_FIELD", "Field of their names", "name", optional=True))
        self.add_style()
        add_pose_parameter(self)
        self.add_options()
        self.addParameter(
            QgsProcessingParameterFileDestination("OUTPUT", "Panorama", "Pictures (*.png *.jpg *.tif *.svg)")
        )
        add_camera_parameters(self, [layer for layer in LAYERS if layer[0] == "CAMERA"])
        self.addOutput(QgsProcessingOutputNumber("EYE_H_M", "Height of the eye above sea level (metres)"))

    def names(self, parameters, context):
        """The points of a layer as a GeoPackage that the program reads."""
        source = self.parameterAsSource(parameters, "NAMES", context)
        if source is None:
            return []
        path = QgsProcessingUtils.generateTempFilename("names.gpkg")
        options = QgsVectorFileWriter.SaveVectorOptions()
        options.driverName = "GPKG"
        writer = QgsVectorFileWriter.create(
            path, source.fields(), source.wkbType(), source.sourceCrs() if source.sourceCrs().isValid() else wgs84(),
            context.transformContext(), options,
        )
        for feature in source.getFeatures():
            writer.addFeature(feature)
        del writer  # closes the file
        field = self.parameterAsString(parameters, "NAMES_FIELD", context)
        return ["--names", path, *(["--names-field", field] if field else [])]

    def processAlgorithm(self, parameters, context, feedback):  # noqa: N802
        output = self.parameterAsFileOutput(parameters, "OUTPUT", context)
        sector = self.parameterAsString(parameters, "SECTOR", context)
        words = [
            "panorama",
            *self.elevation(parameters, context),
            f"--at={self.place(parameters, 'AT', context)}",
            *self.number(parameters, "ABOVE", context, "--above"),
            *([f"--sector={sector}"] if sector else []),
            *self.number(parameters, "WIDTH", context, "--width"),
            *self.names(parameters, context),
            *self.style(parameters, context),
            *pose_words(self, parameters, context),
            *self.options(parameters, context),
            "--out",
            output,
            "--overwrite",
        ]
        report = self.run_program(words, feedback)
        camera = {**report["view"], "eye": report["eye"]}
        return {
            "OUTPUT": output,
            "EYE_H_M": report["eye"]["H_m"],
            **write_camera(self, parameters, context, feedback, camera, output),
        }
