"""Radiance below 0: in the files, and through pieces and passes."""

import unittest

import support
from exr import Exr
from png import Png
from support import CommandTest

# A light that takes away 1000 from all, and one that gives back a part on the right.
SCENE = support.SCENE.replace("<ambientlight><scaleradiance>0.5<", "<ambientlight><scaleradiance>-1000<").replace(
    'blue="0.4"', 'blue="-0.4"')


class Negative(CommandTest):
    def setUp(self):
        super().setUp()
        self.write("scene.xml", SCENE)

    def exr(self, name, *options):
        self.succeed("scene.xml", "-q", "--float", "-o", name, *options)
        return Exr(self.read(name))

    def test_exr_holds_it(self):
        picture = self.exr("a.exr", "-s", "16")
        self.assertEqual(picture.pixel(0, 0)[3], 1)
        self.assertAlmostEqual(picture.pixel(0, 0)[2], -0.4, delta=1e-7)
        floor = picture.pixel(40, 59)  # lit by both other lights, which add less than 1
        self.assertTrue(-400 <= floor[0] < -399, floor)
        done = self.succeed("scene.xml", "-o", "a.exr", "--progress", "none")  # in half, too
        self.assertEqual(done.stderr, "")
        self.assertAlmostEqual(Exr(self.read("a.exr")).pixel(40, 59)[0], floor[0], delta=0.5)

    def test_png_counts_the_pixels_that_it_makes_black(self):
        picture = self.exr("a.exr", "-o", "a.png")
        negative = sum(min(pixel[:3]) < 0 for pixel in picture.pixels().values())
        self.assertGreater(negative, 1000)
        self.assertEqual(Png(self.read("a.png")).pixel(40, 59), (0, 0, 0))
        self.assertGreater(Png(self.read("a.png")).pixel(0, 0)[1], 0)
        warning = f"a.png: {negative} pixels with radiance below 0, which became 0; EXR keeps it"
        self.assertIn(warning, self.succeed("scene.xml", "-o", "a.png").stderr)
        self.succeed("scene.xml", "-q", "-o", "t0.exr", "--tile", "0/2", "--float")
        self.succeed("scene.xml", "-q", "-o", "t1.exr", "--tile", "1/2", "--float")
        done = self.succeed("merge", "t0.exr", "t1.exr", "-o", "a.png", "-o", "b.exr")
        self.assertIn(warning, done.stderr)
        self.assertNotIn("b.exr", done.stderr)

    def test_transparent(self):
        """Coverage is none of its business; the colour that is left is the opaque one's without the background."""
        opaque = self.exr("a.exr", "-s", "16")
        transparent = self.exr("b.exr", "-s", "16", "--transparent", "-o", "b.png")
        png = Png(self.read("b.png"))
        for place, (red, _, blue, alpha) in transparent.pixels().items():
            wanted = opaque.pixel(*place)
            self.assertAlmostEqual(blue + (1 - alpha) * -0.4, wanted[2], delta=1e-4)
            self.assertAlmostEqual(red + (1 - alpha) * 0.1, wanted[0], delta=1e-4)
            self.assertEqual(tuple(png.pixel(*place)), (0, 0, 0, int(255 * alpha + 0.5)))

    def test_pieces(self):
        whole = self.exr("a.exr", "-s", "6")
        self.exr("t0.exr", "-s", "6", "--tile", "0/2")
        self.exr("t1a.exr", "-s", "1", "--tile", "1/2", "--sample-offset", "0")
        self.exr("t1b.exr", "-s", "5", "--tile", "1/2", "--sample-offset", "1")
        self.succeed("merge", "-q", "t1b.exr", "t0.exr", "t1a.exr", "-o", "m.exr")
        self.assertEqual(Exr(self.read("m.exr")).row_bytes, whole.row_bytes)
        crop = self.exr("c.exr", "-s", "6", "--crop", "10,20,50,60")
        self.assertEqual(crop.bytes_of(10, 20, 50, 60), whole.bytes_of(10, 20, 50, 60))

    def test_passes(self):
        whole = self.exr("a.exr", "-s", "40")
        self.assertEqual(self.exr("b.exr", "-s", "40", "--checkpoint", "c.ck").row_bytes, whole.row_bytes)

    def test_pixel_prints_it(self):
        picture = self.exr("a.exr", "-s", "16")
        mean = self.succeed("scene.xml", "--pixel", "40,59", "-s", "16").stdout.splitlines()[-1]
        for text, value in zip(mean.split()[1:], picture.pixel(40, 59)):
            self.assertAlmostEqual(float(text), value, delta=1e-3)


if __name__ == "__main__":
    unittest.main()
