"""Layers of a picture's camera: where it stands, where it looks, and what ground it shows."""

import os
import shutil
import tempfile

import numpy
from osgeo import gdal
from qgis.core import (
    QgsFeature,
    QgsField,
    QgsFields,
    QgsGeometry,
    QgsPoint,
    QgsPointXY,
    QgsProcessingException,
    QgsProcessingParameterBoolean,
    QgsProcessingParameterCrs,
    QgsProcessingParameterFeatureSink,
    QgsWkbTypes,
)
from qgis.PyQt.QtCore import QVariant

LAYERS = (
    ("CAMERA", "Camera", QgsWkbTypes.PointZ, "camera.qml"),
    ("LINE_OF_SIGHT", "Line of sight", QgsWkbTypes.LineStringZ, "line-of-sight.qml"),
    ("FOOTPRINT", "Ground that is seen", QgsWkbTypes.Polygon, "footprint.qml"),
)
MOST_COLUMNS = 1000  # whose farthest ground makes the footprint


def camera_fields():
    fields = QgsFields()
    fields.append(QgsField("picture", QVariant.String))
    for name in ("heading_deg", "pitch_deg", "roll_deg", "fov_deg", "H_m", "h_ellipsoid_m"):
        fields.append(QgsField(name, QVariant.Double))
    return fields


def add_pose_parameter(algorithm):
    algorithm.addParameter(
        QgsProcessingParameterBoolean("POSE", "Write its pose beside it (KML PhotoOverlay, GeoPose, STAC item)", False)
    )


def pose_words(algorithm, parameters, context):
    return ["--kml", "--geopose", "--stac"] if algorithm.parameterAsBool(parameters, "POSE", context) else []


def add_camera_parameters(algorithm, layers=LAYERS):
    algorithm.addParameter(QgsProcessingParameterCrs("CRS", "CRS of the camera's layers", "ProjectCrs", optional=True))
    for name, text, *_ in layers:
        algorithm.addParameter(
            QgsProcessingParameterFeatureSink(name, text, optional=True, createByDefault=False)
        )


def read_band(path):
    dataset = gdal.Open(path)
    if dataset is None:
        raise QgsProcessingException(f"{path}: cannot be read.")
    band = dataset.GetRasterBand(1)
    values = band.ReadAsArray().astype(float)
    if band.GetNoDataValue() is not None:
        values[values == band.GetNoDataValue()] = numpy.nan
    return values


def farthest_ground(folder, stem):
    """Longitude and latitude of the farthest ground of each column of the picture that shows some."""
    longitude, latitude, distance = (
        read_band(os.path.join(folder, f"{stem}.{what}.tif")) for what in ("longitude", "latitude", "distance")
    )
    places = []
    step = max(1, distance.shape[1] // MOST_COLUMNS)
    for column in range(0, distance.shape[1], step):
        seen = numpy.isfinite(distance[:, column]) & numpy.isfinite(longitude[:, column])
        if seen.any():
            row = int(numpy.nanargmax(numpy.where(seen, distance[:, column], numpy.nan)))
            places.append((longitude[row, column], latitude[row, column]))
    return places


def footprint(algorithm, picture, eye, feedback):
    """The polygon from the eye to the farthest ground of each column: the picture is drawn again with layers."""
    folder = tempfile.mkdtemp(prefix="orograph-")
    try:
        again = os.path.join(folder, "again.png")
        algorithm.run_program(["shot", "--view", picture, "--layers", "--out", again], feedback, (0.5, 1.0))
        places = farthest_ground(folder, "again")
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    if len(places) < 2:
        return None
    around = [QgsPointXY(eye["lon_deg"], eye["lat_deg"])] + [QgsPointXY(*place) for place in places]
    return QgsGeometry.fromPolygonXY([[*around, around[0]]])


def line_of_sight(report):
    """From the eye to the ground in the middle of the picture; None where that is sky."""
    seen = report.get("destination")
    if not seen:
        return None
    ends = [QgsPoint(place["lon_deg"], place["lat_deg"], place["H_m"]) for place in (report["eye"], seen)]
    return QgsGeometry.fromPolyline(ends)


def write_camera(algorithm, parameters, context, feedback, report, picture):
    """Writes the layers that are asked for; gives their ids by the names of their parameters."""
    crs = algorithm.sink_crs(algorithm.parameterAsCrs(parameters, "CRS", context))
    eye = report["eye"]
    made = {
        "CAMERA": lambda: QgsGeometry(QgsPoint(eye["lon_deg"], eye["lat_deg"], eye["H_m"])),
        "LINE_OF_SIGHT": lambda: line_of_sight(report),
        "FOOTPRINT": lambda: footprint(algorithm, picture, eye, feedback),
    }
    results = {}
    for name, text, kind, style in LAYERS:
        if not algorithm.has(parameters, name):
            continue
        sink, results[name] = algorithm.parameterAsSink(parameters, name, context, camera_fields(), kind, crs)
        if sink is None:
            raise QgsProcessingException(algorithm.invalidSinkError(parameters, name))
        geometry = made[name]()
        if geometry is None:
            feedback.pushWarning(f"{text}: the picture shows no ground there.")
            continue
        geometry.transform(algorithm.from_wgs84(crs, context))
        feature = QgsFeature(camera_fields())
        feature.setGeometry(geometry)
        angles = [report[name] for name in ("heading_deg", "pitch_deg", "roll_deg", "fov_deg")]
        feature.setAttributes([os.path.basename(picture), *angles, eye["H_m"], eye["h_m"]])
        sink.addFeature(feature)
        algorithm.load_styled(context, results[name], style)
    return results
