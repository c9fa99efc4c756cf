"""`raytrace merge`: what it refuses, and what it keeps."""

import os
import random
import signal
import struct
import subprocess
import unittest
from itertools import compress

import support
from exr import Exr
from support import CommandTest, ENDLESS, REPOSITORY


class Merge(CommandTest):
    def render(self, name, *options, scene="scene.xml"):
        self.succeed(scene, "-q", "-o", name, *options)
        return Exr(self.read(name))

    def merge(self, *pieces, options=()):
        self.succeed("merge", "-q", *pieces, "-o", "merged.exr", *options)
        return Exr(self.read("merged.exr"))

    def refused(self, *arguments):
        """What merging says, which must not leave a picture."""
        message = self.fail_with(1, "merge", *arguments, "-o", "refused.exr")
        self.assertEqual([name for name in self.names() if "refused" in name], [])
        return message

    def tiles(self, count, *options):
        names = [f"tile{i}.exr" for i in range(count)]
        for i, name in enumerate(names):
            self.render(name, "--tile", f"{i}/{count}", *options)
        return names

    def stopped_piece(self, name, *options):
        """A piece whose render was stopped by SIGTERM before its end."""
        for seconds in (0.5, 1, 2, 4, 8, 16, 32, 64):
            process = self.start_program("scene.xml", "-q", "-o", name, "--checkpoint", "checkpoint.exr", "--resume",
                                         *options)
            try:
                process.communicate(timeout=seconds)
            except subprocess.TimeoutExpired:
                process.send_signal(signal.SIGTERM)
                process.communicate(timeout=600)
            if process.returncode == 75:
                return
        self.fail("no signal stopped the render with the exit code 75")

    def test_pieces_of_something_else_are_refused(self):
        self.render("a.exr", "--tile", "0/2")
        self.write("other.xml", support.SCENE.replace("<radius>1</radius>", "<radius>1.5</radius>"))
        instruction_sets = self.succeed("--version").stdout.split("instruction sets: ")[1].split(" (best here: ")
        names, best = instruction_sets[0].split(", "), instruction_sets[1].split(")")[0]
        cases = [("the scene", ["--tile", "1/2"], "other.xml"),
                 ("the seed (7, not 0)", ["--tile", "1/2", "--seed", "7"], "scene.xml"),
                 ("the resolution (40 x 30, not 80 x 60)", ["--tile", "1/2", "-r", "40x30"], "scene.xml"),
                 ("the crop that it is a part of", ["--tile", "1/2", "--crop", "0,0,79,60"], "scene.xml"),
                 ("the background (transparent, not opaque): use --transparent for all of them, or none",
                  ["--tile", "1/2", "--transparent"], "scene.xml"),
                 ("its channels", ["--tile", "1/2", "--float"], "scene.xml"),
                 ("the AOVs (depth, not none)", ["--tile", "1/2", "--aov", "depth"], "scene.xml"),
                 ("the position of the samples", ["--tile", "1/2", "-s", "1"], "scene.xml")]
        if names.index(best) > 0:
            cases.append((f"the instruction set ({names[0]}, not {best})", ["--tile", "1/2", "--isa", names[0]],
                          "scene.xml"))
        for what, options, scene in cases:
            with self.subTest(what):
                self.render("b.exr", *options, scene=scene)
                self.assertIn(f"b.exr does not belong to a.exr: it differs in {what}", self.refused("a.exr", "b.exr"))
                self.assertIn(f"it differs in {what}", self.refused("a.exr", "b.exr", "--partial"))

    def test_frame_and_variables_are_kept_and_compared(self):
        self.write("scene.xml", support.SCENE.replace("<radius>1</radius>", "<radius>${size:-1}</radius>")
                   .replace('<eye x="0"', '<eye x="0.$frame"'))

        def render(tile, frame, size):
            self.succeed("scene.xml", "-q", "--frames", frame, "-D", f"size={size}", "--tile", f"{tile}/2",
                         "-o", f"{tile}.#.exr")

        render(0, "7", "0.5")
        render(1, "7", "0.5")
        self.succeed("merge", "0.7.exr", "1.7.exr", "-o", "whole.exr", "-o", "whole.png")
        picture = Exr(self.read("whole.exr"))
        self.assertEqual(picture.attributes["raytrace:frame"], ("int", struct.pack("<i", 7)))
        self.assertEqual(picture.text("raytrace:variables"), "size=0.5")
        self.assertIn(b"raytrace:variables\0size=0.5", self.read("whole.png"))
        render(1, "8", "0.5")
        self.assertIn("it differs in the scene (frame 8, not frame 7)\n", self.refused("0.7.exr", "1.8.exr"))
        render(1, "7", "2")
        self.assertIn("it differs in the scene (size=2, not size=0.5)\n", self.refused("0.7.exr", "1.7.exr"))

    def test_overlaps_and_gaps_are_refused_by_name(self):
        pieces = self.tiles(3)
        self.assertIn("tile1.exr holds what tile1.exr holds, too", self.refused(*pieces, "tile1.exr"))
        self.render("all.exr")
        message = self.refused(*pieces, "all.exr")
        for name in pieces:
            self.assertRegex(message, f"all.exr holds what {name} holds|{name} holds what all.exr holds")
        self.assertEqual(self.refused("tile2.exr", "tile0.exr"),
                         "raytrace: error: tile 1/3 is missing: render it with --tile 1/3 -s 4\n")
        self.render("missing.exr", "--tile", "1/3", "-s", "4")
        self.merge("tile2.exr", "tile0.exr", "missing.exr")

    def test_missing_and_doubled_samples_are_refused(self):
        for first, count in ((0, 3), (3, 2), (5, 4), (4, 1)):
            self.render(f"from{first}.exr", "-s", str(count), "--sample-offset", str(first))
        self.assertIn("samples 3 to 4 are missing: render them with --sample-offset 3 -s 2\n",
                      self.refused("from5.exr", "from0.exr"))
        self.assertRegex(self.refused("from0.exr", "from3.exr", "from4.exr", "from5.exr"),
                         "from[34].exr holds what from[34].exr holds, too")
        message = self.refused("from0.exr", "from3.exr", "-s", "9")
        self.assertIn("the pieces hold 5 samples per pixel, not 9\n", message)
        self.assertIn("samples 5 to 8 are missing: render them with --sample-offset 5 -s 4\n", message)
        self.merge("from0.exr", "from3.exr", "from5.exr", options=["-s", "9"])
        self.merge("from0.exr", "from3.exr")  # who does not say how many has a picture of 5

    def test_files_that_are_no_pieces_are_refused_by_name(self):
        pieces = self.tiles(2)
        self.assertIn("none.exr", self.refused("tile0.exr", "none.exr"))
        self.write("text.exr", "this is no picture")
        self.write("empty.exr", "")
        for name in ("text.exr", "empty.exr"):
            self.assertIn(f"cannot read {name}: it is not an EXR file", self.refused(*pieces, name))
        whole = self.read("tile1.exr")
        chance = random.Random(1)
        for size in (4, 100, *(chance.randrange(len(whole)) for _ in range(20)), len(whole) - 1):
            with open(self.path("cut.exr"), "wb") as file:
                file.write(whole[:size])
            self.assertIn("cannot read cut.exr: ", self.refused("tile0.exr", "cut.exr"), f"{size} bytes")

    def test_what_is_no_regular_file_is_refused_at_once(self):
        self.tiles(2)
        os.mkfifo(self.path("pipe"))
        for piece in ("pipe", "/dev/zero", "."):
            self.assertIn(f"cannot read {piece}: it is ", self.refused("tile0.exr", piece))
        for name in ("pipe", "/dev/zero", "."):
            message = self.fail_with(2, "merge", "@" + name, "-o", "refused.exr")
            self.assertIn(f"the list of pieces {name} is no regular file", message)
        message = self.fail_with(1, "scene.xml", "-o", "a.exr", "--checkpoint", "pipe", "--resume")
        self.assertIn("pipe: it is not a regular file", message)
        self.assertIn("there is no list of pieces none", self.fail_with(2, "merge", "@none", "-o", "refused.exr"))

    def test_lists_as_other_systems_write_them(self):
        whole = self.render("all.exr")
        self.tiles(2)
        for text in (b"tile0.exr\r\ntile1.exr\r\n", b"\xef\xbb\xbftile0.exr\ntile1.exr",
                     b"\n\ntile0.exr  \n \t\r\ntile1.exr\t\n\n", b"\xef\xbb\xbf\r\ntile0.exr \r\ntile1.exr"):
            with open(self.path("list"), "wb") as file:
                file.write(text)
            self.assertEqual(self.merge("@list").row_bytes, whole.row_bytes, text)
        self.write("list", "\r\n")
        self.assertIn("no pieces given", self.fail_with(2, "merge", "@list", "-o", "refused.exr"))

    def test_windows_that_are_not_a_pieces_own(self):
        """What render/hostile_pieces_test.cpp tries in many ways, from one end to the other."""
        self.tiles(2)
        good = self.read("tile1.exr")
        window = good.index(b"dataWindow\0box2i\0") + len(b"dataWindow\0box2i\0") + 4
        left, top, right, bottom = struct.unpack_from("<4i", good, window)
        for shift in (1, 8, 500, 100000 - left, -left, 2**31 - 1 - right):
            bad = bytearray(good)
            struct.pack_into("<4i", bad, window, left + shift, top, right + shift, bottom)
            with open(self.path("tile1.exr"), "wb") as file:
                file.write(bad)
            for options in ([], ["--partial"]):
                message = self.refused("tile0.exr", "tile1.exr", *options)
                self.assertRegex(message, "tile1.exr.* data window")

    def test_a_piece_that_was_stopped_is_refused_but_with_partial(self):
        self.stopped_piece("tile1.exr", *ENDLESS, "--crop", "0,0,400,400")
        self.assertIn("tile1.exr was stopped before its end: render it to its end with --resume, or use --partial",
                      self.refused("tile1.exr"))
        stopped = Exr(self.read("tile1.exr"))
        self.assertEqual(stopped.attributes["raytrace:partial"], ("int", struct.pack("<i", 1)))
        picture = self.merge("tile1.exr", options=["--partial"])
        self.assertEqual(picture.attributes["raytrace:partial"], ("int", struct.pack("<i", 1)))
        for y, row in picture.rows.items():
            done = [count > 0 for count in stopped.rows[y]["sums.samples"]]
            for name, values in row.items():
                self.assertEqual(list(compress(values, done)), list(compress(stopped.rows[y][name], done)), (name, y))

    def test_partial_fills_what_is_missing_with_checks(self):
        whole = self.render("all.exr")
        self.tiles(3)
        left, top, right, bottom = Exr(self.read("tile1.exr")).data_window
        done = self.succeed("merge", "tile0.exr", "tile2.exr", "--partial", "-o", "merged.exr")
        self.assertIn("the picture is not complete", done.stderr)
        picture = Exr(self.read("merged.exr"))
        self.assertEqual(picture.attributes["raytrace:partial"], ("int", struct.pack("<i", 1)))
        greys = set()
        for (x, y), pixel in picture.pixels().items():
            if left <= x <= right and top <= y <= bottom:
                self.assertEqual((pixel[1], pixel[2], pixel[3]), (pixel[0], pixel[0], 0))
                greys.add(((x // 8 + y // 8) % 2, pixel[0]))
            else:
                self.assertEqual(pixel, whole.pixel(x, y))
        self.assertEqual(len(greys), 2)
        complete = self.merge("tile0.exr", "tile1.exr", "tile2.exr", options=["--partial"])
        self.assertNotIn("raytrace:partial", complete.attributes)
        self.assertEqual(complete.row_bytes, whole.row_bytes)

    def test_partial_takes_the_samples_that_there_are(self):
        self.render("from0.exr", "-s", "3", "--sample-offset", "0")
        self.render("from8.exr", "-s", "2", "--sample-offset", "8", "--crop", "0,0,80,30")
        # A crop is a picture of its own: no part of the whole, whose samples are sought.
        self.assertIn("the crop that it is a part of", self.refused("from0.exr", "from8.exr", "--partial"))
        self.render("from8.exr", "-s", "2", "--sample-offset", "8", "--tile", "0/2")
        left, top, right, bottom = Exr(self.read("from8.exr")).data_window
        three = self.render("three.exr", "-s", "3")
        picture = self.merge("from8.exr", "from0.exr", options=["--partial"])
        self.assertIn("raytrace:partial", picture.attributes)
        differing = {(x, y) for (x, y), pixel in picture.pixels().items() if pixel != three.pixel(x, y)}
        self.assertGreater(len(differing), 10)
        self.assertEqual({(x, y) for x, y in differing if not (left <= x <= right and top <= y <= bottom)}, set())

    def test_tiles_with_light_paths(self):
        with open(os.path.join(REPOSITORY, "scenes", "caustics.xml"), encoding="utf-8") as file:
            self.write("scene.xml", file.read())
        options = ["-q", "-r", "40x30", "-s", "4"]
        self.succeed("scene.xml", *options, "-o", "all.exr")
        whole = Exr(self.read("all.exr"))
        names = [f"tile{i}.exr" for i in range(3)]
        for i, name in enumerate(names):
            self.succeed("scene.xml", *options, "--tile", f"{i}/3", "-o", name)
        self.assertEqual(Exr(self.read(names[1])).data_window, whole.data_window)
        merged = self.merge(*names)
        self.assertEqual(merged.row_bytes, whole.row_bytes)
        # A farm that runs a task again finds it done; another tile's file is not it.
        again = self.succeed("scene.xml", *options[1:], "--tile", "1/3", "--skip-existing", "-o", names[1])
        self.assertIn("skipped", again.stderr)
        other = self.succeed("scene.xml", *options[1:], "--tile", "2/3", "--skip-existing", "-o", names[1])
        self.assertNotIn("skipped", other.stderr)
        # Nothing else can be put together.
        done = self.run_program("scene.xml", *options, "--tile", "0/3", "-o", "tile.png")
        self.assertEqual(done.returncode, 2)
        self.assertIn("light paths", done.stderr)
        # What a tile's file brings to others is in the picture, as far as it is there.
        done = self.succeed("merge", names[0], names[2], "--partial", "-o", "part.exr")
        self.assertIn("the picture is not complete", done.stderr)
        self.assertIn("raytrace:partial", Exr(self.read("part.exr")).attributes)

    def test_channel_types_are_kept(self):
        for options, code in (([], "e"), (["--float"], "f")):
            whole = self.render("all.exr", "-s", "6", *options)
            picture = self.merge(*self.tiles(2, "-s", "6", *options))
            self.assertEqual(picture.channels, dict.fromkeys("ABGR", code))
            self.assertEqual(picture.row_bytes, whole.row_bytes)
            for first, count in ((0, 1), (1, 5)):
                self.render(f"from{first}.exr", "-s", str(count), "--sample-offset", str(first), *options)
            picture = self.merge("from1.exr", "from0.exr")
            self.assertEqual(picture.channels, dict.fromkeys("ABGR", code))
            self.assertEqual(picture.row_bytes, whole.row_bytes)

    def test_pieces_beyond_the_picture(self):
        crop = ["--crop", "-13,-9,101,75", "-s", "6", "--aov", "depth,crypto_object"]
        whole = self.render("all.exr", *crop)
        self.assertEqual((whole.data_window, whole.display_window), ((-13, -9, 100, 74), (0, 0, 79, 59)))
        names = self.tiles(3, *crop)
        self.assertIn("tile 1/3 is missing: render it with --tile 1/3 -s 6 --crop=-13,-9,101,75",
                      self.refused(names[0], names[2]))
        self.assertEqual(self.merge(*names).row_bytes, whole.row_bytes)
        for first in (0, 4):
            self.render(f"from{first}.exr", *crop, "--tile", "1/3", "--sample-offset", str(first), "-s",
                        "4" if first == 0 else "2")
        picture = self.merge(names[2], "from4.exr", names[0], "from0.exr")
        self.assertEqual(picture.row_bytes, whole.row_bytes)
        self.assertEqual((picture.data_window, picture.display_window), (whole.data_window, whole.display_window))
        self.merge(names[0], options=["--partial"])

    def test_metadata_is_kept(self):
        whole = self.render("all.exr", "-s", "9", "--seed", "5", "--crop", "3,5,61,50")
        for first, count in ((0, 4), (4, 5)):
            self.render(f"from{first}.exr", "-s", str(count), "--sample-offset", str(first), "--seed", "5", "--crop",
                        "3,5,61,50")
        picture = self.merge("from4.exr", "from0.exr")
        of_the_run = {"capDate", "raytrace:renderSeconds", "raytrace:threads"}
        self.assertEqual(set(picture.attributes) | of_the_run, set(whole.attributes) | of_the_run)
        for name in set(picture.attributes) - of_the_run:
            self.assertEqual(picture.attributes[name], whole.attributes[name], name)
        self.assertEqual(picture.attributes["raytrace:samples"], ("int", struct.pack("<i", 9)))
        self.assertEqual(picture.text("raytrace:scene"), "scene.xml")
        self.assertEqual(picture.text("raytrace:seed"), "5")

    def test_aovs_of_mixed_pieces_are_those_of_the_whole(self):
        crop = ["--aov", "all", "--crop", "13,9,70,47"]  # no edge on a block's
        whole = self.render("all.exr", "-s", "9", "--aov", "all")
        part = self.render("part.exr", "-s", "9", *crop)
        self.assertEqual(part.bytes_of(13, 9, 70, 47), whole.bytes_of(13, 9, 70, 47))
        self.render("tile0.exr", "-s", "9", "--tile", "0/3", *crop)
        names = ["tile0.exr"]
        for tile in (1, 2):
            for first, count in ((0, 5), (5, 1), (6, 3)):
                names.append(f"tile{tile}from{first}.exr")
                self.render(names[-1], "-s", str(count), "--sample-offset", str(first), "--tile", f"{tile}/3", *crop)
        random.Random(4).shuffle(names)
        picture = self.merge(*names)
        self.assertEqual(picture.channels, whole.channels)
        self.assertEqual(picture.data_window, part.data_window)
        self.assertEqual(picture.display_window, whole.display_window)
        self.assertEqual(picture.row_bytes, part.row_bytes)


if __name__ == "__main__":
    unittest.main()
