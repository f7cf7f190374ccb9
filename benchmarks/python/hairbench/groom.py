"""Files of hair as numpy arrays, by way of `hairbench groom convert`.

Exchanges data with the program as Cem Yuksel's HAIR for reading, a header of 128 bytes and arrays
(cemyuksel.com/research/hairmodels), and as PLY for writing. Both hold strands of any length and
exact widths, and PLY does not invent colours.
"""

from __future__ import annotations

import os
import struct
import tempfile
import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .program import option_arguments, succeed

if TYPE_CHECKING:
    import numpy
    from typing_extensions import Unpack

    from .keywords import ConvertOptions

HEADER = struct.Struct("<4sIIII5f88s")
SEGMENTS, THICKNESS = 1, 4  # bits for the arrays in the file


@dataclass(frozen=True)
class Groom:
    """Strands one after another, root first, in the file's unit.

    points   float32 [n, 3]
    offsets  int64 [strands + 1]: strand i is points[offsets[i]:offsets[i + 1]]
    widths   float32 [n], diameters; None if unknown

    Converts other types of numbers. Raises ValueError if the arrays do not fit together.
    """

    points: numpy.ndarray[Any, Any]
    offsets: numpy.ndarray[Any, Any]
    widths: numpy.ndarray[Any, Any] | None = None

    def __post_init__(self) -> None:
        import numpy

        points = numpy.ascontiguousarray(self.points, numpy.float32)
        if points.ndim != 2 or points.shape[1] != 3:
            raise ValueError(f"points: the shape {points.shape} is not (n, 3)")
        if not numpy.isfinite(points).all():
            raise ValueError("points: a number is not finite")
        if not numpy.issubdtype(numpy.asarray(self.offsets).dtype, numpy.integer):
            raise ValueError("offsets: they are not integers")
        offsets = numpy.ascontiguousarray(self.offsets, numpy.int64)
        if offsets.ndim != 1 or len(offsets) < 2:
            raise ValueError("offsets: one for each strand and one more are needed")
        if offsets[0] != 0 or offsets[-1] != len(points):
            raise ValueError(
                f"offsets: they go from {offsets[0]} to {offsets[-1]}, not from 0 to {len(points)}")
        if (numpy.diff(offsets) < 1).any():
            raise ValueError("offsets: a strand has no point")
        object.__setattr__(self, "points", points)
        object.__setattr__(self, "offsets", offsets)
        if self.widths is None:
            return
        widths = numpy.ascontiguousarray(self.widths, numpy.float32)
        if widths.shape != (len(points),):
            raise ValueError(f"widths: the shape {widths.shape} is not ({len(points)},)")
        if not (numpy.isfinite(widths) & (widths >= 0)).all():
            raise ValueError("widths: one is negative or not finite")
        object.__setattr__(self, "widths", widths)

    def __len__(self) -> int:
        return len(self.offsets) - 1

    def strand(self, index: int) -> numpy.ndarray[Any, Any]:
        """Returns the points of a strand, float32 [its points, 3], as a view."""
        if not 0 <= index < len(self):
            raise IndexError(f"strand {index} of {len(self)}")
        return self.points[self.offsets[index]:self.offsets[index + 1]]


def groom_of_hair(data: bytes) -> Groom:
    """Reads a HAIR file from `groom convert`, with exactly the parts that it writes."""
    import numpy

    _, strands, count, arrays, segments, thickness, *_ = HEADER.unpack_from(data)
    place = HEADER.size

    def take(dtype: str, length: int) -> numpy.ndarray[Any, Any]:
        nonlocal place
        array = numpy.frombuffer(data, dtype, length, place)
        place += array.nbytes
        return array

    sizes = numpy.full(strands, segments, numpy.int64)
    if arrays & SEGMENTS:
        sizes = take("<u2", strands).astype(numpy.int64)
    offsets = numpy.concatenate([[0], numpy.cumsum(sizes + 1)])
    points = take("<f4", 3 * count).astype(numpy.float32).reshape(-1, 3)
    widths = None
    if arrays & THICKNESS:
        widths = take("<f4", count).astype(numpy.float32)
    elif thickness > 0:
        widths = numpy.full(count, thickness, numpy.float32)
    return Groom(points, offsets, widths)


def ply_of_groom(groom: Groom) -> bytes:
    import numpy

    columns = [groom.points]
    properties = ["x", "y", "z"]
    if groom.widths is not None:
        columns.append(groom.widths[:, None])
        properties.append("width")
    header = [
        "ply", "format binary_little_endian 1.0", f"element vertex {len(groom.points)}",
        *(f"property float {name}" for name in properties), f"element strand {len(groom)}",
        "property list uint uint vertex_indices", "end_header", ""]
    # Each list is its length, then the indices of a strand's points.
    lists = numpy.insert(
        numpy.arange(len(groom.points)), groom.offsets[:-1], numpy.diff(groom.offsets))
    vertices = numpy.hstack(columns).astype("<f4")
    return "\n".join(header).encode() + vertices.tobytes() + lists.astype("<u4").tobytes()


def convert(source: Path, target: Path, options: Mapping[str, object]) -> list[tuple[str, str]]:
    """Returns the program's warnings as pairs of file and text."""
    arguments = ["groom", "convert", str(source), str(target), *option_arguments(options)]
    finished = succeed(arguments, None)
    found = []
    for line in finished.errors:
        for path in (str(source), str(target)):
            if line.startswith(f"hairbench: {path}: "):
                found.append((path, line.removeprefix(f"hairbench: {path}: ")))
    return found


def read_groom(path: str | os.PathLike[str], **options: Unpack[ConvertOptions]) -> Groom:
    """Reads any format of docs/grooms.md. Warns about data in the file that is not read.

    options  as in `hairbench groom convert --help`, with _ for -: scale=0.01, guides=200,
             points_per_strand=100

    Raises ProgramError "path: place: reason" if the file is not in its format.
    """
    source = Path(path)
    with tempfile.TemporaryDirectory(prefix="hairbench-") as folder:
        between = Path(folder) / "groom.hair"
        for of, warning in convert(source, between, options):
            # A Groom lacks everything that HAIR cannot hold, so warnings about that are dropped.
            if of == str(source):
                warnings.warn(f"{source}: {warning}", stacklevel=2)
        return groom_of_hair(between.read_bytes())


def write_groom(path: str | os.PathLike[str], groom: Groom, **options: Unpack[ConvertOptions]) -> None:
    """Writes any format of docs/grooms.md that the program can write, by the extension of `path`.

    Warns about data that the format cannot hold. Points are in the format's unit: metres for .hgl.
    The file is replaced once everything is written. `options` are as for read_groom().
    """
    target = Path(path)
    with tempfile.TemporaryDirectory(prefix="hairbench-") as folder:
        between = Path(folder) / "groom.ply"
        between.write_bytes(ply_of_groom(groom))
        for _, warning in convert(between, target, options):
            warnings.warn(f"{target}: {warning}", stacklevel=2)
