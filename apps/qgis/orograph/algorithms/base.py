"""What the algorithms share: elevation data, places and boxes of the map's CRS, and a run of the program."""

import os
import shlex

from processing.core.ProcessingConfig import ProcessingConfig
from qgis.core import (
    QgsCoordinateReferenceSystem,
    QgsCoordinateTransform,
    QgsCsException,
    QgsProcessing,
    QgsProcessingAlgorithm,
    QgsProcessingException,
    QgsProcessingLayerPostProcessorInterface,
    QgsProcessingParameterDefinition,
    QgsProcessingParameterEnum,
    QgsProcessingParameterFile,
    QgsProcessingParameterMultipleLayers,
    QgsProcessingParameterNumber,
    QgsProcessingParameterString,
    QgsProviderRegistry,
)

from ..program import PROGRAM_SETTING, Cancelled, ProgramFailed, find_program, report_of, run

STYLES = os.path.join(os.path.dirname(os.path.dirname(__file__)), "styles")
SHOWN_STYLES = ["natural", "haze", "contours", "slope", "aspect", "relief"]


def wgs84():
    """Latitudes and longitudes, in which the program takes places."""
    return QgsCoordinateReferenceSystem("EPSG:4326")


class LayerStyle(QgsProcessingLayerPostProcessorInterface):
    """Gives a layer its style once it is loaded. Kept here, for QGIS does not keep it."""

    kept = []

    def __init__(self, name):
        super().__init__()
        self.path = os.path.join(STYLES, name)
        LayerStyle.kept.append(self)

    def postProcessLayer(self, layer, context, feedback):  # noqa: N802, QGIS's name
        message, is_loaded = layer.loadNamedStyle(self.path)
        if not is_loaded:
            feedback.pushWarning(message)
        layer.triggerRepaint()


class OrographAlgorithm(QgsProcessingAlgorithm):
    """An algorithm that runs the program. Those who derive from it tell id, title, page and parameters."""

    ELEVATION = "ELEVATION"
    FOLDER = "FOLDER"
    OPTIONS = "OPTIONS"

    identifier = ""
    title = ""
    about = ""

    def name(self):
        return self.identifier

    def displayName(self):  # noqa: N802, QGIS's names
        return self.title

    def shortHelpString(self):  # noqa: N802
        return self.about + (
            "\n\nElevation data are layers of the map, or a folder (or one file) of elevation data, or both. Further "
            "options are those of the program, as on its command line."
        )

    def createInstance(self):  # noqa: N802
        return type(self)()

    # Parameters.

    def add_elevation(self):
        self.addParameter(
            QgsProcessingParameterMultipleLayers(
                self.ELEVATION, "Elevation layers", QgsProcessing.TypeRaster, optional=True
            )
        )
        self.addParameter(
            QgsProcessingParameterFile(
                self.FOLDER, "Folder of elevation data", QgsProcessingParameterFile.Folder, optional=True
            )
        )

    def add_number(self, name, text, default, low=None, high=None, optional=False, whole=False):
        kind = QgsProcessingParameterNumber.Integer if whole else QgsProcessingParameterNumber.Double
        parameter = QgsProcessingParameterNumber(name, text, kind, default, optional)
        if low is not None:
            parameter.setMinimum(low)
        if high is not None:
            parameter.setMaximum(high)
        self.addParameter(parameter)

    def add_style(self):
        self.addParameter(
            QgsProcessingParameterEnum(
                "STYLE", "Style", SHOWN_STYLES, defaultValue="natural", usesStaticStrings=True
            )
        )

    def add_options(self):
        parameter = QgsProcessingParameterString(self.OPTIONS, "Further options of the program", "", optional=True)
        parameter.setFlags(parameter.flags() | QgsProcessingParameterDefinition.FlagAdvanced)
        self.addParameter(parameter)

    def checkParameterValues(self, parameters, context):  # noqa: N802
        is_right, message = super().checkParameterValues(parameters, context)
        if is_right and not parameters.get(self.ELEVATION) and not parameters.get(self.FOLDER):
            return False, "Name elevation layers or a folder of elevation data."
        return is_right, message

    # Words of the command line.

    def elevation(self, parameters, context):
        """Paths of the elevation data, layers first."""
        paths = []
        for layer in self.parameterAsLayerList(parameters, self.ELEVATION, context) or []:
            decoded = QgsProviderRegistry.instance().decodeUri(layer.providerType(), layer.source())
            path = decoded.get("path", "")
            if layer.providerType() != "gdal" or not os.path.exists(path):
                raise QgsProcessingException(f"The layer {layer.name()} is no file of this machine.")
            if path not in paths:
                paths.append(path)
        folder = self.parameterAsString(parameters, self.FOLDER, context)
        if folder:
            paths.append(folder)
        if not paths:
            raise QgsProcessingException("Name elevation layers or a folder of elevation data.")
        return paths

    def place(self, parameters, name, context):
        """A point of the map as the program takes it: latitude,longitude of WGS84. Without a CRS of its own it is in
        the project's; without a project in WGS84."""
        point = self.parameterAsPoint(parameters, name, context)
        transform = self.to_wgs84(self.parameterAsPointCrs(parameters, name, context), context)
        try:
            return place_words(transform.transform(point))
        except QgsCsException as error:
            raise QgsProcessingException(f"The place has none on the Earth: {error}") from error

    def has(self, parameters, name):
        """Whether a parameter has a value: its own, or its default where scripts do not name it."""
        definition = self.parameterDefinition(name)
        if definition is None:
            return False
        return parameters.get(name, definition.defaultValue()) not in (None, "")

    def box(self, parameters, name, context):
        """An extent of the map as --bbox, or [] where none is given."""
        if not self.has(parameters, name):
            return []
        box = self.parameterAsExtent(parameters, name, context)
        transform = self.to_wgs84(self.parameterAsExtentCrs(parameters, name, context), context)
        try:
            # Over the 180th meridian its west is then more than its east, as the program takes it.
            box = transform.transformBoundingBox(box, QgsCoordinateTransform.ForwardTransform, True)
        except QgsCsException as error:
            raise QgsProcessingException(f"The extent has no place on the Earth: {error}") from error
        south, north = max(box.yMinimum(), -90.0), min(box.yMaximum(), 90.0)
        west, east = box.xMinimum(), box.xMaximum()
        if east - west >= 360.0:
            west, east = -180.0, 180.0
        west, east = (lon if -180.0 <= lon <= 180.0 else (lon + 180.0) % 360.0 - 180.0 for lon in (west, east))
        return [f"--bbox={west:.9f},{south:.9f},{east:.9f},{north:.9f}"]

    def number(self, parameters, name, context, option):
        """An option with a number, or [] where none is given."""
        if not self.has(parameters, name):
            return []
        return [option, format(self.parameterAsDouble(parameters, name, context), ".12g")]

    def style(self, parameters, context):
        return ["--style", self.parameterAsEnumString(parameters, "STYLE", context)]

    def options(self, parameters, context):
        try:
            return shlex.split(self.parameterAsString(parameters, self.OPTIONS, context))
        except ValueError as error:
            raise QgsProcessingException(f"Further options: {error}") from error

    # The program.

    def run_program(self, words, feedback, share=(0.0, 1.0)):
        """Runs the program and gives its report (JSON). share: the part of the progress that is its own."""
        program = find_program(ProcessingConfig.getSetting(PROGRAM_SETTING))
        if program is None:
            raise QgsProcessingException(
                "The program orograph is not found. Install it, or name it in Settings, Options, Processing, "
                "Providers, Orograph."
            )
        words = [*words, "--json"]
        feedback.pushCommandInfo(shlex.join([program, *words]))
        begin, end = share

        def say(line):
            (feedback.pushWarning if "note: " in line else feedback.pushInfo)(line)

        def progress(percent, what):
            feedback.setProgress(100.0 * begin + (end - begin) * percent)
            feedback.setProgressText(what)

        try:
            report = report_of(run(program, words, say, progress, feedback.isCanceled))
        except Cancelled:
            raise QgsProcessingException("Cancelled: nothing was written.") from None
        except ProgramFailed as error:
            raise QgsProcessingException(str(error)) from error
        feedback.setProgress(100.0 * end)
        return report

    def load_styled(self, context, path, style):
        """Lets a layer that is loaded when the algorithm is done have a style of the plugin."""
        if context.willLoadLayerOnCompletion(path):
            context.layerToLoadOnCompletionDetails(path).setPostProcessor(LayerStyle(style))

    def sink_crs(self, crs):
        """A CRS, or WGS84 where the map has none."""
        return crs if crs.isValid() else wgs84()

    def to_wgs84(self, crs, context):
        return QgsCoordinateTransform(self.sink_crs(crs), wgs84(), context.transformContext())

    def from_wgs84(self, crs, context):
        return QgsCoordinateTransform(wgs84(), crs, context.transformContext())


def place_words(point):
    return f"{point.y():.9f},{point.x():.9f}"
