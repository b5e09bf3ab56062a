"""Pinocchio model, read from the URDF text."""

from __future__ import annotations

import threading

import numpy as np
import pinocchio as pin

from offwind_pin.base.errors import InputError
from offwind_pin.definitions.turbine import Turbine
from offwind_pin.structure.chain import Chain
from offwind_pin.structure.urdf import urdf_text


def build_model(turbine: Turbine, chain: Chain) -> pin.Model:
    """Pinocchio model of the chain, gravity along -z.

    The joints keep the chain's order, and each has one degree of freedom, so that configuration
    and velocity vectors are plain numbers in that order.
    """
    model = pin.buildModelFromXML(urdf_text(turbine, chain))
    names = tuple(model.names)[1:]
    if names != chain.joint_name or model.nq != len(names):
        raise RuntimeError(f"Pinocchio read the joints {names[:4]}..., not those of the chain")
    model.gravity.linear = np.array([0.0, 0.0, -turbine.site.gravity])
    return model


MOST_JOINTS = 700
"""Pinocchio's scratch data contains tensors of nv^3 numbers: 11 GB for this many joints."""


class Scratch:
    """Pinocchio's scratch data for one model, one per thread, created on first use.

    It is large and slow to create (it contains tensors of nv^3 numbers), so it is kept.
    """

    def __init__(self, model: pin.Model) -> None:
        self._model = model
        self._local = threading.local()

    @property
    def data(self) -> pin.Data:
        if self._model.nv > MOST_JOINTS:
            raise InputError(
                "elements",
                f"{self._model.nv} joints",
                f"at most {MOST_JOINTS} joints with Pinocchio",
                "Use fewer elements, or the compiled engine.",
            )
        if not hasattr(self._local, "data"):
            self._local.data = self._model.createData()
        return self._local.data
