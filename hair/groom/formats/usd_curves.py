"""Writes the curves of a stage of Universal Scene Description to stdout, as usd_import.h says.

Every BasisCurves and NurbsCurves prim is read, in the stage's order, including instances, in world
space, +Y up, in the stage's unit. Prims that are invisible or whose purpose is "guide" are counted
and left out. Data without a place in USD is read under Unreal Engine's names, as primvars or as user
properties of the prims or of those above them (Blender's custom properties): groom_group_id or
groom_group_name, groom_guide and, if the curves have none themselves, groom_width, groom_color,
groom_root_uv. Numbers that are not finite are passed on, and so are curves of one vertex or none.
Linear curves are their points; others are sampled (usd_cubic.py, usd_nurbs.py). Animated curves are
taken at the default time, or else at their points' first sample; with --samples their points are
written at all times at which points, counts or transforms have samples. A stage that can't be read
ends the program with one line on stderr.
"""

import argparse
import collections
import os
import struct
import sys

try:
    import numpy as np
    from pxr import Ar, Sdf, Tf, Usd, UsdGeom

    from usd_prim import Prim, Refused
except ImportError as error:
    sys.exit(f"{error}: this Python lacks a package of requirements.txt")


# A stage may have as many prims, plus one for each 64 bytes of its files: 40,000 prims take 2 s, and
# a prim with points is longer than 64 bytes.
MOST_PRIMS = 20_000
# USD looks for inherited values in all prims around a prim, and in all prims that these are
# composed of.
MOST_NESTED = 128  # nested prims
MOST_COMPOSED = 256  # variants and prims that one prim refers to, directly or through others
MOST_SUBLAYERS = 256  # of a layer and its sublayers together, each as often as it is named
MOST_SAMPLES = 1 << 31  # bytes of points over time
MOST_UNFOLDED = 32 << 20  # bytes of points and triangles, plus 16 times the size of its files

HIDDEN_CURVES = (UsdGeom.Tokens.guide,)  # purposes; hair may be a proxy of nothing else

OUT_OF_MEMORY = "needs more memory than a file of its size may use"

# The prims that a spec composes to, their nesting, and the number of parts of a prim.
Weight = collections.namedtuple("Weight", "prims depth composed")


class Layers:
    """The layers of a stage, each checked before it is opened; `size` is that of all files in bytes.
    With links resolved, files must be in the folders `below`; without folders they may be anywhere."""

    def __init__(self, path, below):
        self.below = [folder.rstrip("/") + "/" for folder in below]
        self.size = 0
        self.weights = {}  # of specs, by layer and path
        self.layers = {}
        waiting = [os.path.abspath(path)]
        while waiting:
            name = waiting.pop()
            if name in self.layers:
                continue
            self._check(name)
            layer = Sdf.Layer.FindOrOpen(name)
            self.layers[name] = layer
            if not layer:
                continue
            for asset in list(layer.GetCompositionAssetDependencies()) + self._clips(layer):
                # The variables of an expression are known only when USD opens the layer.
                if Sdf.VariableExpression.IsExpression(asset):
                    raise Refused(f"{asset}: layer names given by expressions are not read")
                if asset:
                    waiting.append(Sdf.ComputeAssetPathRelativeToLayer(layer, asset))

    def _check(self, name):
        # A name may end with arguments of its format, which are no part of the file's.
        file = Ar.SplitPackageRelativePathOuter(Sdf.Layer.SplitIdentifier(name)[0])[0]
        real = os.path.realpath(file)
        if self.below and not any(real.startswith(folder) for folder in self.below):
            raise Refused(
                f"{file}: is outside the scene's folder; --allow-outside permits it"
            )
        if not os.path.exists(real):
            return  # USD reports it
        if not os.path.isfile(real):
            raise Refused(f"{file}: is not a file")
        self.size += os.path.getsize(real)

    @staticmethod
    def _clips(layer):
        """Returns the assets of value clips, which USD opens when values are read."""
        assets = []

        def visit(path):
            is_prim = path.IsPrimPath() or path.IsPrimVariantSelectionPath()
            prim = layer.GetPrimAtPath(path) if is_prim else None
            for clip in dict(prim.GetInfo("clips")).values() if prim and prim.HasInfo("clips") else ():
                try:
                    if "templateAssetPath" in clip:
                        raise Refused(f"{path}: value clips from a template are not read")
                    assets.append(clip.get("manifestAssetPath", Sdf.AssetPath()).path)
                    assets.extend(asset.path for asset in clip.get("assetPaths", ()))
                except (AttributeError, TypeError):
                    raise Refused(f"{path}: its value clips are not assets") from None

        layer.Traverse(Sdf.Path.absoluteRootPath, visit)
        return assets

    def check_sublayers(self):
        """Refuses layers that are sublayers of each other in too many ways: USD follows each way."""
        for name, layer in self.layers.items():
            count = 0
            waiting = [(layer, ())]
            while waiting:
                below, above = waiting.pop()
                if not below or below in above:  # USD refuses a layer within itself
                    continue
                count += 1
                if count > MOST_SUBLAYERS:
                    raise Refused(
                        f"{name}: more than {MOST_SUBLAYERS} sublayers, including those of sublayers"
                    )
                for path in below.subLayerPaths:
                    below_name = Sdf.ComputeAssetPathRelativeToLayer(below, path) if path else ""
                    waiting.append((self.layers.get(below_name), (*above, below)))

    def check_prims(self, path):
        """Refuses nested references that make too many prims for the size of the files."""
        root = self.layers[os.path.abspath(path)]
        try:
            count = sum(self._weigh(root, prim.path).prims for prim in root.rootPrims) if root else 0
        except RecursionError:
            raise Refused("prims and references are nested too deep") from None
        if count > MOST_PRIMS + self.size // 64:
            raise Refused(
                f"its references make {count:.3g} prims, more than {MOST_PRIMS} plus one for "
                "each 64 bytes"
            )

    def _weigh(self, layer, path):
        key = (layer.identifier, str(path))
        if key in self.weights:
            return self.weights[key]
        self.weights[key] = Weight(0, 0, 0)  # USD refuses a spec that refers to itself
        spec = layer.GetPrimAtPath(path)
        if not spec:
            return self.weights[key]
        children = [self._weigh(layer, child.path) for child in spec.nameChildren]
        variants = [
            [self._weigh(layer, variant.primSpec.path) for variant in variants.variants.values()]
            for variants in spec.variantSets
        ]
        targets = [self._weigh(*arc) for arc in self._arcs(layer, spec)]
        # variants lie at the prim's own place, not below it
        same = targets + [variant for each in variants for variant in each]
        weight = Weight(
            prims=1 + sum(each.prims for each in children + same),
            depth=1 + max([each.depth for each in children] + [each.depth - 1 for each in same], default=0),
            composed=1
            + sum(each.composed for each in targets)
            + sum(max((variant.composed for variant in each), default=0) for each in variants),
        )
        if weight.depth > MOST_NESTED:
            raise Refused(f"{path}: more than {MOST_NESTED} nested prims")
        if weight.composed > MOST_COMPOSED:
            raise Refused(
                f"{path}: is composed of {weight.composed} prims and variants, more than {MOST_COMPOSED}"
            )
        self.weights[key] = weight
        return weight

    def _arcs(self, layer, spec):
        """Yields the layer and path of each prim that the spec refers to."""
        for arcs in (spec.referenceList, spec.payloadList):
            for arc in arcs.GetAddedOrExplicitItems():
                target = layer
                if arc.assetPath:
                    name = Sdf.ComputeAssetPathRelativeToLayer(layer, arc.assetPath)
                    target = self.layers.get(name)
                if target:
                    yield target, arc.primPath or Sdf.Path.absoluteRootPath.AppendChild(target.defaultPrim or "_")
        for arcs in (spec.inheritPathList, spec.specializesList):
            for path in arcs.GetAddedOrExplicitItems():
                yield layer, path


class Unfolded:
    """Counts the bytes of all prims of a stage, with a bound by the size of its files."""

    def __init__(self, size):
        self.most = MOST_UNFOLDED + 16 * size
        self.bytes = 0

    def add(self, *arrays):
        self.bytes += sum(array.nbytes for array in arrays)
        if self.bytes > self.most:
            raise Refused(
                f"its instances expand to more than {self.most >> 20} MiB, the limit of 16 times its "
                f"files' size plus {MOST_UNFOLDED >> 20} MiB"
            )


def open_stage(path, below):
    """Returns the stage, and an Unfolded to count its points and triangles."""
    layers = Layers(path, below)
    layers.check_sublayers()
    layers.check_prims(path)
    return Usd.Stage.Open(path), Unfolded(layers.size)


class Xforms:
    """Caches transforms by time."""

    def __init__(self):
        self.caches = {}

    def at(self, time):
        # Transforms without a default value are then at their first sample.
        time = Usd.TimeCode.EarliestTime() if time.IsDefault() else time
        return self.caches.setdefault(time.GetValue(), UsdGeom.XformCache(time))


def metres_per_unit_of(stage):
    try:
        return UsdGeom.GetStageMetersPerUnit(stage)
    except Tf.ErrorException:  # the value is no double
        unit = stage.GetMetadata(UsdGeom.Tokens.metersPerUnit)
    if isinstance(unit, bool) or not isinstance(unit, (int, float)):
        raise Refused(f"metersPerUnit is not a number: {unit!r}")
    # Restores the decimal that was meant by a float: 0.01, not 0.009999999776.
    return float(str(np.float32(unit)))


def why_hidden(prim, purposes):
    """Returns why a prim isn't drawn: it is invisible or has one of these purposes. Returns nothing if
    it is drawn."""
    imageable = UsdGeom.Imageable(prim)
    if imageable.ComputeVisibility(Usd.TimeCode.EarliestTime()) == UsdGeom.Tokens.invisible:
        return "invisible prims"
    purpose = imageable.ComputePurpose()
    return f'prims of purpose "{purpose}"' if purpose in purposes else None


def hidden_text(hidden, one, many=None):
    """Returns "2 strands of invisible prims, 1 strand of ..." for a count of each reason."""
    return ", ".join(
        f"{count} {one if count == 1 else many or one + 's'} of {why}" for why, count in sorted(hidden.items())
    )


class Reader:
    """Reads a stage: `prims`, `metres_per_unit`, `stated`, `comment`, `warnings`."""

    def __init__(self, path, below):
        self.stage, unfolded = open_stage(path, below)
        errors = self.stage.GetCompositionErrors()
        self.warnings = [" ".join(str(error).split()) for error in errors]
        self.comment = self.stage.GetRootLayer().documentation
        self.prims = []
        self.hidden = collections.Counter()
        self.group_names = {}  # numbers of named groups
        xforms = Xforms()
        left_out = set()
        walk = iter(Usd.PrimRange.Stage(self.stage, Usd.TraverseInstanceProxies()))
        for prim in walk:
            if prim.IsA(UsdGeom.PointInstancer):
                self.warnings.append(f"{prim.GetPath()}: instances on points are left out")
                walk.PruneChildren()
            elif self._is_read(prim) and why_hidden(prim, HIDDEN_CURVES):
                self.hidden[why_hidden(prim, HIDDEN_CURVES)] += Prim.curve_count(prim)
            elif self._is_read(prim):
                self.prims.append(Prim(prim, xforms, self.group_names))
                unfolded.add(self.prims[-1].points)
                left_out |= self.prims[-1].left_out()
                self._warn_of_samples(prim)
            elif prim.IsA(UsdGeom.Curves):
                self.warnings.append(f"{prim.GetPath()}: its {prim.GetTypeName()} are left out")
        if not any(prim.sizes.size for prim in self.prims):
            hidden = f" that are shown, but {hidden_text(self.hidden, 'strand')}" if self.hidden else ""
            raise Refused("the stage has no BasisCurves or NurbsCurves with points" + hidden)
        if self.hidden:
            self.warnings.append(f"{hidden_text(self.hidden, 'strand')}: left out")
        if left_out:
            self.warnings.append(f"{', '.join(sorted(left_out))}: left out")
        # USD's defaults, cm and +Y up, are no statements: many programs leave out the unit of metres.
        states_unit = UsdGeom.StageHasAuthoredMetersPerUnit(self.stage)
        self.stated = states_unit | self.stage.HasAuthoredMetadata(UsdGeom.Tokens.upAxis) << 1
        self.metres_per_unit = metres_per_unit_of(self.stage) if states_unit else 1.0

    @staticmethod
    def _is_read(prim):
        return prim.IsA(UsdGeom.BasisCurves) or prim.IsA(UsdGeom.NurbsCurves)

    def _warn_of_samples(self, prim):
        count = UsdGeom.BasisCurves(prim).GetPointsAttr().GetNumTimeSamples()
        if count > 1:
            self.warnings.append(f"{prim.GetPath()}: one of its {count} time samples is read")

    def points(self):
        points = [prim.points for prim in self.prims]
        if UsdGeom.GetStageUpAxis(self.stage) == UsdGeom.Tokens.z:
            points = [p[:, [0, 2, 1]] * np.array([1, 1, -1], p.dtype) for p in points]
        return points

    def write_samples(self, stream):
        """Writes the unit, the points of each strand, times in seconds from the first, and the
        points at each: usd_import.cpp."""
        codes = sorted(set().union(*(prim.times() for prim in self.prims)))
        per_second = self.stage.GetTimeCodesPerSecond()
        if not (np.isfinite(codes).all() and np.isfinite(per_second) and per_second > 0):
            raise Refused("its times are not finite numbers")
        sizes = joined([prim.sizes for prim in self.prims], "<u4")
        count = int(sizes.sum(dtype=np.int64))
        if 12 * count * len(codes) > MOST_SAMPLES:
            raise Refused(f"{count} points at {len(codes)} times exceed 2 GiB")
        if not codes:
            codes = [Usd.TimeCode.EarliestTime().GetValue()]
        times = (np.array(codes) - codes[0]) / per_second
        stream.write(struct.pack("<dQ", self.metres_per_unit, len(sizes)))
        stream.write(sizes.tobytes())
        stream.write(struct.pack("<Q", len(times)) + times.astype("<f8").tobytes())
        stream.write(struct.pack("<Q", count * len(codes)))
        for code, time in zip(codes, times):
            xforms = Xforms()  # keeps no transform of other times
            for prim in self.prims:
                prim.go_to(Usd.TimeCode(code), time, xforms)
            stream.write(joined(self.points(), "<f4").tobytes())

    def part(self, name):
        """Returns a part for all prims, or nothing if none has it."""
        parts = [prim.parts[name] for prim in self.prims]
        if all(part is None for part in parts):
            return []
        if any(part is None for part in parts):
            # Guides are often prims of their own, and the other prims don't have the primvar.
            if name in ("root_uvs", "root_triangles"):
                self.warnings.append(f"{name}: left out, since some of the curves have none")
                return []
            parts = self._completed(name, parts)
        if name == "root_triangles":
            first = np.cumsum([0] + [prim.sizes.size for prim in self.prims])
            return [part + offset for part, offset in zip(parts, first)]
        if name in ("root_uvs", "groups", "guides"):
            return parts
        if all(np.array_equal(part, parts[0][:1], equal_nan=True) for part in parts):
            return parts[:1]
        return [
            np.repeat(part, prim.sizes.sum(), axis=0) if len(part) == 1 else part
            for part, prim in zip(parts, self.prims)
        ]

    def _completed(self, name, parts):
        """Fills a part of the prims that lack it: no guides, a group of their own, the mean width of
        the others, white, opaque."""
        known = [part for part in parts if part is not None]
        if name == "guides":
            return self._filled(parts, lambda prim: np.zeros(prim.sizes.size, np.uint8))
        lacking = [prim for part, prim in zip(parts, self.prims) if part is None]
        if name == "groups":
            group = min(max(int(part.max(initial=-1)) for part in known) + 1, np.iinfo(np.int32).max)
            strands = sum(prim.sizes.size for prim in lacking)
            self.warnings.append(f"{strands} strands have no group and become group {group}")
            return self._filled(parts, lambda prim: np.full(prim.sizes.size, group, np.int32))
        if name == "widths":
            sums = [
                (float(part.mean()) * prim.sizes.sum(), prim.sizes.sum())
                for part, prim in zip(parts, self.prims)
                if part is not None and part.size and np.isfinite(part).all()
            ]
            total = sum(count for _, count in sums)
            value = [sum(width for width, _ in sums) / total if total else 0.0]
            words = "width and get the mean width of the others"
        else:
            value = [1.0, 1.0, 1.0] if name == "colors" else [0.0]
            words = "colour and become white" if name == "colors" else "opacity and become opaque"
        points = sum(prim.sizes.sum() for prim in lacking)
        all_points = sum(prim.sizes.sum() for prim in self.prims)
        self.warnings.append(f"{points} of {all_points} points have no {words}")
        return self._filled(parts, lambda prim: np.array([value], np.float32))

    def _filled(self, parts, fill):
        return [fill(prim) if part is None else part for part, prim in zip(parts, self.prims)]


def read(path, below=()):
    """Returns a Reader. Raises Refused for every fault of the file."""
    try:
        return Reader(path, below)
    except (Tf.ErrorException, UnicodeDecodeError) as error:
        raise Refused(words_of(error, path)) from None


def words_of(error, path):
    try:
        words = " ".join(error.args[0].commentary.split())
    except (AttributeError, UnicodeDecodeError):  # USD's messages quote the file
        return "its texts are not UTF-8"
    return words.replace(os.path.realpath(path) + ":", "line ")


def joined(arrays, dtype):
    with np.errstate(all="ignore"):  # overflow becomes infinite, and such strands are left out
        arrays = [np.ascontiguousarray(array, dtype) for array in arrays]
    return np.concatenate(arrays) if arrays else np.empty(0, dtype)


def open_stream():
    """Returns the former stdout; prints of libraries go to stderr instead."""
    stream = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    return stream


def main():
    stream = open_stream()
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("stage", help=".usd, .usda, .usdc, .usdz")
    parser.add_argument("--below", action="append", default=[], help="a folder of files it may name")
    parser.add_argument("--samples", action="store_true", help="points over time")
    options = parser.parse_args()
    reader = read(options.stage, options.below)
    if options.samples:
        try:
            reader.write_samples(stream)
        except (Tf.ErrorException, UnicodeDecodeError) as error:
            raise Refused(words_of(error, options.stage)) from None
        stream.close()
        return
    arrays = [
        joined([prim.sizes for prim in reader.prims], "<u4"),
        joined(reader.points(), "<f4"),
        joined(reader.part("widths"), "<f4"),
        joined(reader.part("transparencies"), "<f4"),
        joined(reader.part("colors"), "<f4"),
        joined(reader.part("root_uvs"), "<f4"),
        joined(reader.part("root_triangles"), "<u4"),
        joined(reader.part("groups"), "<i4"),
        joined(reader.part("guides"), "u1"),
    ]
    texts = [reader.comment, "\n".join(reader.warnings)]
    texts = [np.frombuffer(text.encode(), np.uint8) for text in texts]
    sizes = [len(array) for array in arrays + texts]
    stream.write(struct.pack("<8sd12Q", b"HBCURVES", reader.metres_per_unit, *sizes, reader.stated))
    for array in arrays + texts:
        stream.write(memoryview(array).cast("B") if array.size else b"")
    stream.close()


if __name__ == "__main__":
    try:
        main()
    except Refused as refused:
        sys.exit(str(refused))
    except MemoryError:
        sys.exit(OUT_OF_MEMORY)
