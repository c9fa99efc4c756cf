"""Pictures as textures: where they are looked for, what happens without them, and that pieces know them."""

import os
import shutil

from exr import Exr
from png import Png
from support import CommandTest, REPOSITORY

SCENES = os.path.join(REPOSITORY, "scenes")


class Textures(CommandTest):
    def setUp(self):
        super().setUp()
        os.makedirs(self.path("there/images"))
        shutil.copy(os.path.join(SCENES, "texture-image.xml"), self.path("there/scene.xml"))
        self.picture = self.path("there/images/bricks.png")
        shutil.copy(os.path.join(SCENES, "images", "bricks.png"), self.picture)

    def render(self, scene, name, *options):
        self.succeed(scene, "-q", "-r", "64x48", "-s", "4", "-o", name, *options)
        return self.read(name)

    def test_files_are_relative_to_the_scene_and_its_printed_form_is_the_same_scene(self):
        wanted = Exr(self.render("there/scene.xml", "a.exr")).rows
        self.write("printed.xml", self.succeed("there/scene.xml", "--print-scene").stdout)
        self.assertEqual(Exr(self.render("printed.xml", "b.exr")).rows, wanted)

    def test_a_missing_picture_is_an_error_before_anything_is_rendered(self):
        os.remove(self.picture)
        for option in (["--validate"], ["-o", "a.png"]):
            message = self.fail_with(1, "there/scene.xml", *option)
            self.assertRegex(message, r"there/scene\.xml:[0-9]+:[0-9]+: error: the texture 'there/images/bricks\.png' cannot be used")
        self.assertFalse(os.path.exists(self.path("a.png")))

    def test_or_magenta(self):
        os.remove(self.picture)
        done = self.succeed("there/scene.xml", "--missing-texture", "warn", "-r", "64x48", "-s", "1", "-o", "a.png")
        self.assertIn("it is magenta", done.stderr)
        png = Png(self.read("a.png"))
        magenta = [p for p in (png.pixel(x, y) for x in range(64) for y in range(48)) if p[0] > 100 and p[1] == 0]
        self.assertGreater(len(magenta), 100)

    def test_the_memory_for_textures_does_not_change_the_picture(self):
        wanted = Exr(self.render("there/scene.xml", "a.exr")).rows
        self.assertEqual(Exr(self.render("there/scene.xml", "b.exr", "--texture-memory", "1K")).rows, wanted)
        for wrong in ("much", "2g", "-1", "99999999999G"):
            message = self.fail_with(2, "there/scene.xml", "-o", "c.exr", f"--texture-memory={wrong}")
            self.assertIn("is not a size, such as 500M or 2G", message)

    def test_pieces_with_another_picture_are_not_merged(self):
        self.render("there/scene.xml", "1.exr", "--tile", "0/2")
        with open(self.picture, "ab") as file:
            file.write(b"more")  # behind its end, which readers do not care about
        self.render("there/scene.xml", "2.exr", "--tile", "1/2")
        self.assertIn("scene", self.fail_with(1, "merge", "1.exr", "2.exr", "-o", "all.exr"))
