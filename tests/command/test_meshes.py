"""Meshes: where their files are looked for, what happens without them, and that pieces know them."""

import base64
import json
import math
import os
import struct

from exr import Exr
from support import CommandTest

SCENE = """<raytracer>
  <viewplane> <hres>48</hres> <vres>32</vres> <samples>2</samples> </viewplane>
  <camera> <eye x="0" y="0" z="5"/> <lookat x="0" y="0" z="0"/> <viewdistance>60</viewdistance> </camera>
  <lights> <ambientlight/> </lights>
  <objects> <instances> <instance> <group>all</group> </instance> </instances> </objects>
  <groups> <group> <name>all</name> <objects> <meshes> <mesh> <file>%s</file> </mesh> </meshes> </objects> </group> </groups>
</raytracer>
"""
PLY = """ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
property uchar red
property uchar green
property uchar blue
element face 1
property list uchar int vertex_indices
end_header
-1 -1 0 255 0 0
1 -1 0 255 0 0
0 1 0 255 %d 0
3 0 1 2
"""


class Meshes(CommandTest):
    def setUp(self):
        super().setUp()
        os.makedirs(self.path("there/models"))
        self.write("there/scene.xml", SCENE % "models/one.ply")
        self.write("there/models/one.ply", PLY % 0)

    def render(self, scene, name, *options):
        self.succeed(scene, "-q", "-o", name, *options)
        return Exr(self.read(name)).rows

    def test_files_are_relative_to_the_scene_and_its_printed_form_is_the_same_scene(self):
        wanted = self.render("there/scene.xml", "a.exr")
        middle = [wanted[16][channel][24] for channel in "RGB"]
        self.assertGreater(middle[0], 0.9)
        self.assertEqual(middle[1:], [0, 0])
        self.write("printed.xml", self.succeed("there/scene.xml", "--print-scene").stdout)
        self.assertEqual(self.render("printed.xml", "b.exr"), wanted)

    def test_empty_files_of_a_series_are_left_out_with_a_warning(self):
        head = "ply\nformat ascii 1.0\nelement vertex %d\nproperty float x\nproperty float y\nproperty float z\n"
        self.write("there/models/one.ply", head % 0 + "element face 0\nproperty list uchar int vertex_indices\nend_header\n")
        cloud = "<sphereclouds><spherecloud><file>models/none.ply</file><radius>1</radius></spherecloud></sphereclouds>"
        self.write("there/models/none.ply", head % 0 + "end_header\n")
        self.write("there/scene.xml", SCENE.replace("</instances>", "</instances>" + cloud) % "models/one.ply")
        done = self.succeed("there/scene.xml", "-o", "a.exr", "--progress=none")
        self.assertRegex(done.stderr, r"there/scene\.xml:6:\d+: warning: there/models/one\.ply: has no faces; it is left out")
        self.assertRegex(done.stderr, r"there/scene\.xml:5:\d+: warning: there/models/none\.ply: has no points; it is left out")
        self.assertEqual({value for row in Exr(self.read("a.exr")).rows.values() for value in row["R"]}, {0})
        self.assertIn("has no faces", self.fail_with(1, "there/models/one.ply", "-o", "a.exr"))
        self.write("there/models/none.ply", head % 1 + "end_header\nnan nan nan\n")
        self.assertIn("has no points that can be rendered", self.fail_with(1, "there/scene.xml", "-o", "a.exr"))

    def test_a_missing_mesh_is_an_error_where_the_scene_names_it(self):
        os.remove(self.path("there/models/one.ply"))
        for option in (["--validate"], ["-o", "a.png"]):
            message = self.fail_with(1, "there/scene.xml", *option)
            self.assertIn("there/scene.xml:6:69: error: there/models/one.ply: cannot read it: No such file", message)
        self.assertFalse(os.path.exists(self.path("a.png")))

    def test_what_is_wrong_in_a_mesh_has_its_own_line(self):
        self.write("there/models/one.ply", (PLY % 0).replace("3 0 1 2", "3 0 1 7"))
        self.assertIn("there/models/one.ply:16: error", self.fail_with(1, "there/scene.xml", "--validate"))

    def test_an_output_is_no_mesh_of_the_scene(self):
        os.rename(self.path("there/models/one.ply"), self.path("there/models/one.png.ply"))
        self.write("there/scene.xml", SCENE % "models/one.png.ply")
        os.symlink("one.png.ply", self.path("there/models/link.exr"))
        self.fail_with(2, "there/scene.xml", "-o", "there/models/link.exr")
        self.assertTrue(self.read("there/models/one.png.ply").startswith(b"ply"))

    def test_a_scene_that_includes_another_is_that_one_and_does_not_overwrite_it(self):
        self.write("main.xml", "<raytracer> <include> <file>there/scene.xml</file> </include> </raytracer>")
        self.assertEqual(self.render("main.xml", "a.exr"), self.render("there/scene.xml", "b.exr"))
        os.symlink("scene.xml", self.path("there/link.exr"))
        self.fail_with(2, "main.xml", "-o", "there/link.exr")
        os.remove(self.path("there/models/one.ply"))
        message = self.fail_with(1, "main.xml", "--validate")
        self.assertIn("there/scene.xml:6:69: error: there/models/one.ply: cannot read it: No such file", message)

    def test_pieces_with_another_mesh_are_not_merged(self):
        self.render("there/scene.xml", "1.exr", "--tile", "0/2")
        self.write("there/models/one.ply", PLY % 1)
        self.render("there/scene.xml", "2.exr", "--tile", "1/2")
        self.assertIn("scene", self.fail_with(1, "merge", "1.exr", "2.exr", "-o", "all.exr"))


class ModelsOfScenes(CommandTest):
    """<model>: a mesh and the lights of its file."""

    def setUp(self):
        super().setUp()
        data = struct.pack("<9f3H", -1, -1, 0, 1, -1, 0, 0, 1, 0, 0, 1, 2)
        self.write("lamp.gltf", json.dumps({
            "asset": {"version": "2.0"}, "scenes": [{"nodes": [0, 1]}],
            "nodes": [{"mesh": 0},
                      {"extensions": {"KHR_lights_punctual": {"light": 0}}, "translation": [0, 0, 2]}],
            "extensionsUsed": ["KHR_lights_punctual"],
            "extensions": {"KHR_lights_punctual": {"lights": [
                {"type": "spot", "intensity": 12, "spot": {"innerConeAngle": 0.2, "outerConeAngle": 0.6}}]}},
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
            "materials": [{"pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 1}}],
            "buffers": [{"byteLength": len(data),
                         "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                          {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}]}))
        self.write("tile.obj", "mtllib tile.mtl\nv 1 0 0\nv 2 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
                               "usemtl a\nf 1/1 2/2 3/3\n")
        self.write("tile.mtl", "newmtl a\nKd 1 1 1\nmap_Kd wood.png\n")
        scene = SCENE[:SCENE.index("  <objects>")] + """  <objects> <models>
    <model> <file>lamp.gltf</file> <transform> <rotate x="0" y="1" z="0" angle="20"/> </transform> </model>
    %s
  </models> </objects>
</raytracer>
"""
        self.write("plain.xml", scene % "")
        self.write("scene.xml", scene % "<model> <file>tile.obj</file> </model>")
        self.succeed("plain.xml", "-q", "-o", "wood.png")

    def test_it_is_lit_by_its_own_lights_and_its_printed_form_has_the_same_bits(self):
        self.succeed("scene.xml", "-q", "-o", "a.exr")
        picture = Exr(self.read("a.exr"))
        # 12 candela at a distance of 2, 20 degrees from the normal, on white; the ambient light does not reach it.
        self.assertAlmostEqual(picture.pixels()[24, 16][1], 3 * math.cos(math.radians(20)) / math.pi, delta=0.1)
        printed = self.succeed("scene.xml", "--print-scene").stdout
        self.assertIn("<spotlight>", printed)
        self.assertNotIn("<model", printed)
        self.write("printed.xml", printed)
        self.succeed("printed.xml", "-q", "-o", "b.exr")
        self.assertEqual(Exr(self.read("b.exr")).row_bytes, picture.row_bytes)

    def test_pieces_with_another_light_are_not_merged(self):
        self.succeed("plain.xml", "-q", "-o", "1.exr", "--tile", "0/2")
        self.write("lamp.gltf", self.read("lamp.gltf").decode().replace('"intensity": 12', '"intensity": 13'))
        self.succeed("plain.xml", "-q", "-o", "2.exr", "--tile", "1/2")
        self.assertIn("scene", self.fail_with(1, "merge", "1.exr", "2.exr", "-o", "all.exr"))

    def test_an_output_is_no_file_of_a_model(self):
        os.symlink("lamp.gltf", self.path("lamp.exr"))
        for output, role in (("lamp.exr", "a model"), ("wood.png", "a texture")):
            before = self.read(output)
            self.assertIn(role, self.fail_with(2, "scene.xml", "-o", output))
            self.assertEqual(self.read(output), before)
