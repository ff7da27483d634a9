"""The provider: its algorithms, and where the program is."""

import os

from processing.core.ProcessingConfig import ProcessingConfig, Setting
from qgis.core import QgsProcessingProvider
from qgis.PyQt.QtGui import QIcon

from .algorithms.export import Export
from .algorithms.horizon import Horizon
from .algorithms.orthomap import OrthoMap
from .algorithms.panorama import Panorama
from .algorithms.picture import ExtentPicture, Picture
from .algorithms.profile import Profile
from .algorithms.sight import Sight
from .algorithms.viewshed import Viewshed
from .program import PROGRAM_SETTING, find_program, version_of

ICON = os.path.join(os.path.dirname(__file__), "icon.svg")


class OrographProvider(QgsProcessingProvider):
    def id(self):
        return "orograph"

    def name(self):
        return "Orograph"

    def longName(self):  # noqa: N802, QGIS's names
        return "Orograph (terrain on WGS84)"

    def icon(self):
        return QIcon(ICON) if os.path.exists(ICON) else super().icon()

    def versionInfo(self):  # noqa: N802
        program = find_program(ProcessingConfig.getSetting(PROGRAM_SETTING))
        return version_of(program) if program else ""

    def load(self):
        ProcessingConfig.settingIcons[self.name()] = self.icon()
        ProcessingConfig.addSetting(
            Setting(self.name(), PROGRAM_SETTING, "Program (empty: orograph of the PATH)", "", valuetype=Setting.FILE)
        )
        ProcessingConfig.readSettings()
        self.refreshAlgorithms()
        return True

    def unload(self):
        ProcessingConfig.removeSetting(PROGRAM_SETTING)

    def loadAlgorithms(self):  # noqa: N802
        for algorithm in (Panorama, Viewshed, Horizon, Sight, Profile, OrthoMap, Picture, ExtentPicture, Export):
            self.addAlgorithm(algorithm())
