"""View transforms and exposures of files for display: by options, scenes, models, pieces, and OpenColorIO."""

import json
import math
import re
import struct
import unittest

import support
from exr import Exr
from png import Png
from support import CommandTest
from test_models import PLY

OCIO = """ocio_profile_version: 1
strictparsing: true
roles: {default: raw, scene_linear: lin}
displays:
  monitor:
    - !<View> {name: Root, colorspace: root}
    - !<View> {name: Square, colorspace: square}
  cinema:
    - !<View> {name: Half, colorspace: half}
colorspaces:
  - !<ColorSpace> {name: lin, bitdepth: 32f, isdata: false, allocation: uniform}
  - !<ColorSpace> {name: raw, bitdepth: 32f, isdata: true, allocation: uniform}
  - !<ColorSpace>
    name: root
    bitdepth: 32f
    isdata: false
    allocation: uniform
    from_reference: !<ExponentTransform> {value: [0.5, 0.5, 0.5, 1]}
  - !<ColorSpace>
    name: square
    bitdepth: 32f
    isdata: false
    allocation: uniform
    from_reference: !<ExponentTransform> {value: [2, 2, 2, 1]}
  - !<ColorSpace>
    name: half
    bitdepth: 32f
    isdata: false
    allocation: uniform
    from_reference: !<MatrixTransform> {matrix: [0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 1]}
"""


def srgb(linear):
    linear = min(1, max(0, linear))
    return 12.92 * linear if linear <= 0.0031308 else 1.055 * linear**(1 / 2.4) - 0.055


def neutral(color):
    """The Khronos PBR Neutral Tone Mapper, by its specification."""
    x = min(color)
    f = x - x * x / 0.16 if x <= 0.08 else 0.04
    peak = max(color) - f
    if peak <= 0.76:
        return [part - f for part in color]
    new = 1 - 0.24**2 / (peak + 1 - 1.52)
    g = 1 / (0.15 * (peak - new) + 1)
    return [(part - f) * new / peak * g + new * (1 - g) for part in color]


def asked(pixels):
    """The exposure that a picture without gaps in its alpha asks for."""
    logarithms = [math.log2((0.2126 * r + 0.7152 * g + 0.0722 * b) / 0.18) for r, g, b, _ in pixels if r + g + b > 0]
    return -sum(logarithms) / len(logarithms)


class View(CommandTest):
    def setUp(self):
        super().setUp()
        self.write("view.ocio", OCIO)
        self.write("slab.ply", PLY)

    def rendered(self, *options, scene="scene.xml"):
        """EXR of floats, and PNG."""
        self.succeed(scene, "-q", "--float", "-o", "a.exr", "-o", "a.png", *options)
        return Exr(self.read("a.exr")), Png(self.read("a.png"))

    def check(self, exr, png, shown, exposure=0, bits=8):
        """shown(color): encoded, from 0 to 1."""
        steps = 2**bits - 1
        for place, (*color, _) in exr.pixels().items():
            wanted = shown([part * 2**exposure for part in color])
            for value, part in zip(png.pixel(*place), wanted):
                self.assertAlmostEqual(value, min(1, max(0, part)) * steps, delta=0.51 if bits == 8 else 0.6)

    def test_scenes_are_shown_as_before(self):
        exr, png = self.rendered()
        self.check(exr, png, lambda color: map(srgb, color))
        self.assertNotIn("raytrace:viewTransform", png.text)
        pixels = png.rows
        self.assertEqual(self.rendered("--view-transform", "srgb")[1].rows, pixels)
        self.assertNotEqual(self.rendered("--view-transform", "agx")[1].rows, pixels)

    def test_khronos_neutral_in_files(self):
        for bits, exposure in ((8, 0), (16, 1.5)):
            exr, png = self.rendered("--view-transform", "khronos-neutral", "--bit-depth", str(bits), "--exposure",
                                     str(exposure))
            self.check(exr, png, lambda color: map(srgb, neutral(color)), exposure, bits)
            self.assertEqual(png.text["raytrace:viewTransform"], "khronos-neutral")

    def test_linear_files_stay_as_they_are(self):
        before = self.rendered()[0]
        for options in (["--view-transform", "agx"], ["--exposure", "2"], ["--auto-exposure"], ["--ocio", "view.ocio"],
                        ["--white-balance", "2700"]):
            self.assertEqual(self.rendered(*options)[0].row_bytes, before.row_bytes)

    def test_the_printed_scene_is_shown_in_the_same_way(self):
        for options in (["--view-transform", "agx"], ["--exposure=-1.3"], ["--auto-exposure", "--exposure", "0.5"],
                        ["--view-transform", "khronos-neutral", "--auto-exposure"], ["--white-balance", "3200"]):
            exr, png = self.rendered(*options)
            self.write("printed.xml", self.succeed("scene.xml", *options, "--print-scene").stdout)
            printed_exr, printed = self.rendered(scene="printed.xml")
            self.assertEqual(printed.rows, png.rows)
            self.assertEqual(printed_exr.row_bytes, exr.row_bytes)
            for name in ("viewTransform", "exposure", "autoExposure", "whiteBalance"):
                self.assertEqual(printed.text.get("raytrace:" + name), png.text.get("raytrace:" + name))
            # The options' values take the place of the scene's, and an exposure that of its automatic one as well.
            self.assertEqual(self.rendered("--exposure", "0", "--view-transform", "srgb", "--white-balance", "0",
                                           scene="printed.xml")[1].rows,
                             self.rendered()[1].rows)
            self.assertEqual(self.rendered("--exposure", "0", "--auto-exposure", "--view-transform", "srgb", "--white-balance", "0",
                                           scene="printed.xml")[1].rows, self.rendered("--auto-exposure")[1].rows)

    def test_models_are_shown_through_khronos_neutral(self):
        small = ["-r", "48x27", "-s", "2"]
        exr, png = self.rendered(*small, scene="slab.ply")
        self.assertEqual(png.text["raytrace:viewTransform"], "khronos-neutral")
        self.check(exr, png, lambda color: map(srgb, neutral(color)))
        printed = self.succeed("slab.ply", *small, "--print-scene").stdout
        self.assertIn("<viewtransform>khronos-neutral</viewtransform>", printed)
        self.write("printed.xml", printed)
        self.assertEqual(self.rendered(scene="printed.xml")[1].rows, png.rows)
        plain_exr, plain = self.rendered(*small, "--view-transform", "srgb", scene="slab.ply")
        self.check(plain_exr, plain, lambda color: map(srgb, color))
        self.assertEqual(plain_exr.row_bytes, exr.row_bytes)
        self.succeed("slab.ply", "-q", *small, "--turntable", "2", "-o", "turn.#.png")
        self.assertEqual(Png(self.read("turn.1.png")).text["raytrace:viewTransform"], "khronos-neutral")

    def test_a_white_balance_shows_its_lamps_as_white(self):
        """A grey wall in the light of one lamp, in every way that says what is white."""
        self.write("lamp.xml", """<raytracer>
  <viewplane> <hres>8</hres> <vres>6</vres> <whitebalance>$white</whitebalance> <background kelvin="$lamp"/> </viewplane>
  <camera> <eye x="0" y="0" z="1"/> <lookat x="0" y="0" z="0"/> <fov>40</fov> </camera>
</raytracer>""")
        for lamp in (1900, 2700, 6504, 15000):
            for scene_says, options in ((lamp, []), (0, ["--white-balance", str(lamp)]), (9000, [f"--white-balance={lamp}"])):
                options = ["lamp.xml", "-q", "-D", f"lamp={lamp}", "-D", f"white={scene_says}", "--exposure=-1", *options]
                self.succeed(*options, "--bit-depth", "16", "-o", "a.png")
                png = Png(self.read("a.png"))
                self.assertEqual(float(png.text["raytrace:whiteBalance"]), lamp)
                for value in png.rows[0][:3]:
                    self.assertAlmostEqual(value / 65535, srgb(0.5), delta=1e-3)
        # Another white: what is warmer than it is orange, what is colder blue.
        for white, is_orange in ((6504, True), (2000, False)):
            self.succeed("lamp.xml", "-q", "-D", "lamp=2700", "-D", f"white={white}", "--exposure=-1", "-o", "a.png")
            red, _, blue = Png(self.read("a.png")).rows[0][:3]
            self.assertEqual(red > blue, is_orange)
        # Through pieces: as the scene says, and as merge says.
        for tile in range(2):
            self.succeed("lamp.xml", "-q", "-D", "lamp=2700", "-D", "white=2700", "--tile", f"{tile}/2", "-o", f"{tile}.exr")
        self.succeed("merge", "-q", "0.exr", "1.exr", "-o", "b.png", "--exposure=-1")
        self.assertEqual({*Png(self.read("b.png")).rows[0]}, {188})
        self.succeed("merge", "-q", "0.exr", "1.exr", "-o", "b.png", "--white-balance", "0")
        self.assertNotIn("raytrace:whiteBalance", Png(self.read("b.png")).text)
        self.succeed("lamp.xml", "-q", "-D", "lamp=2700", "-D", "white=0", "--tile", "1/2", "-o", "1.exr")
        self.assertIn("say how with --white-balance", self.fail_with(1, "merge", "0.exr", "1.exr", "-o", "b.png"))
        for wrong in ("900", "15001", "warm", "-1", "nan"):
            self.assertIn("white balance", self.fail_with(2, "lamp.xml", "-o", "a.png", f"--white-balance={wrong}"))

    def test_dither_has_each_colour_as_its_mean(self):
        # A backdrop that goes from black to a thousandth: three steps of 8 bits.
        self.write("ramp.xml", """<raytracer><viewplane><hres>160</hres><vres>64</vres></viewplane>
            <camera><eye x="0" y="0" z="9"/><lookat x="0" y="0" z="0"/><fov>20</fov></camera>
            <integrator><albedo/></integrator><textures><images><image><name>ramp</name><file>ramp.pfm</file>
            <wrap>clamp</wrap></image></images></textures><materials><mattes><matte><name>m</name><ka>0</ka><kd>1</kd>
            <cd texture="ramp"/></matte></mattes></materials><objects><rectangles><rectangle><corner x="-9" y="-9" z="0"/>
            <edge1 x="18" y="0" z="0"/><edge2 x="0" y="18" z="0"/><material>m</material></rectangle></rectangles></objects>
            </raytracer>""")
        with open(self.path("ramp.pfm"), "wb") as file:
            file.write(b"PF\n2 1\n-1.0\n" + struct.pack("<6f", 0, 0, 0, 0.001, 0.001, 0.001))
        self.succeed("ramp.xml", "-q", "--float", "-o", "exact.exr", "-o", "plain.png", "-s", "16")
        self.succeed("ramp.xml", "-q", "-o", "a.png", "-s", "16", "--dither")
        exact, plain, png = Exr(self.read("exact.exr")), Png(self.read("plain.png")), Png(self.read("a.png"))
        self.assertEqual((png.text["raytrace:dither"], "raytrace:dither" in plain.text), ("1", False))
        steps = [0, 0]
        for x in range(0, 160, 8):
            for y in range(0, 64, 8):
                block = [(u, v) for u in range(x, x + 8) for v in range(y, y + 8)]
                right = sum(255 * srgb(exact.rows[v]["R"][u]) for u, v in block) / 64
                for i, picture in enumerate((plain, png)):
                    shown = sum(picture.rows[v][3 * u] for u, v in block) / 64
                    steps[i] = max(steps[i], abs(shown - right))
        self.assertLess(steps[1], 0.12)
        self.assertGreater(steps[0], 0.3)
        for row, (y, values) in zip(png.rows, exact.rows.items()):
            for shown, value in zip(row[::3], values["R"]):
                self.assertLess(abs(shown - 255 * srgb(value)), 1.001)
        # A crop is a part of it; a JPEG is one of the same, 16 bits are not dithered; and merge does the same.
        self.succeed("ramp.xml", "-q", "-o", "b.png", "-s", "16", "--dither", "--crop", "13,5,60,31")
        self.assertEqual(Png(self.read("b.png")).rows, [row[39:180] for row in png.rows[5:31]])
        self.succeed("ramp.xml", "-q", "-o", "16.png", "-s", "16", "--bit-depth", "16")
        plain = self.read("16.png")
        self.succeed("ramp.xml", "-q", "-o", "16.png", "-s", "16", "--bit-depth", "16", "--dither")
        self.assertEqual(Png(self.read("16.png")).rows, Png(plain).rows)
        for i in range(2):
            self.succeed("ramp.xml", "-q", "-o", f"{i}.exr", "-s", "16", "--float", "--tile", f"{i}/2")
        self.succeed("merge", "-q", "0.exr", "1.exr", "-o", "c.png", "--dither")
        self.assertEqual(Png(self.read("c.png")).rows, png.rows)
        # What is not dithered is not taken for it.
        self.assertNotIn("skipped", self.succeed("ramp.xml", "-v", "-o", "plain.png", "-s", "16", "--dither", "--skip-existing").stderr)
        self.assertIn("skipped", self.succeed("ramp.xml", "-v", "-o", "plain.png", "-s", "16", "--dither", "--skip-existing").stderr)

    def test_auto_exposure(self):
        exr, png = self.rendered("--auto-exposure", "-t", "1")
        found = float(png.text["raytrace:exposure"])
        self.assertAlmostEqual(found, asked(exr.pixels().values()), delta=0.0051)
        self.check(exr, png, lambda color: map(srgb, color), found)
        self.assertEqual(self.rendered("--auto-exposure", "-t", "3")[1].rows, png.rows)
        self.assertAlmostEqual(
            float(self.rendered("--auto-exposure", "--exposure", "0.5")[1].text["raytrace:exposure"]), found + 0.5)
        self.succeed("scene.xml", "-q", "-o", "a.png", "--auto-exposure", "--view-transform", "agx", "--stats=s.json")
        picture = json.loads(self.read("s.json"))["picture"]
        self.assertEqual((picture["view_transform"], picture["exposure"]), ("agx", found))
        self.assertIn(f"view            srgb, exposure {found:g}",
                      self.succeed("scene.xml", "-o", "a.png", "--auto-exposure", "--stats").stderr)
        # Twice the light, one stop less.
        brighter = re.sub(r"(<scaleradiance>)([\d.]+)", lambda m: m[1] + str(2 * float(m[2])), support.SCENE)
        brighter = brighter.replace('<background red="0.1" green="0.2" blue="0.4"/>',
                                    '<background red="0.2" green="0.4" blue="0.8"/>')
        brighter = brighter.replace('<color red="1" green="0.5" blue="0.25"/>',
                                    '<scaleradiance>2</scaleradiance><color red="1" green="0.5" blue="0.25"/>')
        self.write("brighter.xml", brighter)
        other = self.rendered("--auto-exposure", scene="brighter.xml")[1]
        self.assertEqual(float(other.text["raytrace:exposure"]), found - 1)
        self.assertEqual(other.rows, png.rows)

    def test_an_exposure_takes_the_place_of_a_scenes_automatic_one(self):
        self.write("auto.xml", support.SCENE.replace("<hres>", "<autoexposure>true</autoexposure> <exposure>0.5</exposure> <hres>"))
        found = float(self.rendered(scene="auto.xml")[1].text["raytrace:exposure"])
        said = self.succeed("auto.xml", "-v", "--progress=none", "-o", "a.exr", "-o", "a.png").stderr
        self.assertIn(f"exposed by its own brightness, as by --exposure {found:g}\n", said)
        self.assertNotIn("brightness", self.succeed("auto.xml", "-v", "--progress=none", "-o", "a.exr").stderr)
        exr, png = self.rendered(f"--exposure={found:g}", scene="auto.xml")
        self.check(exr, png, lambda color: map(srgb, color), found)
        self.assertNotIn("raytrace:autoExposure", png.text)
        self.assertEqual(self.rendered("--exposure", "0", scene="auto.xml")[1].rows, self.rendered()[1].rows)
        self.assertEqual(self.rendered("--exposure", "1", scene="auto.xml")[1].rows, self.rendered("--exposure", "1")[1].rows)
        added = self.rendered("--exposure", "2", "--auto-exposure", scene="auto.xml")[1]
        self.assertAlmostEqual(float(added.text["raytrace:exposure"]), found + 1.5)
        # A tile can be exposed so, and what is skipped knows that it is another picture.
        self.succeed("auto.xml", "-q", "--tile", "0/2", "--exposure", "0", "-o", "tile.png")
        self.succeed("auto.xml", "-q", "-o", "kept.png")
        for option, skipped in (("--exposure=0", False), ("--exposure=0", True), ("-q", False)):
            self.assertEqual("kept.png" in self.succeed("auto.xml", "--skip-existing", "--progress=none", option, "-o", "kept.png").stderr,
                             skipped)

    def test_pieces_become_the_whole_picture(self):
        for options in (["--view-transform", "agx", "--auto-exposure"], ["--exposure", "1", "--transparent"],
                        ["--view-transform", "khronos-neutral", "--auto-exposure", "--transparent"]):
            whole = self.rendered(*options)[1]
            pieces = [["--tile", "0/4"], ["--tile", "1/4", "-s", "1", "--sample-offset", "0"], ["--tile", "3/4"],
                      ["--tile", "1/4", "-s", "3", "--sample-offset", "1"], ["--tile", "2/4"]]
            for i, piece in enumerate(pieces):
                self.succeed("scene.xml", "-q", "--float", *options, *piece, "-o", f"piece.{i}.exr")
            names = [f"piece.{i}.exr" for i in range(len(pieces))]
            self.succeed("merge", "-q", *names, "-o", "merged.png", "-o", "merged.exr")
            merged = Png(self.read("merged.png"))
            self.assertEqual(merged.rows, whole.rows)
            for name in ("viewTransform", "exposure", "autoExposure"):
                self.assertEqual(merged.text.get("raytrace:" + name), whole.text.get("raytrace:" + name))
            # Which is what the merged EXR says, too.
            self.succeed("merge", "-q", "merged.exr", "-o", "again.png")
            self.assertEqual(Png(self.read("again.png")).rows, whole.rows)
            # Or as the options say.
            self.succeed("merge", "-q", *names, "-o", "merged.png", "--view-transform", "khronos-neutral",
                         "--exposure", "0.5")
            kept = [option for option in options if option == "--transparent"]
            self.assertEqual(Png(self.read("merged.png")).rows,
                             self.rendered(*kept, "--view-transform", "khronos-neutral", "--exposure", "0.5")[1].rows)
            self.succeed("merge", "-q", "--partial", *names[1:], "-o", "partial.png")

    def test_pieces_that_differ(self):
        self.succeed("scene.xml", "-q", "--float", "--tile", "0/2", "--view-transform", "agx", "-o", "0.exr")
        self.succeed("scene.xml", "-q", "--float", "--tile", "1/2", "-o", "1.exr")
        self.assertIn("1.exr is to be shown in another way than 0.exr: say how with --view-transform",
                      self.fail_with(1, "merge", "0.exr", "1.exr", "-o", "a.png"))
        self.succeed("merge", "-q", "0.exr", "1.exr", "-o", "a.exr")
        self.succeed("merge", "-q", "0.exr", "1.exr", "-o", "a.png", "--view-transform", "agx")
        self.assertEqual(Png(self.read("a.png")).rows, self.rendered("--view-transform", "agx")[1].rows)

    def test_a_tile_is_not_exposed_by_itself(self):
        self.assertIn("--tile: a.png: the whole picture's brightness says how it is exposed; write EXR files and merge "
                      "them, or say it with --exposure",
                      self.fail_with(2, "scene.xml", "-o", "a.png", "--tile", "0/2", "--auto-exposure"))
        self.succeed("scene.xml", "-q", "-o", "a.png", "--crop", "0,0,8,8", "--auto-exposure")
        self.assertIn("--ocio: all outputs hold linear colour",
                      self.fail_with(2, "scene.xml", "-o", "a.exr", "--tile", "0/2", "--ocio", "view.ocio"))

    def test_what_is_wrong_in_a_scene(self):
        for element, text in (("<viewtransform>agks</viewtransform>", "is neither srgb, agx nor khronos-neutral"),
                              ("<exposure>65</exposure>", "an <exposure> is from -64 to 64 stops"),
                              ("<autoexposure>perhaps</autoexposure>", "perhaps")):
            self.write("scene.xml", support.SCENE.replace("<hres>", element + "<hres>"))
            self.assertIn(text, self.fail_with(1, "scene.xml", "-o", "a.png"))

    def test_opencolorio(self):
        exr, png = self.rendered("--ocio", "view.ocio", "--exposure=-1")
        self.check(exr, png, lambda color: map(math.sqrt, color), -1)
        self.assertEqual(png.text["raytrace:ocio"], "view.ocio")
        exr, png = self.rendered("--ocio", "view.ocio", "--ocio-view", "Square", "--bit-depth", "16", "--transparent")
        for place, (*color, alpha) in exr.pixels().items():
            for part, value in zip(color, png.pixel(*place)):
                self.assertAlmostEqual(value, min(1, (part / alpha)**2) * 65535 if alpha else 0, delta=2)
        exr, png = self.rendered("--ocio", "view.ocio", "--ocio-display", "cinema", "--ocio-colorspace", "lin",
                                 scene="slab.ply", *(["-r", "48x27", "-s", "2"]))
        self.check(exr, png, lambda color: [part / 2 for part in color])
        self.succeed("merge", "-q", "a.exr", "-o", "b.png", "--ocio", "view.ocio", "--ocio-display", "cinema")
        self.assertEqual(Png(self.read("b.png")).rows, png.rows)
        self.succeed("slab.ply", "-q", "-r", "48x27", "-s", "2", "--ocio", "view.ocio", "-o", "a.jpg", "-o", "a.tif")

    def test_what_is_wrong_with_opencolorio(self):
        self.write("broken.ocio", "no configuration")
        for options, text in ((["absent.ocio"], "--ocio: absent.ocio: there is no such file"),
                              (["broken.ocio"], "--ocio: broken.ocio: "),
                              (["view.ocio", "--ocio-display", "monitr"], "no display 'monitr'; did you mean 'monitor'?"),
                              (["view.ocio", "--ocio-view", "Rot"], "no view 'Rot'; did you mean 'Root'?"),
                              (["view.ocio", "--ocio-view", "Half"], "no view 'Half'"),
                              (["view.ocio", "--ocio-colorspace", "lim"], "no colour space 'lim'; did you mean 'lin'?")):
            self.assertIn(text, self.fail_with(1, "scene.xml", "-o", "a.png", "--ocio", *options))
            self.assertNotIn("a.png", self.names())


if __name__ == "__main__":
    unittest.main()
