"""Structural dynamics of monopile offshore wind turbines.

>>> import offwind_pin as ow
>>> turbine = ow.load_turbine("oc6_phase2")
>>> system = ow.build(turbine, foundation="coupled_springs", sea=ow.StillWater())
>>> ow.modes(system, n=2).label
['SS1', 'FA1']

The analyses and what a short script needs are here; the rest is in ``ow.sea``, ``ow.soil``,
``ow.wind``, ``ow.signal``, ``ow.plots`` and ``ow.viewer``. Names are imported when first used.
"""

from offwind_pin.base.public_names import public_names

__version__ = "0.1.0"

__getattr__, __dir__, __all__ = public_names(__name__, __file__)
