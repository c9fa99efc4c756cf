"""Two files of a run that are one: refused before anything is touched."""

import json
import os
import struct
import unittest

from support import CommandTest

SMALL = ["-q", "-r", "16x12", "-s", "1"]


class Clashes(CommandTest):
    def setUp(self):
        super().setUp()
        os.mkdir(self.path("sub"))
        os.symlink("sub", self.path("folder"))
        os.symlink("scene.xml", self.path("scene.exr"))
        os.link(self.path("scene.xml"), self.path("hard.exr"))
        os.symlink("pic.exr", self.path("dangling.exr"))
        self.scene = self.read("scene.xml")

    def refuse(self, *arguments, both=()):
        names = self.names()
        message = self.fail_with(2, *arguments)
        for text in both:
            self.assertIn(text, message)
        self.assertEqual(self.names(), names)
        self.assertEqual(os.listdir(self.path("sub")), [])
        self.assertEqual(self.read("scene.xml"), self.scene)

    def test_each_pair_of_uses(self):
        out = ["scene.xml", *SMALL, "-o", "pic.exr"]
        for other in ("pic.exr", "./pic.exr", self.path("pic.exr"), "folder/../pic.exr", "dangling.exr"):
            self.refuse(*out, "--checkpoint", other, both=("--checkpoint " + other, "--output pic.exr"))
            self.refuse(*out, "--stats=" + other, both=("--stats " + other, "--output pic.exr"))
            self.refuse(*out, "--log-file", other, both=("--log-file " + other, "--output pic.exr"))
            if other != "pic.exr":
                self.refuse(*out, "-o", other, both=("--output " + other, "--output pic.exr"))
        self.refuse(*out, "--stats=s", "--checkpoint", "./s", both=("--stats s", "--checkpoint ./s"))
        self.refuse(*out, "--log-file", "s", "--checkpoint", "./s", both=("--log-file s", "--checkpoint ./s"))
        self.refuse(*out, "--log-file", "s", "--stats=./s", both=("--log-file s", "--stats ./s"))

    def test_the_scene_is_never_written(self):
        for link in ("scene.exr", "hard.exr"):
            self.refuse("scene.xml", *SMALL, "-o", link, both=("--output " + link, "the scene scene.xml"))
            for option in ("--checkpoint", "--stats", "--log-file"):
                self.refuse("scene.xml", *SMALL, "-o", "pic.exr", f"{option}={link}",
                            both=(f"{option} {link}", "the scene scene.xml"))
        self.refuse("scene.xml", "--validate", "--log-file", "./scene.xml")
        self.refuse("scene.xml", "--print-scene", "--log-file", "./scene.xml")
        with open(self.path("scene.xml"), encoding="utf-8") as scene:
            done = self.run_program("-", *SMALL, "-o", "hard.exr", stdin=scene)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(self.read("scene.xml"), self.scene)

    def test_of_several_renders(self):
        self.refuse("scene.xml", *SMALL, "--frames", "1-2", "-o", "folder/p.#.exr", "--checkpoint", "sub/p.2.exr")
        self.refuse("scene.xml", *SMALL, "--frames", "1-2", "-o", "p.#.exr", "--checkpoint", "./p.#.exr")
        # One frame's picture is the next one's scene.
        self.write("s.2.exr", "")
        self.refuse("s.#.exr", *SMALL, "--frames", "1-2", "-o", "./s.2.exr")
        self.write("other.xml", "")
        self.refuse("scene.xml", "other.xml", *SMALL, "-o", "{scene}.exr", "--stats=other.xml")
        os.symlink("sub/one.exr", self.path("f.1.exr"))
        os.symlink("folder/one.exr", self.path("f.2.exr"))
        self.refuse("scene.xml", *SMALL, "--frames", "1-2", "-o", "f.#.exr", both=("f.1.exr", "f.2.exr"))

    def test_what_is_none(self):
        self.succeed("scene.xml", *SMALL, "--frames", "1-2", "-o", "p.#.exr", "-o", "sub/p.#.exr", "--log-file", "log",
                     "--stats=s.#.json", "--checkpoint", "sub/c.#")
        self.succeed("scene.xml", *SMALL, "-o", "p.exr", "--log-file", "/dev/null")
        self.assertEqual(sorted(os.listdir(self.path("sub"))), ["p.1.exr", "p.2.exr"])

    def test_what_a_model_reads_is_never_written(self):
        self.write("a.obj", "mtllib a.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        self.write("a.mtl", "newmtl red\nKd 1 0 0\n")
        positions = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
        with open(self.path("b.bin"), "wb") as file:
            file.write(positions)
        self.write("b.gltf", json.dumps({
            "asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "buffers": [{"uri": "b.bin", "byteLength": 36}], "bufferViews": [{"buffer": 0, "byteLength": 36}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                           "min": [0, 0, 0], "max": [1, 1, 0]}]}))
        self.write("c.xml", self.scene.decode().replace(
            "<objects>", "<objects><meshes><mesh><file>a.obj</file></mesh></meshes>", 1))
        for scene, read in (("a.obj", "a.mtl"), ("b.gltf", "b.bin"), ("c.xml", "a.obj"), ("c.xml", "a.mtl")):
            before = self.read(read)
            for option in ("--log-file", "--stats", "--checkpoint"):
                self.refuse(scene, "-r", "16x12", "-s", "1", "-o", "pic.exr", f"{option}=./{read}", both=("./" + read,))
                self.assertEqual(self.read(read), before)
            self.succeed(scene, *SMALL, "-o", "pic.exr", "--log-file", "log")
            os.remove(self.path("pic.exr"))
            os.remove(self.path("log"))

    def test_of_a_merge(self):
        for tile in (0, 1):
            self.succeed("scene.xml", *SMALL, "--tile", f"{tile}/2", "-o", f"t.{tile}.exr")
        self.write("list.exr", "t.0.exr\nt.1.exr\n")
        os.symlink("t.1.exr", self.path("link.exr"))
        before = {name: self.read(name) for name in ("t.0.exr", "t.1.exr", "list.exr")}
        for output in ("t.0.exr", "./t.1.exr", "link.exr", "list.exr"):
            self.refuse("merge", "@list.exr", "-o", output, both=("--output " + output,))
        self.refuse("merge", "t.0.exr", "t.1.exr", "-o", "w.exr", "-o", "./w.exr", both=("w.exr", "./w.exr"))
        self.assertEqual({name: self.read(name) for name in before}, before)
        self.succeed("merge", "@list.exr", "-q", "-o", "w.exr")


class Checkpoint(CommandTest):
    def test_a_file_that_took_its_place_is_not_removed(self):
        self.write("kept", "kept")
        os.mkfifo(self.path("late.xml"))
        process = self.start_program("late.xml", *SMALL, "-o", "a.exr", "--checkpoint", "c.exr")
        with open(self.path("late.xml"), "wb") as scene:  # waits for the program, whose checks are done by then
            os.symlink("kept", self.path("c.exr"))
            scene.write(self.read("scene.xml"))
        _, told = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 0, told)
        self.assertEqual(self.names(), ["a.exr", "c.exr", "kept", "late.xml", "scene.xml"])


if __name__ == "__main__":
    unittest.main()
