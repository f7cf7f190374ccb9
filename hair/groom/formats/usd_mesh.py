"""Writes the meshes of a stage of Universal Scene Description to stdout, as mesh_stream.h says.

Every Mesh prim that is rendered (neither invisible nor of purpose proxy or guide) is read, in the
stage's order, including instances, in world space, +Y up, in metres or, if the stage states no
unit, as it is: its control mesh, without subdivision. Other meshes are counted. At rest, points are
at the default time, or else at their first sample. With --samples, the times at which anything
moves are written instead, in seconds from the first, and the vertices' positions at each. Points
with samples (point caches), transforms, and skeletons and blend shapes, which UsdSkel bakes into
points, can move. A stage that can't be read ends the program with one line on stderr.
"""

import argparse
import collections
import struct
import sys

try:
    import numpy as np
    from pxr import Gf, Tf, Usd, UsdGeom, UsdShade, UsdSkel

    from usd_curves import OUT_OF_MEMORY, Xforms, joined, metres_per_unit_of, open_stage, open_stream
    from usd_curves import hidden_text, why_hidden, words_of
    from usd_prim import Refused
except ImportError as error:
    sys.exit(f"{error}: this Python lacks a package of requirements.txt")

MOST = 1 << 31  # bytes of positions over time
HIDDEN_MESHES = (UsdGeom.Tokens.proxy, UsdGeom.Tokens.guide)  # purposes


def encoded(linear):
    """Returns linear RGB encoded as sRGB (IEC 61966-2-1)."""
    linear = np.clip(linear, 0, 1)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


class Mesh:
    """One prim. Vertices are its points; a point has several if texture coordinates differ. Has
    `points` [vertex], `triangles` [triangle][3] and `uvs` [vertex] or None."""

    def __init__(self, prim, xforms):
        self.prim = prim
        self.mesh = UsdGeom.Mesh(prim)
        self.time = Usd.TimeCode.Default()
        attribute = self.mesh.GetPointsAttr()
        if attribute.Get(self.time) is None and attribute.GetNumTimeSamples():
            self.time = Usd.TimeCode(attribute.GetTimeSamples()[0])
        positions = attribute.Get(self.time)
        self.count = 0 if positions is None else len(positions)
        counts, corners = self._topology()
        faces = np.repeat(np.arange(counts.size), counts)
        uvs = self._uvs(corners)
        if uvs is None:
            self.points, vertices, self.uvs = np.arange(self.count), corners, None
        else:
            keys = np.column_stack((corners, uvs.view(np.int32)))
            keys, vertices = np.unique(keys, axis=0, return_inverse=True)
            self.points = keys[:, 0]
            self.uvs = np.ascontiguousarray(keys[:, 1:].astype(np.int32)).view(np.float32)
            vertices = vertices.reshape(-1)
        # A fan round each face's first corner.
        first = np.repeat(np.cumsum(counts) - counts, counts)
        number = np.arange(corners.size) - first
        fan = np.flatnonzero((number > 0) & (number < np.repeat(counts, counts) - 1))
        self.triangles = vertices[np.column_stack((first[fan], fan, fan + 1))]
        self.faces = faces[fan]  # [triangle]
        orientation = self.mesh.GetOrientationAttr().Get(self.time)
        world = np.array(xforms.at(self.time).GetLocalToWorldTransform(prim))
        if (orientation == UsdGeom.Tokens.leftHanded) != (np.linalg.det(world[:3, :3]) < 0):
            self.triangles = self.triangles[:, ::-1]
        self.positions = self.at(self.time, xforms)

    def refuse(self, reason):
        raise Refused(f"{self.prim.GetPath()}: {reason}")

    def _topology(self):
        values = []
        for attribute in (self.mesh.GetFaceVertexCountsAttr(), self.mesh.GetFaceVertexIndicesAttr()):
            value = attribute.Get(self.time)
            if value is None:
                value = attribute.Get(Usd.TimeCode.EarliestTime())
            if attribute.GetNumTimeSamples() > 1:
                self.refuse(f"{attribute.GetName()} changes over time")
            values.append(np.array([] if value is None else value, np.int64))
        counts, corners = values
        if (counts < 3).any():
            self.refuse(f"face {np.argmax(counts < 3)} has {counts[counts < 3][0]} corners")
        if counts.sum() != corners.size:
            self.refuse(f"{corners.size} corners of faces, but {counts.sum()} are needed")
        wrong = np.flatnonzero((corners < 0) | (corners >= self.count))
        if wrong.size:
            self.refuse(f"corner {wrong[0]} is point {corners[wrong[0]]} of {self.count}")
        return counts, corners

    def _uvs(self, corners):
        """Returns the texture coordinates of each corner of each face, v down, or None."""
        primvar = UsdGeom.PrimvarsAPI(self.mesh).FindPrimvarWithInheritance("st")
        values = primvar.ComputeFlattened(self.time) if primvar else None
        if values is None:
            return None
        interpolation = primvar.GetInterpolation()
        values = np.atleast_2d(np.array(values, np.float32))
        needed = {"vertex": self.count, "varying": self.count, "faceVarying": corners.size}
        if values.shape != (needed.get(interpolation), 2) or not np.isfinite(values).all():
            self.refuse(f"primvars:st: {len(values)} values that are {interpolation}")
        if interpolation != "faceVarying":
            values = values[corners]
        return np.ascontiguousarray(values * np.float32([1, -1]) + np.float32([0, 1]))

    def at(self, time, xforms):
        """Returns the vertices' positions in world space, in the stage's axes and unit."""
        points = self.mesh.GetPointsAttr().Get(time)
        points = np.zeros((0, 3)) if points is None else np.array(points, np.float64)
        if points.shape != (self.count, 3):
            self.refuse(f"{len(points)} points at time code {time}, but {self.count} at rest")
        wrong = np.flatnonzero(~np.isfinite(points).all(1))
        if wrong.size:
            self.refuse(f"point {wrong[0]} is not finite")
        world = np.array(xforms.at(time).GetLocalToWorldTransform(self.prim))
        return (points @ world[:3, :3] + world[3, :3])[self.points]

    def normals(self):
        """Sums the triangles' normals, weighted by area, at each point, so that no seam shows."""
        a, b, c = (self.positions[self.triangles[:, i]] for i in range(3))
        sums = np.zeros((self.count, 3))
        for i in range(3):
            np.add.at(sums, self.points[self.triangles[:, i]], np.cross(b - a, c - a))
        return sums[self.points]

    def times(self):
        times = set(self.mesh.GetPointsAttr().GetTimeSamples())
        prim = self.prim
        while prim and not prim.IsPseudoRoot():
            if prim.IsA(UsdGeom.Xformable):
                times |= set(UsdGeom.Xformable(prim).GetTimeSamples())
            prim = prim.GetParent()
        return times

    def materials(self):
        """Returns names, and the index of the name for each triangle. Names are those of the bound
        material, otherwise the mesh, and of GeomSubsets of faces."""
        bound = UsdShade.MaterialBindingAPI(self.prim).ComputeBoundMaterial()[0]
        names = [bound.GetPrim().GetName() if bound else self.prim.GetName()]
        face_count = len(self.mesh.GetFaceVertexCountsAttr().Get(self.time) or [])
        numbers = np.zeros(face_count, np.uint32)
        for subset in UsdGeom.Subset.GetAllGeomSubsets(self.mesh):
            indices = np.array(subset.GetIndicesAttr().Get(self.time) or [], np.int64)
            if subset.GetElementTypeAttr().Get() != UsdGeom.Tokens.face:
                continue
            if (indices < 0).any() or (indices >= face_count).any():
                self.refuse(f"{subset.GetPrim().GetName()}: a face that the mesh lacks")
            numbers[indices] = len(names)
            names.append(subset.GetPrim().GetName())
        return names, numbers[self.faces]

    def color(self):
        values = self.mesh.GetDisplayColorAttr().Get(self.time)
        if values is None or len(values) != 1 or not np.isfinite(values).all():
            return np.full(3, 0.8)
        return encoded(np.array(values[0], np.float64))


class Reader:
    """Reads a stage: its `meshes`, the unit and axis that take positions to metres, +Y up (as they are
    if no unit is stated), whether it states both, and `warnings`."""

    def __init__(self, path, below, samples):
        self.stage, unfolded = open_stage(path, below)
        if samples:
            self._bake()
        xforms = Xforms()
        self.meshes = []
        hidden = collections.Counter()
        for prim in Usd.PrimRange.Stage(self.stage, Usd.TraverseInstanceProxies()):
            if not prim.IsA(UsdGeom.Mesh):
                continue
            why = why_hidden(prim, HIDDEN_MESHES)
            if why:
                hidden[why] += 1
                continue
            self.meshes.append(Mesh(prim, xforms))
            unfolded.add(self.meshes[-1].positions, self.meshes[-1].triangles)
        text = hidden_text(hidden, "mesh", "meshes")
        if not sum(len(mesh.triangles) for mesh in self.meshes):
            raise Refused("the stage has no Mesh with faces" + (f" that is shown, but {text}" if text else ""))
        self.warnings = [f"{text}: left out"] if text else []
        # USD's defaults, cm and +Y up, are no statements.
        states_unit = UsdGeom.StageHasAuthoredMetersPerUnit(self.stage)
        self.unit = metres_per_unit_of(self.stage) if states_unit else 1.0
        self.is_placed = states_unit and self.stage.HasAuthoredMetadata(UsdGeom.Tokens.upAxis)
        self.is_z_up = UsdGeom.GetStageUpAxis(self.stage) == UsdGeom.Tokens.z

    def _bake(self):
        self.stage.SetEditTarget(self.stage.GetSessionLayer())
        for prim in self.stage.Traverse():
            if prim.IsA(UsdSkel.Root):
                UsdSkel.BakeSkinning(UsdSkel.Root(prim), Gf.Interval.GetFullInterval())

    def metres(self, positions):
        positions = np.concatenate(positions)
        if self.is_z_up:
            positions = positions[:, [0, 2, 1]] * [1, 1, -1]
        positions = positions * self.unit
        if (np.abs(positions) > np.finfo(np.float32).max).any():
            raise Refused("in world space a point exceeds a float's range")
        return positions.astype("<f4")

    def write_mesh(self, stream):
        first = np.cumsum([0] + [len(mesh.points) for mesh in self.meshes])
        normals = np.concatenate([mesh.normals() for mesh in self.meshes])
        if self.is_z_up:
            normals = normals[:, [0, 2, 1]] * [1, 1, -1]
        array(stream, self.metres([mesh.positions for mesh in self.meshes]))
        array(stream, normals.astype("<f4"))
        uvs = [mesh.uvs for mesh in self.meshes]
        if all(part is None for part in uvs):
            uvs = []
        uvs = [
            np.zeros((len(mesh.points), 2)) if part is None else part
            for part, mesh in zip(uvs, self.meshes)
        ]
        array(stream, joined(uvs, "<f4"))
        array(stream, joined([m.triangles + f for m, f in zip(self.meshes, first)], "<u4"))
        names, colors, numbers = [], [], []
        for mesh in self.meshes:
            own, triangles = mesh.materials()
            numbers.append(triangles + len(names))
            names += own
            colors += [mesh.color()] * len(own)
        array(stream, joined(numbers, "<u4"))
        array(stream, joined([np.full(len(m.triangles), i) for i, m in enumerate(self.meshes)], "<u4"))
        count(stream, len(self.meshes))
        for mesh in self.meshes:
            text(stream, mesh.prim.GetName())
        count(stream, 0)  # vertex groups
        count(stream, len(names))
        for name, color in zip(names, colors):
            text(stream, name)
            stream.write(struct.pack("<3f", *color))
        stream.write(bytes([self.is_placed]))
        count(stream, len(self.warnings))
        for warning in self.warnings:
            text(stream, warning)
        count(stream, len(names))
        for _ in names:
            text(stream, "")  # no textures

    def write_samples(self, stream):
        codes = sorted(set().union(*(mesh.times() for mesh in self.meshes)))
        vertices = sum(len(mesh.points) for mesh in self.meshes)
        if 12 * vertices * len(codes) > MOST:
            raise Refused(f"{vertices} vertices at {len(codes)} times exceed 2 GiB")
        per_second = self.stage.GetTimeCodesPerSecond()
        if not (np.isfinite(codes).all() and np.isfinite(per_second) and per_second > 0):
            raise Refused("its times are not finite numbers")
        array(stream, (np.array(codes) - (codes[0] if codes else 0)) / per_second)
        count(stream, vertices * len(codes))
        for code in codes:
            xforms = Xforms()  # keeps no transform of other times
            time = Usd.TimeCode(code)
            stream.write(self.metres([mesh.at(time, xforms) for mesh in self.meshes]).tobytes())


def count(stream, number):
    stream.write(struct.pack("<Q", number))


def array(stream, values):
    count(stream, len(values))
    stream.write(np.ascontiguousarray(values).tobytes())


def text(stream, words):
    array(stream, np.frombuffer(words.encode(), np.uint8))


def main():
    stream = open_stream()
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--samples", action="store_true", help="positions over time")
    parser.add_argument("stage", help=".usd, .usda, .usdc, .usdz")
    parser.add_argument("--below", action="append", default=[], help="a folder of files it may name")
    options = parser.parse_args()
    try:
        reader = Reader(options.stage, options.below, options.samples)
        (reader.write_samples if options.samples else reader.write_mesh)(stream)
    except (Tf.ErrorException, UnicodeDecodeError) as error:
        raise Refused(words_of(error, options.stage)) from None
    stream.close()


if __name__ == "__main__":
    try:
        main()
    except Refused as refused:
        sys.exit(str(refused))
    except MemoryError:
        sys.exit(OUT_OF_MEMORY)
