"""Throw pots on a virtual wheel, export them as proved solids, check any mesh.

Lengths are in mm, volumes in mm3, densities in g/cm3. Arrays show the memory of the pot or mesh
without a copy and cannot be written to. Every failure is an `Error`.
"""

from __future__ import annotations

import os
import re
import warnings
from dataclasses import dataclass, field
from typing import Optional, Sequence, Union

import numpy as np

from . import _native
from ._arguments import KINDS as _KINDS, Path as _Path, checked as _checked
from ._arguments import instance_of as _instance_of

__version__: str = _native.version
__all__ = [
    "Check", "Error", "Export", "File", "Mesh", "Pot", "Problem", "check", "export",
    "import_pot", "mesh", "read_mesh", "read_pot", "stack", "throw",
]

_STATUS = {"unsound": 1, "bad_input": 2, "io": 3, "device": 4}
_QUANTUM_MM2 = 2.0**-36


class Error(Exception):
    """A failure: `message` as the command line prints it, `file` and `place` (a line, a facet, a
    field) if it names them, `kind` (unsound, bad_input, io, device) and `code`, the exit status of
    the command line."""

    def __init__(self, kind: str, message: str):
        super().__init__(kind, message)  # all arguments, so that a process can pass it to another
        self.kind = kind
        self.message = message
        self.code = _STATUS[kind]
        found = re.match(r"(.+?\.\w+):(?: |(?=\d+: ))(?:(\d+|facet \d+|[\w.\[\]]+): )?", message,
                         re.DOTALL)
        self.file: Optional[str] = found.group(1) if found else None
        self.place: Optional[str] = found.group(2) if found else None

    def __str__(self) -> str:
        return self.message


def _call(function, *arguments):
    try:
        return function(*arguments)
    except _native.Failure as failure:
        raise Error(*failure.args) from None


@dataclass(frozen=True, eq=False)
class Pot:
    """A stack of rings of one height, the lowest first. Equal pots give equal files."""

    ring_height_mm: float
    height_mm: float
    volume_mm3: float
    density_g_cm3: float
    collapsed: bool
    quanta: np.ndarray = field(repr=False)  #: R^2 and r^2 of each ring [2^-36 mm2], int64, no copy
    _native: _native.Pot = field(repr=False)

    def __eq__(self, other: object) -> bool:
        return self._native.equals(other._native) if isinstance(other, Pot) else NotImplemented

    def __hash__(self) -> int:
        return hash((self.ring_height_mm, self.height_mm, self.volume_mm3))

    @property
    def outer_mm(self) -> np.ndarray:
        """The outer radius of each ring."""
        return np.sqrt(self.quanta[:, 0] * _QUANTUM_MM2)

    @property
    def inner_mm(self) -> np.ndarray:
        """The inner radius of each ring; 0: it is solid."""
        return np.sqrt(self.quanta[:, 1] * _QUANTUM_MM2)

    @property
    def weight_g(self) -> float:
        """Of the wet clay."""
        return 1e-3 * self.volume_mm3 * self.density_g_cm3

    @_checked
    def write(self, path: _Path) -> None:
        """Writes a .pot.json or .pot.cbor."""
        _call(_native.write_pot, self._native, path)


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles of indices into points, counter-clockwise from outside; z is up in meshes of pots,
    as in the files."""

    points: np.ndarray = field(repr=False)  #: (n, 3) float64 [mm], no copy
    triangles: np.ndarray = field(repr=False)  #: (m, 3) uint32, no copy
    _native: _native.Mesh = field(repr=False)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Mesh):
            return NotImplemented
        return (np.array_equal(self.points, other.points)
                and np.array_equal(self.triangles, other.triangles))

    def __hash__(self) -> int:
        return hash((self.points.shape, self.triangles.shape))


_KINDS[Pot] = ("a Pot", _instance_of(Pot))
_KINDS[Union[Mesh, _Path]] = (
    "a Mesh or a path", lambda what: what if isinstance(what, Mesh) else os.fsencode(what))


@dataclass(frozen=True)
class Problem:
    """A fault of a mesh, a limit that failed, or a warning."""

    what: str  #: the fault ("open edge"), or the check ("walls", "process", "geometry", "contents")
    text: str  #: the message, as the command line prints it, with the place
    fails: bool = True  #: False: a warning


@dataclass(frozen=True)
class File:
    path: str
    bytes: int
    content_hash: str
    max_error_mm: float


@dataclass(frozen=True)
class Export:
    """What was written, and the measures of the solid."""

    triangles: int
    segments: int
    diameter_mm: float
    height_mm: float
    volume_mm3: float
    min_wall_mm: float
    files: tuple[File, ...]
    problems: tuple[Problem, ...]

    @property
    def passes(self) -> bool:
        """No limit failed. The solid itself is always sound: `export` writes no other."""
        return not any(problem.fails for problem in self.problems)


@dataclass(frozen=True)
class Check:
    """The verdict on a mesh."""

    passes: bool  #: the mesh is sound, and no limit failed
    sound: bool  #: the mesh alone
    closed: bool
    manifold: bool
    oriented: bool
    components: int
    cavities: int
    self_intersections: int
    triangles: int
    volume_mm3: Optional[float]  #: None: it has none, because it is not closed or oriented
    area_mm2: float
    size_mm: tuple[float, float, float]  #: width, depth and height, as x, y and z
    sampled_wall_mm: Optional[float]  #: the thinnest sample, not a bound; None: no walls were sampled
    problems: tuple[Problem, ...]


def _pot(native) -> Pot:
    return Pot(native.ring_height_mm, native.height_mm, native.volume_mm3, native.density_g_cm3,
               native.collapsed, native.quanta, native)


def _warn(messages, level: int) -> None:
    """As the command line does. A warning names the line that called the public function: `level`
    calls above this one, of which `_checked` is one."""
    for message in messages:
        warnings.warn(message, stacklevel=level)


def _made(native, messages) -> Pot:
    _warn(messages, 5)
    return _pot(native)


def _mesh(native) -> Mesh:
    return Mesh(native.points, native.triangles, native)


def _settings(**values):
    settings = _native.ExportSettings()
    for name, value in values.items():
        setattr(settings, name, value)
    return settings


@_checked
def throw(scene: _Path, session: Optional[_Path] = None) -> Pot:
    """Plays a session on a scene; by default the session beside it, as the command line does. What
    the command line warns of is a Python warning."""
    if session is None:
        ending = b".scene.json"
        named = scene[-len(ending):].lower() == ending
        session = (scene[: -len(ending)] if named else scene) + b".session"
    return _made(*_call(_native.throw_pot, scene, session))


@_checked
def stack(ring_height_mm: float, outer_mm: Sequence[float], inner_mm: Sequence[float],
          density_g_cm3: float = 1.9) -> Pot:
    """A pot of given rings, the lowest first; an inner radius of 0 is solid."""
    return _pot(_call(_native.stacked, ring_height_mm, outer_mm, inner_mm, density_g_cm3))


@_checked
def read_pot(path: _Path) -> Pot:
    """Reads a .pot.json, a .pot.cbor, or the pot inside a .3mf by Claystack."""
    return _pot(_call(_native.read_pot, path))


@_checked
def import_pot(path: _Path, *, height_mm: Optional[float] = None,
               wall_mm: Optional[float] = None) -> Pot:
    """Makes a pot of a drawing (SVG, DXF, CSV) or of a mesh of revolution. Warns of doubts, such as
    about the axis, and of parts that were left out.

    `height_mm` scales it to this height. `wall_mm` is the thickness of wall and floor, for a drawing
    that shows only the outside."""
    return _made(*_call(_native.import_pot, path, height_mm, wall_mm))


@_checked
def export(pot: Pot, files: Union[_Path, Sequence[_Path]], *, tolerance_mm: float = 0.02,
           smoothing: str = "fair", smooth_length_mm: Optional[float] = None,
           segments: Optional[int] = None, max_triangles: Optional[int] = None,
           min_wall_mm: Optional[float] = None, process: Optional[_Path] = None,
           shrinkage: float = 0.0, step: Optional[str] = None, glb: Optional[str] = None,
           material: Optional[str] = None, wall_map: bool = False,
           certificates: bool = False) -> Export:
    """Proves the pot and writes the file, or all files or none. The solids are those of `claystack export`.

    `smooth_length_mm`, for smoothing "fair": walls of continuous curvature; marks shorter than this
    are smoothed away. None: as the command line chooses it: the radius of the pot's tool, or half its
    height if that is less; 0 for a pot thrown without clay rules, and for a tolerance above 0.1 mm."""
    settings = _settings(
        tolerance_mm=tolerance_mm, smoothing=smoothing, smooth_length_mm=smooth_length_mm,
        segments=segments, max_triangles=max_triangles, min_wall_mm=min_wall_mm, process=process,
        shrinkage=shrinkage, step=step, glb=glb, material=material, wall_map=wall_map,
        certificates=certificates)
    report = _call(_native.export_pot, pot._native, files, settings)
    report["files"] = tuple(File(**one) for one in report["files"])
    report["problems"] = tuple(Problem(**one) for one in report["problems"])
    return Export(**report)


@_checked
def mesh(pot: Pot, *, tolerance_mm: float = 0.02, smoothing: str = "fair",
         smooth_length_mm: Optional[float] = None) -> Mesh:
    """The solid of a pot, as a binary STL holds it. `smooth_length_mm` as for `export`."""
    return _mesh(_call(_native.mesh_of, pot._native,
                       _settings(tolerance_mm=tolerance_mm, smoothing=smoothing,
                                 smooth_length_mm=smooth_length_mm)))


@_checked
def read_mesh(path: _Path) -> Mesh:
    """Reads STL, OBJ, DRC, PLY, OFF, 3MF or GLB. Warns of a size that suggests another unit than
    mm."""
    native, messages = _call(_native.read_mesh, path)
    _warn(messages, 4)
    return _mesh(native)


@_checked
def check(what: Union[Mesh, _Path], *, min_wall_mm: Optional[float] = None,
          process: Optional[_Path] = None) -> Check:
    """Checks whether a mesh, or the mesh in a file, is a printable solid within the limits. Warns as
    `read_mesh`."""
    if isinstance(what, Mesh):
        report = _call(_native.check_mesh, what._native, min_wall_mm, process)
    else:
        report, messages = _call(_native.check_file, what, min_wall_mm, process)
        _warn(messages, 4)
    report["problems"] = tuple(Problem(**one) for one in report["problems"])
    return Check(**report)
