"""Files of densities, as smoke and clouds have them: where they are looked for, what they hold, and what is wrong."""

import base64
import math
import os
import struct
import zlib

from exr import Exr
from support import CommandTest

SCENE = """<raytracer>
  <viewplane> <hres>32</hres> <vres>32</vres> <samples>64</samples> <background red="1" green="1" blue="1"/> </viewplane>
  <camera> <eye x="1.15" y="3.5" z="40"/> <lookat x="1.15" y="3.5" z="11"/> <fov>0.01</fov> </camera>
  <integrator> <path/> </integrator>
  <materials>
    <fogs> <fog> <name>smoke</name> <meanfreepath>20</meanfreepath> <color red="0" green="0" blue="0"/> FOG </fog> </fogs>
  </materials>
  <objects>
    <boxes> <box> <min x="-10" y="-10" z="-10"/> <max x="20" y="20" z="30"/> <material>smoke</material> </box> </boxes>
  </objects>
</raytracer>
"""

# Made by OpenVDB 10: "heat", 2 from (0, 0, 0) to (7, 7, 7) in units of 1; and "density" of 12 x 10 x 9 points from
# (-5, 3, 20) on, which are 1 + the number along x, but in the last layer along z 0.5, under a map that makes (i, j, k)
# the place (0.1 i + 1, 0.2 j + 2, 0.4 k + 3).
VDB = (
    b"eNrt3L9rE2EYB/D30qStWk3UiliEREQRJDSxbZrqkFRFCioJtZbiclySN3qQXEruGlpByN6lIIhuXd0dFBy6Cv4D4tLJuUM3h/g8d5c2SZs2EP"
    b"tD+/3Am+fu7Zvec0/SdygPF7r/cFaQdRqnhUPJRCLxvIzGwpocz4VHx2N3wpmJkYlwfjyai+XHxsZjE3Fe6KHhpfFKalaA4kxZSjVfKGmWOqaO"
    b"qiO8Zsn9pW9uNsdeGn00ztLI6wWpZjKlRbWoLfpooiKzI/qAu6Jv95W60bSyUaC+Mlsqzpelaeolg69nWmXdeHmJjjKFkpkN3Q5pWUuvyFBFKy"
    b"xI83z9bTlZ0JZkTqU7yfFV1foMT/AFztVXFmVRzSxZ0uRcdMOKjfbTQeSjtzmPSmlRFiibBcNqWmhX0C2ioRXldpL1svopPjf0fKlcfJbVCvKp"
    b"Nu+8ZSNxsHF9R1QaKqy0VLz1HAAAAAAAAAAAAAAAAAAAAP5BATd6lBG790FpmIOTC40hJ9xgw8bAO4N3ey7JXV05aZi6tdSufeyz2y42azrx+6"
    b"ITO2sf41Ucr4r92sd+12q1Hje1A20fe0AT/S01GrbrE/VWKVbdc07kMhcpLV5Q0aKvxVuv8CtiLm2/ZZ8OtKmVU1vb8p4daHGnU22XDrSGD4fv"
    b"zO4+mylrhlnQrJ1taCLphP7k6gf2JeHEb4n3dvyRaDfPla/VriedeDHp7Bje5KZ9PufGeLLHnr+ytc6JPe76zab2NLutbqNWw58fAAAAAAAAwO"
    b"HBfwEBAAAAAAAA4MChPe1kGhADKAL81Y1hg3UQ2wmyDuKxuTj+ewsAAAAAAAAAAAAAAAAAAPAfaNckge4aAGwMu3VPddqo1K5xqdNGpV0bl470"
    b"4nvrLJWprcJGvStUVR48x08Fi/AFqdSfglWa9f8USpAfguW/J8RwdZWOgvwsLH+KhkfcSCfZHgl1dm/TDQlt0q/nMe0mdNdN6FeqSnzC47+g9K"
    b"b4snz8SCjKoEitEjrl3HxCFX6fmLJTS3RXKCEOrVYdfwkOtFbdfbXLW6ld80Y8VB+PM8epnXFTM50nzLWc3uLTNa7YuuL8QAQD/BLilwi9DFFl"
    b"nQryFsB1HgxOKuJxepJ1/Ve13JD6V0qbx3JL6u+aU3dPuebqGqFqKql1wrVWRG8qQOg4FSIcI4TiE+fzsG/GfgifalffJ4ZSfCs+odn3lOh2mz"
    b"nCj6PrHe4Yfhx/AOEciS4="
)


def vdb():
    return zlib.decompress(base64.b64decode(VDB))


def vol(numbers=(0.5, 1.5), size=(1, 1, 2), box=(0, 0, 0, 4, 5, 10)):
    return b"VOL\x03" + struct.pack(f"<5i6f{len(numbers)}f", 1, *size, 1, *box, *numbers)


class Densities(CommandTest):
    def put(self, name, data):
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        with open(self.path(name), "wb") as file:
            file.write(data)

    def scene(self, fog):
        os.makedirs(self.path("there"), exist_ok=True)
        self.write("there/scene.xml", SCENE.replace("FOG", fog))

    def left(self, *options):
        """Of the light behind the fog."""
        self.succeed("there/scene.xml", "-q", "-o", "a.exr", *options)
        rows = Exr(self.read("a.exr")).rows.values()
        return sum(sum(row["R"]) for row in rows) / 32**2

    def check_depth(self, fog, depth):
        self.scene(fog)
        wanted = math.exp(-depth)
        self.assertAlmostEqual(self.left(), wanted, delta=4 * math.sqrt(wanted * (1 - wanted) / 65536))

    def has_vdb(self):
        self.put("there/smoke.vdb", vdb())
        self.scene("<densityfile>smoke.vdb</densityfile>")
        done = self.run_program("there/scene.xml", "--validate")
        if "no reader for OpenVDB" in done.stderr:
            self.skipTest("the OpenImageIO of this machine has no reader for OpenVDB")

    def test_a_vol(self):
        self.put("there/smoke.vol", vol())
        # 2.5 of each, and the 5 between them.
        self.check_depth("<densityfile>smoke.vol</densityfile>", (2.5 * 0.5 + 5 * 1 + 2.5 * 1.5) / 20)
        self.check_depth("<densityfile>smoke.vol</densityfile> <density>3</density>", 3 * 10 / 20)
        self.check_depth(
            '<densityfile>smoke.vol</densityfile> <transform> <translate x="0" y="0" z="25"/> </transform>',
            (2.5 * 0.5 + 2.5 * 0.75) / 20)  # half of the way between is in the box, which ends at 30

    def test_points_that_are_farther_from_each_other_than_the_fog_is_wide(self):
        self.put("there/smoke.vol", vol((1, 1.001), box=(-1e6, -1e6, -1e6, 1e6, 1e6, 1e6)))
        self.check_depth("<densityfile>smoke.vol</densityfile>", 40 * 1.0005 / 20)
        self.put("there/smoke.vol", vol((1, 1), box=(-1e6, -1e6, -1e6, 1e6, 1e6, 1e6)))
        self.check_depth("<densityfile>smoke.vol</densityfile>", 40 / 20)

    def test_fogs_count_where_they_are_alone(self):
        """Fogs of a group each: of all in all instances there would be more than there are numbers of media."""
        count, seen = 200, 137
        self.put("there/smoke.vol", vol())
        self.scene("<densityfile>smoke.vol</densityfile>")
        with open(self.path("there/scene.xml"), encoding="utf-8") as file:
            text = file.read()
        begin, end = text.index("<fog> "), text.index("</fogs>")
        fog = text[begin:end]
        box = text[text.index("    <boxes>"):text.index("  </objects>")]
        text = text.replace(fog, "".join(fog.replace("smoke<", f"smoke{i}<") for i in range(count)))
        text = text.replace(box, "<instances>" + "".join(
            f'<instance> <group>g{i}</group> <transform> <translate x="{(i - seen) * 100}" y="{y}" z="0"/> </transform> </instance>'
            for i in range(count) for y in (500, 0)) + "</instances>")
        # That one has the fog of another group as well, behind its own.
        other = box.replace('z="-10"', 'z="-50"').replace('z="30"', 'z="-10"').replace("smoke<", "smoke5<")
        groups = "".join(f"<group> <name>g{i}</name> <objects> {box.replace('smoke<', f'smoke{i}<')} "
                         f"{other if i == seen else ''} </objects> </group>" for i in range(count))
        self.write("there/scene.xml", text.replace("</raytracer>", f"<groups> {groups} </groups> </raytracer>"))
        wanted = math.exp(-0.5)
        self.assertAlmostEqual(self.left(), wanted, delta=4 * math.sqrt(wanted * (1 - wanted) / 65536))

    def test_a_vdb(self):
        self.has_vdb()
        self.check_depth("<densityfile>smoke.vdb</densityfile>", 0.4 * (8 * 7.5 + 0.5) / 20)
        self.check_depth("<densityfile>smoke.vdb</densityfile> <densitygrid>heat</densitygrid>", 2 * 8 / 20)
        self.scene("<densityfile>smoke.vdb</densityfile> <densitygrid>fire</densitygrid>")
        self.assertIn("it has no grid of floats named fire; it has ", self.fail_with(1, "there/scene.xml", "--validate"))

    def test_damaged_vdbs(self):
        self.has_vdb()
        data = self.read("there/smoke.vdb")
        for end in (0, 3, 100, 1000, len(data) // 2, len(data) - 100):
            self.put("there/smoke.vdb", data[:end])
            done = self.run_program("there/scene.xml", "--validate")
            self.assertIn(done.returncode, (0, 1))
            if done.returncode == 1:
                self.assertRegex(done.stderr, r"there/scene.xml:6:[0-9]+: error: the density 'there/smoke\.vdb' cannot be used: ")
        self.put("there/smoke.vdb", vol())
        self.assertRegex(self.fail_with(1, "there/scene.xml", "--validate"), "error: the density 'there/smoke.vdb' cannot be used")

    def test_what_is_wrong_is_said_where_the_scene_names_the_file(self):
        self.scene("<densityfile>smoke.vol</densityfile>")
        where = r"there/scene\.xml:6:[0-9]+: error: the density 'there/smoke\.vol' cannot be used: "
        self.assertRegex(self.fail_with(1, "there/scene.xml", "--validate"), where + "there is no such file")
        for data, reason in ((vol()[:-1], "it ends before the last of its numbers"), (b"", "begins with VOL"),
                             (vol(size=(2000000000,) * 3), "it ends before the last of its numbers"),
                             (vol((math.nan, 1)), "it has a number that is not finite")):
            self.put("there/smoke.vol", data)
            self.assertRegex(self.fail_with(1, "there/scene.xml", "-o", "a.exr"), where + ".*" + reason)

    def test_a_fog_that_is_not_where_its_density_is_has_a_warning(self):
        self.put("there/smoke.vol", vol(box=(30, 0, 0, 34, 5, 10)))
        self.scene("<densityfile>smoke.vol</densityfile>")
        self.assertIn("the density of the fog 'smoke' is between (30, 0, 0) and (34, 5, 10), where no object of it is",
                      self.succeed("there/scene.xml", "--validate").stderr)
        self.scene('<densityfile>smoke.vol</densityfile> <transform> <translate x="-20" y="0" z="0"/> </transform>')
        self.assertEqual(self.succeed("there/scene.xml", "--validate").stderr, "")
        # Of an instance's <material>, which is in place of the objects' own.
        for place in (30, 0):
            self.put("there/smoke.vol", vol(box=(place, 0, 0, place + 4, 5, 10)))
            self.scene("<densityfile>smoke.vol</densityfile>")
            with open(self.path("there/scene.xml"), encoding="utf-8") as file:
                text = file.read()
            box = text[text.index("    <boxes>"):text.index("  </objects>")]
            text = text.replace(box, "<instances> <instance> <group>g</group> <material>smoke</material> </instance> </instances>")
            text = text.replace("<fogs>", "<emissives> <emissive> <name>lamp</name> <ce red='1' green='1' blue='1'/> </emissive> </emissives> <fogs>")
            box = box.replace("smoke", "lamp")
            text = text.replace("</raytracer>", f"<groups> <group> <name>g</name> <objects> {box} </objects> </group> </groups> </raytracer>")
            self.write("there/scene.xml", text)
            self.assertEqual("where no object of it is" in self.succeed("there/scene.xml", "--validate").stderr, place == 30)

    def test_what_moves_a_density_while_the_shutter_is_open(self):
        self.put("there/smoke.vol", vol())
        keys = '<transform> <translate> <key frame="1" x="0" y="0" z="0"/> <key frame="2" x="1" y="0" z="0"/> </translate> </transform>'
        shutter = lambda text: text.replace("<fov>", "<shutteropen>0</shutteropen> <shutterclose>1</shutterclose> <fov>")
        self.scene("<densityfile>smoke.vol</densityfile>" + keys)
        with open(self.path("there/scene.xml"), encoding="utf-8") as file:
            text = file.read()
        self.assertEqual(self.succeed("there/scene.xml", "--validate").stderr, "")
        self.write("there/scene.xml", shutter(text))
        self.assertRegex(self.succeed("there/scene.xml", "--validate").stderr,
                         "scene.xml:6:[0-9]+: warning: the material 'smoke' stands still while the shutter is open")
        text = text.replace(keys, "").replace("</material> </box>", f"</material> {keys} </box>")
        self.write("there/scene.xml", shutter(text))
        self.assertRegex(self.fail_with(1, "there/scene.xml", "--validate"),
                         r"scene\.xml:9:[0-9]+: error: this <box> moves while the shutter is open, and its fog")

    def test_instances_with_such_a_fog_do_not_move_while_the_shutter_is_open(self):
        self.put("there/smoke.vol", vol())
        self.scene("<densityfile>smoke.vol</densityfile>")
        with open(self.path("there/scene.xml"), encoding="utf-8") as file:
            text = file.read()
        box = text[text.index("    <boxes>"):text.index("  </objects>")]
        text = text.replace(box, '<instances> <instance> <group>g</group> <transform> <translate> <key frame="1" x="0" y="0" z="0"/> '
                                 '<key frame="2" x="1" y="0" z="0"/> </translate> </transform> </instance> </instances>')
        text = text.replace("</raytracer>", f"<groups> <group> <name>g</name> <objects> {box} </objects> </group> </groups> </raytracer>")
        self.write("there/scene.xml", text)
        self.succeed("there/scene.xml", "--validate")
        self.write("there/scene.xml", text.replace("<fov>", "<shutteropen>0</shutteropen> <shutterclose>1</shutterclose> <fov>"))
        self.assertRegex(self.fail_with(1, "there/scene.xml", "--validate"),
                         r"there/scene\.xml:9:[0-9]+: error: this <instance> moves while the shutter is open, and its fog")

    def test_the_file_is_known_by_its_bytes(self):
        self.put("there/smoke.vol", vol())
        self.scene("<densityfile>smoke.vol</densityfile>")
        render = lambda name, tile: self.succeed("there/scene.xml", "-q", "-s", "4", "-o", name, "--tile", tile)
        render("1.exr", "0/2")
        self.put("there/smoke.vol", vol((0.5, 1.6)))
        render("2.exr", "1/2")
        self.assertIn("scene", self.fail_with(1, "merge", "1.exr", "2.exr", "-o", "all.exr"))
        self.put("there/smoke.vol", vol())
        render("2.exr", "1/2")
        self.succeed("merge", "1.exr", "2.exr", "-o", "all.exr")

    def test_a_file_of_densities_is_a_model(self):
        self.put("there/smoke.vol", vol((0.5, 1.5)))
        small = ("-q", "-r", "24x16", "-s", "16", "--float")
        for options in ((), ("--up", "z", "--floor", "--sun", "30,40"), ("--turntable", "4", "--frames", "2")):
            self.succeed("there/smoke.vol", "-o", "a.exr", *small, *options)
            with open(self.path("printed.xml"), "w", encoding="utf-8") as file:
                file.write(self.succeed("there/smoke.vol", "--print-scene", "-r", "24x16", *options).stdout)
            self.succeed("printed.xml", "-o", "b.exr", *small)
            a, b = (Exr(self.read(name)).rows for name in ("a.exr", "b.exr"))
            self.assertEqual([row["G"] for row in a.values()], [row["G"] for row in b.values()])
        # It is in the middle of the picture, and nowhere near the sides.
        self.succeed("there/smoke.vol", "-o", "a.exr", *small, "--transparent", "--environment", "none", "--sun", "30,40")
        rows = Exr(self.read("a.exr")).rows
        green = [rows[y]["G"] for y in sorted(rows)]
        self.assertGreater(green[8][12], 0.05)
        self.assertEqual((green[0][0], green[15][23]), (0, 0))

    def test_capitals_make_no_difference(self):
        self.put("there/SMOKE.VOL", vol((0.5, 1.5)))
        self.succeed("there/SMOKE.VOL", "-q", "-r", "8x8", "-s", "4", "-o", "a.exr")
        self.check_depth("<densityfile>SMOKE.VOL</densityfile>", 0.5)

    def test_a_model_of_no_density_is_refused(self):
        self.put("there/smoke.vol", vol((0, 0)))
        self.assertIn("there/smoke.vol: error: has no density anywhere", self.fail_with(1, "there/smoke.vol", "-o", "a.exr"))
        self.put("there/smoke.vol", vol()[:-1])
        self.assertIn("error: the density 'there/smoke.vol' cannot be used", self.fail_with(1, "there/smoke.vol", "-o", "a.exr"))
        self.put("there/smoke.vol", vol())
        self.assertIn("error: a file of densities has no animation",
                      self.fail_with(1, "there/smoke.vol", "-o", "a.exr", "--animation", "Run"))
        self.assertIn("error: has no camera 'front', nor any other",
                      self.fail_with(1, "there/smoke.vol", "-o", "a.exr", "--camera", "front"))
