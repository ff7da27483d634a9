"""How high the ground is along lines of a layer."""

import csv
import json
import os

from qgis.core import (
    QgsCoordinateTransform,
    QgsFeature,
    QgsField,
    QgsFields,
    QgsGeometry,
    QgsPoint,
    QgsProcessing,
    QgsProcessingException,
    QgsProcessingOutputNumber,
    QgsProcessingParameterFeatureSink,
    QgsProcessingParameterFeatureSource,
    QgsProcessingUtils,
    QgsWkbTypes,
)
from qgis.PyQt.QtCore import QVariant

from .base import OrographAlgorithm, wgs84


class Profile(OrographAlgorithm):
    identifier = "profile"
    title = "Profile along lines"
    about = (
        "Writes points with the height of the ground along each line of a layer: wherever the line passes from one "
        "triangle of the ground to the next, or every so many metres. From vertex to vertex the shortest way over the "
        "ellipsoid is followed. Heights are above sea level (H) and above the ellipsoid (h)."
    )

    def initAlgorithm(self, configuration=None):  # noqa: N802, QGIS's name
        self.add_elevation()
        self.addParameter(
            QgsProcessingParameterFeatureSource("LINES", "Lines", [QgsProcessing.TypeVectorLine])
        )
        self.add_number("STEP", "Distance between points (metres; empty: every triangle)", None, 0.01, optional=True)
        self.add_options()
        self.addParameter(QgsProcessingParameterFeatureSink("OUTPUT", "Profile"))
        for name, text in (
            ("LENGTH_M", "Length of all lines (metres)"),
            ("ASCENT_M", "Ascent in rises of 10 m or more (metres)"),
            ("DESCENT_M", "Descent in falls of 10 m or more (metres)"),
            ("HIGHEST_M", "Highest H (metres)"),
            ("LOWEST_M", "Lowest H (metres)"),
        ):
            self.addOutput(QgsProcessingOutputNumber(name, text))

    @staticmethod
    def fields():
        fields = QgsFields()
        fields.append(QgsField("line", QVariant.LongLong))
        for name in ("distance_m", "H_m", "h_ellipsoid_m"):
            fields.append(QgsField(name, QVariant.Double))
        return fields

    @staticmethod
    def write_line(geometry, file):
        """The line as GeoJSON of WGS84, which the program reads."""
        with open(file, "w", encoding="utf-8") as to:
            feature = {"type": "Feature", "properties": {}, "geometry": json.loads(geometry.asJson(9))}
            json.dump({"type": "FeatureCollection", "features": [feature]}, to)

    def processAlgorithm(self, parameters, context, feedback):  # noqa: N802
        source = self.parameterAsSource(parameters, "LINES", context)
        if source is None:
            raise QgsProcessingException(self.invalidSourceError(parameters, "LINES"))
        crs = self.sink_crs(source.sourceCrs())
        sink, output = self.parameterAsSink(parameters, "OUTPUT", context, self.fields(), QgsWkbTypes.PointZ, crs)
        if sink is None:
            raise QgsProcessingException(self.invalidSinkError(parameters, "OUTPUT"))
        to_wgs84 = QgsCoordinateTransform(source.sourceCrs(), wgs84(), context.transformContext())
        count = max(1, source.featureCount())
        reports = []
        for number, feature in enumerate(source.getFeatures()):
            geometry = QgsGeometry(feature.geometry())
            if geometry.isEmpty():
                feedback.pushWarning(f"The feature {feature.id()} has no line and is left out.")
                continue
            geometry.transform(to_wgs84)
            share = (number / count, min(1.0, (number + 1) / count))
            report, table = self.one(parameters, context, feedback, geometry, share)
            reports.append(report)
            self.write(table, sink, feature.id(), self.from_wgs84(crs, context))
        if not reports:
            raise QgsProcessingException("The layer has no line.")
        self.load_styled(context, output, "profile.qml")
        return {"OUTPUT": output, **self.sums(reports)}

    def one(self, parameters, context, feedback, geometry, share):
        """The program's report of one line, and the table that it wrote."""
        line = QgsProcessingUtils.generateTempFilename("line.geojson")
        table = os.path.join(os.path.dirname(line), "profile.csv")
        self.write_line(geometry, line)
        words = [
            "profile",
            *self.elevation(parameters, context),
            "--along",
            line,
            *self.number(parameters, "STEP", context, "--step"),
            *self.options(parameters, context),
            "--out",
            table,
            "--overwrite",
        ]
        return self.run_program(words, feedback, share), table

    @staticmethod
    def sums(reports):
        return {
            "LENGTH_M": sum(report["length_m"] for report in reports),
            "ASCENT_M": sum(report["over_threshold"]["ascent_m"] for report in reports),
            "DESCENT_M": sum(report["over_threshold"]["descent_m"] for report in reports),
            "HIGHEST_M": max((r["highest"]["H_m"] for r in reports if r.get("highest")), default=None),
            "LOWEST_M": min((r["lowest"]["H_m"] for r in reports if r.get("lowest")), default=None),
        }

    def write(self, table, sink, line, transform):
        with open(table, encoding="utf-8", newline="") as rows:
            for row in csv.DictReader(rows):
                H_m, h_m = (float(row[name]) if row[name] else None for name in ("H_m", "h_m"))
                point = QgsPoint(float(row["lon_deg"]), float(row["lat_deg"]))
                if H_m is not None:
                    point.addZValue(H_m)
                feature = QgsFeature(self.fields())
                geometry = QgsGeometry(point)
                geometry.transform(transform)
                feature.setGeometry(geometry)
                feature.setAttributes([line, float(row["distance_m"]), H_m, h_m])
                sink.addFeature(feature)
