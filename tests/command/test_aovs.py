"""AOVs: what is in the files, as other programs see it."""

import json
import os
import re
import signal
import struct
import time
import unittest

import support
from exr import Exr
from png import Png
from support import CommandTest

NAMES = ["depth", "position", "normal", "albedo", "denoise_albedo", "denoise_normal", "object_id", "material_id",
         "crypto_object", "crypto_material", "samples"]


PASSES = [f"{scattering}_{way}" for scattering in ("diffuse", "specular", "transmission", "volume")
          for way in ("direct", "indirect")] + ["emission", "background"]


def mattes(exr, layer):
    """name -> (x, y) -> share of the pixel, decoded as the specification of Cryptomatte says."""
    key = next(name[:-len("name")] for name in exr.attributes
               if re.fullmatch("cryptomatte/[0-9a-f]{7}/name", name) and exr.text(name) == layer)
    assert exr.text(key + "hash") == "MurmurHash3_32"
    assert exr.text(key + "conversion") == "uint32_to_float32"
    ids = {name: struct.unpack("<f", struct.pack("<I", int(digits, 16)))[0]
           for name, digits in json.loads(exr.text(key + "manifest")).items()}
    names = {number: name for name, number in ids.items()}
    found = {name: {} for name in ids}
    levels = sorted({name.rsplit(".", 1)[0] for name in exr.channels if re.match(layer + r"\d\d\.", name)})
    left = exr.data_window[0]
    for y, row in exr.rows.items():
        for level in levels:
            for number, share in (("R", "G"), ("B", "A")):
                for i, value in enumerate(row[f"{level}.{number}"]):
                    part = row[f"{level}.{share}"][i]
                    if part:
                        found[names[value]][left + i, y] = part
    return found


class Aovs(CommandTest):
    def setUp(self):
        super().setUp()
        self.write("scene.xml", support.SCENE.replace("</scaleradiance></pointlight>",
                                                      "</scaleradiance><group>key</group></pointlight>"))

    def render(self, *options, name="a.exr", scene="scene.xml", **keywords):
        self.succeed(scene, "-q", "-o", name, *options, **keywords)
        return Exr(self.read(name))

    def test_list(self):
        self.assertEqual(self.succeed("--list", "aovs").stdout.split(), NAMES + PASSES)

    def test_wrong_names_are_told(self):
        message = self.fail_with(2, "scene.xml", "-o", "a.exr", "--aov", "depth,normals")
        self.assertIn("--aov: 'normals' is not one of depth, position,", message)
        self.assertIn("did you mean 'normal'?", message)
        self.fail_with(2, "scene.xml", "-o", "a.exr", "--aov", "")
        self.fail_with(2, "scene.xml", "-o", "a.exr", "--aov", "light_")
        message = self.fail_with(2, "scene.xml", "-o", "a.exr", "--aov", "light_kye")
        self.assertIn("--aov: no light of the scene is in the group 'kye'; there are light_default, light_key", message)
        self.assertEqual(self.names(), ["scene.xml"])

    def test_some_output_must_hold_them(self):
        message = self.fail_with(2, "scene.xml", "-o", "a.png", "--aov", "depth")
        self.assertIn("--aov: none of the outputs can hold more than colour; .exr can", message)
        self.succeed("scene.xml", "-q", "-o", "a.png", "-o", "a.exr", "--aov", "depth")
        self.succeed("scene.xml", "-q", "-o", "b.png")
        self.assertEqual(Png(self.read("a.png")).rows, Png(self.read("b.png")).rows)

    def test_channels_and_their_types(self):
        plain, picture = self.render(name="b.exr"), self.render("--aov", "all")
        types = {**plain.channels, "Z": "f", "id.object": "I", "id.material": "I", "samples": "I"}
        types.update({f"{layer}.{axis}": "f" for layer in "PN" for axis in "XYZ"})
        types.update({f"{layer}.{color}": "f" for layer in ("albedo", "denoise_albedo") for color in "RGB"})
        types.update({f"denoise_normal.{axis}": "f" for axis in "XYZ"})
        types.update({f"{layer}{level}.{part}": "f" for layer in ("crypto_object", "crypto_material")
                      for level in ("00", "01", "02") for part in "RGBA"})
        types.update({f"light_{group}.{color}": "f" for group in ("default", "key") for color in "RGB"})
        self.assertEqual(picture.channels, types)
        self.assertEqual(picture.pixels(), plain.pixels())
        self.assertEqual(self.render("--aov", "normal,depth", "--float").channels,
                         {"R": "f", "G": "f", "B": "f", "A": "f", "Z": "f", "N.X": "f", "N.Y": "f", "N.Z": "f"})

    def test_values_of_a_known_pixel(self):
        # The picture's lowest pixel in the middle sees the floor, whose normal is (0, 1, 0), with all its samples.
        picture = self.render("--aov", "all")
        value = {name: values[40] for name, values in picture.rows[59].items()}
        self.assertEqual([value["N.X"], value["N.Z"], value["samples"]], [0, 0, 4])
        self.assertAlmostEqual(value["N.Y"], 1, places=6)
        self.assertAlmostEqual(value["albedo.R"], 0.6 * 0.8, places=6)
        self.assertAlmostEqual(value["P.Y"], 0, places=5)
        self.assertGreater(value["P.Z"], 0)
        self.assertEqual(json.loads(picture.text("raytrace:manifest/id.object"))[value["id.object"] - 1], "plane#1")
        self.assertEqual(json.loads(picture.text("raytrace:manifest/id.material"))[value["id.material"] - 1], "floor")
        # Of that point: its distance from the eye (0, 3, 8) along the view to (0, 0.5, 0).
        view = [0, -2.5 / 70.25**0.5, -8 / 70.25**0.5]
        point = [value["P.X"], value["P.Y"] - 3, value["P.Z"] - 8]
        self.assertAlmostEqual(value["Z"], sum(a * b for a, b in zip(view, point)), places=4)
        sky = {name: values[0] for name, values in picture.rows[0].items()}
        self.assertEqual([sky["Z"], sky["id.object"], sky["N.Y"], sky["crypto_object00.G"]],
                         [struct.unpack("<f", struct.pack("<f", 1e30))[0], 0, 0, 0])

    def test_passes_add_up_to_the_picture(self):
        picture, plain = self.render("--aov", "passes", "--float"), self.render("--float", name="b.exr")
        self.assertEqual(set(picture.channels) - set(plain.channels), {f"{name}.{color}" for name in PASSES for color in "RGB"})
        for y, row in picture.rows.items():
            for color in "RGB":
                self.assertEqual(row[color], plain.rows[y][color])
                for whole, *parts in zip(row[color], *(row[f"{name}.{color}"] for name in PASSES)):
                    self.assertAlmostEqual(sum(parts), whole, delta=1e-5)
        self.assertGreater(max(max(row["diffuse_direct.R"]) for row in picture.rows.values()), 0.1)
        self.assertGreater(max(max(row["background.B"]) for row in picture.rows.values()), 0.1)
        one = self.render("--aov", "diffuse_direct", "--float", name="b.exr")
        self.assertEqual([row["diffuse_direct.R"] for row in one.rows.values()],
                         [row["diffuse_direct.R"] for row in picture.rows.values()])

    def test_light_groups_add_up_to_the_picture(self):
        picture = self.render("--aov", "light_key,light_default", "--float")
        self.write("unlit.xml", support.SCENE.replace("<scaleradiance>2<", "<scaleradiance>0<"))
        unlit = self.render("--float", name="b.exr", scene="unlit.xml")
        for y, row in picture.rows.items():
            for color in "RGB":
                for whole, key, other, alone in zip(row[color], row[f"light_key.{color}"], row[f"light_default.{color}"],
                                                    unlit.rows[y][color]):
                    self.assertAlmostEqual(whole, key + other, places=6)
                    self.assertAlmostEqual(other, alone, places=6)

    def test_a_sky_and_its_sun_are_groups(self):
        sky = """<lights><skylights><skylight><sundirection x='1' y='1' z='1'/>%s</skylight></skylights></lights>"""
        shown = {}
        for name, groups in (("both", "<group>sky</group><sungroup>sun</sungroup>"), ("one", "<group>sky</group>"),
                             ("sun", "<sungroup>sun</sungroup>"), ("dark", "")):
            self.write(name + ".xml", re.sub("<lights>.*</lights>", sky % groups, support.SCENE, flags=re.DOTALL))
            shown[name] = self.render("--aov", "all", "--float", "--integrator", "path", name=name + ".exr", scene=name + ".xml")
        for y, row in shown["both"].rows.items():
            for color in "RGB":
                self.assertEqual(row[f"light_sun.{color}"], shown["sun"].rows[y][f"light_sun.{color}"])
                self.assertEqual(row[f"light_sky.{color}"], shown["sun"].rows[y][f"light_default.{color}"])
                layers = [row[f"light_{group}.{color}"] for group in ("sun", "sky", "default")]
                without_groups = shown["dark"].rows[y][color]
                of_one_group = shown["one"].rows[y][f"light_sky.{color}"]
                for whole, plain, one, *parts in zip(row[color], without_groups, of_one_group, *layers):
                    self.assertAlmostEqual(whole, sum(parts), delta=1e-6 * max(whole, 1))
                    self.assertAlmostEqual(whole, plain, delta=1e-6 * max(whole, 1))
                    self.assertAlmostEqual(whole, one + parts[-1], delta=1e-6 * max(whole, 1))
        largest = {group: max(max(row[f"light_{group}.R"]) for row in shown["both"].rows.values()) for group in ("sun", "sky")}
        self.assertGreater(min(largest.values()), 0.01)

    def test_a_matte_is_the_coverage_of_its_object(self):
        picture = self.render("--aov", "crypto_object,crypto_material", "-s", "16")
        # f834d0a6 is the hash of "crypto_object" by other programs.
        self.assertEqual(picture.text("cryptomatte/f834d0a/name"), "crypto_object")
        objects, materials = mattes(picture, "crypto_object"), mattes(picture, "crypto_material")
        self.assertEqual(sorted(objects), ["plane#1", "sphere#1"])
        self.assertEqual(objects["sphere#1"], materials["shiny"])
        self.assertEqual(objects["plane#1"], materials["floor"])
        # The sphere lies on the plane, which hides nothing of it.
        self.write("sphere.xml", re.sub("<planes>.*</planes>", "", support.SCENE))
        alone = self.render("--float", "-s", "16", "--transparent", scene="sphere.xml", name="b.exr").pixels()
        wanted = {place: pixel[3] for place, pixel in alone.items() if pixel[3]}
        self.assertEqual(objects["sphere#1"], wanted)
        self.assertGreater(len({share for share in wanted.values() if share < 1}), 5)  # soft edges
        whole = self.render("--float", "-s", "16", "--transparent", name="b.exr").pixels()
        for place, pixel in whole.items():
            covered = objects["sphere#1"].get(place, 0) + objects["plane#1"].get(place, 0)
            self.assertAlmostEqual(covered, pixel[3], places=6)

    def test_an_object_without_a_name_is_no_other(self):
        one = "<sphere><center x='-1.5' y='1' z='0'/><radius>0.5</radius><material>shiny</material></sphere>"
        other = "<sphere><name>sphere#2</name><center x='1.5' y='1' z='0'/><radius>0.5</radius>" \
                "<material>shiny</material></sphere>"
        self.write("scene.xml", support.SCENE.replace("</spheres>", one + other + "</spheres>"))
        picture = self.render("--aov", "object_id,crypto_object")
        names = json.loads(picture.text("raytrace:manifest/id.object"))
        self.assertEqual(names, ["plane#1", "sphere#1", "sphere#2#2", "sphere#2"])
        found = mattes(picture, "crypto_object")
        self.assertEqual(sorted(found), sorted(names))
        self.assertLess(max(x for x, _ in found["sphere#2#2"]), 40)
        self.assertGreater(min(x for x, _ in found["sphere#2"]), 40)

    def test_names_of_all_kinds_come_through(self):
        name = "caf\u00e9 & \"co\" \\ \u4e16"
        escaped = name.replace("&", "&amp;")
        self.write("scene.xml", support.SCENE.replace("<sphere>", f"<sphere><name>{escaped}</name>"))
        picture = self.render("--aov", "object_id,crypto_object")
        self.assertEqual(json.loads(picture.text("raytrace:manifest/id.object")), ["plane#1", name])
        self.assertIn(name, mattes(picture, "crypto_object"))

    def test_crops_are_parts_of_the_whole(self):
        whole = self.render("--aov", "all")
        crop = self.render("--aov", "all", "--crop", "29,17,62,43", name="b.exr")
        self.assertEqual(crop.data_window, (29, 17, 61, 42))
        for y, row in crop.rows.items():
            for name, values in row.items():
                self.assertEqual(values, whole.rows[y][name][29:62], (name, y))

    def test_merged_tiles_and_sample_ranges_are_the_whole(self):
        whole = self.render("--aov", "all,passes", "-s", "9")
        for i in range(4):
            self.render("--aov", "all,passes", "-s", "9", "--tile", f"{i}/4", name=f"tile{i}.exr")
        for first, count in ((0, 2), (2, 6), (8, 1)):
            self.render("--aov", "all,passes", "-s", str(count), "--sample-offset", str(first), name=f"range{first}.exr")
        for pieces in (["tile2.exr", "tile0.exr", "tile3.exr", "tile1.exr"], ["range8.exr", "range0.exr", "range2.exr"]):
            self.succeed("merge", *pieces, "-o", "merged.exr")
            merged = Exr(self.read("merged.exr"))
            self.assertEqual(merged.channels, whole.channels)
            self.assertEqual(merged.rows, whole.rows)
            self.assertEqual(mattes(merged, "crypto_object"), mattes(whole, "crypto_object"))
        self.render("-s", "6", "--sample-offset", "2", name="range2.exr")
        message = self.fail_with(1, "merge", "range0.exr", "range2.exr", "range8.exr", "-o", "no.exr")
        self.assertIn("it differs in the AOVs (none, not depth,position", message)

    def test_a_resumed_render_is_the_whole(self):
        options = ["scene.xml", "-q", "-o", "a.exr", "--aov", "all", "-r", "400x300", "-s", support.samples(300)]
        self.succeed(*options)
        whole = Exr(self.read("a.exr"))
        resumable = [*options, "--checkpoint", "c.exr", "--checkpoint-interval", "0.01s", "--resume"]
        self.assertEqual(self.stop_after_a_checkpoint(*resumable), 75)
        self.assertIn(self.stop_after_a_checkpoint(*resumable), (0, 75))
        self.succeed(*resumable)
        self.assertEqual(Exr(self.read("a.exr")).rows, whole.rows)
        # Of other AOVs, a checkpoint is refused.
        self.assertEqual(self.stop_after_a_checkpoint(*resumable), 75)
        message = self.fail_with(1, "scene.xml", "-o", "a.exr", *options[6:], "--checkpoint", "c.exr", "--resume")
        self.assertIn("it differs in the AOVs", message)

    def stop_after_a_checkpoint(self, *arguments):
        """The exit code of a render that gets SIGTERM when it has written c.exr anew."""
        def written():
            return os.stat(self.path("c.exr")).st_mtime_ns if os.path.exists(self.path("c.exr")) else None

        before = written()
        process = self.start_program(*arguments)
        while process.poll() is None and written() in (None, before):
            time.sleep(0.01)
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=600)
        return process.returncode


if __name__ == "__main__":
    unittest.main()
