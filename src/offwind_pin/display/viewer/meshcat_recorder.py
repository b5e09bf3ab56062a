"""The one door to meshcat: a window that records commands where meshcat would start a server.

``meshcat.Visualizer()`` by itself starts a server that listens on every interface. Given this
window, it starts nothing.
"""

from __future__ import annotations

import base64
import warnings
from functools import cache
from pathlib import Path
from typing import Any

import umsgpack
from markupsafe import Markup

from offwind_pin.display.report.templates import environment

with warnings.catch_warnings():
    # meshcat imports a module that pyzmq deprecates; the servers that need it are never used here.
    warnings.simplefilter("ignore", DeprecationWarning)
    import meshcat
    import meshcat.geometry as meshcat_geometry

__all__ = ["Recorder", "meshcat", "meshcat_geometry"]


class Recorder:
    """Stands in for meshcat's window: keeps each command as the bytes its viewer understands.

    Attributes
    ----------
    commands : list of bytes
        MessagePack of the commands in the order they were given, floats in single precision.
    """

    def __init__(self) -> None:
        self.commands: list[bytes] = []

    def send(self, command: Any) -> None:
        """Record a command of :mod:`meshcat.commands`."""
        self.commands.append(umsgpack.packb(command.lower(), force_float_precision="single"))

    def visualizer(self) -> Any:
        """A ``meshcat.Visualizer`` that draws into this recorder."""
        return meshcat.Visualizer(window=self)

    def page(self, template: str, **values: Any) -> str:
        """HTML page of a template with Meshcat's viewer and the recorded commands in it.

        It needs neither server nor network.
        """
        return (
            environment()
            .get_template(template)
            .render(
                commands=[base64.b64encode(command).decode() for command in self.commands],
                licence=Markup(_viewer_licence().replace("*/", "* /")),  # noqa: S704 (from the package)
                viewer_script=Markup(_viewer_script()),  # noqa: S704 (from the package)
                **values,
            )
        )


@cache
def _viewer_script() -> str:
    """JavaScript of meshcat's viewer, fit to stand inside a script element."""
    script = (_assets() / "dist" / "main.min.js").read_text(encoding="utf-8")
    if "</script" in script.lower():
        raise RuntimeError("meshcat's viewer script would end the script element that holds it")
    return script


@cache
def _viewer_licence() -> str:
    """Licences of the viewer and of what it bundles, which go wherever it goes."""
    bundled = (_assets() / "dist" / "main.min.js.LICENSE.txt").read_text(encoding="utf-8")
    return (_assets() / "LICENSE").read_text(encoding="utf-8") + "\n" + bundled


def _assets() -> Path:
    return Path(meshcat.viewer_assets_path())
