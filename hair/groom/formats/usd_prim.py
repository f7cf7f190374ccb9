"""The curves of one UsdGeomBasisCurves or UsdGeomNurbsCurves, as points of strands."""

import numpy as np
from pxr import Usd, UsdGeom

from usd_cubic import CubicCurves, starts
from usd_nurbs import NurbsCurves


# User properties in which Blender keeps the names of its own objects and data.
NAMES_OF_BLENDER = ("blender:", "blenderName:")


class Refused(Exception):
    """The reason why a file can't be read."""


class LinearCurves:
    """Curves of which each point is a vertex, with the interface of CubicCurves."""

    def __init__(self, sizes):
        self.sizes = sizes

    def point_counts(self):
        return self.sizes

    ends = point_counts

    def vertex(self, values):
        return values

    varying = vertex


def rows(values, dtype, components):
    """Returns a row for each value. `components`: columns of the result if there are no values."""
    values = np.atleast_1d(np.asarray(values, dtype))  # a constant may be a scalar
    return values.reshape(len(values), -1 if len(values) else components)


class Prim:
    """One prim's curves: `sizes` (points of each), `points`, and `parts` by name. A part has one
    row, or one for each point. Exceptions: root_uvs, groups and guides have one for each curve,
    root_triangles any number."""

    @staticmethod
    def curve_count(prim):
        """Returns the number of curves of a prim that is not read."""
        counts = UsdGeom.Curves(prim).GetCurveVertexCountsAttr().Get(Usd.TimeCode.EarliestTime())
        return len(counts or [])

    def __init__(self, prim, xforms, group_names):
        self.path = prim.GetPath()
        self.root_uv_name = None  # name of the primvar with the root UVs
        self.has_groom_width = False
        self.has_group_names = False
        kind = UsdGeom.NurbsCurves if prim.IsA(UsdGeom.NurbsCurves) else UsdGeom.BasisCurves
        self.curves = kind(prim)
        self.time = Usd.TimeCode.Default()
        points = self.curves.GetPointsAttr()
        if points.Get(self.time) is None and points.GetNumTimeSamples():
            self.time = Usd.TimeCode(points.GetTimeSamples()[0])
        self.topology = self._topology()
        self.sizes = self.topology.point_counts()
        world = np.array(xforms.at(self.time).GetLocalToWorldTransform(prim))
        self.points = self._points(world)
        # The factor of lengths; for a scale that differs by direction, the geometric mean.
        scale = np.cbrt(abs(np.linalg.det(world[:3, :3])))
        self.parts = {
            "widths": self._widths(1.0 if abs(scale - 1) < 1e-9 else scale),
            "colors": self._colors(),
            "transparencies": self._transparencies(),
            "root_uvs": self._root_uvs(),
            "groups": self._groups(group_names),
            "guides": self._guides(),
            "root_triangles": self._root_triangles(),
        }

    def refuse(self, reason):
        raise Refused(f"{self.path}: {reason}")

    def times(self):
        """Returns the time codes at which the points or their places have samples."""
        curves = self.curves
        times = set(curves.GetPointsAttr().GetTimeSamples())
        times |= set(curves.GetCurveVertexCountsAttr().GetTimeSamples())
        for prim in self._and_above():
            if prim.IsA(UsdGeom.Xformable):
                times |= set(UsdGeom.Xformable(prim).GetTimeSamples())
        return times

    def go_to(self, code, seconds, xforms):
        """Takes the points at a time code, that many seconds after the first."""
        self.time = code
        topology = self._topology()
        sizes = topology.point_counts()
        if not np.array_equal(sizes, self.sizes):
            same = sizes.size == self.sizes.size
            what = "points" if same else "curves"
            before, now = (self.sizes.sum(), sizes.sum()) if same else (self.sizes.size, sizes.size)
            self.refuse(
                f"at time code {code.GetValue():g} ({seconds:g} s) it has {now} {what}, but {before} "
                "at first: strands that appear, vanish or change their number of points don't play"
            )
        self.topology = topology
        self.points = self._points(np.array(xforms.at(code).GetLocalToWorldTransform(self.curves.GetPrim())))

    def _value(self, attribute):
        value = attribute.Get(self.time)
        return attribute.Get(Usd.TimeCode.EarliestTime()) if value is None else value

    def _topology(self):
        sizes = self._value(self.curves.GetCurveVertexCountsAttr())
        sizes = np.array([] if sizes is None else sizes, np.int64)
        if (sizes < 0).any():
            self.refuse(f"curve {np.argmax(sizes < 0)} has {sizes[sizes < 0][0]} vertices")
        if isinstance(self.curves, UsdGeom.NurbsCurves):
            return self._nurbs(sizes)
        wrap = self._value(self.curves.GetWrapAttr())
        if wrap not in ("nonperiodic", "pinned"):
            self.refuse(f"its curves are {wrap}: only curves with two ends are strands")
        kind = self._value(self.curves.GetTypeAttr())
        if kind == "linear":
            return LinearCurves(sizes)
        if kind != "cubic":
            self.refuse(f"unknown type '{kind}'; known: linear, cubic")
        try:
            return CubicCurves(self._value(self.curves.GetBasisAttr()), wrap, sizes)
        except ValueError as error:
            self.refuse(error)

    def _nurbs(self, sizes):
        def of(attribute):
            value = self._value(attribute)
            return [] if value is None else value

        curves = self.curves
        try:
            return NurbsCurves(
                sizes,
                of(curves.GetOrderAttr()),
                of(curves.GetKnotsAttr()),
                of(curves.GetRangesAttr()),
                of(curves.GetPointWeightsAttr()),
            )
        except ValueError as error:
            self.refuse(error)

    def _checked(self, name, values, count, components):
        values = rows(values, np.float32, components)
        if values.shape != (count, components):
            found = " x ".join(map(str, values.shape))
            self.refuse(f"{name}: {found} numbers, but {count} x {components} are needed")
        return values

    def _points(self, world):
        points = self._value(self.curves.GetPointsAttr())
        points = self._checked(
            "points", [] if points is None else points, self.topology.sizes.sum(), 3
        )
        with np.errstate(all="ignore"):  # of numbers that are not finite
            points = self.topology.vertex(points)
            if (world != np.eye(4)).any():
                points = points.astype(np.float64) @ world[:3, :3] + world[3, :3]
        return points

    def _per_point(self, name, components):
        primvar = UsdGeom.PrimvarsAPI(self.curves).FindPrimvarWithInheritance(name)
        interpolation = primvar.GetInterpolation() if primvar else ""
        values = primvar.ComputeFlattened(self.time) if primvar else None
        if values is None and primvar:
            values = primvar.ComputeFlattened(Usd.TimeCode.EarliestTime())
        if values is None and name == "widths":
            interpolation = self.curves.GetWidthsInterpolation()
            values = self._value(self.curves.GetWidthsAttr())
        if values is None:
            return None
        self.controls = np.atleast_1d(values)
        topology = self.topology
        name += f" ({interpolation})"
        if interpolation == "constant":
            return self._checked(name, values, 1, components)
        if len(np.atleast_1d(values)) == 1 and topology.sizes.sum() > 1:
            # USD's interpolation, if none is stated, is "vertex"; one value for all is meant.
            return self._checked(name, values, 1, components)
        if interpolation == "uniform":
            values = self._checked(name, values, topology.sizes.size, components)
            return np.repeat(values, self.sizes, axis=0)
        if interpolation == "vertex":
            return topology.vertex(self._checked(name, values, topology.sizes.sum(), components))
        ends = topology.ends().sum()
        if len(np.atleast_1d(values)) == topology.sizes.sum() != ends:
            # Exporters write one for each vertex where "varying" has one for each segment's end.
            return topology.vertex(self._checked(name, values, topology.sizes.sum(), components))
        return topology.varying(self._checked(name, values, ends, components))

    def _widths(self, scale):
        widths = self._per_point("widths", 1)
        if widths is None:
            widths = self._per_point("groom_width", 1)
            self.has_groom_width = widths is not None
        if widths is None:
            return None
        # Between control vertices with widths that are not negative, a curve may be below all of them.
        if not isinstance(self.topology, LinearCurves) and not (self.controls < 0).any():
            widths = np.maximum(widths, 0)  # NaN stays
        return widths if scale == 1 else (widths * scale).astype(np.float32)

    def _transparencies(self):
        opacities = self._per_point("displayOpacity", 1)
        if opacities is None:
            return None
        return np.float32(1) - np.clip(opacities, 0, 1).astype(np.float32)

    def _colors(self):
        colors = self._per_point("displayColor", 3)
        return self._per_point("groom_color", 3) if colors is None else colors

    def _root_uvs(self):
        for name in ("st", "groom_root_uv"):
            primvar = UsdGeom.PrimvarsAPI(self.curves).GetPrimvar(name)
            values = primvar.ComputeFlattened(self.time) if primvar else None
            if values is None:
                continue
            roots = self._at_roots(np.atleast_2d(values), primvar.GetInterpolation())
            if roots is not None:
                self.root_uv_name = name
                return self._checked("primvars:" + name, roots, self.sizes.size, 2)
        return None

    def _at_roots(self, values, interpolation):
        """Returns the values at the curves' first vertices; nothing if there are none for curves."""
        if interpolation == "uniform":
            return values
        if interpolation not in ("vertex", "varying"):
            return None
        topology = self.topology
        for sizes in (topology.sizes, topology.ends()):
            if len(values) == sizes.sum():
                # A curve without vertices gets the first value of another; it is left out anyway.
                values = values if len(values) else np.zeros((1, 2))
                return values[np.minimum(starts(sizes), len(values) - 1)]
        self.refuse(
            f"{len(values)} texture coordinates ({interpolation}), but there are "
            f"{topology.sizes.sum()} vertices"
        )

    def _and_above(self):
        """Yields the prim, its parent, and so on."""
        prim = self.curves.GetPrim()
        while prim and not prim.IsPseudoRoot():
            yield prim
            prim = prim.GetParent()

    def _user(self, name):
        """Returns a user property of the prim or of the nearest prim above that has it."""
        for prim in self._and_above():
            attribute = prim.GetAttribute("userProperties:" + name)
            if attribute and attribute.HasAuthoredValue():
                return self._value(attribute)
        return None

    def _named(self, name):
        """Returns a primvar's values and whether there is one for each curve, or a user property's."""
        primvar = UsdGeom.PrimvarsAPI(self.curves).FindPrimvarWithInheritance(name)
        values = primvar.ComputeFlattened(self.time) if primvar else None
        if values is not None:
            return np.atleast_1d(values), primvar.GetInterpolation() == "uniform"
        values = self._user(name)
        if values is None:
            return None, False
        values = np.atleast_1d(values)
        return values, len(values) != 1

    def _groups(self, group_names):
        groups = self._per_strand("groom_group_id")
        names, is_uniform = self._named("groom_group_name")
        if groups is not None or names is None:
            return groups
        count = self.sizes.size if is_uniform else 1
        if names.shape != (count,):
            self.refuse(f"groom_group_name: {names.size} names, but {count} are needed")
        numbers = [group_names.setdefault(str(name), len(group_names)) for name in names]
        self.has_group_names = True
        return np.broadcast_to(np.array(numbers, np.int32), (self.sizes.size,))

    def _per_strand(self, name):
        """Returns integers, one for each curve or one for all. They may come from a parent prim."""
        values, is_uniform = self._named(name)
        if values is None:
            return None
        if values.dtype.kind not in "iub":
            self.refuse(f"{name}: integers are needed")
        count = self.sizes.size if is_uniform else 1
        if values.shape != (count,):
            self.refuse(f"{name}: {values.size} numbers, but {count} are needed")
        values = values.astype(np.int64)
        if (np.abs(values) > np.iinfo(np.int32).max).any():
            self.refuse(f"{name}: a number is not an int32")
        return np.broadcast_to(values.astype(np.int32), (self.sizes.size,))

    def _guides(self):
        guides = self._per_strand("groom_guide")
        return None if guides is None else (guides != 0).astype(np.uint8)

    def _root_triangles(self):
        attribute = self.curves.GetPrim().GetAttribute("hairbench:rootTriangles")
        values = self._value(attribute) if attribute else None
        if values is None:
            return None
        values = rows(values, np.int64, 3)
        if values.shape[1] != 3 or (values < 0).any() or (values >= self.sizes.size).any():
            self.refuse("hairbench:rootTriangles: each needs three of the prim's own strands")
        return values

    def left_out(self):
        """Returns the names of the prim's other data, which is not read."""
        known = {"displayColor", "displayOpacity", "widths", "groom_group_id", "groom_guide"}
        if self.parts["root_uvs"] is not None:
            known.add(self.root_uv_name)
        if self.has_groom_width:
            known.add("groom_width")
        if self.has_group_names:
            known.add("groom_group_name")
        if "displayColor" not in self._primvar_names():
            known.add("groom_color")
        names = {"primvars:" + name for name in self._primvar_names() - known}
        known -= {"displayColor", "displayOpacity", "widths"}
        for prim in self._and_above():
            for attribute in prim.GetAuthoredPropertiesInNamespace("userProperties"):
                name = attribute.GetName().removeprefix("userProperties:")
                if name not in known and not name.startswith(NAMES_OF_BLENDER):
                    names.add(attribute.GetName())
        for name in ("normals", "velocities", "accelerations"):
            if self.curves.GetPrim().GetAttribute(name).HasAuthoredValue():
                names.add(name)
        return names

    def _primvar_names(self):
        primvars = UsdGeom.PrimvarsAPI(self.curves).GetPrimvarsWithAuthoredValues()
        return {primvar.GetPrimvarName() for primvar in primvars}
