"""What is rendered, and into which files."""

import os
import struct
import unittest

import support
from exr import Exr
from png import Png
from support import CommandTest


class Pictures(CommandTest):
    def render(self, *options, name="a.exr", scene="scene.xml", **keywords):
        self.succeed(scene, "-q", "-o", name, *options, **keywords)
        return Exr(self.read(name))

    def test_whole_picture(self):
        picture = self.render()
        self.assertEqual(picture.data_window, (0, 0, 79, 59))
        self.assertEqual(picture.display_window, (0, 0, 79, 59))
        self.assertEqual(picture.channels, {"A": "e", "B": "e", "G": "e", "R": "e"})
        sky, floor = picture.pixel(0, 0), picture.pixel(40, 59)
        self.assertEqual((sky[3], floor[3]), (1, 1))
        for value, wanted in zip(sky, (0.1, 0.2, 0.4)):
            self.assertAlmostEqual(value, wanted, delta=1e-3)
        red, green, _, alpha = picture.pixel(40, 25)
        self.assertGreater(red, 2 * green)  # the sphere
        self.assertEqual(alpha, 1)

    def test_several_files_from_one_render(self):
        self.succeed("scene.xml", "-q", "-o", "a.exr", "-o", "b.png", "--output", "c.tif", "--output=d.jpg")
        self.assertEqual(self.names(), ["a.exr", "b.png", "c.tif", "d.jpg", "scene.xml"])

    def test_only_other_formats_than_exr_and_png_load_openimageio(self):
        # Its 250 libraries take longer than a small render.
        for name, loaded in (("a.exr", False), ("a.png", False), ("a.jpg", True)):
            told = self.succeed("scene.xml", "-q", "-o", name, env={**os.environ, "LD_DEBUG": "files"}).stderr
            self.assertIn("libOpenEXR", told)  # the loader does tell
            self.assertEqual("libOpenImageIO" in told, loaded, name)

    def test_png_is_the_srgb_curve_of_the_exr(self):
        for bits in (8, 16):
            self.succeed("scene.xml", "-q", "--float", "--bit-depth", str(bits), "-o", "a.exr", "-o", "a.png")
            linear, encoded = Exr(self.read("a.exr")), Png(self.read("a.png"))
            self.assertEqual((encoded.width, encoded.height, encoded.bits), (80, 60, bits))
            steps = 2**bits - 1
            worst = 0
            for y in range(60):
                for x in range(80):
                    for channel in range(3):
                        v = min(1, max(0, linear.pixel(x, y)[channel]))
                        srgb = 12.92 * v if v <= 0.0031308 else 1.055 * v**(1 / 2.4) - 0.055
                        worst = max(worst, abs(encoded.rows[y][3 * x + channel] - srgb * steps))
            self.assertLess(worst, 0.501 if bits == 8 else 0.52)

    def test_float_holds_what_half_rounds(self):
        half = self.render().pixels()
        full = self.render("--float")
        self.assertEqual(full.channels["R"], "f")
        for place, values in full.pixels().items():
            for a, b in zip(values, half[place]):
                self.assertEqual(struct.unpack("<e", struct.pack("<e", a))[0], b)

    def test_scene_from_standard_input(self):
        picture = self.render(scene="-", input=support.SCENE)
        self.assertEqual(picture.pixels(), self.render(name="b.exr").pixels())
        done = self.run_program("-", "-o", "c.exr", input="<raytracer>")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"<stdin>:\d+:\d+: error: ")

    def test_resolution_keeps_the_framing(self):
        picture = self.render("-r", "160x120")
        self.assertEqual(picture.display_window, (0, 0, 159, 119))
        scaled = self.render("--scale", "2")
        self.assertEqual(scaled.pixels(), picture.pixels())
        half = self.render("-r", "160x120", "--scale", "0.5")
        self.assertEqual(half.pixels(), self.render().pixels())
        # The sphere's top is a quarter down in all of them.
        small, picture = self.render("--transparent"), self.render("--transparent", "-r", "160x120")
        self.assertEqual([small.pixel(40, y)[3] for y in (5, 50)], [picture.pixel(80, y)[3] for y in (10, 100)])

    def test_scale_rounds_and_never_gets_to_nothing(self):
        self.assertEqual(self.render("--scale", "0.001").display_window, (0, 0, 0, 0))
        self.assertEqual(self.render("--scale", "0.13").display_window, (0, 0, 9, 7))

    def test_samples(self):
        self.assertEqual(self.render("-s", "4").pixels(), self.render().pixels())
        one = self.render("-s", "1", "--transparent").pixels()
        self.assertEqual({values[3] for values in one.values()}, {0, 1})
        one = self.render("-s", "1").pixels()
        self.assertEqual(self.render("--spp=1", "--seed", "5").pixels(), one)  # the pixel's centre, always

    def test_seed(self):
        first = self.render().pixels()
        self.assertEqual(self.render("--seed", "0").pixels(), first)
        other = self.render("--seed", "18446744073709551615").pixels()
        self.assertNotEqual(other, first)
        self.assertEqual(self.render("--seed", "18446744073709551615").pixels(), other)

    def test_crop_is_the_whole_pictures_part(self):
        whole = self.render().pixels()
        for crop in ["0,0,80,60", "13,7,54,41", "79,59,80,60", "32,20,33,21"]:
            part = self.render("--crop", crop)
            x0, y0, x1, y1 = map(int, crop.split(","))
            self.assertEqual(part.data_window, (x0, y0, x1 - 1, y1 - 1))
            self.assertEqual(part.display_window, (0, 0, 79, 59))
            for place, values in part.pixels().items():
                self.assertEqual(values, whole[place], (crop, place))

    def test_pixels_beyond_the_picture(self):
        whole = self.render()
        for crop in ("-80,-60,160,120", "-13,-9,83,60", "-5,20,30,61", "3,-7,79,59"):
            left, top, right, bottom = map(int, crop.split(","))
            part = self.render("--crop", crop)
            self.assertEqual(part.data_window, (left, top, right - 1, bottom - 1))
            self.assertEqual(part.display_window, (0, 0, 79, 59))
            inside = max(left, 0), max(top, 0), min(right, 80), min(bottom, 60)
            self.assertEqual(part.bytes_of(*inside), whole.bytes_of(*inside))
            self.assertEqual(self.render("--crop=" + crop).row_bytes, part.row_bytes)
        # The larger picture with the same pixels on the view plane.
        wide = support.SCENE.replace("<hres>80", "<hres>120").replace("<vres>60", "<vres>100")
        self.write("wide.xml", wide)
        centered = ["-s", "1"]  # samples are placed by the pixel's coordinates
        larger = self.render(*centered, scene="wide.xml")
        over = self.render("--crop", "-20,-20,100,80", *centered)
        self.assertEqual({(x + 20, y + 20): pixel for (x, y), pixel in over.pixels().items()}, larger.pixels())
        for samples in ("2", "4", "8", "16"):  # packets of several shapes
            larger = self.render("-s", samples, scene="wide.xml").pixels()
            over = self.render("--crop", "-20,-20,100,80", "-s", samples).pixels()
            off = [abs(value - other) for (x, y), pixel in over.items()
                   for value, other in zip(pixel, larger[x + 20, y + 20])]
            self.assertLess(sum(off) / len(off), 0.02)

    def test_pixels_beyond_the_picture_in_other_ways(self):
        crop = ["--crop", "-9,-5,40,30"]
        whole = self.render(*crop)
        self.assertEqual(self.render(*crop, "--time-limit", "10h").row_bytes, whole.row_bytes)
        self.assertEqual(self.render(*crop, "-t", "3", "--checkpoint", "c.exr").row_bytes, whole.row_bytes)
        printed = self.succeed("scene.xml", *crop, "--pixel", "-3,-2").stdout
        mean = [float(word) for word in printed.splitlines()[-1].split()[1:]]
        for value, wanted in zip(mean, whole.pixel(-3, -2)):
            self.assertAlmostEqual(value, wanted, delta=1e-3)
        self.assertIn("--pixel: there is no pixel -3,-2", self.fail_with(2, "scene.xml", "--pixel", "-3,-2"))
        self.succeed("scene.xml", "-q", "-o", "b.png", *crop)
        self.assertEqual((Png(self.read("b.png")).width, Png(self.read("b.png")).height), (49, 35))

    def test_crop_of_a_png_is_just_its_pixels(self):
        self.succeed("scene.xml", "-q", "-o", "a.png")
        self.succeed("scene.xml", "-q", "-o", "b.png", "--crop", "13,7,54,41")
        whole, part = Png(self.read("a.png")), Png(self.read("b.png"))
        self.assertEqual((part.width, part.height), (41, 34))
        for y in range(34):
            self.assertEqual(part.rows[y], whole.rows[y + 7][3 * 13:3 * 54])

    def test_threads_change_nothing(self):
        one = self.render("-t", "1").pixels()
        for threads in ("2", "7"):
            self.assertEqual(self.render("--threads", threads).pixels(), one)

    def test_instruction_sets_agree(self):
        version = self.succeed("--version").stdout
        names = version.split("instruction sets: ")[1].split(" (")[0].split(", ")
        best = version.split("best here: ")[1].split(")")[0]
        reference = self.render("--float", "--isa", best).pixels()
        for name in names:
            done = self.run_program("scene.xml", "-q", "--float", "-o", "b.exr", "--isa", name)
            if names.index(name) > names.index(best):
                self.assertEqual(done.returncode, 2)
                self.assertIn("this processor has no " + name, done.stderr)
                continue
            self.assertEqual(done.returncode, 0, done.stderr)
            other = Exr(self.read("b.exr")).pixels()
            # Samples on a silhouette may fall to either side, a quarter of a pixel each.
            apart = sum(any(abs(a - b) > 1e-3 for a, b in zip(values, other[place]))
                        for place, values in reference.items())
            self.assertLessEqual(apart, len(reference) * 0.002, name)

    def test_metadata(self):
        self.succeed("scene.xml", "-q", "-t", "2", "-s", "3", "--seed", "9", "-o", "a.exr", "-o", "a.png")
        exr, png = Exr(self.read("a.exr")), Png(self.read("a.png"))
        self.assertRegex(exr.text("Software"), r"^raytrace \d+\.\d+\.\d+$")
        self.assertEqual(exr.text("raytrace:scene"), "scene.xml")
        self.assertEqual(exr.text("raytrace:seed"), "9")
        self.assertEqual(struct.unpack("<i", exr.attributes["raytrace:samples"][1]), (3,))
        self.assertEqual(struct.unpack("<i", exr.attributes["raytrace:threads"][1]), (2,))
        self.assertEqual(exr.attributes["chromaticities"][0], "chromaticities")
        self.assertEqual(png.text["raytrace:samples"], "3")
        self.assertEqual(png.text["raytrace:scene"], "scene.xml")

        kind, data = exr.attributes["worldToCamera"]
        self.assertEqual(kind, "m44f")
        world_to_camera = struct.unpack("<16f", data)
        world_to_ndc = struct.unpack("<16f", exr.attributes["worldToNDC"][1])
        eye = transformed((0, 3, 8), world_to_camera)
        for value in eye[:3]:
            self.assertAlmostEqual(value, 0, delta=1e-5)
        seen = transformed((0, 0.5, 0), world_to_ndc)  # looked at: the middle of the picture
        self.assertAlmostEqual(seen[0] / seen[3], 0.5, delta=1e-5)
        self.assertAlmostEqual(seen[1] / seen[3], 0.5, delta=1e-5)

    def test_pictures_that_no_matrix_leads_to_say_none(self):
        fisheye = support.SCENE.replace("<viewdistance>80</viewdistance>", "").replace("camera>", "fisheyecamera>")
        self.write("scene.xml", fisheye)
        self.succeed("scene.xml", "-q", "--tile", "0/2", "-o", "a.exr", "-o", "a.png")
        self.succeed("scene.xml", "-q", "--tile", "1/2", "-o", "b.exr")
        self.succeed("merge", "-q", "a.exr", "b.exr", "-o", "merged.exr")
        for attributes in (Exr(self.read("a.exr")).attributes, Exr(self.read("merged.exr")).attributes,
                           Png(self.read("a.png")).text):
            self.assertIn("worldToCamera", attributes)
            self.assertNotIn("worldToNDC", attributes)

    def test_metadata_has_frame_and_variables(self):
        self.write("scene.xml", support.SCENE.replace("<radius>1</radius>", "<name>$who</name><radius>$size</radius>"))
        self.succeed("scene.xml", "-q", "--frames", "-3", "-D", "who=a b\\=c", "-D", "size=2", "-o", "a.exr", "-o", "a.png")
        exr, png = Exr(self.read("a.exr")), Png(self.read("a.png"))
        self.assertEqual(exr.attributes["raytrace:frame"], ("int", struct.pack("<i", -3)))
        self.assertEqual(exr.text("raytrace:variables"), r"size=2 who=a\ b\\=c")
        self.assertEqual(png.text["raytrace:frame"], "-3")
        self.assertEqual(png.text["raytrace:variables"], r"size=2 who=a\ b\\=c")
        self.write("scene.xml", support.SCENE)
        self.succeed("scene.xml", "-q", "-o", "a.exr", "-o", "a.png")
        for names in (Exr(self.read("a.exr")).attributes, Png(self.read("a.png")).text):
            self.assertFalse({"raytrace:frame", "raytrace:variables"} & set(names))

    def test_source_date_epoch_makes_bytes_repeat(self):
        environment = dict(os.environ, SOURCE_DATE_EPOCH="1000000000")
        for name in ("a.exr", "a.png"):
            self.succeed("scene.xml", "-q", "-t", "1", "-o", name, env=environment)
            first = self.read(name)
            self.succeed("scene.xml", "-q", "-t", "2", "-o", name, env=environment)
            self.assertEqual(self.read(name), first)

    def test_values_beyond_half_are_told(self):
        self.write("bright.xml", support.SCENE.replace('red="0.1"', 'red="1e6"'))
        done = self.succeed("bright.xml", "-o", "a.exr")
        self.assertRegex(done.stderr, r"raytrace: warning: a\.exr: \d+ values beyond .*--float")
        self.assertEqual(Exr(self.read("a.exr")).pixel(0, 0)[0], 65504)
        self.assertNotIn("warning", self.succeed("bright.xml", "--float", "-o", "a.exr").stderr)


def transformed(point, matrix):
    """A row vector times a row-major matrix."""
    vector = (*point, 1)
    return [sum(vector[i] * matrix[4 * i + j] for i in range(4)) for j in range(4)]


if __name__ == "__main__":
    unittest.main()
