"""Kinds of beam elements."""

from __future__ import annotations

from typing import Literal

Element = Literal["euler_bernoulli", "timoshenko"]
