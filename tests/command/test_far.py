"""Scenes far from the origin, and equal distances, as the files show them."""

import struct

import support
from exr import Exr
from support import CommandTest

FAR = 10_000_000


def moved(scene, distance):
    """The scene with its camera, light and sphere moved along x and z."""
    for element in ("eye", "lookat", "location", "center"):
        head, tail = scene.split(f"<{element} ", 1)
        attributes, rest = tail.split("/>", 1)
        values = dict(item.split("=") for item in attributes.split())
        number = {name: float(value.strip('"')) for name, value in values.items()}
        scene = (f'{head}<{element} x="{number["x"] + distance!r}" y="{number["y"]!r}" '
                 f'z="{number["z"] + distance!r}"/>{rest}')
    return scene


class Far(CommandTest):
    def pixels(self, name, scene, *options):
        self.write("scene.xml", scene)
        self.succeed("scene.xml", "-q", "--float", "--aov", "depth,position", "-o", name, *options)
        return Exr(self.read(name))

    def test_a_moved_scene_is_the_same_picture_and_its_files_know_where_it_is(self):
        near = self.pixels("near.exr", support.SCENE)
        far = self.pixels("far.exr", moved(support.SCENE, FAR))
        different = 0
        for y, row in near.rows.items():
            for channel, tolerance in (("R", 1e-3), ("G", 1e-3), ("B", 1e-3), ("Z", 1e-3)):
                different += sum(abs(a - b) > tolerance * max(1, abs(a))
                                 for a, b in zip(row[channel], far.rows[y][channel]))
            for channel, offset in (("P.X", FAR), ("P.Y", 0), ("P.Z", FAR)):
                # A float is that precise there; and where nothing is hit, there is no position.
                different += sum(depth < 1e20 and abs(a + offset - b) > (1 if offset else 1e-3)
                                 for a, b, depth in zip(row[channel], far.rows[y][channel], row["Z"]))
        self.assertLess(different, 40)
        matrix = struct.unpack("<16f", far.attributes["worldToCamera"][1])
        before = struct.unpack("<16f", near.attributes["worldToCamera"][1])
        self.assertEqual(matrix[:12], before[:12])
        self.assertAlmostEqual(matrix[12], before[12] - FAR, delta=2)

    def test_what_is_moved_does_not_move_between_pieces(self):
        scene = moved(support.SCENE, FAR)
        whole = self.pixels("whole.exr", scene)
        for i in range(3):
            self.succeed("scene.xml", "-q", "--float", "--aov", "depth,position", "--tile", f"{i}/3", "-o", f"{i}.exr")
        self.succeed("merge", "-q", "-o", "merged.exr", "0.exr", "1.exr", "2.exr")
        self.assertEqual(Exr(self.read("merged.exr")).row_bytes, whole.row_bytes)


DISKS = "".join(
    f'<disk><center x="{x}" y="0.5" z="0"/><normal x="0" y="1" z="0"/><radius>1.5</radius>'
    f"<material>{material}</material></disk>"
    for x, material in zip((-2, -1.5, -1, -0.5, 0, 0.5, 1, 1.5), ("floor", "shiny") * 4))


class Ties(CommandTest):
    def test_equal_distances_have_one_winner_in_every_way(self):
        self.write("scene.xml", support.SCENE.replace("</objects>", f"<disks>{DISKS}</disks></objects>"))

        def picture(name, *options):
            self.succeed("scene.xml", "-q", "--float", "-s", "8", "-o", name, *options)
            return [[row[channel] for channel in "RGB"] for row in Exr(self.read(name)).row_bytes.values()]

        plain = picture("plain.exr")
        self.assertEqual(picture("threads.exr", "-t", "3"), plain)
        self.assertEqual(picture("aovs.exr", "--aov", "object_id"), plain)
        self.assertEqual(picture("checkpoint.exr", "--checkpoint", "x.checkpoint"), plain)
        self.assertEqual(picture("limit.exr", "--time-limit", "10000"), plain)
        for i, (first, count) in enumerate(((0, 3), (3, 4), (7, 1))):
            picture(f"{i}.exr", "--sample-offset", str(first), "-s", str(count))
        self.succeed("merge", "-q", "-o", "merged.exr", "0.exr", "1.exr", "2.exr")
        self.assertEqual([[row[channel] for channel in "RGB"] for row in Exr(self.read("merged.exr")).row_bytes.values()],
                         plain)
