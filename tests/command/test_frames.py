"""Variables, frames, keys, several scenes: what only a whole run shows."""

import json
import os
import re
import struct
import unittest

import support
from exr import Exr
from png import Png
from support import CommandTest

# The sphere wanders; its radius and the frame are variables.
MOVING = support.SCENE.replace(
    '<center x="0" y="1" z="0"/>',
    '<center><key frame="1" x="-2" y="1" z="0"/><key frame="5" x="2" y="$frame" z="0"/></center>')
VARIABLE = support.SCENE.replace("<radius>1</radius>", "<radius>$radius</radius>")
SMALL = ["-q", "-r", "16x12", "-s", "1"]


class Variables(CommandTest):
    def setUp(self):
        super().setUp()
        self.write("scene.xml", VARIABLE)

    def test_a_variable_is_its_value(self):
        printed = self.succeed("scene.xml", "--print-scene", "-D", "radius=0.25").stdout
        self.assertIn("<radius>0.25</radius>", printed)
        self.assertNotIn("$", printed)
        self.assertIn("<radius>2</radius>", self.succeed("scene.xml", "--print-scene", "-D", "radius=1",
                                                         "-Dradius=2").stdout)

    def test_unset(self):
        message = self.fail_with(1, "scene.xml", "-o", "a.exr")
        self.assertRegex(message, r"^scene\.xml:27:\d+: error: '\$radius' in <radius> uses \$radius, which is not set; "
                                  r"set it: -D radius=VALUE\n$")
        self.assertIn("did you mean $raduis?", self.fail_with(1, "scene.xml", "-o", "a.exr", "-D", "raduis=2"))

    def test_unused(self):
        message = self.fail_with(1, "scene.xml", "-o", "a.exr", "-D", "radius=1", "-D", "color=red")
        self.assertEqual(message, "scene.xml: error: no value of the scene uses $color; remove -D color=...\n")
        self.assertEqual(self.names(), ["scene.xml"])

    def test_frame_is_always_set(self):
        self.write("scene.xml", support.SCENE.replace("<radius>1<", "<radius>0.$frame<"))
        self.assertIn("<radius>0.1</radius>", self.succeed("scene.xml", "--print-scene").stdout)
        self.assertIn("<radius>0.42</radius>", self.succeed("scene.xml", "--print-scene", "--frames", "42").stdout)


class Frames(CommandTest):
    def setUp(self):
        super().setUp()
        self.write("scene.xml", MOVING)
        self.environment = {**os.environ, "SOURCE_DATE_EPOCH": "0"}

    def test_keys_are_evaluated_at_the_frame(self):
        centers = {"-7": 'x="-2" y="1"', "1": 'x="-2" y="1"', "3": 'x="0" y="2"', "9": 'x="2" y="9"'}
        for frame, center in centers.items():
            printed = self.succeed("scene.xml", "--print-scene", "--frames", frame).stdout
            self.assertIn(f'<center {center} z="0"/>', printed)
            self.assertNotIn("key", printed)

    def test_each_frame_has_its_file_and_is_the_same_alone(self):
        self.succeed("scene.xml", *SMALL, "--frames", "5,1-3:2,4", "-o", "a.####.exr", "-o", "b%02d.png",
                     "--stats=s.#.json", env=self.environment)
        frames = [1, 3, 4, 5]
        self.assertEqual(self.names(), sorted(["scene.xml"] + [f"a.{i:04}.exr" for i in frames] +
                                              [f"b{i:02}.png" for i in frames] + [f"s.{i}.json" for i in frames]))
        pictures = {self.read(f"a.{i:04}.exr") for i in frames}
        self.assertEqual(len(pictures), len(frames))
        for i in frames:
            together = self.read(f"a.{i:04}.exr"), self.read(f"b{i:02}.png")
            self.succeed("scene.xml", *SMALL, "--frames", str(i), "-o", f"a.{i:04}.exr", "-o", f"b{i:02}.png",
                         env=self.environment)
            self.assertEqual((self.read(f"a.{i:04}.exr"), self.read(f"b{i:02}.png")), together)

    def test_a_folder_that_is_there_keeps_its_name(self):
        os.mkdir(self.path("C#"))
        os.rename(self.path("scene.xml"), self.path("C#/scene.xml"))
        os.mkdir(self.path("f1"))
        os.mkdir(self.path("f2"))
        self.succeed("C#/scene.xml", *SMALL, "--frames", "1-2", "-o", "C#/a.#.exr", "-o", "f#/{#}%%.exr",
                     "--stats=C#/s.#.json")
        self.assertEqual(sorted(os.listdir(self.path("C#"))), ["a.1.exr", "a.2.exr", "s.1.json", "s.2.json", "scene.xml"])
        self.assertEqual(os.listdir(self.path("f1")) + os.listdir(self.path("f2")), ["#%.exr", "#%.exr"])
        self.fail_with(2, "C#/scene.xml", *SMALL, "--frames", "1-2", "-o", "C#/a.exr")

    def test_what_is_said_of_a_frame_has_its_number(self):
        done = self.succeed("scene.xml", *SMALL, "--frames", "3-4", "-o", "a.#.exr", "--stats=s.#.json",
                            "--progress=json")
        events = [json.loads(line) for line in done.stdout.splitlines()]
        self.assertEqual([event["frame"] for event in events if event["event"] == "progress"][-1], 4)
        self.assertEqual(json.loads(self.read("s.3.json"))["frame"], 3)
        self.assertRegex(self.succeed("scene.xml", *SMALL[1:], "--frames", "5", "-o", "a.exr", "--progress=plain",
                                      "--stats").stderr, r"rendered 100 %, frame 5[^\0]*scene +scene\.xml, frame 5\n")
        self.succeed("scene.xml", *SMALL, "-o", "a.exr", "--stats=s.json")
        self.assertIsNone(json.loads(self.read("s.json"))["frame"])
        done = self.succeed("scene.xml", "--frames", "7", "-s", "1000000", "--integrator", "path", "-r", "64x64",
                            "--time-limit", "0.2s", "-o", "a.exr")
        self.assertRegex(done.stderr, r"the time limit was reached after \d+ samples per pixel of frame 7\n")

    def test_frames_may_have_noise_of_their_own(self):
        self.write("still.xml", support.SCENE)
        noisy = ("still.xml", "-r", "16x12", "-s", "2", "--integrator", "ambientocclusion", "--frames", "1-2")
        self.succeed(*noisy, "-o", "same.#.png")
        self.assertEqual(Png(self.read("same.1.png")).rows, Png(self.read("same.2.png")).rows)
        self.succeed(*noisy, "--seed", "frame", "-o", "own.#.png", "--stats=s.#.json")
        self.assertNotEqual(Png(self.read("own.1.png")).rows, Png(self.read("own.2.png")).rows)
        self.assertEqual(json.loads(self.read("s.2.json"))["picture"]["seed"], 2)
        self.succeed("still.xml", *noisy[1:-2], "--seed", "2", "-o", "alone.png")
        self.assertEqual(Png(self.read("own.2.png")).rows, Png(self.read("alone.png")).rows)

    def test_many_frames_need_a_token(self):
        message = self.fail_with(2, "scene.xml", "--frames", "1-3", "-o", "a.mp4")
        self.assertIn(".mp4", message)
        self.assertNotIn("####", message)
        message = self.fail_with(2, "scene.xml", "--frames", "1-3", "-o", "a.exr")
        self.assertIn("use a name such as a.####.exr", message)
        self.assertEqual(self.names(), ["scene.xml"])

    def test_a_scene_for_each_frame(self):
        for i in (1, 2):
            self.write(f"shot.{i:03}.xml", support.SCENE.replace("<radius>1<", f"<radius>0.{i}<"))
        self.succeed("shot.###.xml", *SMALL, "--frames", "1-2", "-o", "{scene}.exr")
        self.assertEqual(self.names(), ["scene.xml", "shot.001.exr", "shot.001.xml", "shot.002.exr", "shot.002.xml"])

    def test_a_broken_frame_does_not_stop_the_others(self):
        self.write("scene.xml", support.SCENE.replace(
            "<radius>1</radius>", '<radius><key frame="1" value="1"/></radius>').replace(
            '<eye x="0" y="3" z="8"/>', '<eye><key frame="1" x="0" y="0.5" z="8"/>'
                                        '<key frame="3" x="0" y="0.5" z="-8"/></eye>'))
        done = self.run_program("scene.xml", *SMALL, "--frames", "1-4", "-o", "a.#.exr")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(self.names(), ["a.1.exr", "a.3.exr", "a.4.exr", "scene.xml"])
        self.assertIn("scene.xml, frame 2: failed", done.stderr)
        self.assertTrue(done.stderr.endswith("raytrace: error: 1 of 4 renders failed:\n  scene.xml, frame 2\n"),
                        done.stderr)

    def test_a_frame_that_cannot_be_written_does_not_stop_the_others(self):
        os.mkdir(self.path("a.2.exr"))
        done = self.run_program("scene.xml", *SMALL, "--frames", "1-3", "-o", "a.#.exr")
        self.assertEqual(done.returncode, 1)
        self.assertIn("cannot write a.2.exr: ", done.stderr)
        self.assertIn("1 of 3 renders failed:\n  scene.xml, frame 2\n", done.stderr)
        self.assertEqual(self.names(), ["a.1.exr", "a.2.exr", "a.3.exr", "scene.xml"])

    def test_a_signal_stops_all_frames(self):
        process = self.start_program("scene.xml", *support.ENDLESS, "--frames", "1-3", "-o", "a.#.exr",
                                     "--progress=plain")
        self.assertTrue(process.stderr.readline())  # it renders
        process.terminate()
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, 143)
        self.assertEqual(self.names(), ["a.1.exr", "scene.xml"])
        self.assertIn("raytrace:partial", Exr(self.read("a.1.exr")).attributes)


class ToldOnce(CommandTest):
    """What many frames have in common is found before the first, or told for the first of them alone."""

    def told(self, code, *arguments):
        done = self.run_program(*arguments, "-r", "16x12", "-s", "1", "--progress=none")
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stderr

    def test_a_variable(self):
        keys = "".join(f'<key frame="{frame}" value="$size"/>\n' for frame in range(25))
        self.write("scene.xml", support.SCENE.replace("<radius>1<", f"<radius>{keys}<"))
        self.assertRegex(self.told(1, "scene.xml", "--frames", "1-24", "-o", "a.####.exr"),
                         r"^scene\.xml:27:\d+: error: '\$size' for value in <key> uses \$size, which is not set; set it: "
                         r"-D size=VALUE \(and at 24 other places\)\n"
                         r"raytrace: error: scene\.xml, frame 1: failed\n"
                         r"raytrace: error: 24 of 24 renders failed:\n  scene\.xml, frames 1-24\n$")
        told = self.told(1, "scene.xml", "-D", "size=1", "-D", "none=1", "--frames", "1-9:2", "-o", "a.####.exr")
        self.assertEqual(told, "scene.xml: error: no value of the scene uses $none; remove -D none=...\n"
                               "raytrace: error: scene.xml, frame 1: failed\n"
                               "raytrace: error: 5 of 5 renders failed:\n  scene.xml, frames 1-9:2\n")
        self.assertEqual(self.names(), ["scene.xml"])

    def test_what_depends_on_the_frame(self):
        self.write("scene.xml", support.SCENE.replace("<radius>1<", "<radius>-$frame<").replace("<kd>0.6<", "<kd>-1<"))
        told = self.told(1, "scene.xml", "--frames", "1-2", "-o", "a.#.exr")
        self.assertEqual(told.count("'-1' in <kd>"), 2, "of two materials")
        for frame in (1, 2):
            self.assertIn(f"'-{frame}' in <radius>", told)
            self.assertIn(f"scene.xml, frame {frame}: failed", told)

    def test_a_folder(self):
        """Before any render: the second output is never written."""
        told = self.told(1, "scene.xml", "--frames", "1-24", "-o", "missing/a.####.exr", "-o", "b.####.exr",
                         "--checkpoint", "missing/c.####")
        self.assertEqual(told, "raytrace: error: cannot write missing/a.0001.exr: there is no folder missing\n"
                               "raytrace: error: 24 of 24 renders failed:\n  scene.xml, frames 1-24\n")
        self.write("other.xml", support.SCENE)
        os.mkdir(self.path("scene"))
        told = self.told(1, "scene.xml", "other.xml", "--frames", "1-3", "-o", "{scene}/a.#.exr", "--stats=s/{scene}.#")
        self.assertTrue(told.startswith("raytrace: error: cannot write s/scene.1: there is no folder s\n"
                                        "raytrace: error: cannot write other/a.1.exr: there is no folder other\n"), told)
        self.assertEqual(self.names(), ["other.xml", "scene", "scene.xml"])

    def test_a_scene(self):
        told = self.told(1, "missing.xml", "scene.xml", "--frames", "1-3", "-o", "{scene}.#.exr")
        self.assertEqual(told, "missing.xml: error: cannot read the scene: No such file or directory\n"
                               "raytrace: error: 3 of 6 renders failed:\n  missing.xml, frames 1-3\n")
        self.assertEqual(self.names(), ["scene.1.exr", "scene.2.exr", "scene.3.exr", "scene.xml"])

    def test_the_command_line(self):
        """It is refused before anything is rendered."""
        for options, reason in ((["-o", "a.#.png", "--float"], "--float"), (["-o", "a.#.png", "--aov", "Z"], "--aov"),
                                (["-o", "a.#.exr", "--checkpoint", "c.#"], "there is a c.3 already")):
            self.write("c.3", "")
            told = self.told(2, "scene.xml", "--frames", "1-4", *options)
            self.assertEqual(told.count("error: "), 1, told)
            self.assertIn(reason, told)
            self.assertEqual(self.names(), ["c.3", "scene.xml"])
        told = self.told(2, "scene.xml", "--frames", "1-4", "-o", "a.#.exr", "--crop", "0,0,1700,1")
        self.assertEqual(told.count("--crop"), 1, told)
        self.assertIn("4 of 4 renders failed:\n  scene.xml, frames 1-4\n", told)
        told = self.told(2, "scene.xml", "--frames", "1-4", "-o", "a.#.nothing")
        self.assertEqual(told.count("\n"), 1, told)

    def test_pictures_that_are_there_need_no_folder(self):
        """That nobody may write to, say."""
        command = ["scene.xml", "--frames", "1-3", "-o", "kept/a.#.exr", "--skip-existing"]
        os.mkdir(self.path("kept"))
        self.told(0, *command)
        os.chmod(self.path("kept"), 0o555)
        self.assertEqual(self.told(0, *command).count("there already, skipped"), 3)


class Turntable(CommandTest):
    scene = os.path.join(support.REPOSITORY, "scenes", "gallery", "turntable.xml")

    def test_it_ends_where_it_began(self):
        first, half, last = (self.succeed(self.scene, "--print-scene", "--frames", frame).stdout
                             for frame in ("1", "25", "49"))
        self.assertEqual(first, last)
        self.assertNotEqual(first, half)

    def test_its_frames_render(self):
        self.succeed(self.scene, "-q", "--scale", "0.02", "-s", "1", "--frames", "1-48:24", "-o", "t.##.exr")
        self.assertEqual(self.names(), ["scene.xml", "t.01.exr", "t.25.exr"])
        self.assertNotEqual(Exr(self.read("t.01.exr")).rows, Exr(self.read("t.25.exr")).rows)


class SkipExisting(CommandTest):
    def render(self, frames):
        done = self.succeed("scene.xml", "-r", "16x12", "-s", "1", "--progress=none", "--frames", frames,
                            "-o", "a.#.exr", "-o", "b.#.png", "--skip-existing")
        return re.findall(r"^raytrace: (.*): there already, skipped$", done.stderr, re.MULTILINE)

    def test_frames_that_are_there_are_skipped_and_told(self):
        self.assertEqual(self.render("1-2"), [])
        before = os.stat(self.path("a.1.exr")).st_mtime_ns
        self.assertEqual(self.render("1-3"), ["a.1.exr, b.1.png", "a.2.exr, b.2.png"])
        self.assertEqual(os.stat(self.path("a.1.exr")).st_mtime_ns, before)
        os.remove(self.path("b.2.png"))
        self.assertEqual(self.render("1-3"), ["a.1.exr, b.1.png", "a.3.exr, b.3.png"])

    def test_a_part_is_rendered_again(self):
        self.render("1")
        whole = self.read("a.1.exr")
        # Behind the magic number and the version, an attribute: name, type, size, value. It moves the only chunk of
        # rows, whose place stands right before it.
        mark = b"raytrace:partial\0int\0" + struct.pack("<ii", 4, 1)
        table = next(at for at in range(8, len(whole)) if whole[at:at + 8] == struct.pack("<Q", at + 8))
        self.write_bytes("a.1.exr", whole[:8] + mark + whole[8:table] + struct.pack("<Q", table + 8 + len(mark)) +
                         whole[table + 8:])
        self.assertEqual(Exr(self.read("a.1.exr")).rows, Exr(whole).rows)
        self.assertEqual(self.render("1"), [])
        self.assertEqual(self.render("1"), ["a.1.exr, b.1.png"])

    def test_a_truncated_file_is_rendered_again(self):
        self.render("1")
        for length in (0, 20, len(self.read("a.1.exr")) - 10):
            self.write_bytes("a.1.exr", self.read("a.1.exr")[:length])
            self.assertEqual(self.render("1"), [], length)
            self.assertEqual(self.render("1"), ["a.1.exr, b.1.png"])

    def test_a_truncated_picture_of_any_format_is_rendered_again(self):
        names = [f"a.{ending}" for ending in ("png", "jpg", "tif", "bmp", "tga", "hdr", "gif", "ppm")]
        outputs = [word for name in names for word in ("-o", name)]
        command = ["scene.xml", "-r", "23x17", "-s", "1", "--progress=none", "--skip-existing", *outputs]
        self.succeed(*command)
        whole = {name: self.read(name) for name in names}
        self.assertIn("skipped", self.succeed(*command).stderr)
        for name in names:
            for length in (0, len(whole[name]) - 1):
                self.write_bytes(name, whole[name][:length])
                self.assertEqual(self.succeed("scene.xml", "-r", "23x17", "-s", "1", "--progress=none",
                                              "--skip-existing", "-o", name).stderr, "", (name, length))

    def test_another_picture_is_rendered_again(self):
        self.write("scene.xml", support.SCENE.replace("<radius>1<", "<radius>$radius<"))
        for outputs in (["-o", "a.exr"], ["-o", "a.png"]):
            def skipped(*options):
                done = self.succeed("scene.xml", "-r", "24x16", "-s", "2", "--progress=none", "--skip-existing", *outputs,
                                    *(options if "-D" in options else (*options, "-D", "radius=1")))
                return "skipped" in done.stderr
            for change in ([], ["-D", "radius=0.5"], ["--seed", "3"], ["-s", "3"], ["-s", "1"], ["-r", "20x16"],
                           ["--sample-offset", "2"], ["--tile", "1/2"], ["--crop", "0,0,8,16"],
                           ["--transparent"]):
                self.assertFalse(skipped(*change), change)
                self.assertTrue(skipped(*change), change)
        for kept, change in (("a.exr", ["--float"]), ("a.exr", ["--aov", "depth"]), ("a.exr", ["--sample-offset", "0"]),
                             ("a.png", ["--bit-depth", "16"]), ("a.png", ["--exposure", "-0.75"]),
                             ("a.png", ["--view-transform", "agx"]), ("a.png", ["--auto-exposure"]),
                             ("a.png", ["--white-balance", "3000"])):
            outputs = ["-o", kept]
            skipped()
            self.assertTrue(skipped(), change)
            self.assertFalse(skipped(*change), change)
        # What only the machine or the program decides does not count.
        outputs = ["-o", "a.exr"]
        skipped()
        self.assertTrue(skipped("-t", "1"))
        self.assertTrue(skipped("--time-limit", "1h", "-s", "64"))

    def test_a_size_that_no_picture_has_costs_no_memory(self):
        self.render("1")
        whole = self.read("a.1.exr")
        at = whole.index(b"dataWindow\0box2i\0") + len(b"dataWindow\0box2i\0") + 4
        self.write_bytes("a.1.exr", whole[:at] + struct.pack("<iiii", 0, 0, (1 << 30) - 1, 11) + whole[at + 16:])
        self.succeed("scene.xml", *SMALL, "--skip-existing", "-o", "a.1.exr", "--stats=stats.json")
        self.assertEqual(Exr(self.read("a.1.exr")).data_window, (0, 0, 15, 11))
        self.assertLess(json.loads(self.read("stats.json"))["memory"]["peak_bytes"], 2 << 30)

    def test_what_is_skipped_is_not_said_to_be_rendered(self):
        command = ["scene.xml", "-r", "16x12", "-s", "1", "--skip-existing", "-o", "a.exr"]
        self.assertIn("rendered 100 %", self.succeed(*command, "--progress=plain").stderr)
        self.assertEqual(self.succeed(*command, "--progress=plain").stderr, "raytrace: a.exr: there already, skipped\n")
        self.assertIn("openjd_progress: 100", self.succeed(*command, "--progress=openjd").stdout)

    def write_bytes(self, name, data):
        with open(self.path(name), "wb") as file:
            file.write(data)


class Scenes(CommandTest):
    def test_each_scene_has_its_output(self):
        self.write("other.xml", support.SCENE.replace("<radius>1<", "<radius>0.5<"))
        self.succeed("scene.xml", "other.xml", *SMALL, "-o", "{scene}.exr")
        self.assertEqual(self.names(), ["other.exr", "other.xml", "scene.exr", "scene.xml"])
        self.assertNotEqual(Exr(self.read("scene.exr")).rows, Exr(self.read("other.exr")).rows)
        self.assertIn("use a name such as a.{scene}.exr", self.fail_with(2, "scene.xml", "other.xml", "-o", "a.exr"))

    def test_a_broken_scene_does_not_stop_the_others(self):
        self.write("bad.xml", "<raytracer/>")
        done = self.run_program("bad.xml", "scene.xml", "missing.xml", "-", *SMALL, "-o", "{scene}.exr",
                                input=support.SCENE)
        self.assertEqual(done.returncode, 1)
        self.assertTrue(done.stderr.endswith("2 of 4 renders failed:\n  bad.xml\n  missing.xml\n"), done.stderr)
        self.assertEqual(self.names(), ["bad.xml", "scene.exr", "scene.xml", "stdin.exr"])
        self.assertEqual(Exr(self.read("scene.exr")).rows, Exr(self.read("stdin.exr")).rows)

    def test_all_are_validated(self):
        self.write("bad.xml", "<raytracer/>")
        done = self.run_program("scene.xml", "bad.xml", "--validate")
        self.assertEqual(done.returncode, 1)
        self.assertTrue(done.stdout.startswith("scene.xml: ok ("), done.stdout)
        self.assertIn("bad.xml:1:1: error: ", done.stderr)


if __name__ == "__main__":
    unittest.main()
