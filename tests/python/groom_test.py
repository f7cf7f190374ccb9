"""Compares grooms as arrays with files of the corpus, which the tests read without hairbench."""

import struct
import tempfile
import unittest
import warnings
from pathlib import Path

import numpy

from support import REPOSITORY, hairbench

CORPUS = REPOSITORY / "tests" / "corpus"
BITS = numpy.uint32  # points are compared by their bits

# Formats with strands of any number of points, and formats with the same number for all.
ANY_LENGTH = (".hair", ".ply", ".obj", ".gltf", ".glb", ".usda", ".abc", ".data")
ONE_LENGTH = (".npy", ".npz", ".tfx", ".hgl")
WITH_WIDTHS = (".hair", ".ply", ".gltf", ".glb", ".usda", ".abc")


def numbers(count, seed):
    """Returns lengths as of hair that use all bits of their mantissas."""
    return numpy.random.default_rng(seed).uniform(-0.3, 0.3, count).astype(numpy.float32)


def quiet_write(path, groom):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        hairbench.write_groom(path, groom)


class GroomTest(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)

    def assert_bits(self, found, expected):
        self.assertEqual(found.dtype, numpy.float32)
        self.assertEqual(found.shape, expected.shape)
        self.assertTrue(numpy.array_equal(found.view(BITS), expected.view(BITS)))


class ReadGroom(GroomTest):
    def test_has_the_points_of_a_list_of_strands(self):
        # USC-HairSalon: int32 strand count, then for each strand int32 point count and float32 xyz.
        data = (CORPUS / "data" / "three_strands.data").read_bytes()
        place, points, offsets = 4, [], [0]
        for _ in range(struct.unpack_from("<i", data)[0]):
            count = struct.unpack_from("<i", data, place)[0]
            points.append(numpy.frombuffer(data, "<f4", 3 * count, place + 4).reshape(-1, 3))
            place += 4 + 12 * count
            offsets.append(offsets[-1] + count)
        self.assertEqual(place, len(data))
        groom = hairbench.read_groom(CORPUS / "data" / "three_strands.data")
        self.assert_bits(groom.points, numpy.concatenate(points))
        self.assertEqual(groom.offsets.tolist(), offsets)
        self.assertIsNone(groom.widths)
        self.assertEqual(len(groom), 3)
        self.assert_bits(groom.strand(1), points[1])

    def test_has_points_and_widths_of_hair(self):
        data = (CORPUS / "hair" / "all_arrays.hair").read_bytes()
        strands, count, arrays = struct.unpack_from("<III", data, 4)
        self.assertEqual(arrays & 7, 7)  # segments, points, thickness
        segments = numpy.frombuffer(data, "<u2", strands, 128)
        start = 128 + 2 * strands
        points = numpy.frombuffer(data, "<f4", 3 * count, start).reshape(-1, 3)
        widths = numpy.frombuffer(data, "<f4", count, start + 12 * count)
        groom = hairbench.read_groom(CORPUS / "hair" / "all_arrays.hair")
        self.assert_bits(groom.points, points)
        self.assert_bits(groom.widths, widths)
        self.assertEqual(numpy.diff(groom.offsets).tolist(), (segments + 1).tolist())

    def test_has_what_numpy_loads(self):
        path = CORPUS / "npz" / "groups_and_guides.npz"
        positions = numpy.load(path)["strands"]
        groom = hairbench.read_groom(path)
        self.assert_bits(
            groom.points, numpy.ascontiguousarray(positions.reshape(-1, 3), numpy.float32))
        self.assertEqual(set(numpy.diff(groom.offsets)), {positions.shape[1]})

    def test_gives_one_width_to_all_points(self):
        # The width may be only in the header: bytes 20 to 23.
        data = bytearray((CORPUS / "hair" / "points_only.hair").read_bytes())
        struct.pack_into("<f", data, 20, 0.5)
        path = self.folder / "one_width.hair"
        path.write_bytes(data)
        groom = hairbench.read_groom(path)
        self.assertEqual(groom.widths.tolist(), [0.5] * len(groom.points))

    def test_takes_options_of_the_converter(self):
        path = CORPUS / "data" / "three_strands.data"
        whole = hairbench.read_groom(path)
        groom = hairbench.read_groom(path, scale=2, vertices=5)
        self.assertEqual(groom.offsets.tolist(), [0, 5, 10, 15])
        self.assert_bits(groom.points[0], 2 * whole.points[0])

    def test_says_what_is_left_out(self):
        path = CORPUS / "npz" / "difflocks.npz"
        self.assertIn("root_normal", numpy.load(path).files)
        with self.assertWarnsRegex(UserWarning, "difflocks.npz: .*root_normal"):
            hairbench.read_groom(path)

    def test_says_where_a_file_is_wrong(self):
        path = self.folder / "short.hair"
        path.write_bytes((CORPUS / "hair" / "all_arrays.hair").read_bytes()[:200])
        with self.assertRaises(hairbench.ProgramError) as raised:
            hairbench.read_groom(path)
        self.assertRegex(str(raised.exception), "^/.*short.hair: byte 200: truncated")


class WriteGroom(GroomTest):
    def test_reads_back_to_the_bit(self):
        sizes = {False: [2, 5, 3, 9], True: [4, 4, 4, 4]}
        for extension in ANY_LENGTH + ONE_LENGTH:
            lengths = sizes[extension in ONE_LENGTH]
            groom = hairbench.Groom(
                numbers(3 * sum(lengths), 7).reshape(-1, 3), numpy.cumsum([0, *lengths]),
                abs(numbers(sum(lengths), 8)) if extension in WITH_WIDTHS else None)
            with self.subTest(extension):
                path = self.folder / f"groom{extension}"
                quiet_write(path, groom)
                back = hairbench.read_groom(path)
                self.assert_bits(back.points, groom.points)
                self.assertEqual(back.offsets.tolist(), groom.offsets.tolist())
                if groom.widths is not None:
                    self.assert_bits(back.widths, groom.widths)

    def test_writes_what_others_read(self):
        groom = hairbench.Groom(numbers(36, 1).reshape(-1, 3), [0, 4, 8, 12], abs(numbers(12, 2)))
        with warnings.catch_warnings():
            warnings.simplefilter("error")  # no warning: nothing is lost
            hairbench.write_groom(self.folder / "groom.npz", groom)
        archive = numpy.load(self.folder / "groom.npz")
        self.assert_bits(archive["positions"], groom.points.reshape(3, 4, 3))
        self.assert_bits(archive["widths"], groom.widths.reshape(3, 4))

    def test_says_what_the_format_can_not_hold(self):
        groom = hairbench.Groom(numbers(12, 3).reshape(-1, 3), [0, 4], abs(numbers(4, 4)))
        with self.assertWarnsRegex(UserWarning, "groom.obj: the widths are left out"):
            hairbench.write_groom(self.folder / "groom.obj", groom)

    def test_refuses_formats_that_nobody_knows(self):
        groom = hairbench.Groom(numbers(12, 3).reshape(-1, 3), [0, 4])
        with self.assertRaises(hairbench.ProgramError) as raised:
            hairbench.write_groom(self.folder / "groom.xyz", groom)
        self.assertIn("groom.xyz", str(raised.exception))
        self.assertFalse((self.folder / "groom.xyz").exists())


class GroomArrays(unittest.TestCase):
    def test_are_refused_where_they_do_not_fit(self):
        points = numpy.zeros((4, 3))
        for arguments, reason in (
                ((points[:, :2], [0, 4]), r"points: the shape \(4, 2\)"),
                ((points + numpy.nan, [0, 4]), "points: a number is not finite"),
                ((points, [0]), "offsets: one for each strand"),
                ((points, [0.0, 4.0]), "offsets: they are not integers"),
                ((points, [0, 3]), "offsets: they go from 0 to 3, not from 0 to 4"),
                ((points, [0, 2, 2, 4]), "offsets: a strand has no point"),
                ((points, [0, 4], numpy.zeros(3)), r"widths: the shape \(3,\)"),
                ((points, [0, 4], [1, 1, 1, -1]), "widths: one is negative")):
            with self.assertRaisesRegex(ValueError, reason):
                hairbench.Groom(*arguments)

    def test_know_their_strands(self):
        groom = hairbench.Groom(numpy.arange(12).reshape(4, 3), [0, 1, 4])
        self.assertEqual(len(groom), 2)
        self.assertEqual(groom.strand(1).tolist(), [[3, 4, 5], [6, 7, 8], [9, 10, 11]])
        with self.assertRaises(IndexError):
            groom.strand(2)


if __name__ == "__main__":
    unittest.main()
