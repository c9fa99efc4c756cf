"""Transparent pictures, whose alpha is coverage, and exposure: in the files, and through merging and checkpoints."""

import re
import unittest

import support
from exr import Exr
from png import Png
from support import CommandTest

BACKGROUND = (0.1, 0.2, 0.4)  # of support.SCENE


def srgb(linear, exposure=0, steps=255):
    linear = min(1, max(0, linear * 2**exposure))
    return (12.92 * linear if linear <= 0.0031308 else 1.055 * linear**(1 / 2.4) - 0.055) * steps


class Alpha(CommandTest):
    def setUp(self):
        super().setUp()
        # The sphere alone, with an edge of pixels that are covered in part.
        scene = re.sub("<planes>.*</planes>", "", support.SCENE)
        self.write("scene.xml", scene.replace("<samples>4<", "<samples>16<"))

    def exr(self, name, *options):
        self.succeed("scene.xml", "-q", "--float", "-o", name, *options)
        return Exr(self.read(name))

    def test_over_the_background_it_is_the_opaque_picture(self):
        opaque, transparent = self.exr("a.exr"), self.exr("b.exr", "--transparent")
        self.assertEqual(transparent.channels, opaque.channels)
        self.assertEqual({pixel[3] for pixel in opaque.pixels().values()}, {1})
        alphas = {pixel[3] for pixel in transparent.pixels().values()}
        self.assertLessEqual({0, 1}, alphas)
        self.assertGreater(len(alphas), 5)
        for place, (*color, alpha) in transparent.pixels().items():
            if alpha == 0:
                self.assertEqual(color, [0, 0, 0])
            for part, wanted, behind in zip(color, opaque.pixel(*place), BACKGROUND):
                self.assertAlmostEqual(part + (1 - alpha) * behind, wanted, delta=1e-6)

    def test_aovs_are_those_of_the_opaque_picture(self):
        opaque, transparent = self.exr("a.exr", "--aov", "all"), self.exr("b.exr", "--aov", "all", "--transparent")
        for y, row in opaque.rows.items():
            for name in set(row) - set("RGBA"):
                self.assertEqual(transparent.rows[y][name], row[name], name)

    def test_png_is_straight(self):
        for bits in (8, 16):
            with self.subTest(bits):
                picture = self.exr("a.exr", "--transparent", "-o", "a.png", "--bit-depth", str(bits), "--exposure=-0.5")
                self.check_straight(picture, Png(self.read("a.png")), bits, -0.5)

    def check_straight(self, linear, png, bits, exposure):
        self.assertEqual((png.channels, png.bits), (4, bits))
        steps = 2**bits - 1
        for (x, y), (*color, alpha) in linear.pixels().items():
            stored = png.pixel(x, y)
            self.assertAlmostEqual(stored[3], alpha * steps, delta=0.501)
            for part, value in zip(color, stored):
                wanted = srgb(part / alpha, exposure, steps) if alpha else 0
                self.assertAlmostEqual(value, wanted, delta=0.501 if bits == 8 else 0.55)

    def test_pixel_prints_what_a_picture_holds(self):
        for options in ([], ["--transparent"]):
            picture = self.exr("a.exr", *options)
            x, y = next(place for place, pixel in self.exr("b.exr", "--transparent").pixels().items()
                        if 0 < pixel[3] < 1)
            mean = self.succeed("scene.xml", "--pixel", f"{x},{y}", *options).stdout.splitlines()[-1]
            for text, value in zip(mean.split()[1:], picture.pixel(x, y)):
                self.assertAlmostEqual(float(text), value, delta=1e-6)

    def test_pieces_of_a_transparent_picture(self):
        whole = self.exr("whole.exr", "--transparent", "-o", "whole.png")
        self.exr("one.exr", "--transparent", "--tile", "0/2")
        self.exr("two0.exr", "--transparent", "--tile", "1/2", "-s", "5", "--sample-offset", "0")
        self.exr("two5.exr", "--transparent", "--tile", "1/2", "-s", "11", "--sample-offset", "5")
        self.succeed("merge", "-q", "two5.exr", "one.exr", "two0.exr", "-o", "merged.exr", "-o", "merged.png", "-o",
                     "exposed.png", "--exposure", "-0.5")
        merged = Exr(self.read("merged.exr"))
        self.assertEqual(merged.row_bytes, whole.row_bytes)
        self.assertEqual(merged.attributes["raytrace:transparent"], whole.attributes["raytrace:transparent"])
        self.check_straight(whole, Png(self.read("merged.png")), 8, -0.5)
        self.succeed("merge", "-q", "two5.exr", "one.exr", "two0.exr", "-o", "merged.png")
        self.assertEqual(Png(self.read("merged.png")).rows, Png(self.read("whole.png")).rows)
        # What is missing covers nothing, and adds nothing.
        self.succeed("merge", "-q", "one.exr", "-o", "part.exr", "-o", "part.png", "--partial")
        part, linear, there = Png(self.read("part.png")), Exr(self.read("part.exr")), Exr(self.read("one.exr")).pixels()
        for (x, y), pixel in whole.pixels().items():
            self.assertEqual(part.pixel(x, y)[3] > 0, (x, y) in there and pixel[3] > 0)
            if (x, y) not in there:
                self.assertEqual(linear.pixel(x, y), (0, 0, 0, 0))

    def test_beyond_the_picture(self):
        whole = self.exr("a.exr", "--transparent")
        crop = "--crop=-20,-10,100,70"
        wide = self.exr("b.exr", "--transparent", crop)
        self.assertEqual(wide.bytes_of(0, 0, 80, 60), whole.bytes_of(0, 0, 80, 60))
        self.assertEqual(wide.pixel(-20, -10), (0, 0, 0, 0))
        self.assertEqual(self.exr("c.exr", crop).pixel(-20, -10)[3], 1)
        for i in range(3):
            self.exr(f"t{i}.exr", "--transparent", crop, "--tile", f"{i}/3")
        self.succeed("merge", "-q", "t0.exr", "t1.exr", "t2.exr", "-o", "m.exr")
        self.assertEqual(Exr(self.read("m.exr")).row_bytes, wide.row_bytes)

    def test_passes_of_a_render_with_a_checkpoint(self):
        whole = self.exr("a.exr", "--transparent", "-s", "40")
        passes = self.exr("b.exr", "--transparent", "-s", "40", "--checkpoint", "c.ck")
        self.assertEqual(passes.row_bytes, whole.row_bytes)

    def test_pieces_and_checkpoints_of_the_other_kind_are_refused(self):
        self.exr("a.exr", "--tile", "0/2")
        self.exr("b.exr", "--tile", "1/2", "--transparent")
        for pieces, got, wanted in ((["a.exr", "b.exr"], "transparent", "opaque"),
                                    (["b.exr", "a.exr"], "opaque", "transparent")):
            message = self.fail_with(1, "merge", *pieces, "-o", "c.exr")
            self.assertIn(f"it differs in the background ({got}, not {wanted})", message)
        # A piece with its sums is as good as a checkpoint to read from, up to where they are compared.
        message = self.fail_with(1, "scene.xml", "-q", "--tile", "0/2", "--transparent", "-o", "c.exr", "--checkpoint",
                                 "a.exr", "--resume")
        self.assertIn("cannot resume from a.exr: it differs in the background (opaque, not transparent)", message)

    def test_a_missing_part_of_an_opaque_picture_has_alpha_0(self):
        self.exr("a.exr", "--tile", "0/2")
        self.succeed("merge", "-q", "a.exr", "-o", "b.exr", "-o", "b.png", "--partial")
        self.assertEqual({pixel[3] for pixel in Exr(self.read("b.exr")).pixels().values()}, {0, 1})
        self.assertEqual(Png(self.read("b.png")).channels, 3)


class Exposure(CommandTest):
    def test_of_encoded_files_alone(self):
        self.succeed("scene.xml", "-q", "--float", "-o", "a.exr", "-o", "a.png")
        for exposure in (-1.5, 2):
            with self.subTest(exposure):
                self.succeed("scene.xml", "-q", "--float", "-o", "b.exr", "-o", "b.png", "--exposure", str(exposure))
                linear = Exr(self.read("a.exr"))
                self.assertEqual(Exr(self.read("b.exr")).row_bytes, linear.row_bytes)
                encoded = Png(self.read("b.png"))
                self.assertEqual(float(encoded.text["raytrace:exposure"]), exposure)
                for (x, y), (*color, _) in linear.pixels().items():
                    for part, value in zip(color, encoded.pixel(x, y)):
                        self.assertAlmostEqual(value, srgb(part, exposure), delta=0.501)
                self.succeed("merge", "-q", "a.exr", "-o", "c.png", f"--exposure={exposure}")
                merged = Png(self.read("c.png"))
                self.assertEqual(merged.rows, encoded.rows)
                self.assertEqual(float(merged.text["raytrace:exposure"]), exposure)
        self.assertNotIn("raytrace:exposure", Png(self.read("a.png")).text)

    def test_of_merged_floats(self):
        """Whether a TIFF gets floats is known from the pieces alone."""
        self.succeed("scene.xml", "-q", "-o", "a.exr", "--float")
        message = self.fail_with(1, "merge", "a.exr", "-o", "b.tif", "--exposure", "1")
        self.assertIn("--exposure: all outputs hold linear colour", message)
        self.assertEqual(self.names(), ["a.exr", "scene.xml"])


if __name__ == "__main__":
    unittest.main()
