"""What the program says of pictures that are black, or shown too dark or too bright."""

import re
import unittest

from support import CommandTest

SCENE = """<raytracer>
  <viewplane> <hres>16</hres> <vres>12</vres> <samples>4</samples> </viewplane>
  <camera> <eye x="0" y="0" z="5"/> <lookat x="0" y="0" z="0"/> <fov>40</fov> </camera>
  <lights> <pointlights> <pointlight> <location x="0" y="0" z="9"/> </pointlight> </pointlights> </lights>
  <materials>
    <mattes> <matte> <name>m</name> <ka>0</ka> <kd>1</kd> <cd red="0.8" green="0.8" blue="0.8"/> </matte> </mattes>
    <emissives> <emissive> <name>lamp</name> <ce red="1" green="1" blue="1"/> </emissive> </emissives>
  </materials>
  <objects>
    <spheres> <sphere> <center x="0" y="0" z="0"/> <radius>3</radius> <material>m</material> </sphere> </spheres>
  </objects>
</raytracer>"""
LIGHTS = re.compile("<lights>.*</lights>")


class Brightness(CommandTest):
    def said_of(self, scene, *arguments, output="a.png"):
        self.write("scene.xml", scene)
        return self.succeed("scene.xml", "-o", output, "--progress=none", *arguments).stderr

    def assert_warning(self, text, said):
        self.assertEqual(said, f"raytrace: warning: {text}\n")

    def test_a_picture_that_shows_something_is_not_spoken_of(self):
        self.assertEqual(self.said_of(SCENE), "")

    def test_no_light(self):
        dark = LIGHTS.sub("", SCENE)
        text = ("the picture will be black: the scene has no light; add one to <lights>, or an object of an <emissive> "
                "material")
        self.assert_warning(text, self.said_of(dark))
        self.assert_warning(text, self.said_of(dark, "--integrator", "path"))
        self.assertEqual(self.said_of(dark, "--integrator", "normals"), "")
        self.assertEqual(self.said_of(dark, "-q"), "")
        self.assertEqual(self.said_of(dark.replace("<material>m", "<material>lamp")), "")
        shining = dark.replace("</samples>", "</samples> <background red='0.1' green='0.1' blue='0.1'/>")
        self.assertEqual(self.said_of(shining.replace("<radius>3", "<radius>1")), "")

    def test_the_camera_looks_the_other_way(self):
        self.assert_warning("the picture is black: all objects are behind the camera; move its <eye> or <lookat>",
                            self.said_of(SCENE.replace('<lookat x="0" y="0" z="0"', '<lookat x="0" y="0" z="10"')))

    def test_the_camera_looks_past_everything(self):
        aside = SCENE.replace('<lookat x="0"', '<lookat x="20"')
        text = "the picture is black: no object is in view; move the camera's <eye> or <lookat>"
        self.assert_warning(text, self.said_of(aside))
        self.assert_warning(text, self.said_of(aside, "--integrator", "normals"))
        self.assertEqual(self.said_of(aside, "--crop", "0,0,8,8"), "")

    def test_no_light_reaches_what_is_in_view(self):
        inside = SCENE.replace("<radius>3", "<radius>6")  # and the lamp is outside
        text = ("the picture is black: no light reaches what is in view; a light or the camera may be inside an object: "
                "--integrator normals shows what is in view")
        for integrator in ("raycast", "path"):
            self.assert_warning(text, self.said_of(inside, "--integrator", integrator))

    def test_the_exposure_that_is_offered_shows_the_picture(self):
        for color, what in (("1e-5", "the picture is nearly black: its brightest pixel has "),
                            ("1e5", "nearly all of the picture is much brighter than white; ")):
            scene = SCENE.replace('z="9"/>', f'z="9"/> <scaleradiance>{color}</scaleradiance>')
            scene = scene.replace("<radius>3", "<radius>4")
            said = self.said_of(scene)
            self.assertIn(f"raytrace: warning: {what}", said)
            exposure = re.search(r"--exposure (\S+) shows it", said).group(1)
            self.assertEqual(self.said_of(scene, "--exposure", exposure), "")

    def test_the_exposure_of_a_picture_that_sets_its_own_is_not_spoken_of(self):
        dim = SCENE.replace('z="9"/>', 'z="9"/> <scaleradiance>1e-5</scaleradiance>')
        self.assertEqual(self.said_of(dim, "--auto-exposure", "--exposure", "3"), "")

    def test_lights_that_give_nothing_are_none(self):
        self.assertIn("the scene has no light",
                      self.said_of(SCENE.replace('z="9"/>', 'z="9"/> <scaleradiance>0</scaleradiance>')))

    def test_black_is_no_fault_where_it_is_meant(self):
        black = SCENE.replace('<cd red="0.8" green="0.8" blue="0.8"/>', '<cd red="0" green="0" blue="0"/>')
        self.assertEqual(self.said_of(black, "--integrator", "albedo"), "")
        # Shadows alone.
        caught = SCENE.replace('<material>m</material> </sphere>',
                               '<shadowcatcher>true</shadowcatcher> <material>m</material> </sphere> <sphere> <center x="0" y="0" z="6"/> '
                               '<radius>0.5</radius> <visible>false</visible> <material>m</material> </sphere>')
        self.assertEqual(self.said_of(caught, "--transparent"), "")
        # A white ground.
        white = SCENE.replace("</samples>", '</samples> <background red="1.1" green="1.1" blue="1.1"/>')
        self.assertEqual(self.said_of(white.replace("<radius>3", "<radius>0.05")), "")

    def test_a_file_of_radiance_cannot_be_too_bright(self):
        bright = SCENE.replace('z="9"/>', 'z="9"/> <scaleradiance>1e5</scaleradiance>').replace("<radius>3", "<radius>4")
        self.assertEqual(self.said_of(bright, output="a.exr"), "")
        self.assertEqual(self.said_of(bright.replace("1e5", "1e-5"), output="a.exr"), "")
        self.assertEqual(self.said_of(bright.replace("</samples>", "</samples> <viewtransform>agx</viewtransform>")), "")


if __name__ == "__main__":
    unittest.main()
