"""--clay: what a picture of it is, of scenes and of models, and that it is another picture than one without."""

import json
import re
import unittest

from exr import Exr
from support import CommandTest

MATTE = "<ka>0.5</ka><kd>1</kd><cd red='{0}' green='{1}' blue='{2}'/>"
SCENE = """<raytracer>{integrator}
<viewplane><hres>24</hres><vres>16</vres><samples>4</samples></viewplane>
<camera><eye x='0' y='2' z='6'/><lookat x='0' y='0' z='0'/><fov>40</fov></camera>
<lights><ambientlight><scaleradiance>0.2</scaleradiance><color red='1' green='1' blue='1'/></ambientlight>
<pointlights><pointlight><location x='3' y='5' z='4'/><scaleradiance>3</scaleradiance>
<color red='1' green='1' blue='1'/></pointlight></pointlights></lights>
<textures><checkers><checker><name>holes</name><uvscale x='8' y='4'/></checker></checkers></textures>
<materials>{materials}</materials>
<objects><planes><plane><point x='0' y='-1' z='0'/><normal x='0' y='1' z='0'/><material>floor</material></plane></planes>
<spheres><sphere><center x='-1' y='0' z='0'/><radius>0.9</radius><material>ball</material></sphere>
<sphere><center x='1' y='0' z='0'/><radius>0.9</radius><material>veil</material></sphere></spheres></objects>
</raytracer>"""
OPACITY = "<opacity texture='holes'/>"
COLORED = (f"<mattes><matte><name>floor</name>{MATTE.format(1, 0.2, 0.1)}</matte></mattes>"
           "<phongs><phong><name>ball</name><ka>0.3</ka><kd>0.6</kd><ks>0.4</ks><exp>30</exp>"
           "<cd red='0' green='1' blue='0' texture='holes'/><cs red='1' green='1' blue='1'/>"
           "<bump texture='holes' height='0.1'/></phong>"
           "<phong><name>veil</name><ka>0.3</ka><kd>0.6</kd><ks>0.4</ks><exp>30</exp><cd red='0' green='0' blue='1'/>"
           f"<cs red='1' green='1' blue='1'/>{OPACITY}</phong></phongs>")
GREY = MATTE.format(0.5, 0.5, 0.5)
BY_HAND = (f"<mattes><matte><name>floor</name>{GREY}</matte><matte><name>ball</name>{GREY}</matte>"
           f"<matte><name>veil</name>{GREY}{OPACITY}</matte></mattes>")
INTEGRATORS = ("raycast", "path", "ambientocclusion", "normals", "uv", "albedo")


class Clay(CommandTest):
    def setUp(self):
        super().setUp()
        for name, materials in (("colored", COLORED), ("by_hand", BY_HAND)):
            self.write(f"{name}.xml", SCENE.format(integrator="<integrator><raycast/></integrator>", materials=materials))

    def bits(self, *options):
        self.succeed("-q", "--float", *options, "-o", "a.exr")
        return Exr(self.read("a.exr")).row_bytes

    def test_it_is_the_scene_with_grey_materials(self):
        for integrator in INTEGRATORS:
            with self.subTest(integrator=integrator):
                options = ["--integrator", integrator]
                self.assertEqual(self.bits("colored.xml", "--clay", *options), self.bits("by_hand.xml", *options))
        self.assertNotEqual(self.bits("colored.xml", "--clay"), self.bits("colored.xml"))
        # What is printed is what is rendered.
        self.write("printed.xml", self.succeed("colored.xml", "--clay", "--print-scene").stdout)
        self.assertEqual(self.bits("printed.xml"), self.bits("by_hand.xml"))

    def test_the_default_integrator_is_that_of_the_materials(self):
        mirror = "<mirrors><mirror><name>{}</name><cr red='1' green='1' blue='1'/></mirror></mirrors>"
        self.write("open.xml", SCENE.format(integrator="", materials=COLORED + mirror.format("unused")))
        self.write("paths.xml", SCENE.format(integrator="<integrator><path/></integrator>", materials=BY_HAND))
        self.assertEqual(self.bits("open.xml", "--clay"), self.bits("paths.xml"))

    def test_materials_that_are_named_stay(self):
        self.assertEqual(self.bits("colored.xml", "--clay=floor,ball,veil"), self.bits("colored.xml"))
        kept = self.bits("colored.xml", "--clay=ball")
        self.assertNotIn(kept, (self.bits("colored.xml"), self.bits("colored.xml", "--clay")))
        self.assertIn("--clay: there is no material 'balll'; did you mean 'ball'?",
                      self.fail_with(2, "colored.xml", "--clay=balll", "-o", "b.exr"))
        self.assertIn("there are 'floor', 'ball', 'veil'", self.fail_with(2, "colored.xml", "--clay=glass", "--validate"))
        self.assertIn("has a name that is empty", self.fail_with(2, "colored.xml", "--clay=ball,", "-o", "b.exr"))
        self.assertIn("--clay=ball", self.fail_with(2, "colored.xml", "--clay", "ball", "-o", "b.exr"))
        self.assertIn("did you mean '--clay'?", self.fail_with(2, "colored.xml", "--override-material", "-o", "b.exr"))
        self.assertNotIn("b.exr", self.names())

    def test_it_is_another_picture(self):
        for tile, options in (("0/2", ["--clay"]), ("1/2", ["--clay"]), ("1/2", []), ("1/2", ["--clay=ball"])):
            self.succeed("-q", "colored.xml", "--tile", tile, *options, "-o", f"{tile[0]}{''.join(options)}.exr")
        self.succeed("merge", "-q", "0--clay.exr", "1--clay.exr", "-o", "merged.exr")
        for other in ("1.exr", "1--clay=ball.exr"):
            self.assertIn(other, self.fail_with(1, "merge", "0--clay.exr", other, "-o", "b.exr"))
        # An output without it does not count as there.
        self.succeed("-q", "colored.xml", "-o", "a.exr")
        before = self.read("a.exr")
        self.succeed("-q", "colored.xml", "--skip-existing", "-o", "a.exr")
        self.assertEqual(self.read("a.exr"), before)
        self.succeed("-q", "colored.xml", "--skip-existing", "--clay", "-o", "a.exr")
        self.assertNotEqual(Exr(self.read("a.exr")).row_bytes, Exr(before).row_bytes)

    def test_models_are_of_clay_too(self):
        square = {"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
                  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
                  "materials": [{"name": "paint", "pbrMetallicRoughness": {"baseColorFactor": [1, 0.1, 0, 1]}}],
                  "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,"
                               "AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAAAAAAAAgD8AAAAA"}],
                  "bufferViews": [{"buffer": 0, "byteLength": 36}],
                  "accessors": [{"bufferView": 0, "type": "VEC3", "componentType": 5126, "count": 3}]}
        self.write("a.gltf", json.dumps(square))
        model = ["a.gltf", "-r", "32x18", "-s", "16", "--view", "front", "--integrator", "albedo"]
        pixel = lambda *options: (self.bits(*model, *options), Exr(self.read("a.exr")).pixels()[16, 9])[1]
        self.assertEqual([round(c, 6) for c in pixel("--clay")[:3]], [0.5, 0.5, 0.5])
        self.assertEqual(pixel("--clay=paint"), pixel())
        self.assertGreater(pixel()[0], 5 * pixel()[1])
        # In a scene with other things, as well.
        self.write("with.xml", re.sub("<objects>", "<objects><models><model><file>a.gltf</file></model></models>",
                                      SCENE.format(integrator="", materials=BY_HAND)))
        self.assertNotEqual(self.bits("with.xml", "--clay"), self.bits("with.xml", "--clay=paint"))


if __name__ == "__main__":
    unittest.main()
