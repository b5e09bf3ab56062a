"""Engines that evaluate the equations of motion."""

from __future__ import annotations

from typing import Literal

Engine = Literal["compiled", "pinocchio"]
