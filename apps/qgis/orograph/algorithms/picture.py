"""Pictures of terrain: from an eye, and of the map's extent."""

from qgis.core import (
    QgsProcessingException,
    QgsProcessingOutputNumber,
    QgsProcessingParameterExtent,
    QgsProcessingParameterFileDestination,
    QgsProcessingParameterPoint,
)

from .base import OrographAlgorithm
from .camera import add_camera_parameters, add_pose_parameter, pose_words, write_camera


class PictureOfEye(OrographAlgorithm):
    """What pictures share: their size, their style, the files beside them and the layers of their camera."""

    def add_picture(self):
        self.add_number("WIDTH", "Width (pixels)", 1280, 1, 65500, whole=True)
        self.add_number("HEIGHT", "Height (pixels)", 720, 1, 65500, whole=True)
        self.add_style()
        add_pose_parameter(self)
        self.add_options()
        self.addParameter(
            QgsProcessingParameterFileDestination(
                "OUTPUT", "Picture", "Pictures (*.png *.jpg *.tif)"
            )
        )
        add_camera_parameters(self)
        for name, text in (
            ("HEADING_DEG", "Heading (degrees from north)"),
            ("PITCH_DEG", "Pitch (degrees)"),
            ("EYE_H_M", "Height of the eye above sea level (metres)"),
        ):
            self.addOutput(QgsProcessingOutputNumber(name, text))

    def draw(self, parameters, context, feedback, words):
        output = self.parameterAsFileOutput(parameters, "OUTPUT", context)
        if not output:
            raise QgsProcessingException("Name a file for the picture.")
        width, height = (self.parameterAsInt(parameters, name, context) for name in ("WIDTH", "HEIGHT"))
        is_drawn_again = self.has(parameters, "FOOTPRINT")
        report = self.run_program(
            [
                "shot",
                *self.elevation(parameters, context),
                *words,
                "--size",
                f"{width}x{height}",
                *self.style(parameters, context),
                *pose_words(self, parameters, context),
                *self.options(parameters, context),
                "--out",
                output,
                "--overwrite",
            ],
            feedback,
            (0.0, 0.5 if is_drawn_again else 1.0),
        )
        return {
            "OUTPUT": output,
            "HEADING_DEG": report["heading_deg"],
            "PITCH_DEG": report["pitch_deg"],
            "EYE_H_M": report["eye"]["H_m"],
            **write_camera(self, parameters, context, feedback, report, output),
        }


class Picture(PictureOfEye):
    identifier = "picture"
    title = "Picture from a place"
    about = (
        "Draws what an eye at a place sees. It looks at another place, or in a direction. Layers of its camera can be "
        "written: where it stands, its line of sight, and the ground that the picture shows."
    )

    def initAlgorithm(self, configuration=None):  # noqa: N802, QGIS's name
        self.add_elevation()
        self.addParameter(QgsProcessingParameterPoint("AT", "Eye"))
        self.add_number("ABOVE", "Height of the eye over the ground (metres)", 2.0, 0.0)
        self.addParameter(QgsProcessingParameterPoint("LOOK_AT", "Place that it looks at", optional=True))
        self.add_number("HEADING", "Heading (degrees from north), where it looks at no place", 0.0, -360.0, 360.0,
                        optional=True)
        self.add_number("PITCH", "Pitch (degrees), where it looks at no place", 0.0, -90.0, 90.0, optional=True)
        self.add_number("FOV", "Angle of view from bottom to top (degrees)", 45.0, 0.05, 120.0)
        self.add_picture()

    def processAlgorithm(self, parameters, context, feedback):  # noqa: N802
        if self.has(parameters, "LOOK_AT"):
            direction = [f"--look-at={self.place(parameters, 'LOOK_AT', context)}"]
        else:
            direction = [
                *self.number(parameters, "HEADING", context, "--heading"),
                *self.number(parameters, "PITCH", context, "--pitch"),
            ]
        words = [
            f"--at={self.place(parameters, 'AT', context)}",
            *self.number(parameters, "ABOVE", context, "--above"),
            *direction,
            *self.number(parameters, "FOV", context, "--fov"),
        ]
        return self.draw(parameters, context, feedback, words)


class ExtentPicture(PictureOfEye):
    identifier = "extentpicture"
    title = "Picture of the map's extent"
    about = "Draws the terrain of an extent as seen from the south, from so high that all of it is in the picture."

    def initAlgorithm(self, configuration=None):  # noqa: N802
        self.add_elevation()
        self.addParameter(QgsProcessingParameterExtent("EXTENT", "Extent"))
        self.add_picture()

    def processAlgorithm(self, parameters, context, feedback):  # noqa: N802
        return self.draw(parameters, context, feedback, self.box(parameters, "EXTENT", context))
