"""Scenes, files and machines that fail: exit codes 1 and 33, and what was there stays."""

import os
import resource
import subprocess
import unittest

import support
from support import CommandTest


class Failures(CommandTest):
    def test_scene_errors_have_their_place(self):
        self.write("bad.xml", support.SCENE.replace("<radius>1</radius>", "<radius>-1</radius>")
                   .replace("<hres>", "<hress>").replace("</hres>", "</hress>"))
        message = self.fail_with(1, "bad.xml", "-o", "a.exr")
        self.assertRegex(message, r"bad\.xml:3:\d+: error: .*hress.*hres")
        self.assertRegex(message, r"bad\.xml:27:\d+: error: ")
        self.assertEqual(self.names(), ["bad.xml", "scene.xml"])

    def test_missing_scene(self):
        message = self.fail_with(1, "missing.xml", "-o", "a.exr")
        self.assertIn("missing.xml", message)
        self.assertIn("No such file", message)

    def test_outputs_that_cannot_be(self):
        os.mkdir(self.path("folder.exr"))
        self.write("kept.exr", "old")
        os.chmod(self.path("kept.exr"), 0o444)
        before = self.names()
        for code, name, reason in [(1, "missing/a.exr", "no folder"), (1, "folder.exr", "it is a folder"),
                                   (1, "kept.exr", "read-only"), (2, "a.exrr", "did you mean '.exr'?"),
                                   (2, "a", "no extension")]:
            message = self.fail_with(code, "scene.xml", "-o", name)
            self.assertTrue(message.startswith(f"raytrace: error: cannot write {name}: "), message)
            self.assertIn(reason, message)
        self.assertIn("8 bits", self.fail_with(2, "scene.xml", "-o", "a.jpg", "--bit-depth", "16"))
        self.assertEqual(self.names(), before)
        self.assertEqual(self.read("kept.exr"), b"old")

    def test_bad_outputs_are_told_before_the_render(self):
        self.fail_with(1, "scene.xml", *support.ENDLESS, "-o", "good.exr", "-o", "missing/bad.exr", timeout=60)
        self.fail_with(1, "scene.xml", *support.ENDLESS, "-o", "good.exr", "--stats=missing/bad.json", timeout=60)
        self.assertEqual(self.names(), ["scene.xml"])

    def test_a_disk_that_takes_no_more(self):
        self.succeed("scene.xml", "-q", "-o", "a.exr")
        before = self.read("a.exr")

        def small_files_only():
            resource.setrlimit(resource.RLIMIT_FSIZE, (8000, resource.RLIM_INFINITY))

        # Python ignores the signal of that limit, and without restore_signals so does the program.
        message = self.fail_with(1, "scene.xml", "-q", "-r", "400x300", "-o", "a.exr", "-o", "b.png",
                                 preexec_fn=small_files_only, restore_signals=False)
        self.assertIn("cannot write a.exr: File too large", message)
        self.assertIn("cannot write b.png: File too large", message)
        self.assertEqual(self.read("a.exr"), before)
        self.assertEqual(self.names(), ["a.exr", "scene.xml"])

    def test_standard_output_that_takes_no_more(self):
        with open("/dev/full", "w", encoding="utf-8") as full:
            done = subprocess.run([support.PROGRAM, "scene.xml", "--print-scene"], cwd=self.folder, stdout=full,
                                  stderr=subprocess.PIPE, text=True, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertIn("standard output", done.stderr)

    @unittest.skipIf(support.SANITIZERS, "a sanitizer needs more address space than any limit leaves")
    def test_out_of_memory(self):
        def little_memory():
            resource.setrlimit(resource.RLIMIT_AS, (1 << 30, resource.RLIM_INFINITY))

        message = self.fail_with(33, "scene.xml", "-q", "-r", "16384x16384", "--sample-offset", "0", "-o", "a.exr",
                                 preexec_fn=little_memory)
        self.assertEqual(message, "raytrace: error: out of memory: the address-space limit of this process (ulimit -v) "
                                  "allows 1024 MiB\n")
        self.assertEqual(self.names(), ["scene.xml"])


if __name__ == "__main__":
    unittest.main()
