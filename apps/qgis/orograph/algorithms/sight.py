"""Whether one place is seen from another."""

from qgis.core import (
    QgsFeature,
    QgsField,
    QgsFields,
    QgsGeometry,
    QgsPointXY,
    QgsProcessingException,
    QgsProcessingOutputBoolean,
    QgsProcessingOutputNumber,
    QgsProcessingParameterFeatureSink,
    QgsProcessingParameterPoint,
    QgsWkbTypes,
)
from qgis.PyQt.QtCore import QVariant

from .base import OrographAlgorithm


class Sight(OrographAlgorithm):
    identifier = "sight"
    title = "Line of sight"
    about = (
        "Tells whether one place is seen from another. The layer has a line from the eye to the target, in two parts "
        "where the target is hidden: as far as the ground that hides it, and behind that."
    )

    def initAlgorithm(self, configuration=None):  # noqa: N802, QGIS's name
        self.add_elevation()
        self.addParameter(QgsProcessingParameterPoint("FROM", "Eye"))
        self.addParameter(QgsProcessingParameterPoint("TO", "Target"))
        self.add_number("ABOVE", "Height of the eye over the ground (metres)", 2.0, 0.0)
        self.add_number("TARGET", "Height of the target over the ground (metres)", 0.0, 0.0)
        self.add_options()
        self.addParameter(QgsProcessingParameterFeatureSink("OUTPUT", "Line of sight"))
        self.addOutput(QgsProcessingOutputBoolean("VISIBLE", "Whether the target is seen"))
        self.addOutput(QgsProcessingOutputNumber("DISTANCE_M", "Distance (metres)"))
        self.addOutput(QgsProcessingOutputNumber("MISSED_BY_M", "How much higher the target would have to be (metres)"))

    @staticmethod
    def fields():
        fields = QgsFields()
        for name, kind in (
            ("part", QVariant.String),
            ("visible", QVariant.Int),
            ("distance_m", QVariant.Double),
            ("azimuth_deg", QVariant.Double),
            ("elevation_deg", QVariant.Double),
            ("missed_by_m", QVariant.Double),
        ):
            fields.append(QgsField(name, kind))
        return fields

    def processAlgorithm(self, parameters, context, feedback):  # noqa: N802
        crs = self.sink_crs(self.parameterAsPointCrs(parameters, "FROM", context))
        words = [
            "sight",
            *self.elevation(parameters, context),
            f"--from={self.place(parameters, 'FROM', context)}",
            f"--to={self.place(parameters, 'TO', context)}",
            *self.number(parameters, "ABOVE", context, "--above"),
            *self.number(parameters, "TARGET", context, "--target"),
            *self.options(parameters, context),
        ]
        report = self.run_program(words, feedback)
        sink, output = self.parameterAsSink(
            parameters, "OUTPUT", context, self.fields(), QgsWkbTypes.LineString, crs
        )
        if sink is None:
            raise QgsProcessingException(self.invalidSinkError(parameters, "OUTPUT"))
        self.write(report, sink, self.from_wgs84(crs, context))
        self.load_styled(context, output, "sight.qml")
        return {
            "OUTPUT": output,
            "VISIBLE": report["visible"],
            "DISTANCE_M": report["distance_m"],
            "MISSED_BY_M": report.get("target_missed_by_m"),
        }

    def write(self, report, sink, transform):
        places = [report["from"], report["to"]]
        parts = ["seen"]
        if not report["visible"] and report.get("obstacle"):
            places.insert(1, report["obstacle"])
            parts.append("hidden")
        points = [QgsPointXY(place["lon_deg"], place["lat_deg"]) for place in places]
        for part, *ends in zip(parts, points, points[1:]):
            feature = QgsFeature(self.fields())
            line = QgsGeometry.fromPolylineXY(ends)
            line.transform(transform)
            feature.setGeometry(line)
            feature.setAttributes(
                [
                    part,
                    int(report["visible"]),
                    report["distance_m"],
                    report["azimuth_deg"],
                    report["elevation_deg"],
                    report.get("target_missed_by_m"),
                ]
            )
            sink.addFeature(feature)
