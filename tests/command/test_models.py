"""A model's file in a scene's place: its camera and lights, and the scene that it stands for."""

import base64
import gzip
import json
import math
import struct
import unittest
import zlib

from exr import Exr
from png import Png
from support import CommandTest

# A slab, 4 wide, 1 high and 0.5 deep, with a post on its left front corner.
CORNERS = [(x, y, z) for x in (10, 14) for y in (5, 6) for z in (-1, -0.5)]
FACES = ["0 1 3 2", "4 6 7 5", "0 4 5 1", "2 3 7 6", "0 2 6 4", "1 5 7 3"]
PLY = f"""ply
format ascii 1.0
element vertex {len(CORNERS) + 3}
property float x
property float y
property float z
element face {len(FACES) + 1}
property list uchar int vertex_indices
end_header
""" + "".join(f"{x} {y} {z}\n" for x, y, z in CORNERS) + "10 6 -0.5\n10.2 6 -0.5\n10.1 8 -0.5\n" + "".join(
    f"4 {face}\n" for face in FACES) + "3 8 9 10\n"
OPTIONS = ["-q", "-r", "96x54", "-s", "4"]


class Models(CommandTest):
    def setUp(self):
        super().setUp()
        self.write("slab.ply", PLY)

    def covered(self, *options):
        """The columns and rows in which some pixel shows the model: the first and the last."""
        self.succeed("slab.ply", *OPTIONS, "--transparent", *options, "-o", "covered.exr")
        shown = [place for place, pixel in Exr(self.read("covered.exr")).pixels().items() if pixel[3] > 0]
        columns, rows = zip(*shown)
        return (min(columns), max(columns)), (min(rows), max(rows)), len(shown)

    def test_all_of_it_is_in_view(self):
        for view in ([], ["--view", "front"], ["--view", "back"], ["--view", "side"], ["--view", "top"],
                     ["--view", "iso"], ["--view", "-130,-40"], ["--up", "z"], ["--up", "z", "--view", "top"],
                     ["-r", "54x96"]):
            with self.subTest(view=view):
                (left, right), (top, bottom), count = self.covered(*view)
                width, height = (54, 96) if "-r" in view else (96, 54)
                self.assertGreater(min(left, top), 0)
                self.assertLess(right, width - 1)
                self.assertLess(bottom, height - 1)
                # It fills the picture along one of its sides.
                self.assertGreater(max((right - left) / width, (bottom - top) / height), 0.74)
                self.assertLess(abs(left + right - width) / width, 0.2)
                self.assertLess(abs(top + bottom - height) / height, 0.2)
                self.assertGreater(count, 100)

    def test_views_are_from_where_they_say(self):
        (left, right), (top, bottom), _ = self.covered("--view", "front")
        self.assertAlmostEqual((right - left) / (bottom - top), 4 / 3, delta=0.1)
        (left, right), (top, bottom), _ = self.covered("--view", "side")
        self.assertLess((right - left) / (bottom - top), 0.4)  # its near end is 1 high, its far end 3
        (left, right), (top, bottom), _ = self.covered("--view", "top")
        self.assertAlmostEqual((right - left) / (bottom - top), 4 / 0.5, delta=1.2)
        # Of a file whose z is up, the front is what y has from below.
        (left, right), (top, bottom), _ = self.covered("--up", "z", "--view", "front")
        self.assertAlmostEqual((right - left) / (bottom - top), 4 / 0.5, delta=1.2)

    def test_it_is_the_scene_that_is_printed(self):
        for view in ([], ["--view", "200,30", "--up", "z"]):
            self.succeed("slab.ply", *OPTIONS, *view, "-o", "model.exr")
            self.write("printed.xml", self.succeed("slab.ply", *OPTIONS, *view, "--print-scene").stdout)
            self.succeed("printed.xml", "-q", "-o", "printed.exr")
            model = Exr(self.read("model.exr"))
            self.assertEqual(model.row_bytes, Exr(self.read("printed.exr")).row_bytes)
            self.assertGreater(max(pixel[1] for pixel in model.pixels().values()), 0.1)
        self.assertIn("<hres>1280</hres>", self.succeed("slab.ply", "--print-scene").stdout)

    def test_colours_of_a_gltf_file_are_srgb_whatever_their_depth(self):
        """And its numbers are not. The same texel of a colour in 8 and in 16 bits."""
        def png(depth):
            texel = struct.pack(">BBBB" if depth == 8 else ">HHHH", *(value * (1 if depth == 8 else 257)
                                                                    for value in (128, 64, 200, 255)))
            chunks = [(b"IHDR", struct.pack(">IIBBBBB", 1, 1, depth, 6, 0, 0, 0)),
                      (b"IDAT", zlib.compress(b"\0" + texel)), (b"IEND", b"")]
            return b"\x89PNG\r\n\x1a\n" + b"".join(
                struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
                for name, data in chunks)

        corners = struct.pack("<9f", -1, -1, 0, 1, -1, 0, 0, 1, 0) + struct.pack("<6f", 0, 0, 1, 0, 0, 1)
        seen = []
        for depth in (8, 16):
            self.write(f"{depth}.gltf", json.dumps({
                "asset": {"version": "2.0"},
                "buffers": [{"byteLength": 60, "uri": "data:;base64," + base64.b64encode(corners).decode()}],
                "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24}],
                "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                               "min": [-1, -1, 0], "max": [1, 1, 0]},
                              {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}],
                "images": [{"uri": "data:image/png;base64," + base64.b64encode(png(depth)).decode()}],
                "textures": [{"source": 0}],
                "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0},
                                                        "metallicRoughnessTexture": {"index": 0}}}],
                "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}],
                "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}], "scene": 0}))
            seen.append(Exr((self.succeed(f"{depth}.gltf", *OPTIONS, "--view", "front", "-o", f"{depth}.exr"),
                             self.read(f"{depth}.exr"))[1]).pixels())
        differences = [abs(a - b) for place in seen[0] for a, b in zip(seen[0][place], seen[1][place])]
        self.assertLess(max(differences), 0.004)
        middle = seen[0][48, 30]
        self.assertGreater(middle[2], 2 * middle[0])

    def test_a_turntable_is_a_full_turn(self):
        self.succeed("slab.ply", *OPTIONS, "--turntable", "4", "--transparent", "-o", "turn.#.exr")
        self.assertEqual([name for name in self.names() if name.startswith("turn")],
                         [f"turn.{frame}.exr" for frame in (1, 2, 3, 4)])
        pictures = [Exr(self.read(f"turn.{frame}.exr")) for frame in (1, 2, 3, 4)]
        shown = [{place for place, pixel in picture.pixels().items() if pixel[3] > 0} for picture in pictures]
        for i, (one, other) in enumerate(zip(shown, shown[1:])):
            self.assertGreater(len(one ^ other), 50, i)
        # As near in all of them, and in view.
        tops = [min(y for _, y in places) for places in shown]
        self.assertLess(max(tops) - min(tops), 10)
        for places in shown:
            self.assertGreater(len(places), 100)
            self.assertFalse({x for x, _ in places} & {0, 95})
            self.assertFalse({y for _, y in places} & {0, 53})
        self.succeed("slab.ply", *OPTIONS, "--turntable", "4", "--frames", "5", "--transparent", "-o", "again.exr")
        self.assertEqual(Exr(self.read("again.exr")).pixels(), pictures[0].pixels())

    def test_other_light(self):
        self.succeed("slab.ply", *OPTIONS, "-o", "studio.exr")
        studio = Exr(self.read("studio.exr"))
        with open(self.path("sky.exr"), "wb") as file:
            file.write(self.read("studio.exr"))  # any picture
        seen = [studio.row_bytes]
        for options in (["--environment", "sky"], ["--environment", "sky", "--sun", "100,10"], ["--sun", "-60,30"],
                        ["--environment", "sky.exr"], ["--environment", "sky.exr", "--sun", "-60,30"]):
            self.succeed("slab.ply", *OPTIONS, *options, "-o", "other.exr")
            other = Exr(self.read("other.exr"))
            self.assertGreater(max(pixel[1] for pixel in other.pixels().values()), 0.02)
            self.assertNotIn(other.row_bytes, seen)
            seen.append(other.row_bytes)
            self.write("printed.xml", self.succeed("slab.ply", *OPTIONS, *options, "--print-scene").stdout)
            self.succeed("printed.xml", "-q", "-o", "printed.exr")
            self.assertEqual(Exr(self.read("printed.exr")).row_bytes, other.row_bytes)

        self.assertEqual(self.run_program("slab.ply", "--environment", "sky.exr", "-o", "sky.exr").returncode, 2)

    def test_a_floor(self):
        self.succeed("slab.ply", *OPTIONS, "--transparent", "-o", "model.exr")
        self.succeed("slab.ply", *OPTIONS, "--floor", "--view", "30,15", "-o", "floor.exr")
        model, floor = (Exr(self.read(name)).pixels() for name in ("model.exr", "floor.exr"))
        below = [place for place, pixel in floor.items() if pixel[1] > 0.02 and model[place][3] == 0]
        self.assertGreater(len(below), 96 * 54 / 4)
        self.assertGreater(floor[0, 53][1], 0.02)
        # The model's shadow is on it.
        brightness = sorted(floor[place][1] for place in below)
        self.assertLess(brightness[len(brightness) // 100], brightness[len(brightness) // 2] / 1.5)
        printed = self.succeed("slab.ply", *OPTIONS, "--floor", "--print-scene").stdout
        self.assertIn('<point x="12" y="5" z="-0.75"/>', printed)
        self.write("printed.xml", printed)
        self.succeed("printed.xml", "-q", "-o", "printed.exr")
        self.assertEqual(Exr(self.read("printed.exr")).pixels(), floor)
        self.assertIn("--floor", self.fail_with(2, "printed.xml", "--floor", "-o", "a.exr"))

    def test_a_printed_scene_has_the_same_materials(self):
        """Also where the file has one of the floor's name."""
        self.write("a.mtl", "newmtl wood\nKd 0.5 0.3 0.1\nnewmtl floor\nKd 0.1 0.2 0.3\n")
        self.write("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl wood\nf 1 2 3\n"
                            "usemtl floor\nf 1 3 4\n")
        options = [*OPTIONS, "--aov", "material_id,object_id,crypto_material", "-o"]
        self.succeed("a.obj", "--floor", *options, "model.exr")
        self.write("printed.xml", self.succeed("a.obj", *OPTIONS, "--floor", "--print-scene").stdout)
        self.succeed("printed.xml", *options, "printed.exr")
        model, printed = (Exr(self.read(name)) for name in ("model.exr", "printed.exr"))
        self.assertEqual(printed.row_bytes, model.row_bytes)
        names = [json.loads(picture.text("raytrace:manifest/id.material"))[:3] for picture in (model, printed)]
        self.assertEqual(names, [["floor", "wood", "floor#2"]] * 2)

    def test_copies_of_a_mesh_stand_on_the_floor_and_are_in_view(self):
        """A disk of 64 triangles, 8,192 times, turned by 45 degrees, so that boxes around copies reach below it."""
        def data(*values):
            return struct.pack(f"<{len(values)}f", *values)

        circle = [(math.cos(k * math.pi / 32), math.sin(k * math.pi / 32), 0) for k in range(65)]
        places = [(i % 128 / 16, 3, i // 128 / 8) for i in range(8192)]
        turns = (0, 0, math.sin(math.pi / 8), math.cos(math.pi / 8)) * 8192
        parts = [data(0, 0, 0, *(x for point in circle for x in point)), data(*(x for p in places for x in p)),
                 data(*turns)]
        offsets = [sum(map(len, parts[:i])) for i in range(3)]
        uri = "data:application/octet-stream;base64," + base64.b64encode(b"".join(parts)).decode()
        self.write("disks.gltf", json.dumps({
            "asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}],
            "nodes": [{"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {
                "TRANSLATION": 1, "ROTATION": 2}}}}],
            "meshes": [{"primitives": [{"mode": 6, "attributes": {"POSITION": 0}}]}],
            "buffers": [{"uri": uri, "byteLength": sum(map(len, parts))}],
            "bufferViews": [{"buffer": 0, "byteOffset": offsets[i], "byteLength": len(parts[i])} for i in range(3)],
            "accessors": [{"bufferView": i, "componentType": 5126, "type": kind, "count": count}
                          for i, (kind, count) in enumerate([("VEC3", 66), ("VEC3", 8192), ("VEC4", 8192)])]}))
        printed = self.succeed("disks.gltf", *OPTIONS, "--floor", "--print-scene").stdout
        height = float(printed.split('<point x="')[1].split('y="')[1].split('"')[0])
        self.assertAlmostEqual(height, 2, delta=1e-6)
        self.succeed("disks.gltf", *OPTIONS, "--transparent", "--view", "front", "-o", "disks.exr")
        shown = [place for place, pixel in Exr(self.read("disks.exr")).pixels().items() if pixel[3] > 0]
        columns = [x for x, _ in shown]
        self.assertGreater(min(columns), 0)
        self.assertLess(max(columns), 95)
        self.assertGreater((max(columns) - min(columns)) / 96, 0.6)

    def test_a_transparent_picture_has_the_shadow_on_the_floor(self):
        self.succeed("slab.ply", *OPTIONS, "--transparent", "--aov", "depth,normal", "-o", "model.exr")
        self.succeed("slab.ply", *OPTIONS, "--transparent", "--aov", "depth,normal", "--floor", "-o", "shadow.exr",
                     "-o", "shadow.png")
        model, shadow = Exr(self.read("model.exr")), Exr(self.read("shadow.exr"))
        shadows = [pixel for place, pixel in shadow.pixels().items() if model.pixel(*place)[3] == 0]
        self.assertTrue(all(max(pixel[:3]) == 0 for pixel in shadows))
        self.assertGreater(max(pixel[3] for pixel in shadows), 0.3)
        self.assertTrue(any(pixel[3] == 0 for pixel in shadows))
        self.assertTrue(all(shadow.pixel(*place)[3] == 1 for place, pixel in model.pixels().items() if pixel[3] == 1))
        for y, row in model.rows.items():
            for name in set(row) - set("RGBA"):
                self.assertEqual(shadow.rows[y][name], row[name], name)
        self.assertEqual(Png(self.read("shadow.png")).channels, 4)
        self.write("printed.xml", self.succeed("slab.ply", *OPTIONS, "--floor", "--print-scene").stdout)
        self.succeed("printed.xml", "-q", "--transparent", "-o", "printed.exr")
        self.assertEqual(Exr(self.read("printed.exr")).pixels(), shadow.pixels())

    def write_gltf(self, cameras, lights, nodes):
        """A square from -1 to 1 that faces +z, of a matte white, and these."""
        data = struct.pack("<12f6H", -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, 0, 1, 2, 0, 2, 3)
        self.write("square.gltf", json.dumps({
            "asset": {"version": "2.0"}, "scenes": [{"nodes": list(range(1 + len(nodes)))}],
            "nodes": [{"mesh": 0}, *nodes], "cameras": cameras,
            "extensionsUsed": ["KHR_lights_punctual"], "extensions": {"KHR_lights_punctual": {"lights": lights}},
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
            "materials": [{"pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 1},
                           "extensions": {"KHR_materials_specular": {"specularFactor": 0}}}],
            "buffers": [{"byteLength": len(data),
                         "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
            "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                          {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}]}))

    def test_cameras_and_lights_of_the_file(self):
        self.write_gltf([{"type": "perspective", "name": "near", "perspective": {"yfov": 2 * math.atan(0.5), "znear": 1}},
                         {"type": "orthographic", "name": "plan",
                          "orthographic": {"xmag": 4, "ymag": 4, "znear": 0, "zfar": 9}}],
                        [{"type": "point", "intensity": 12, "color": [1, 0.5, 0]}],
                        [{"camera": 0, "translation": [0, 0, 4]}, {"camera": 1, "translation": [0, 0, 4]},
                         {"extensions": {"KHR_lights_punctual": {"light": 0}}, "translation": [0, 0, 2]}])
        options = ["square.gltf", "-q", "-r", "64x64", "-s", "4", "--transparent"]

        def shown(*more):
            self.succeed(*options, *more, "-o", "a.exr")
            picture = Exr(self.read("a.exr")).pixels()
            return picture, [place for place, pixel in picture.items() if pixel[3] > 0.5]

        # Half of the picture's height at a distance of 4, and a quarter of what the plan shows.
        picture, places = shown()
        self.assertEqual({x for x, _ in places}, set(range(16, 48)))
        self.assertEqual({y for _, y in places}, set(range(16, 48)))
        # The lamp's 12 candela at 2 units: an irradiance of 3, of which a white matte surface sends 1 / pi on. The sky has
        # 8 % of the brightest channel.
        red, green, blue, _ = picture[32, 32]
        sky = 0.08 * 3 / math.pi
        self.assertAlmostEqual(red, 3 / math.pi + sky, delta=0.02)
        self.assertAlmostEqual(green, 1.5 / math.pi + sky, delta=0.01)
        self.assertAlmostEqual(blue, sky, delta=0.01)
        self.assertEqual({x for x, _ in shown("--camera", "plan")[1]}, set(range(24, 40)))
        self.assertGreater(len(shown("--view", "front")[1]), 32 * 32)
        self.assertGreater(shown("--environment", "sky")[0][32, 32][2], 2 * sky)
        red, green, blue, _ = shown("--environment", "none")[0][32, 32]
        self.assertAlmostEqual(red, 3 / math.pi, delta=0.02)
        self.assertAlmostEqual(green, 1.5 / math.pi, delta=0.01)
        self.assertEqual(blue, 0)
        for camera in ("near", "plan"):
            self.succeed(*options, "--camera", camera, "-o", "model.exr")
            self.write("printed.xml", self.succeed(*options, "--camera", camera, "--print-scene").stdout)
            self.succeed("printed.xml", "-q", "--transparent", "-o", "printed.exr")
            self.assertEqual(Exr(self.read("model.exr")).row_bytes, Exr(self.read("printed.exr")).row_bytes)
        # Of several, the first, as one line says.
        said = "2 cameras; looks by 'near'; --camera NAME chooses"
        plain = ["square.gltf", "-r", "8x8", "-s", "1", "-o", "c.exr"]
        self.assertEqual(self.succeed(*plain).stderr.count(said), 1)
        self.assertNotIn("cameras;", self.succeed(*plain, "--camera", "plan").stderr)
        self.assertNotIn("cameras;", self.succeed(*plain, "--view", "top").stderr)
        # Other light takes the place of the file's, as one line says.
        for light in (["--environment", "sky"], ["--sun", "70,25"]):
            self.assertIn(f"its light is left out: {light[0]} lights it instead;", self.succeed(*plain, *light).stderr)
        self.assertNotIn("left out", self.succeed(*plain, "--environment", "none").stderr)
        message = self.fail_with(1, *options, "--camera", "far", "-o", "b.exr")
        self.assertIn("has no camera 'far'; there are 'near', 'plan'", message)

    def test_an_exposure_is_that_of_lamps_of_the_file(self):
        """It is exposed by its own brightness, unless it is said how."""
        options = ["square.gltf", "-q", "-r", "32x32", "-s", "4", "--view", "front", "--view-transform", "srgb"]
        seen = {}
        for intensity in (1, 64):
            self.write_gltf([], [{"type": "point", "intensity": intensity}],
                            [{"extensions": {"KHR_lights_punctual": {"light": 0}}, "translation": [0, 0, 2]}])
            for exposure in ([], ["--exposure", "0"], ["--exposure", "-6"], ["--exposure", "-6", "--auto-exposure"]):
                self.succeed(*options, *exposure, "-o", "a.png")
                png = Png(self.read("a.png"))
                self.assertEqual("raytrace:autoExposure" in png.text, exposure in ([], ["--exposure", "-6", "--auto-exposure"]))
                seen[intensity, *exposure] = png.rows
        self.assertEqual(seen[1, ], seen[64, ])
        self.assertEqual(seen[1, "--exposure", "0"], seen[64, "--exposure", "-6"])
        self.assertNotEqual(seen[64, "--exposure", "0"], seen[64, "--exposure", "-6"])
        self.assertEqual(seen[1, "--exposure", "-6", "--auto-exposure"], seen[64, "--exposure", "-6", "--auto-exposure"])

    def test_indirect_light_is_clamped_where_that_is_asked_for(self):
        model = ["slab.ply", *OPTIONS, "--floor"]

        def rendered(*options):
            self.succeed(*options, "-o", "a.exr")
            exr = Exr(self.read("a.exr"))
            return exr.row_bytes, sum(pixel[1] for pixel in exr.pixels().values())

        bits, light = rendered(*model)
        clamped_bits, clamped_light = rendered(*model, "--clamp-indirect", "0.001")
        self.assertLess(clamped_light, 0.99 * light)
        self.assertGreater(clamped_light, 0.3 * light)
        self.assertEqual(rendered(*model, "--clamp-indirect=0")[0], bits)
        self.write("printed.xml", self.succeed(*model, "--clamp-indirect", "0.001", "--print-scene").stdout)
        self.assertEqual(rendered("printed.xml", "-q")[0], clamped_bits)
        # It takes the place of what a scene says,
        self.assertEqual(rendered("printed.xml", "-q", "--clamp-indirect", "0")[0], bits)
        # and pieces know it.
        for tile, clamp in (("0/2", "0"), ("1/2", "0"), ("1/2", "0.001")):
            self.succeed(*model, "--tile", tile, "--clamp-indirect", clamp, "-o", f"{tile[0]}.{clamp}.exr")
        self.succeed(*model, "--tile", "1/2", "-o", "1.exr")
        self.succeed("merge", "-q", "0.0.exr", "1.0.exr", "-o", "merged.exr")
        self.succeed("merge", "-q", "0.0.exr", "1.exr", "-o", "merged.exr")
        self.assertIn("1.0.001.exr", self.fail_with(1, "merge", "0.0.exr", "1.0.001.exr", "-o", "merged.exr"))
        # Only paths have such light.
        self.assertIn("--clamp-indirect is of path tracing", self.fail_with(2, "scene.xml", "--clamp-indirect", "1", "-o", "b.exr"))
        self.assertIn("--clamp-indirect", self.fail_with(2, *model, "--integrator", "normals", "--clamp-indirect", "1", "-o", "b.exr"))
        self.assertIn("<clampindirect>2.5</clampindirect>",
                      self.succeed("scene.xml", "--integrator", "path", "--clamp-indirect", "2.5", "--print-scene").stdout)
        # A scene that leaves its integrator open, and has a lamp that needs paths.
        lamp = self.read("scene.xml").decode().replace(
            "<materials>", "<materials> <emissives> <emissive> <name>lamp</name> <ce red='1' green='1' blue='1'/> </emissive> </emissives>")
        self.write("lamp.xml", lamp)
        self.assertIn("<clampindirect>3</clampindirect>", self.succeed("lamp.xml", "--clamp-indirect", "3", "--print-scene").stdout)
        self.assertNotIn("<clampindirect>", self.succeed("lamp.xml", "--clamp-indirect", "0", "--print-scene").stdout)

    def test_the_shape_of_a_picture_is_the_cameras(self):
        self.write_gltf([{"type": "perspective", "name": "tall",
                          "perspective": {"yfov": 1, "znear": 1, "aspectRatio": 0.5625}},
                         {"type": "orthographic", "name": "plan",
                          "orthographic": {"xmag": 4, "ymag": 3, "znear": 0, "zfar": 9}},
                         {"type": "perspective", "name": "any", "perspective": {"yfov": 1, "znear": 1}},
                         {"type": "perspective", "name": "thread",
                          "perspective": {"yfov": 1, "znear": 1, "aspectRatio": 1e-30}}], [],
                        [{"camera": camera, "translation": [0, 0, 4]} for camera in range(4)])

        def size(*options):
            text = self.succeed("square.gltf", *options, "--print-scene").stdout
            return [int(text.split(f"<{name}>")[1].split("<")[0]) for name in ("hres", "vres")]

        self.assertEqual(size(), [720, 1280])
        self.assertEqual(size("--camera", "plan"), [1108, 832])
        self.assertEqual(size("--camera", "any"), [1280, 720])
        self.assertEqual(size("--camera", "thread"), [240, 3840])
        self.assertEqual(size("--view", "front"), [1280, 720])
        self.assertEqual(size("-r", "96x54"), [96, 54])
        self.assertEqual(size("--scale", "0.5"), [360, 640])
        # All that the camera sees is in it: 2 x 4 tan(yfov / 2) units of its height.
        self.succeed("square.gltf", "-q", "--scale", "0.1", "-s", "4", "--transparent", "-o", "tall.exr")
        rows = {place[1] for place, pixel in Exr(self.read("tall.exr")).pixels().items() if pixel[3] > 0.5}
        self.assertAlmostEqual(len(rows), 128 * 2 / (8 * math.tan(0.5)), delta=1)

    def test_fit_moves_cameras_of_files_and_scenes(self):
        self.write_gltf([{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}], [],
                        [{"camera": 0, "translation": [3, 0, 40]}])

        def sides(*options):
            self.succeed(*options, "-q", "--transparent", "-o", "fit.exr")
            shown = [place for place, pixel in Exr(self.read("fit.exr")).pixels().items() if pixel[3] > 0]
            columns, rows = zip(*shown)
            return min(columns), max(columns), min(rows), max(rows)

        model = ["square.gltf", "-r", "100x100", "-s", "4"]
        self.assertLess(sides(*model)[1], 50)  # small, on the left
        self.assertEqual(sides(*model, "--fit"), (4, 95, 4, 95))
        # A scene with the lamps of a studio, at the size that is asked for; and as it is printed.
        self.write("scene.xml", self.succeed("square.gltf", "--view", "front", "--print-scene").stdout)
        scene = ["scene.xml", "-r", "100x200", "-s", "4", "--fit"]
        left, right, top, bottom = sides(*scene)
        self.assertEqual((left, right), (4, 95))
        self.assertEqual(top + bottom, 199)
        self.write("fitted.xml", self.succeed(*scene, "--print-scene").stdout)
        bits = Exr(self.read("fit.exr")).row_bytes
        self.succeed("fitted.xml", "-q", "--transparent", "-o", "fit.exr")
        self.assertEqual(Exr(self.read("fit.exr")).row_bytes, bits)
        scene_text = self.read("scene.xml").decode()
        camera = scene_text[scene_text.index("<camera>"):scene_text.index("</camera>")]
        view = "".join(line for line in camera.splitlines() if not any(word in line for word in ("viewdistance", "<shift", "<nearclip")))
        self.write("around.xml", scene_text.replace(
            camera + "</camera>", view.replace("camera", "sphericalcamera") + "</sphericalcamera>"))
        self.assertIn("--fit", self.fail_with(2, "around.xml", "--fit", "-o", "a.exr"))

    def test_a_camera_of_the_file_does_not_see_the_studio(self):
        # Which lights as much as the one that others see.
        self.write_gltf([{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}], [],
                        [{"camera": 0, "translation": [0, 0, 4]}])
        lights = []
        for view in ([], ["--view", "front"]):
            self.succeed("square.gltf", "-q", "-r", "32x32", "-s", "64", *view, "-o", "a.exr")
            pixels = Exr(self.read("a.exr")).pixels()
            lights.append(sum(pixels[x, y][0] for x in range(12, 20) for y in range(12, 20)) / 64)
        self.assertAlmostEqual(lights[0] / lights[1], 1, delta=0.1)
        self.assertGreater(lights[0], 0.4)
        self.assertNotIn("rectangle", self.succeed("square.gltf", "--print-scene").stdout)
        self.assertIn("rectangle", self.succeed("square.gltf", "--view", "front", "--print-scene").stdout)

    def test_frames_of_an_animation(self):
        # A square of half the picture's height: it goes to the right by one square a second, then up.
        data = struct.pack("<12f6H", -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, 0, 1, 2, 0, 2, 3)
        data += struct.pack("<3f9f", 0, 1, 2, 0, 0, 0, 2, 0, 0, 2, 2, 0)
        self.write("moves.gltf", json.dumps({
            "asset": {"version": "2.0"}, "scenes": [{"nodes": [0, 1]}],
            "nodes": [{"mesh": 0, "translation": [-2, 0, 0]}, {"camera": 0, "translation": [0, 0, 5]}],
            "cameras": [{"type": "orthographic", "orthographic": {"xmag": 4, "ymag": 4, "znear": 0, "zfar": 9}}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
            "animations": [{"name": "go", "samplers": [{"input": 2, "output": 3}],
                            "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}],
            "buffers": [{"byteLength": len(data),
                         "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
            "bufferViews": [{"buffer": 0, "byteOffset": offset, "byteLength": length}
                            for offset, length in ((0, 48), (48, 12), (60, 12), (72, 36))],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                          {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
                          {"bufferView": 2, "componentType": 5126, "count": 3, "type": "SCALAR"},
                          {"bufferView": 3, "componentType": 5126, "count": 3, "type": "VEC3"}]}))
        options = ["moves.gltf", "-q", "-r", "64x64", "-s", "4", "--transparent"]

        def corner(file):
            """The column and the row of the square's upper left pixel."""
            shown = [place for place, pixel in Exr(self.read(file)).pixels().items() if pixel[3] > 0.5]
            self.assertEqual(len(shown), 16 * 16)
            return min(shown)

        self.succeed(*options, "-o", "rest.exr")
        self.assertEqual(corner("rest.exr"), (8, 24))
        self.succeed(*options, "--animation", "go", "-o", "rest.exr")
        self.assertEqual(corner("rest.exr"), (24, 24))
        self.succeed(*options, "--frames", "1-37:12", "-o", "a.##.exr")
        self.assertEqual([corner(f"a.{frame:02}.exr") for frame in (1, 13, 25, 37)],
                         [(24, 24), (32, 24), (40, 24), (40, 16)])
        self.succeed(*options, "--frames", "2-4", "--fps", "2", "-o", "a.##.exr")
        self.assertEqual([corner(f"a.{frame:02}.exr") for frame in (2, 3, 4)], [(32, 24), (40, 24), (40, 16)])
        # On a turntable it is at rest, unless it is asked to move.
        turned = [*options, "--turntable", "4", "--frames", "2", "--print-scene"]
        self.assertNotIn("<animation>", self.succeed(*turned).stdout)
        self.assertIn("<time>0.5</time>", self.succeed(*turned, "--fps", "2").stdout)
        # A camera of ours has all of the movement in view, and stands still.
        views = [self.succeed(*options, "--view", "front", "--frames", str(frame), "--print-scene").stdout
                 for frame in (1, 25)]
        cameras = [view[view.index("<camera>"):view.index("</camera>")] for view in views]
        self.assertEqual(*cameras)
        # As a scene it has the same bits, and its time is the scene's to say.
        printed = self.succeed(*options, "--frames", "31", "--print-scene").stdout
        self.assertIn("<animation>0</animation>\n", printed)
        self.assertIn("<time>1.25</time>\n", printed)
        self.write("printed.xml", printed)
        self.succeed("printed.xml", "-q", "--transparent", "-o", "printed.exr")
        self.succeed(*options, "--frames", "31", "-o", "model.exr")
        self.assertEqual(Exr(self.read("model.exr")).row_bytes, Exr(self.read("printed.exr")).row_bytes)
        self.write("keys.xml", printed.replace(
            "<time>1.25</time>", '<time> <key frame="1" value="0"/> <key frame="3" value="2"/> </time>'))
        self.succeed("keys.xml", "-q", "--transparent", "--frames", "2", "-o", "keys.exr")
        self.assertEqual(corner("keys.exr"), (40, 24))
        self.assertIn("has no animation 'run'; there are 'go'",
                      self.fail_with(1, *options, "--animation", "run", "-o", "b.exr"))
        self.assertIn("has no material variant 'red', nor any other",
                      self.fail_with(1, *options, "--variant", "red", "-o", "b.exr"))
        self.assertIn("is no rate of frames", self.fail_with(2, *options, "--fps", "0", "-o", "b.exr"))
        self.assertIn("--fps", self.fail_with(2, "printed.xml", "--fps", "25", "-o", "b.exr"))
        self.assertIn("it is no glTF", self.fail_with(1, "slab.ply", "--animation", "go", "-o", "b.exr"))

    def test_a_compressed_model(self):
        with gzip.open(self.path("slab.ply.gz"), "wb") as file:
            file.write(PLY.encode())
        for name in ("slab.ply", "slab.ply.gz"):
            self.succeed(name, *OPTIONS, "-o", "{scene}.exr")
        self.assertEqual(Exr(self.read("slab.exr")).row_bytes, Exr(self.read("slab.ply.exr")).row_bytes)

    def test_several_models_are_several_pictures(self):
        self.write("other.ply", PLY.replace("10.1 8", "10.1 12"))
        self.succeed("slab.ply", "other.ply", *OPTIONS, "-o", "{scene}.png")
        self.assertNotEqual(self.read("slab.png"), self.read("other.png"))
        self.assertEqual(self.succeed("slab.ply", "--validate").returncode, 0)

    def test_what_is_wrong_is_said(self):
        self.write("broken.ply", PLY[:-30])
        for arguments, code, text in (
                (["broken.ply", "-o", "a.png"], 1, "broken.ply"),
                (["missing.glb", "-o", "a.png"], 1, "missing.glb"),
                (["scene.xml", "--view", "top", "-o", "a.png"], 2, "scene.xml has a camera"),
                (["slab.ply", "--view", "tpo", "-o", "a.png"], 2, "did you mean 'top'?"),
                (["slab.ply", "--view", "30,95", "-o", "a.png"], 2, "from -90 to 90"),
                (["slab.ply", "--up", "x", "-o", "a.png"], 2, "is not one of y, z"),
                (["scene.xml", "--sun", "1,1", "-o", "a.png"], 2, "scene.xml has a camera"),
                (["slab.ply", "--sun", "10,-5", "-o", "a.png"], 2, "no place of a sun"),
                (["slab.ply", "--turntable", "0", "-o", "a.png"], 2, "from 1 to"),
                (["slab.ply", "--turntable", "8", "-o", "a.png"], 2, "more than one render would write"),
                (["slab.ply", "--environment", "none.exr", "-o", "a.png"], 1, "none.exr"),
                (["slab.ply", "-D", "a=1", "-o", "a.png"], 2, "no variables"),
                (["slab.ply", "-o", "slab.ply"], 2, "slab.ply")):
            with self.subTest(arguments=arguments):
                done = self.run_program(*arguments)
                self.assertIn(text, done.stderr)
                self.assertEqual(done.returncode, code, done.stderr)
                self.assertNotIn("a.png", self.names())


if __name__ == "__main__":
    unittest.main()
