"""Terrain at its true place on the Earth, and what is seen over it, for NumPy.

A module over liborograph, by ctypes: nothing is compiled. Names and units are those of orograph.h: latitudes and
longitudes in degrees on WGS84, H above the geoid and h above the ellipsoid in metres. The same question has the same
answer as from the program.

    import orograph
    with orograph.open("N46E008.hgt") as region:
        H_m, h_m = region.heights([46.5, 46.6], [8.1, 8.2])
"""

import ctypes
import json
import os
import threading
import weakref
from collections import namedtuple
from ctypes import POINTER, byref, c_char_p, c_double, c_float, c_int, c_int64, c_size_t, c_uint8, c_uint64, c_void_p
from pathlib import Path

import numpy as np

__all__ = ["AIR_STANDARD", "CancelledError", "Error", "Horizons", "NoDataError", "NoDeviceError", "Point", "Position", "Profile",
           "Region", "Sight", "UNKNOWN", "UsageError", "Viewshed", "open", "version"]

AIR_STANDARD = "standard"
UNKNOWN = np.float32(-9999.0)

OK, FAILED, USAGE, NO_DATA, NO_DEVICE, CANCELLED, TOO_SMALL = range(7)


class Error(Exception):
    """What the library refused, or failed to do. `code` is its oro_status."""

    code = FAILED


class UsageError(Error, ValueError):
    """An argument cannot mean anything."""

    code = USAGE


class NoDataError(Error):
    """There are no elevation data where the question is."""

    code = NO_DATA


class NoDeviceError(Error):
    """No suitable GPU was found."""

    code = NO_DEVICE


class CancelledError(Error):
    """The progress function asked to stop."""

    code = CANCELLED


class Point(namedtuple("Point", ["lat_deg", "lon_deg", "height_m", "above"])):
    """A point with a height above the "ground", the "geoid" (H) or the "ellipsoid" (h)."""

    __slots__ = ()

    def __new__(cls, lat_deg, lon_deg, height_m=0.0, above="ground"):
        return super().__new__(cls, lat_deg, lon_deg, height_m, above)


Position = namedtuple("Position", ["lat_deg", "lon_deg", "H_m", "h_m"])
Position.__doc__ = "A point as the library answers it."

Sight = namedtuple("Sight", ["visible", "from_", "to", "obstacle", "obstacle_distance_m", "target_deficit_m",
                             "eye_deficit_m", "least_clearance_m", "least_clearance", "distance_m", "azimuth_deg",
                             "elevation_deg", "slant_m", "without_data_m"])
Sight.__doc__ = """A line of sight. `obstacle` is None where the target is seen. What is not known is NaN."""

Profile = namedtuple("Profile", ["points", "length_m", "ascent_m", "descent_m", "ascent_over_m", "descent_over_m",
                                 "without_data_m", "highest", "lowest"])
Profile.__doc__ = """The ground along a line. `points` is a structured array: distance_m, lat_deg, lon_deg, H_m, h_m.
`highest` and `lowest` are numbers of points."""

Viewshed = namedtuple("Viewshed", ["clearance_deficit_m", "observers", "transform", "crs", "known", "seen"])
Viewshed.__doc__ = """What is seen: two arrays of float32, rows from the north. A post is UNKNOWN in both where it is void
or beyond the radius. `transform` is GDAL's, of the corner of the first cell; `crs` is its CRS."""

Horizons = namedtuple("Horizons", ["elevation_deg", "sky_view", "transform", "crs", "known", "with_sky_view"])
Horizons.__doc__ = """Horizons around posts: elevation_deg of the shape (azimuths, rows, columns) and sky_view (rows,
columns), float32. Azimuths are evenly spaced clockwise from north. A value is UNKNOWN at a void post and in an azimuth
without ground. `known` posts have a horizon, `with_sky_view` a sky-view factor."""

POINT_TYPE = np.dtype([(name, np.float64) for name in ("distance_m", "lat_deg", "lon_deg", "H_m", "h_m")])


class _Options(ctypes.Structure):
    _fields_ = [("size", c_size_t), ("bbox", c_char_p), ("tile", c_char_p), ("height_unit", c_char_p),
                ("source_crs", c_char_p), ("source_vertical", c_char_p), ("order", c_char_p), ("feather_m", c_double),
                ("strict_datum", c_int), ("fill_voids", c_int), ("resample", c_int),
                ("landcover", POINTER(c_char_p)), ("landcover_count", c_size_t),
                ("canopy", POINTER(c_char_p)), ("canopy_count", c_size_t), ("canopy_held", c_double)]


class _Point(ctypes.Structure):
    _fields_ = [("lat_deg", c_double), ("lon_deg", c_double), ("height_m", c_double), ("above", c_int)]


class _Position(ctypes.Structure):
    _fields_ = [(name, c_double) for name in Position._fields]


class _SightOptions(ctypes.Structure):
    _fields_ = [("size", c_size_t), ("air", c_int), ("refraction_k", c_double), ("on_summit", c_int)]


class _Sight(ctypes.Structure):
    _fields_ = [("size", c_size_t), ("visible", c_int), ("from_", _Position), ("to", _Position),
                ("obstacle", _Position), ("obstacle_distance_m", c_double), ("target_deficit_m", c_double),
                ("eye_deficit_m", c_double), ("least_clearance_m", c_double), ("least_clearance", _Position),
                ("distance_m", c_double), ("azimuth_deg", c_double), ("elevation_deg", c_double),
                ("slant_m", c_double), ("without_data_m", c_double)]


class _ProfileOptions(ctypes.Structure):
    _fields_ = [("size", c_size_t), ("step_m", c_double), ("climb_threshold_m", c_double)]


class _ProfileSums(ctypes.Structure):
    _fields_ = [("size", c_size_t)] + [(name, c_double) for name in Profile._fields[1:7]] + [
        ("highest", c_size_t), ("lowest", c_size_t)]


class _ViewshedOptions(ctypes.Structure):
    _fields_ = [("size", c_size_t), ("radius_km", c_double), ("target_m", c_double), ("air", c_int),
                ("refraction_k", c_double), ("on_summit", c_int), ("targets_on_canopy", c_int)]


class _HorizonOptions(ctypes.Structure):
    _fields_ = [("size", c_size_t), ("bbox", c_char_p), ("directions", c_int), ("radius_km", c_double),
                ("above_m", c_double), ("air", c_int), ("refraction_k", c_double)]


class _Window(ctypes.Structure):
    _fields_ = [("size", c_size_t), ("grid", c_size_t), ("first_row", c_int64), ("first_column", c_int64),
                ("rows", c_size_t), ("columns", c_size_t), ("transform", c_double * 6), ("known", c_size_t),
                ("seen", c_size_t)]


_LAYERS = {"longitude_deg": np.float64, "latitude_deg": np.float64, "H_m": np.float32, "h_m": np.float32,
           "distance_m": np.float32, "slope_deg": np.float32, "source": np.float32, "shadow": np.float32,
           "cover": np.float32}


class _Layers(ctypes.Structure):
    _fields_ = [("size", c_size_t), ("capacity", c_size_t)] + [(name, c_void_p) for name in _LAYERS]


_Progress = ctypes.CFUNCTYPE(c_int, c_double, c_char_p, c_void_p)


def _find_library():
    named = os.environ.get("OROGRAPH_LIBRARY")
    if named:
        return named
    # lib/python3/dist-packages/orograph/__init__.py of an installation.
    folder = Path(__file__).resolve().parents[min(3, len(Path(__file__).resolve().parents) - 1)]
    for found in [folder / "liborograph.so.1", *sorted(folder.glob("*-linux-*/liborograph.so.1"))]:
        if found.exists():
            return str(found)
    return "liborograph.so.1"


def _load():
    library = ctypes.CDLL(_find_library())
    texts, sizes = POINTER(c_char_p), POINTER(c_size_t)
    progress = [_Progress, c_void_p]
    # Buffers of NumPy are given as addresses.
    picture = [c_uint64, c_size_t, texts, c_void_p, c_size_t, sizes, sizes, *progress]
    heights = [c_uint64, c_size_t, c_void_p, c_void_p, c_void_p, c_void_p]
    profile = [c_uint64, c_size_t, c_void_p, c_void_p, POINTER(_ProfileOptions), c_void_p, c_size_t, sizes,
               POINTER(_ProfileSums)]
    eyes = [c_uint64, c_size_t, POINTER(_Point), POINTER(_ViewshedOptions)]
    for name, arguments, answer in [
            ("oro_version", [], c_char_p), ("oro_api_version", [], c_int), ("oro_error_text", [], c_char_p),
            ("oro_error_code", [], c_int),
            ("oro_open", [texts, c_size_t, POINTER(_Options), *progress, POINTER(c_uint64)], c_int),
            ("oro_close", [c_uint64], c_int),
            ("oro_info", [c_uint64, c_char_p, c_size_t, sizes], c_int),
            ("oro_heights", heights, c_int), ("oro_heights_with_progress", [*heights, *progress], c_int),
            ("oro_sight", [c_uint64, POINTER(_Point), POINTER(_Point), POINTER(_SightOptions), POINTER(_Sight)], c_int),
            ("oro_profile", profile, c_int), ("oro_profile_with_progress", [*profile, *progress], c_int),
            ("oro_viewshed_window", [*eyes, POINTER(_Window)], c_int),
            ("oro_viewshed", [*eyes, c_void_p, c_void_p, c_size_t, POINTER(_Window), *progress], c_int),
            ("oro_horizon_window", [c_uint64, POINTER(_HorizonOptions), POINTER(_Window)], c_int),
            ("oro_horizon", [c_uint64, POINTER(_HorizonOptions), c_void_p, c_void_p, c_size_t, POINTER(_Window),
                             *progress], c_int),
            ("oro_grid_crs", [c_uint64, c_size_t, c_char_p, c_size_t, sizes], c_int),
            ("oro_shot_layers", [c_uint64, c_size_t, texts, POINTER(_Layers), sizes, sizes, *progress], c_int),
            ("oro_shot", picture, c_int), ("oro_panorama", picture, c_int)]:
        function = getattr(library, name)
        function.argtypes, function.restype = arguments, answer
    return library


_library = _load()
_errors = {error.code: error for error in (UsageError, NoDataError, NoDeviceError, CancelledError)}


def version():
    """The version of the library, as in "0.1.0"."""
    return _library.oro_version().decode()


def _last_text():
    return _library.oro_error_text().decode("utf-8", "replace")


def _check(status, text=None):
    if status != OK:
        raise _errors.get(status, Error)(_last_text() if text is None else text)


def _text(value):
    return None if value is None else os.fsencode(value) if isinstance(value, os.PathLike) else str(value).encode()


def _texts(values):
    if isinstance(values, (str, bytes, os.PathLike)):
        values = [values]
    encoded = [value if isinstance(value, bytes) else _text(value) for value in values]
    for one in encoded:
        if b"\0" in one:
            raise UsageError(f"{one!r} has a zero byte in it")
    return (c_char_p * len(encoded))(*encoded), len(encoded)


class _LongCall:
    """A call that may be stopped: by its progress function, by what that raises, and by Ctrl-C. In the main thread the
    call is made by another one, while this one waits for signals: Python raises them here, and never in between."""

    def __init__(self, progress):
        self.progress = progress
        self.raised = None
        self.is_stopped = False
        self.for_c = _Progress(self._show)

    def _show(self, share, step, user):
        try:
            if not self.is_stopped and self.progress is not None and self.progress(share, step.decode()):
                self.is_stopped = True
        except BaseException as raised:
            self.raised, self.is_stopped = raised, True
        return 1 if self.is_stopped else 0

    def status(self, function, *arguments):
        """Calls function(*arguments, progress, user) and returns its status. What was raised is raised from here. The
        arguments keep all alive that the library writes to, as long as it works."""
        answer, is_done = [FAILED, ""], threading.Event()

        def work():
            try:
                answer[:] = function(*arguments, self.for_c, None), _last_text()
            finally:
                is_done.set()

        if threading.current_thread() is threading.main_thread():
            threading.Thread(target=work, daemon=True).start()
        else:
            work()
        while not is_done.is_set():
            try:
                is_done.wait()
            except BaseException as raised:  # KeyboardInterrupt, or what another handler of signals raises
                self.raised, self.is_stopped = raised, True
        if self.raised is not None:
            raise self.raised
        self.text = answer[1]
        return answer[0]

    def check(self, function, *arguments):
        _check(self.status(function, *arguments), self.text)


def _asked_text(ask):
    length = c_size_t()
    _check(ask(None, 0, byref(length)))
    while True:
        buffer = ctypes.create_string_buffer(length.value + 1)
        status = ask(buffer, len(buffer), byref(length))
        if status != TOO_SMALL:
            _check(status)
            return buffer.value.decode()


# Fewer are found before anybody could stop it.
_MANY_PLACES = 10_000
_above = {"ground": 0, "geoid": 1, "ellipsoid": 2}


def _point(value, height_m):
    place = tuple(value)
    if not 2 <= len(place) <= 4:
        raise UsageError(f"{value!r} is no point: (lat_deg, lon_deg), or a Point")
    above = place[3] if len(place) > 3 else "ground"
    if above not in _above:
        raise UsageError(f"{above!r} is none of {', '.join(_above)}")
    return _Point(float(place[0]), float(place[1]), float(place[2] if len(place) > 2 else height_m), _above[above])


def _air(air):
    return (0, 0.13) if isinstance(air, str) and air == AIR_STANDARD else (1, float(air))


def _degrees(lat_deg, lon_deg):
    lat, lon = np.broadcast_arrays(np.asarray(lat_deg, np.float64), np.asarray(lon_deg, np.float64))
    return np.ascontiguousarray(lat).reshape(lat.shape), np.ascontiguousarray(lon).reshape(lon.shape)


def _address(array):
    return array.ctypes.data_as(c_void_p)


def _buffer(array, shape, kind):
    """An array that the library can write into, as it is."""
    if array is None:
        return np.empty(shape, kind)
    if not isinstance(array, np.ndarray) or array.dtype != kind or array.shape != tuple(shape):
        raise UsageError(f"the array must be {np.dtype(kind).name} of the shape {tuple(shape)}")
    if not array.flags.c_contiguous or not array.flags.writeable or not array.flags.aligned:
        raise UsageError("the array must be contiguous, aligned and writeable")
    return array


# The options of shot and panorama that may be given several times.
_REPEATED = {"canopy", "drape", "landcover", "names", "overlay"}


def _words(words, named):
    """Words of a command line: "--heading", "90" from heading=90, and "--on-summit" from on_summit=True. A list gives an
    option again for each of its parts, where it may be given several times."""
    line = [str(word) for word in words]
    for name, value in named.items():
        name = name.rstrip("_")
        for one in value if isinstance(value, list) and name in _REPEATED else [value]:
            if one is None or one is False:
                continue
            line.append("--" + name.replace("_", "-"))
            if one is True:
                continue
            line.append(",".join(str(part) for part in one) if isinstance(one, (tuple, list)) else str(one))
    return line


class Region:
    """An open region; open() makes one. It may be used from several threads, and closes at the end of `with`."""

    def __init__(self, number):
        self._number = number
        self._close = weakref.finalize(self, _library.oro_close, number)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        """Closes the region. A second time does nothing; all else of a closed region raises UsageError."""
        self._close()

    @property
    def info(self):
        """What the region is made of: the dictionary of `orograph info --json`."""
        return json.loads(_asked_text(lambda *room: _library.oro_info(self._number, *room)))

    def heights(self, lat_deg, lon_deg, *, progress=None):
        """H_m and h_m of the ground at places, NaN where there is none. The arguments are broadcast. `progress` stops it,
        as Ctrl-C does where there are many places."""
        lat, lon = _degrees(lat_deg, lon_deg)
        H_m, h_m = np.empty(lat.shape), np.empty(lat.shape)
        asked = self._number, lat.size, _address(lat), _address(lon), _address(H_m), _address(h_m)
        if progress is None and lat.size < _MANY_PLACES:
            _check(_library.oro_heights(*asked))
        else:
            _LongCall(progress).check(_library.oro_heights_with_progress, *asked)
        return H_m, h_m

    def sight(self, from_, to, *, air=AIR_STANDARD, on_summit=False):
        """The line of sight from one point to another. A point is (lat_deg, lon_deg), which stands 2 m over the ground
        as from_ and on it as `to`; or a Point. `air` is AIR_STANDARD or a coefficient of refraction."""
        law, k = _air(air)
        options = _SightOptions(ctypes.sizeof(_SightOptions), law, k, bool(on_summit))
        answer = _Sight(size=ctypes.sizeof(_Sight))
        _check(_library.oro_sight(self._number, byref(_point(from_, 2.0)), byref(_point(to, 0.0)), byref(options),
                                  byref(answer)))
        values = {name: getattr(answer, name) for name in Sight._fields}
        for name in ("from_", "to", "obstacle", "least_clearance"):
            values[name] = Position(*(getattr(values[name], part) for part in Position._fields))
        values["visible"] = bool(answer.visible)
        if values["visible"]:
            values["obstacle"] = None
        return Sight(**values)

    def profile(self, lat_deg, lon_deg, *, step_m=None, climb_threshold_m=10.0, progress=None):
        """The ground along the line through places: each step_m, or where it crosses the edges of the ground. A line of
        more than 4,096 points is followed twice: `progress` is then told of both."""
        lat, lon = _degrees(lat_deg, lon_deg)
        options = _ProfileOptions(ctypes.sizeof(_ProfileOptions), 0.0 if step_m is None else step_m, climb_threshold_m)
        if step_m is not None and not step_m > 0.0:
            raise UsageError(f"step_m {step_m!r} must be more than 0")
        sums, count = _ProfileSums(size=ctypes.sizeof(_ProfileSums)), c_size_t(4096)
        asked = self._number, lat.size, _address(lat), _address(lon), byref(options)
        long_call = _LongCall(progress)
        while True:
            points = np.empty(count.value, POINT_TYPE)
            status = long_call.status(_library.oro_profile_with_progress, *asked, _address(points), points.size,
                                      byref(count), byref(sums))
            if status != TOO_SMALL:
                break
        _check(status, long_call.text)
        return Profile(points[:count.value], *(getattr(sums, name) for name in Profile._fields[1:]))

    def _viewshed_asked(self, eyes, radius_km, target_m, air, on_summit, targets_on_canopy):
        eyes = list(eyes)
        if eyes and np.isscalar(eyes[0]):
            eyes = [tuple(eyes)]
        points = (_Point * len(eyes))(*(_point(eye, 2.0) for eye in eyes))
        law, k = _air(air)
        options = _ViewshedOptions(ctypes.sizeof(_ViewshedOptions), radius_km, target_m, law, k, bool(on_summit),
                                   bool(targets_on_canopy))
        return self._number, len(eyes), points, byref(options)

    def viewshed(self, eyes, *, radius_km=20.0, target_m=0.0, air=AIR_STANDARD, on_summit=False,
                 targets_on_canopy=False, out=None, progress=None):
        """What is seen from one point or several. `out` may be two arrays of float32 of the window's shape, which
        viewshed_shape() tells; the library writes into them, and nothing is copied."""
        asked = self._viewshed_asked(eyes, radius_km, target_m, air, on_summit, targets_on_canopy)
        window = _Window(size=ctypes.sizeof(_Window))
        _check(_library.oro_viewshed_window(*asked, byref(window)))
        shape = (window.rows, window.columns)
        deficit, observers = (_buffer(array, shape, np.float32) for array in (out or (None, None)))
        _LongCall(progress).check(_library.oro_viewshed, *asked, _address(deficit), _address(observers), deficit.size,
                                  byref(window))
        crs = _asked_text(lambda *room: _library.oro_grid_crs(self._number, window.grid, *room))
        return Viewshed(deficit, observers, tuple(window.transform), crs, window.known, window.seen)

    def viewshed_shape(self, eyes, *, radius_km=20.0, target_m=0.0, air=AIR_STANDARD, on_summit=False,
                       targets_on_canopy=False):
        """The rows and columns that viewshed() with the same arguments has."""
        window = _Window(size=ctypes.sizeof(_Window))
        _check(_library.oro_viewshed_window(
            *self._viewshed_asked(eyes, radius_km, target_m, air, on_summit, targets_on_canopy), byref(window)))
        return window.rows, window.columns

    def horizon(self, *, bbox=None, directions=36, radius_km=50.0, above_m=0.0, air=AIR_STANDARD, out=None,
                progress=None):
        """How high the horizon stands around the posts of a box (all of the region's without one), and how much of the
        sky they see. Ground that the region does not hold does not count: open it wider than the box by the radius.
        `out` may be two arrays of float32, of the shapes (directions, rows, columns) and (rows, columns)."""
        law, k = _air(air)
        options = _HorizonOptions(ctypes.sizeof(_HorizonOptions), _text(_box_text(bbox)), directions, radius_km,
                                  above_m, law, k)
        window = _Window(size=ctypes.sizeof(_Window))
        _check(_library.oro_horizon_window(self._number, byref(options), byref(window)))
        shape = (window.rows, window.columns)
        elevation, sky = out or (None, None)
        elevation = _buffer(elevation, (directions, *shape), np.float32)
        sky = _buffer(sky, shape, np.float32)
        _LongCall(progress).check(_library.oro_horizon, self._number, byref(options), _address(elevation),
                                  _address(sky), sky.size, byref(window))
        crs = _asked_text(lambda *room: _library.oro_grid_crs(self._number, window.grid, *room))
        return Horizons(elevation, sky, tuple(window.transform), crs, window.known, window.seen)

    def _draw(self, call, words, progress, out):
        texts, count = _texts(words)
        width, height = c_size_t(), c_size_t()
        long_call = _LongCall(progress)
        size = getattr(out, "shape", ())
        if out is None:
            status = long_call.status(call, self._number, count, texts, None, 0, byref(width), byref(height))
            if status != TOO_SMALL:
                _check(status, long_call.text)
            size = (height.value, width.value, 4)
        rgba = _buffer(out, size, np.uint8)
        long_call.check(call, self._number, count, texts, _address(rgba), rgba.nbytes, byref(width), byref(height))
        if out is not None and size != (height.value, width.value, 4):
            raise UsageError(f"the picture is {width.value} x {height.value} pixels, and the array is not")
        return rgba

    def shot(self, *words, progress=None, out=None, **options):
        """A picture as `orograph shot` draws it: an array of uint8 of the shape (rows, columns, 4). Options are those
        of the program: shot(at="46.67,8.06", heading=90, size="800x600"), or words: shot("--at", "46.67,8.06")."""
        return self._draw(_library.oro_shot, _words(words, options), progress, out)

    def layers(self, *words, names=("latitude_deg", "longitude_deg", "H_m"), progress=None, **options):
        """What each pixel of shot() with the same options shows: a dictionary of arrays of the shape (rows, columns),
        NaN where it shows no ground. Names are longitude_deg, latitude_deg (float64), H_m, h_m, distance_m, slope_deg,
        source, shadow, and of views with land cover cover (float32)."""
        unknown = [name for name in names if name not in _LAYERS]
        if unknown:
            raise UsageError(f"{unknown[0]!r} is none of {', '.join(_LAYERS)}")
        texts, count = _texts(_words(words, options))
        width, height, long_call = c_size_t(), c_size_t(), _LongCall(progress)
        asked = _library.oro_shot_layers, self._number, count, texts
        size = byref(width), byref(height)
        status = long_call.status(*asked, byref(_Layers(ctypes.sizeof(_Layers))), *size)
        if status != TOO_SMALL:
            _check(status, long_call.text)
        arrays = {name: np.empty((height.value, width.value), _LAYERS[name]) for name in names}
        layers = _Layers(ctypes.sizeof(_Layers), width.value * height.value,
                         **{name: array.ctypes.data for name, array in arrays.items()})
        layers.arrays = arrays  # as long as it
        long_call.check(*asked, byref(layers), *size)
        return arrays

    def panorama(self, *words, progress=None, out=None, **options):
        """A panorama as `orograph panorama` draws it, with rulers and names: panorama(at="46.67,8.06", width=2000)."""
        return self._draw(_library.oro_panorama, _words(words, options), progress, out)


def _box_text(bbox):
    """A box as the program takes it: "west,south,east,north", from that or from four numbers."""
    if bbox is None or isinstance(bbox, str):
        return bbox
    return ",".join(repr(float(side)) for side in bbox)


def open(paths, *, bbox=None, tile=None, height_unit=None, source_crs=None, source_vertical=None, order=None,
         feather_m=0.0, strict_datum=False, fill_voids=False, resample=False, landcover=(), canopy=(),
         canopy_held=None, progress=None):
    """Opens elevation data in a file, a folder or an archive, or in several, as one region. Options are those of the
    program. `progress(share, step)` is told how far the reading is, and stops it by a true answer."""
    texts, count = _texts(paths)
    cover, cover_count = _texts(landcover)
    trees, trees_count = _texts(canopy)
    options = _Options(ctypes.sizeof(_Options), _text(_box_text(bbox)), _text(tile), _text(height_unit), _text(source_crs),
                       _text(source_vertical), _text(order), feather_m, bool(strict_datum), bool(fill_voids),
                       bool(resample), cover, cover_count, trees, trees_count, -1.0 if canopy_held is None else canopy_held)
    number = c_uint64()

    def open_them(shown, user):
        return _library.oro_open(texts, count, byref(options), shown, user, byref(number))

    _LongCall(progress).check(open_them)
    return Region(number.value)
