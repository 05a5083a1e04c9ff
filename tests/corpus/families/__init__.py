"""Families of machine parts: functions of a Draw that return a shape, found by their names in FAMILIES."""

from .registry import FAMILIES, HARD
from . import blades, castings, drives, hard, plates, profiles, threads, turned  # noqa: F401  (they enter their families)

__all__ = ["FAMILIES", "HARD"]
