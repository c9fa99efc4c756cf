"""Meshes: where their files are looked for, what happens without them, and that pieces know them."""

import os

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
