"""Wind: profiles and gusts, the thrust of the rotor, drag on the tower."""

from offwind_pin.base.public_names import public_names

__getattr__, __dir__, __all__ = public_names(__name__, __file__)
