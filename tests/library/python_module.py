"""The module of Python over the installed library, against what the program says to the same questions: every figure
must be the same double, every pixel and every post the same byte."""

import ast
import ctypes
import inspect
import json
import math
import os
import re
import signal
import subprocess
import sys
import tempfile
import threading
import unittest
from pathlib import Path

import abi
import numpy as np

INSTALLED = Path(os.environ["OROGRAPH_INSTALLED"])
SOURCE = Path(os.environ["OROGRAPH_SOURCE"])
PROGRAM = os.environ["OROGRAPH_PROGRAM"]
DATA = SOURCE / "data" / "jacksboro.tif"
MODULE = INSTALLED / "lib/python3/dist-packages"
sys.path.insert(0, str(MODULE))

import orograph  # noqa: E402  (of the installation)

A, B = (36.55, -84.25), (36.512345, -84.298765)


def program(*words):
    done = subprocess.run([PROGRAM, *(str(word) for word in words), "-q"], capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    return done.stdout


def told(*words):
    return json.loads(program(*words, "--json"))


def place(point):
    return "%r,%r" % tuple(point[:2])


class Heights(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.region = orograph.open(DATA)

    def test_are_those_of_a_profile(self):
        said = told("profile", DATA, "--along", place(A) + ";" + place(B))
        H_m, h_m = self.region.heights([A[0], B[0]], [A[1], B[1]])
        self.assertEqual([*H_m], [said["begin"]["H_m"], said["end"]["H_m"]])
        self.assertEqual([*h_m], [said["begin"]["h_m"], said["end"]["h_m"]])

    def test_take_arrays_of_any_shape(self):
        lat = np.linspace(36.5, 36.6, 7)[:, None]
        lon = np.linspace(-84.3, -84.2, 5)[None, :]
        H_m, h_m = self.region.heights(lat, lon)
        self.assertEqual(H_m.shape, (7, 5))
        one = self.region.heights(lat[3, 0], lon[0, 2])
        self.assertEqual(one[0].shape, ())
        self.assertEqual((H_m[3, 2], h_m[3, 2]), (one[0][()], one[1][()]))

    def test_are_nan_beyond_the_data(self):
        H_m, h_m = self.region.heights([36.55, 40.0], [-84.25, 8.0])
        self.assertEqual([*np.isnan(H_m)], [False, True])
        self.assertEqual([*np.isnan(h_m)], [False, True])

    def test_of_many_places_do_not_depend_on_threads(self):
        seed = 20261128
        print("seed", seed)
        random = np.random.default_rng(seed)
        lat, lon = random.uniform(36.5, 36.6, 50_000), random.uniform(-84.3, -84.2, 50_000)
        H_m, _ = self.region.heights(lat, lon)
        for i in random.integers(0, lat.size, 50):
            self.assertEqual(H_m[i], self.region.heights(lat[i], lon[i])[0])

    def test_tell_how_far_they_are_and_stop(self):
        lat, lon = np.linspace(36.5, 36.6, 50_000), np.linspace(-84.3, -84.2, 50_000)
        shares = []
        told = self.region.heights(lat, lon, progress=lambda share, step: shares.append((share, step)))
        np.testing.assert_array_equal(told, self.region.heights(lat, lon))
        # 13 blocks of 4,096.
        self.assertEqual(shares, [(count / 13, "finding heights") for count in range(1, 14)])
        with self.assertRaises(orograph.CancelledError):
            self.region.heights(lat, lon, progress=lambda share, step: share > 0.5)
        self.assertEqual(self.region.heights(*A)[0], self.region.heights(*A, progress=lambda share, step: False)[0])

    def test_posts_are_those_that_gdal_reads(self):
        try:
            from osgeo import gdal
        except ImportError:
            self.skipTest("needs python3-gdal")
        gdal.UseExceptions()
        raster = gdal.Open(str(DATA))
        t, posts = raster.GetGeoTransform(), raster.ReadAsArray()
        rows, columns = np.meshgrid(np.arange(3, 60, 7), np.arange(5, 90, 11), indexing="ij")
        H_m, _ = self.region.heights(t[3] + (rows + 0.5) * t[5], t[0] + (columns + 0.5) * t[1])
        # A place that is rounded stands beside its post: 1e-14 degrees of a slope of 1 are 1 nm.
        np.testing.assert_allclose(H_m, posts[rows, columns], rtol=0.0, atol=1e-6)

    def test_refuse_what_is_no_place(self):
        for lat, lon in [(91, 0), (0, 181), (math.nan, 0), (0, math.inf)]:
            with self.assertRaisesRegex(orograph.UsageError, "^place 1: "):
                self.region.heights([36.55, lat], [-84.25, lon])


class HorizonsOfRegions(unittest.TestCase):
    BOX = "-84.26,36.54,-84.24,36.56"
    ASK = {"directions": 8, "radius_km": 3.0, "above_m": 2.0}

    def test_are_those_of_the_program(self):
        try:
            from osgeo import gdal
        except ImportError:
            self.skipTest("needs python3-gdal")
        gdal.UseExceptions()
        with tempfile.TemporaryDirectory() as folder, orograph.open(DATA) as region:
            found = region.horizon(bbox=self.BOX, **self.ASK)
            said = told("horizon", DATA, "--bbox=" + self.BOX, "--directions", 8, "--radius", 3, "--above", 2, "--out",
                        Path(folder) / "h.tif")
            rasters = [gdal.Open(str(Path(folder) / f"h.{kind}.tif")) for kind in ("horizon", "sky-view")]
            # The program reads the part of the file that counts, and places it by another post: some 1e-8 degrees.
            np.testing.assert_allclose(found.elevation_deg, rasters[0].ReadAsArray(), rtol=0.0, atol=1e-7)
            np.testing.assert_allclose(found.sky_view, rasters[1].ReadAsArray(), rtol=0.0, atol=1e-8)
            np.testing.assert_allclose(found.transform, rasters[0].GetGeoTransform(), rtol=1e-14)
            self.assertEqual((found.known, found.with_sky_view), (said["posts"], said["posts_with_sky_view"]))

    def test_go_into_arrays_of_the_caller_and_are_stopped(self):
        with orograph.open(DATA) as region:
            own = region.horizon(bbox=(-84.26, 36.54, -84.24, 36.56), **self.ASK)
            mine = np.empty(own.elevation_deg.shape, np.float32), np.empty(own.sky_view.shape, np.float32)
            again = region.horizon(bbox=self.BOX, out=mine, **self.ASK)
            self.assertIs(again.elevation_deg, mine[0])
            np.testing.assert_array_equal(mine[0], own.elevation_deg)
            with self.assertRaises(orograph.CancelledError):
                region.horizon(bbox=self.BOX, progress=lambda share, step: True, **self.ASK)

    def test_refuse_what_means_nothing(self):
        with orograph.open(DATA) as region:
            for wrong in ({"directions": 2}, {"directions": 721}, {"radius_km": 0.0}, {"radius_km": math.nan},
                          {"above_m": -1.0}, {"above_m": math.inf}, {"bbox": "1,2"}, {"air": 2.0}):
                with self.assertRaises(orograph.UsageError, msg=wrong):
                    region.horizon(**{**self.ASK, "bbox": self.BOX, **wrong})
            with self.assertRaises(orograph.NoDataError):
                region.horizon(bbox="8,46,9,47", **self.ASK)


class Regions(unittest.TestCase):
    def test_tell_what_the_program_tells(self):
        with orograph.open(DATA) as region:
            self.assertEqual(region.info, told("info", DATA))
        with orograph.open(DATA, bbox=(-84.28, 36.52, -84.22, 36.58)) as part:
            self.assertEqual(part.info, told("info", DATA, "--bbox=-84.28,36.52,-84.22,36.58"))

    def test_closed_are_refused(self):
        region = orograph.open(DATA)
        region.close()
        region.close()
        with self.assertRaisesRegex(orograph.UsageError, "is not open"):
            region.heights(*A)
        with self.assertRaisesRegex(orograph.UsageError, "is not open"):
            region.info

    def test_that_cannot_be_opened_say_why(self):
        with self.assertRaisesRegex(orograph.Error, "none.tif") as raised:
            orograph.open("/nowhere/none.tif")
        self.assertEqual(raised.exception.code, 1)
        with self.assertRaises(orograph.NoDataError):
            orograph.open(DATA, bbox="8,46,9,47")
        with self.assertRaises(orograph.UsageError):
            orograph.open(DATA, bbox="8,46,9")
        with self.assertRaises(orograph.UsageError):
            orograph.open([])

    def test_tell_how_far_reading_is_and_stop(self):
        steps = []
        orograph.open(DATA, progress=lambda share, step: steps.append((share, step))).close()
        self.assertGreaterEqual(len(steps), 1)
        self.assertTrue(all(0.0 <= share <= 1.0 for share, _ in steps), steps)
        with self.assertRaises(orograph.CancelledError):
            orograph.open(DATA, progress=lambda share, step: True)

        def fails(share, step):
            raise KeyError("mine")

        with self.assertRaisesRegex(KeyError, "mine"):
            orograph.open(DATA, progress=fails)

    def test_are_used_by_several_threads_while_one_closes(self):
        region, failures = orograph.open(DATA), []
        expected = region.heights(*A)[0]

        def ask():
            try:
                while True:
                    if region.heights(*A)[0] != expected:
                        failures.append("another height")
            except orograph.UsageError as closed:
                if "is not open" not in str(closed):
                    failures.append(str(closed))

        threads = [threading.Thread(target=ask) for _ in range(4)]
        for thread in threads:
            thread.start()
        region.viewshed(A, radius_km=1.0)
        region.close()
        for thread in threads:
            thread.join(60)
        self.assertEqual(failures, [])

    def test_leave_gdal_of_the_process_usable(self):
        try:
            from osgeo import gdal
        except ImportError:
            self.skipTest("needs python3-gdal")
        gdal.UseExceptions()
        before = gdal.Open(str(DATA)).ReadAsArray()
        with orograph.open(DATA):
            np.testing.assert_array_equal(gdal.Open(str(DATA)).ReadAsArray(), before)
            made = gdal.GetDriverByName("MEM").Create("", 3, 2)
            made.GetRasterBand(1).Fill(7)
            self.assertEqual(made.ReadAsArray().sum(), 42)
        with self.assertRaises(RuntimeError):
            gdal.Open("/nowhere/none.tif")


class SightsAndProfiles(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.region = orograph.open(DATA)

    def check_sight(self, sight, said):
        self.assertEqual(sight.visible, said["visible"])
        for mine, its in [(sight.from_, said["from"]), (sight.to, said["to"]), (sight.obstacle, said["obstacle"]),
                          (sight.least_clearance, said["clearance"]["ground"])]:
            self.assertEqual(mine is None, its is None)
            if mine is not None:
                self.assertEqual(mine._asdict(), {name: its[name] for name in mine._fields})
        for name, key in [("target_deficit_m", "target_missed_by_m"), ("eye_deficit_m", "eye_missed_by_m"),
                          ("distance_m", "distance_m"), ("azimuth_deg", "azimuth_deg"),
                          ("elevation_deg", "elevation_deg"), ("slant_m", "slant_m"),
                          ("without_data_m", "without_data_m")]:
            self.assertEqual(getattr(sight, name), said[key], name)
        self.assertEqual(sight.least_clearance_m, said["clearance"]["least_m"])
        if sight.obstacle is not None:
            self.assertEqual(sight.obstacle_distance_m, said["obstacle"]["distance_m"])

    def test_sights_are_those_of_the_program(self):
        ask = ("sight", DATA, "--from", place(A), "--to", place(B))
        hidden = self.region.sight(A, B)
        self.assertFalse(hidden.visible)
        self.check_sight(hidden, told(*ask))
        high = self.region.sight((*A, 1500.0), (*B, 30.0))
        self.assertTrue(high.visible)
        self.check_sight(high, told(*ask, "--above", 1500, "--target", 30))
        self.check_sight(self.region.sight(A, B, air=0.0), told(*ask, "--refraction", 0))
        self.check_sight(self.region.sight(orograph.Point(*A, 2000.0, "geoid"), B, on_summit=False),
                         told(*ask, "--altitude", 2000))
        self.check_sight(self.region.sight(orograph.Point(*A, 1234.5, "ellipsoid"), orograph.Point(*B, 987.25, "ellipsoid")),
                         told("sight", DATA, "--from", "geo:%s,1234.5" % place(A), "--to", "geo:%s,987.25" % place(B)))
        self.check_sight(self.region.sight(A, B, on_summit=True), told(*ask, "--on-summit"))

    def test_sights_that_cannot_be_are_refused(self):
        for asked, words in [(((*A, 2.0), (*A, 2.0)), "to: is where from is"), (((40.0, 8.0), B), "from .*: no elevation data"),
                             (((*A, -5.0), B), "height_m -5: must be 0 or more"),
                             ((A, orograph.Point(*B, -99.0, "geoid")), "under the ground"),
                             (((math.nan, 0.0), B), "from: latitude nan")]:
            with self.assertRaisesRegex(orograph.Error, words):
                self.region.sight(*asked)
        with self.assertRaisesRegex(orograph.UsageError, "refraction"):
            self.region.sight(A, B, air=7.0)

    def test_profiles_tell_how_far_they_are_and_stop(self):
        # Over the data to and fro, in steps and from triangle to triangle.
        lines = [(([36.46, 36.59], [-84.34, -84.21]), {"step_m": 1.0}),
                 ((np.where(np.arange(40) % 2 == 0, 36.46, 36.59), np.linspace(-84.34, -84.21, 40)), {})]
        for line, options in lines:
            shares = []
            told = self.region.profile(*line, progress=lambda share, step: shares.append((share, step)), **options)
            np.testing.assert_array_equal(told.points, self.region.profile(*line, **options).points)
            self.assertGreater(len(told.points), 8192)
            self.assertEqual({step for _, step in shares}, {"following the line"})
            # The first way tells how many points there are, the second one has them.
            first = [share for share, _ in shares[:len(shares) // 2]]
            self.assertEqual(first, sorted(first))
            self.assertEqual(shares, shares[:len(shares) // 2] * 2)
            self.assertTrue(0.0 < first[0] and first[-1] <= 1.0, first)
            with self.assertRaises(orograph.CancelledError):
                self.region.profile(*line, progress=lambda share, step: True, **options)

    def test_profiles_are_those_of_the_program(self):
        for step_m in (None, 37.5):
            profile = self.region.profile([A[0], 36.53, B[0]], [A[1], -84.22, B[1]], step_m=step_m, climb_threshold_m=25.0)
            said = told("profile", DATA, "--along", place(A) + "; 36.53,-84.22;" + place(B), "--climb-threshold", 25,
                        *([] if step_m is None else ["--step", step_m]))
            self.assertEqual(len(profile.points), said["points"])
            for name in ("length_m", "ascent_m", "descent_m", "without_data_m"):
                self.assertEqual(getattr(profile, name), said[name], name)
            self.assertEqual(profile.ascent_over_m, said["over_threshold"]["ascent_m"])
            self.assertEqual(profile.descent_over_m, said["over_threshold"]["descent_m"])
            for number, name in [(0, "begin"), (-1, "end"), (profile.highest, "highest"), (profile.lowest, "lowest")]:
                self.assertEqual(dict(zip(profile.points.dtype.names, profile.points[number].tolist())), said[name])
        with self.assertRaises(orograph.UsageError):
            self.region.profile([1.0], [2.0])
        with self.assertRaises(orograph.UsageError):
            self.region.profile([A[0], B[0]], [A[1], B[1]], step_m=-1.0)
        with self.assertRaises(orograph.NoDataError):
            self.region.profile([1.0, 2.0], [3.0, 4.0])


class Viewsheds(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.region = orograph.open(DATA)

    def test_are_those_of_the_program(self):
        try:
            from osgeo import gdal, osr
        except ImportError:
            self.skipTest("needs python3-gdal")
        gdal.UseExceptions()
        osr.UseExceptions()
        for eyes, options in [([A], []), ([(*A, 25.0), (*B, 25.0)], ["--above", 25])]:
            shed = self.region.viewshed(eyes, radius_km=5.0, target_m=3.0)
            with tempfile.TemporaryDirectory() as folder:
                file = folder + "/shed.tif"
                ats = [word for eye in eyes for word in ("--at", place(eye))]
                said = told("viewshed", DATA, *ats, *options, "--radius", 5, "--target", 3, "--out", file)
                raster = gdal.Open(file)
                bands = raster.ReadAsArray()
                self.assertEqual(raster.GetGeoTransform(), shed.transform)
                crs = osr.SpatialReference()
                crs.SetFromUserInput(shed.crs)
                self.assertTrue(crs.IsSame(raster.GetSpatialRef(), ["IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES"]))
            self.assertEqual((said["cells"], said["seen"]), (shed.known, shed.seen))
            self.assertGreater(shed.seen, 1000)
            observers = np.where(shed.observers == orograph.UNKNOWN, orograph.UNKNOWN, shed.observers > 0)
            np.testing.assert_array_equal(observers, bands[0])
            deficit = np.where(np.isinf(shed.clearance_deficit_m), orograph.UNKNOWN, shed.clearance_deficit_m)
            np.testing.assert_array_equal(deficit, bands[1])
            if len(eyes) > 1:
                np.testing.assert_array_equal(shed.observers, bands[2])

    def test_go_into_arrays_of_the_caller(self):
        ask = dict(radius_km=2.0)
        shape = self.region.viewshed_shape(A, **ask)
        mine = np.zeros(shape, np.float32), np.zeros(shape, np.float32)
        shed = self.region.viewshed(A, out=mine, **ask)
        self.assertIs(shed.clearance_deficit_m, mine[0])
        self.assertIs(shed.observers, mine[1])
        own = self.region.viewshed(A, **ask)
        np.testing.assert_array_equal(own.observers, mine[1])
        self.assertEqual((own.observers > 0).sum(), shed.seen)
        for bad in (mine[0].T, mine[0].astype(np.float64), mine[0][:, ::2], np.zeros((3, 3), np.float32), "text"):
            with self.assertRaises(orograph.UsageError):
                self.region.viewshed(A, out=(bad, mine[1]), **ask)
        fixed = np.zeros(shape, np.float32)
        fixed.flags.writeable = False
        with self.assertRaises(orograph.UsageError):
            self.region.viewshed(A, out=(mine[0], fixed), **ask)

    def test_tell_how_far_they_are_and_stop(self):
        shares = []
        self.region.viewshed(A, progress=lambda share, step: shares.append(share))
        self.assertGreaterEqual(len(shares), 1)
        with self.assertRaises(orograph.CancelledError):
            self.region.viewshed(A, progress=lambda share, step: True)

    def test_are_stopped_by_signals(self):
        # A program begun in the background of a shell ignores this signal, and Python leaves it so.
        self.addCleanup(signal.signal, signal.SIGINT, signal.signal(signal.SIGINT, signal.default_int_handler))
        # Python handles it in the progress function, which waits until it was sent: a busy machine sends it late.
        began, sent = threading.Event(), threading.Event()

        def interrupt():
            began.wait(60)
            os.kill(os.getpid(), signal.SIGINT)
            sent.set()

        def show(share, step):
            began.set()
            sent.wait(60)

        thread = threading.Thread(target=interrupt)
        thread.start()
        with self.assertRaises(KeyboardInterrupt):
            self.region.viewshed(A, progress=show)
        thread.join()
        self.assertGreater(self.region.viewshed(A, radius_km=1.0).known, 100)

    def test_that_cannot_be_are_refused(self):
        for asked, options in [(A, dict(radius_km=0.0)), (A, dict(radius_km=math.nan)), (A, dict(target_m=-1.0)),
                               (A, dict(target_m=math.nan)), ([], {}), (A, dict(targets_on_canopy=True)),
                               (A, dict(air=9.0)), ((math.inf, 0.0), {})]:
            with self.assertRaises(orograph.UsageError, msg=(asked, options)):
                self.region.viewshed(asked, **options)
        with self.assertRaises(orograph.NoDataError):
            self.region.viewshed((1.0, 2.0))


class OtherRegions(unittest.TestCase):
    """Posts in a CRS of their own, a canopy over the ground, a baked file, two grids over each other."""

    def setUp(self):
        try:
            from osgeo import gdal
        except ImportError:
            self.skipTest("needs python3-gdal")
        gdal.UseExceptions()
        gdal.AllRegister()
        self.gdal = gdal
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def file(self, name):
        return self.folder.name + "/" + name

    def check(self, data, *words, canopy=None, **options):
        """Heights, a line of sight and a viewshed, against the program's."""
        gdal = self.gdal
        with orograph.open(data, **({} if canopy is None else {"canopy": canopy}), **options) as region:
            self.assertEqual(region.info, told("info", data, *words))
            said = told("profile", data, "--along", place(A) + ";" + place(B), *words)
            self.assertEqual([*region.heights(*A)], [said["begin"]["H_m"], said["begin"]["h_m"]])
            self.assertEqual([*region.heights(*B)], [said["end"]["H_m"], said["end"]["h_m"]])
            trees = [] if canopy is None else ["--canopy", canopy]
            sight = region.sight((*A, 40.0), B)
            said = told("sight", data, "--from", place(A), "--above", 40, "--to", place(B), *words, *trees)
            self.assertEqual((sight.visible, sight.target_deficit_m), (said["visible"], said["target_missed_by_m"]))
            self.assertEqual(sight.obstacle._asdict(), {key: said["obstacle"][key] for key in sight.obstacle._fields})
            shed = region.viewshed((*A, 40.0), radius_km=2.0)
            said = told("viewshed", data, "--at", place(A), "--above", 40, "--radius", 2, "--out", self.file("shed.tif"),
                        "--overwrite", *words, *trees)
            raster = gdal.Open(self.file("shed.tif"))
            self.assertEqual((shed.known, shed.seen), (said["cells"], said["seen"]))
            np.testing.assert_array_equal(shed.observers, raster.ReadAsArray()[0])
            self.assertEqual(shed.transform, raster.GetGeoTransform())
            reference = raster.GetSpatialRef()
            mine = type(reference)()
            mine.SetFromUserInput(shed.crs)
            self.assertTrue(mine.IsSame(reference, ["IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES"]))
            return shed

    def test_posts_in_utm(self):
        self.gdal.Warp(self.file("utm.tif"), str(DATA), dstSRS="EPSG:32616", xRes=90, yRes=90, resampleAlg="bilinear",
                       outputType=self.gdal.GDT_Float32)
        shed = self.check(self.file("utm.tif"))
        self.assertEqual((shed.transform[1], shed.transform[5]), (90.0, -90.0))
        self.check(self.file("utm.tif"), "--resample", resample=True)

    def test_a_baked_file(self):
        program("bake", DATA, "--out", self.file("j.oro"))
        self.check(self.file("j.oro"))

    def test_two_grids(self):
        self.gdal.Translate(self.file("fine.tif"), str(DATA), projWin=[-84.28, 36.56, -84.24, 36.53], width=200,
                            height=150, resampleAlg="cubic")
        for order in ("finest", "listed"):
            data = [str(DATA), self.file("fine.tif")]
            with orograph.open(data, order=order) as region:
                said = told("profile", *data, "--order", order, "--along", place((36.545, -84.26)) + ";" + place(B))
                self.assertEqual([*region.heights(36.545, -84.26)], [said["begin"]["H_m"], said["begin"]["h_m"]])
                self.assertEqual(region.info, told("info", *data, "--order", order))
                mine = region.shot(at=A, heading=220, size="64x48")
                program("shot", *data, "--order", order, "--at", place(A), "--heading", 220, "--size", "64x48", "--out",
                        self.file("p.png"), "--overwrite")
                np.testing.assert_array_equal(np.moveaxis(mine[..., :3], -1, 0),
                                              self.gdal.Open(self.file("p.png")).ReadAsArray()[:3])

    def test_a_canopy(self):
        posts = self.gdal.Open(str(DATA))
        trees = self.gdal.GetDriverByName("GTiff").Create(self.file("trees.tif"), posts.RasterXSize, posts.RasterYSize, 1,
                                                          self.gdal.GDT_Float32)
        trees.SetGeoTransform(posts.GetGeoTransform())
        trees.SetSpatialRef(posts.GetSpatialRef())
        trees.GetRasterBand(1).WriteArray(np.full((posts.RasterYSize, posts.RasterXSize), 15.0, np.float32))
        trees = None
        under = self.check(str(DATA)).seen
        over = self.check(str(DATA), canopy=self.file("trees.tif")).seen
        self.assertLess(over, under)
        with orograph.open(DATA, canopy=self.file("trees.tif")) as region:
            with self.assertRaisesRegex(orograph.UsageError, "in the canopy"):
                region.viewshed(A, radius_km=1.0)
            self.assertEqual(region.sight(A, B).visible, False)


class OptionWords(unittest.TestCase):
    """Options of pictures, as the module hands them to the library. Nothing is drawn."""

    @classmethod
    def setUpClass(cls):
        cls.region = orograph.open(DATA)
        cls.commands = {"shot": cls.region.shot, "panorama": cls.region.panorama}

    def refusal(self, command, *words, **options):
        with self.assertRaises(orograph.Error) as raised:
            self.commands[command](*words, **options)
        return str(raised.exception)

    def test_that_name_files_to_write_or_other_data_are_refused(self):
        for command in self.commands:
            self.assertEqual(self.refusal(command, "--out", "p.png", at=A), "options: --out is for the program")
            self.assertRegex(self.refusal(command, at=A, out="p.png"), "^the array must be uint8")
            for option, value in [("kml", True), ("geopose", True), ("stac", True), ("mesh_file", "m.obj"),
                                  ("fetch", "skadi"), ("network", True)]:
                said = self.refusal(command, at=A, **{option: value})
                self.assertEqual(said, "options: --%s is for the program" % option.replace("_", "-"), command)
            for option, value in [("bbox", (1, 2, 3, 4)), ("tile", "N36W085"), ("order", "listed"), ("feather", 10),
                                  ("height_unit", "ft"), ("source_crs", "EPSG:2056"), ("strict_datum", True),
                                  ("fill_voids", True), ("resample", True)]:
                self.assertIn("oro_open() takes these", self.refusal(command, at=A, **{option: value}), option)

    def test_lists_give_an_option_again_and_tuples_have_commas(self):
        files = ["/nowhere/a.geojson", Path("/nowhere/b.geojson")]
        for command in self.commands:
            self.assertRegex(self.refusal(command, at=A, overlay=files), "^/nowhere/a.geojson: ")
            self.assertRegex(self.refusal(command, at=A, overlay=tuple(files)), "^/nowhere/a.geojson,/nowhere/b.geojson: ")
            self.assertRegex(self.refusal(command, at=A, landcover=[("/nowhere/a.tif", "/nowhere/t.csv")]), "/nowhere/")
        # One that is given once is a list with commas, too.
        self.assertIn("10,60,70", self.refusal("panorama", at=A, sector=[10, 60, 70]))

    def is_repeated(self, command, option):
        value = "100"
        while True:
            said = self.refusal(command, option, value, option, value)
            wanted = re.search(r"(?:choose|must be between) (\w+)", said)
            if wanted is None:
                return "is given more than once" not in said
            value = wanted[1]

    def test_that_may_be_given_several_times_are_those_of_the_program(self):
        found = set()
        for command in self.commands:
            options = re.findall(r"^  (--[\w-]+) [A-Za-z]", program(command, "--help", "all"), re.M)
            self.assertGreater(len(options), 40, command)
            found |= {option for option in options if self.is_repeated(command, option)}
        # Both are refused, once or twice.
        found -= {"--view", "--mesh-file"}
        self.assertEqual({option[2:].replace("-", "_") for option in found}, orograph._REPEATED)


class Pictures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.region = orograph.open(DATA)

    def drawn(self, command, name, *words):
        try:
            from osgeo import gdal
        except ImportError:
            self.skipTest("needs python3-gdal")
        gdal.UseExceptions()
        gdal.AllRegister()
        with tempfile.TemporaryDirectory() as folder:
            program(command, DATA, "--out", folder + "/" + name, *words)
            return np.moveaxis(gdal.Open(folder + "/" + name).ReadAsArray(), 0, -1)

    def test_shots_have_the_pixels_of_the_program(self):
        for words, options in [(["--size", "160x90"], dict(size="160x90")),
                               (["--at", place(A), "--heading", "45", "--size", "320x100", "--legend", "--style", "haze"],
                                dict(at=A, heading=45, size="320x100", legend=True, style="haze"))]:
            mine = self.region.shot(**options)
            its = self.drawn("shot", "p.png", *words)
            self.assertEqual(mine.shape[:2], its.shape[:2])
            np.testing.assert_array_equal(mine[..., :3], its[..., :3])
            self.assertTrue((mine[..., 3] == 255).all())
            np.testing.assert_array_equal(self.region.shot(*words), mine)

    def test_maps_have_the_pixels_and_the_opacity_of_the_program(self):
        mine = self.region.shot(ortho=True, size="64x64")
        np.testing.assert_array_equal(mine, self.drawn("shot", "m.tif", "--ortho", "--size", "64x64"))

    def test_panoramas_have_the_pixels_of_the_program(self):
        mine = self.region.panorama(at=A, sector=(10, 60), width=400)
        np.testing.assert_array_equal(mine[..., :3], self.drawn("panorama", "p.png", "--at", place(A), "--sector", "10,60",
                                                                "--width", "400")[..., :3])

    def test_layers_have_the_values_of_the_program(self):
        try:
            from osgeo import gdal
        except ImportError:
            self.skipTest("needs python3-gdal")
        gdal.UseExceptions()
        files = {"longitude_deg": "longitude", "latitude_deg": "latitude", "H_m": "height", "h_m": "ellipsoidal-height",
                 "distance_m": "distance", "slope_deg": "slope", "source": "source", "shadow": "shadow"}
        mine = self.region.layers("--at", place(A), "--heading", 45, size="96x54", names=[*files])
        with tempfile.TemporaryDirectory() as folder:
            program("shot", DATA, "--at", place(A), "--heading", "45", "--size", "96x54", "--layers", "--out",
                    folder + "/p.png")
            for name, file in files.items():
                np.testing.assert_array_equal(mine[name], gdal.Open(f"{folder}/p.{file}.tif").ReadAsArray(), name)
        self.assertGreater(np.isfinite(mine["H_m"]).sum(), 500)
        for names, words in [(["wrong"], []), (["cover"], []), (["H_m"], ["--ortho"]), (["H_m"], ["--layers"])]:
            with self.assertRaises(orograph.UsageError):
                self.region.layers(*words, names=names, size="96x54")

    def test_overlays_of_a_list_are_those_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            files = [f"{folder}/{number}.geojson" for number in range(2)]
            for file, end in zip(files, ([-84.28, 36.52], [-84.22, 36.52])):
                line = {"type": "LineString", "coordinates": [[-84.25, 36.545], end]}
                Path(file).write_text(json.dumps({"type": "Feature", "properties": {}, "geometry": line}))
            words = ["--at", place(A), "--above", "800", "--heading", "180", "--pitch", "-30", "--size", "160x90"]
            mine = self.region.shot(*words, overlay=files)
            both = self.drawn("shot", "p.png", *words, "--overlay", files[0], "--overlay", files[1])
            np.testing.assert_array_equal(mine[..., :3], both[..., :3])
            self.assertTrue((mine != self.region.shot(*words, overlay=files[0])).any())
            self.assertTrue((mine != self.region.shot(*words, overlay=files[1])).any())

    def test_go_into_an_array_of_the_caller(self):
        mine = np.zeros((48, 64, 4), np.uint8)
        self.assertIs(self.region.shot(size="64x48", out=mine), mine)
        self.assertTrue(mine.any())
        with self.assertRaises(orograph.Error):
            self.region.shot(size="64x49", out=mine)

    def test_stop(self):
        with self.assertRaises(orograph.CancelledError):
            self.region.shot(size="64x48", progress=lambda share, step: True)
        with self.assertRaises(orograph.CancelledError):
            self.region.panorama(at=A, width=400, progress=lambda share, step: True)
        self.assertEqual(self.region.shot(size="64x48").shape, (48, 64, 4))

    def test_that_cannot_be_are_refused(self):
        for words in (["--out", "p.png"], ["--bbox", "1,2,3,4"], ["--view", "p.png"], ["--layers"], ["--wrong"],
                      ["--size"], ["--size", "0x0"], ["more.tif"], ["--help"], ["--at", "nowhere"]):
            with self.assertRaises(orograph.UsageError, msg=words):
                self.region.shot(*words)
        with self.assertRaises(orograph.UsageError):
            self.region.panorama()
        with self.assertRaises(orograph.NoDataError):
            self.region.shot(at=(1, 2))


class Stubs(unittest.TestCase):
    """The stub has the names of the module, and its functions their arguments."""

    def arguments(self, function):
        args = function.args
        return [arg.arg for arg in args.posonlyargs + args.args + ([args.vararg] if args.vararg else []) +
                args.kwonlyargs + ([args.kwarg] if args.kwarg else [])]

    STRUCTURES = {"_Options": "oro_open_options", "_Point": "oro_point", "_Position": "oro_position",
                  "_SightOptions": "oro_sight_options", "_Sight": "oro_sight_answer",
                  "_ProfileOptions": "oro_profile_options", "_ProfileSums": "oro_profile_sums",
                  "_ViewshedOptions": "oro_viewshed_options", "_HorizonOptions": "oro_horizon_options",
                  "_Window": "oro_window", "_Layers": "oro_layers"}
    KINDS = {"double": ctypes.c_double, "int": ctypes.c_int, "size_t": ctypes.c_size_t, "int64_t": ctypes.c_int64}

    def test_structures_are_those_of_the_interface(self):
        mine = {name for name, value in vars(orograph).items()
                if isinstance(value, type) and issubclass(value, ctypes.Structure)}
        self.assertEqual(mine, set(self.STRUCTURES))
        kept = [line for line in abi.kept_lines() if line.startswith("member ")]
        kinds = {line.split()[1]: re.fullmatch(r"member \S+ (.*) at \d+ of \d+", line)[1] for line in kept}
        lines = []
        for name, structure in self.STRUCTURES.items():
            for field, kind in getattr(orograph, name)._fields_:
                member, place = f"{structure}.{field.rstrip('_')}", getattr(getattr(orograph, name), field)
                lines.append(f"member {member} {kinds.get(member)} at {place.offset} of {place.size}")
                if kinds.get(member) in self.KINDS:
                    self.assertIs(kind, self.KINDS[kinds[member]], member)
        for field, (_, offset) in orograph.POINT_TYPE.fields.items():
            lines.append(f"member oro_profile_point.{field} double at {offset} of 8")
        self.assertEqual(sorted(lines), sorted(kept))
        self.assertEqual(ctypes.sizeof(orograph._Point), 32)
        self.assertEqual(orograph.POINT_TYPE.itemsize, 40)

    def test_functions_have_the_arguments_of_the_interface(self):
        found = [re.fullmatch(r"function [\w ]+?\*? ?(oro_\w+)\((.*)\)", line) for line in abi.kept_lines()
                 if line.startswith("function ")]
        counts = {each[1]: 0 if each[2] == "void" else each[2].count(",") + 1 for each in found}
        self.assertEqual({name: len(getattr(orograph._library, name).argtypes) for name in counts}, counts)

    def test_are_those_of_the_module(self):
        tree = ast.parse((MODULE / "orograph/__init__.pyi").read_text())
        names = {node.name: node for node in tree.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
        values = {node.target.id for node in tree.body if isinstance(node, ast.AnnAssign)}
        self.assertEqual(sorted(set(names) | values), sorted(orograph.__all__))
        self.assertTrue((MODULE / "orograph/py.typed").exists())
        for name, node in names.items():
            known = getattr(orograph, name)
            if isinstance(node, ast.FunctionDef):
                self.assertEqual(self.arguments(node), [*inspect.signature(known).parameters], name)
            elif hasattr(known, "_fields"):
                self.assertEqual([field.target.id for field in node.body], [*known._fields], name)
            for method in [each for each in getattr(node, "body", []) if isinstance(each, ast.FunctionDef)]:
                mine = inspect.getattr_static(known, method.name)
                if name == "Region" and callable(mine) and not method.name.startswith("__"):
                    self.assertEqual(self.arguments(method), [*inspect.signature(mine).parameters], method.name)
        public = [each for each in vars(orograph.Region) if not each.startswith("_")]
        self.assertEqual(sorted(public), sorted(each.name for each in names["Region"].body
                                                if not each.name.startswith("_")))


if __name__ == "__main__":
    unittest.main(verbosity=2)
