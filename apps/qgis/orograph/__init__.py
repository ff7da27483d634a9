"""A Processing provider of QGIS that runs the program orograph."""


def classFactory(iface):  # noqa: N802, QGIS's name
    from .plugin import OrographPlugin

    return OrographPlugin()
