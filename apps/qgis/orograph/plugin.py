"""What QGIS loads and unloads: the provider's registration."""

from qgis.core import QgsApplication

from .provider import OrographProvider


class OrographPlugin:
    """Registers the provider while the plugin is on. It has no window of its own."""

    def __init__(self):
        self.provider = None

    def initProcessing(self):  # noqa: N802, QGIS's name
        """Called by qgis_process, which has no windows, and by initGui()."""
        self.provider = OrographProvider()
        QgsApplication.processingRegistry().addProvider(self.provider)

    def initGui(self):  # noqa: N802
        self.initProcessing()

    def unload(self):
        if self.provider is not None:
            QgsApplication.processingRegistry().removeProvider(self.provider)
            self.provider = None
