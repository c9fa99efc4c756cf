"""However a picture is cut - threads, crops, tiles, ranges of samples, interruptions - its pixels have the same bits.

Here each way to cut goes once through the program; render/cuts_test.cpp has many of each, in process."""

import glob
import os
import random
import signal
import subprocess
import time
import unittest

import support
from exr import Exr
from support import CommandTest, REPOSITORY

SCENES = sorted(glob.glob(os.path.join(REPOSITORY, "scenes", "gallery", "*.xml")))
WIDTH, HEIGHT = 40, 28  # no multiples of the blocks of 8 x 8 pixels that are traced together


def cut(chance, total, parts):
    """[0, total) as so many ranges that are not empty, or fewer."""
    edges = sorted({0, total, *(chance.randrange(1, total) for _ in range(parts - 1))})
    return list(zip(edges, edges[1:]))


def random_crop(chance):
    left, top = chance.randrange(WIDTH), chance.randrange(HEIGHT)
    return left, top, chance.randint(left + 1, WIDTH), chance.randint(top + 1, HEIGHT)


class Pieces(CommandTest):
    def setUp(self):
        super().setUp()
        self.commands = []  # of the case at hand, for the message

    def render(self, scene, name, *options):
        self.commands.append(" ".join([scene, "-o", name, *options]))
        self.succeed(scene, "-q", "--float", "-r", f"{WIDTH}x{HEIGHT}", "-o", name, *options)
        return Exr(self.read(name))

    def merge(self, chance, names):
        chance.shuffle(names)
        self.commands.append(" ".join(["merge", *names]))
        self.succeed("merge", "-q", *names, "-o", "merged.exr")
        return Exr(self.read("merged.exr"))

    def tiles(self, chance, scene, samples, options, parts, split):
        """Renders all tiles, each in up to `split` ranges of samples of its own; returns the names."""
        names = []
        count = chance.randint(2, parts)
        for tile in range(count):
            where = [*options, "--tile", f"{tile}/{count}", "-t", str(chance.randint(1, 4))]
            names += self.ranges(chance, scene, samples, where, chance.randint(1, split), f"tile{tile}.")
        return names

    def ranges(self, chance, scene, samples, options, parts, name=""):
        if parts == 1:
            self.render(scene, f"{name}exr", "-s", str(samples), *options)
            return [f"{name}exr"]
        names = []
        for first, last in cut(chance, samples, parts):
            names.append(f"{name}from{first}.exr")
            self.render(scene, names[-1], "-s", str(last - first), "--sample-offset", str(first), *options)
        return names

    def one_way(self, chance, kind, scene, samples):
        """The whole picture, or the crop (left, top, right, bottom) of it, in a way of this kind."""
        crop = (0, 0, WIDTH, HEIGHT)
        options = []
        if kind.endswith("of a crop"):
            crop = random_crop(chance)
            while (crop[2] - crop[0]) * (crop[3] - crop[1]) < 8:  # enough pixels for all tiles
                crop = random_crop(chance)
            options = ["--crop", ",".join(map(str, crop))]
        if kind.startswith("threads"):
            picture = self.render(scene, "whole.exr", "-s", str(samples), "-t", str(chance.randint(1, 8)), *options)
        elif kind.startswith("passes"):  # a time limit makes it go over the picture several times
            picture = self.render(scene, "whole.exr", "-s", str(samples), "--time-limit", "10h", *options)
        elif kind.startswith("tiles"):
            picture = self.merge(chance, self.tiles(chance, scene, samples, options, 6, 1))
        elif kind.startswith("samples"):
            picture = self.merge(chance, self.ranges(chance, scene, samples, options, chance.randint(2, 5)))
        else:
            assert kind.startswith("mixed"), kind
            picture = self.merge(chance, self.tiles(chance, scene, samples, options, 3, 3))
        return crop, picture

    def test_each_kind_of_cut(self):
        kinds = ["threads", "threads of a crop", "passes", "passes of a crop", "tiles", "tiles of a crop", "samples",
                 "samples of a crop", "mixed", "mixed of a crop"]
        self.assertGreaterEqual(len(SCENES), 7)
        for number, kind in enumerate(kinds):
            scene = SCENES[number % len(SCENES)]
            chance = random.Random(kind)
            samples = chance.randint(8, 12)
            self.commands = []
            whole = self.render(scene, "reference.exr", "-s", str(samples), "-t", "1")
            crop, picture = self.one_way(chance, kind, scene, samples)
            left, top, right, bottom = crop
            self.assertEqual(picture.data_window, (left, top, right - 1, bottom - 1), self.commands)
            self.assertEqual(picture.display_window, whole.display_window)
            self.assertEqual(picture.channels, whole.channels)
            if picture.bytes_of(*crop) != whole.bytes_of(*crop):
                self.fail(f"{kind}, {samples} samples: other bits after " + "; ".join(self.commands))

    def test_gallery_scenes_interrupted_at_random(self):
        stopped = {signal.SIGTERM: 0, signal.SIGKILL: 0}
        for scene in SCENES if support.LONG else SCENES[:2]:
            chance = random.Random(os.path.basename(scene))
            options = [scene, "-q", "--float", "-r", f"{WIDTH}x{HEIGHT}", "-s", support.samples(601)]
            began = time.monotonic()
            self.succeed(*options, "-o", "reference.exr")
            seconds = time.monotonic() - began
            whole = self.read("reference.exr")
            for number in stopped:
                resumable = [*options, "-o", "a.exr", "--checkpoint", "checkpoint.exr", "--checkpoint-interval", "0.05s",
                             "--resume"]
                for _ in range(2):
                    process = self.start_program(*resumable, "-t", str(chance.randint(1, 8)))
                    try:
                        _, told = process.communicate(timeout=chance.uniform(0, seconds))
                    except subprocess.TimeoutExpired:
                        process.send_signal(number)
                        _, told = process.communicate(timeout=600)
                    # A signal before the program listens to it ends it, too.
                    self.assertIn(process.returncode, (0, 75, -number), told)
                    stopped[number] += process.returncode != 0
                self.succeed(*resumable)
                self.assertNotIn("checkpoint.exr", self.names())
                if Exr(self.read("a.exr")).row_bytes != Exr(whole).row_bytes:
                    self.fail(f"{scene} stopped by {signal.Signals(number).name} has other bits")
        self.assertGreater(stopped[signal.SIGTERM], 0)
        self.assertGreater(stopped[signal.SIGKILL], 0)


if __name__ == "__main__":
    unittest.main()
