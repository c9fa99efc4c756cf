"""What benchmarks/compare writes for each renderer; none but raytrace is needed."""

import os
import subprocess
import tempfile
import unittest

from comparison import renderers, scenes
from comparison.paths import PROGRAM

SMALL = ("mix-5k", "lights-16", "4k")
WORDS = {  # of each shape, in each language
    "raytrace": {"Sphere": "<sphere>", "Cylinder": "<cylinder>", "Torus": "<torus>", "Triangle": "<triangle>"},
    "povray": {"Sphere": "\nsphere {", "Cylinder": "\ncylinder {", "Torus": "\ntorus {", "Triangle": "\ntriangle {"},
    "tachyon": {"Sphere": "\nSPHERE ", "Cylinder": "\nFCYLINDER ", "Triangle": "\nTRI "},
    "mitsuba": {"Sphere": '<shape type="sphere">', "Cylinder": '<shape type="cylinder">'},
}


class Scenes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="raytrace-comparison-")
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def text(self):
        parts = []
        for name in sorted(os.listdir(self.folder)):
            with open(os.path.join(self.folder, name), encoding="latin-1") as file:
                parts.append(file.read())
        return "".join(parts)

    def test_ours_is_valid_and_complete(self):
        for name in SMALL:
            scene = scenes.make(name)
            renderers.ALL["raytrace"].write(scene, self.folder)
            done = subprocess.run([PROGRAM, "--validate", os.path.join(self.folder, "scene.xml")], text=True,
                                  capture_output=True, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            count = len(scene.objects) + 1  # the floor
            self.assertIn(f"{count} objects", (done.stdout + done.stderr).replace(",", ""))

    def test_every_renderer_gets_every_object(self):
        for key, renderer in renderers.ALL.items():
            scene = scenes.make("mix-5k" if renderer.can(scenes.make("mix-5k")) else "mix-without-tori-5k")
            with tempfile.TemporaryDirectory() as self.folder:
                renderer.write(scene, self.folder)
                text = self.text()
            for shape, word in WORDS[key].items():
                self.assertEqual(text.count(word), len(scene.of(getattr(scenes, shape))), f"{key}: {shape}")

    def test_who_takes_part(self):
        tori = scenes.make("tori-1k")
        self.assertEqual([key for key, renderer in renderers.ALL.items() if renderer.can(tori)], ["raytrace", "povray"])

    def test_pov_ray_takes_as_many_samples(self):
        for name in ("spheres-10", "4k", "samples-256"):
            scene = scenes.make(name)
            renderers.ALL["povray"].write(scene, self.folder)
            with open(os.path.join(self.folder, "scene.ini"), encoding="utf-8") as file:
                settings = dict(line.strip().split("=") for line in file)
            pixels = int(settings["Width"]) * int(settings["Height"])
            edge = int(settings.get("Antialias_Depth", 1))
            self.assertLessEqual(edge, 9, "it leaves out what is more")
            self.assertEqual(pixels * edge * edge, scene.width * scene.height * scene.samples)

    def test_the_same_every_time(self):
        self.assertEqual(scenes.make("mix-5k"), scenes.make("mix-5k"))


if __name__ == "__main__":
    unittest.main()
