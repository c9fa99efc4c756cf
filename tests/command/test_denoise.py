"""--denoise: what the filter gets and what becomes of it, with a library that stands in for Open Image Denoise
(fake_denoiser.cpp): it tells in each number what it was made of."""

import os
import re
import signal
import struct
import unittest

import support
from exr import Exr
from png import Png
from support import CommandTest

FAKE = os.environ["RAYTRACE_FAKE_DENOISER"]
ENVIRONMENT = {**os.environ, "RAYTRACE_DENOISER": FAKE}
IN_GROUPS = support.SCENE.replace("<scaleradiance>2</scaleradiance>", "<scaleradiance>2</scaleradiance> <group>key</group>")
SIZE = ["-r", "24x18", "-s", "4", "--float", "-q"]


class DenoiseTest(CommandTest):
    def render(self, name, *options, **keywords):
        size = [option for option in SIZE if option != "--float" or name.endswith(".exr")]
        self.succeed("scene.xml", "-o", name, *size, *options, env=ENVIRONMENT, **keywords)
        return Exr(self.read(name)) if name.endswith(".exr") else None

    def check(self, picture):
        """That its colours are what the filter makes of the picture."""
        for row in picture.rows.values():
            for x in range(picture.width):
                for color, axis in zip("RGB", "XYZ"):
                    expected = (row[f"noisy.{color}"][x] / 2 + 2 * row[f"denoise_albedo.{color}"][x] -
                                4 * row[f"denoise_normal.{axis}"][x])
                    self.assertAlmostEqual(row[color][x], expected, delta=1e-5)

    def bits(self, picture, names):
        return {(y, name): row[name] for y, row in picture.row_bytes.items() for name in names}


class Pictures(DenoiseTest):
    def test_the_filter_gets_the_picture(self):
        noisy = self.render("noisy.exr", "--aov", "denoise_albedo,denoise_normal")
        picture = self.render("clean.exr", "--denoise")
        self.check(picture)
        for color in "RGB":
            self.assertEqual([row[f"noisy.{color}"] for row in picture.row_bytes.values()],
                             [row[color] for row in noisy.row_bytes.values()], color)
        features = [name for name in picture.channels if name.startswith("denoise_")]
        self.assertEqual(len(features), 6)
        self.assertEqual(self.bits(picture, features), self.bits(noisy, features))
        self.assertEqual(picture.text("raytrace:denoiser"), "Open Image Denoise 2.3.4")
        self.assertGreater(max(max(row["denoise_albedo.R"]) for row in picture.rows.values()), 0.3)

    def test_other_aovs_and_formats(self):
        picture = self.render("clean.exr", "--denoise", "--aov", "depth,crypto_object", "-o", "clean.png")
        self.check(picture)
        self.assertIn("Z", picture.channels)
        self.assertNotIn("noisy.A", picture.channels)
        self.render("alone.png", "--denoise")
        self.assertEqual(Png(self.read("alone.png")).rows, Png(self.read("clean.png")).rows)
        self.render("noisy.png")
        self.assertNotEqual(Png(self.read("alone.png")).rows, Png(self.read("noisy.png")).rows)

    def test_alpha(self):
        noisy = self.render("noisy.exr", "--transparent", "--crop=0,-12,24,9")
        picture = self.render("clean.exr", "--transparent", "--denoise", "--crop=0,-12,24,9")
        self.assertEqual([row["noisy.A"] for row in picture.row_bytes.values()],
                         [row["A"] for row in noisy.row_bytes.values()])
        width, height = picture.width, picture.height
        top = picture.data_window[1]
        alpha = [picture.rows[top + y]["noisy.A"] for y in range(height)]
        kept = {0: 0, 1: 0, None: 0}
        for y in range(height):
            row = picture.rows[top + y]
            for x in range(width):
                around = {alpha[v][u] for v in range(max(0, y - 2), min(height, y + 3))
                          for u in range(max(0, x - 2), min(width, x + 3))}
                even = around in ({0}, {1})
                kept[alpha[y][x] if even else None] += 1
                wanted = alpha[y][x] if even else min(alpha[y][x] / 2 + row["denoise_albedo.R"][x] / 4, 1)
                self.assertAlmostEqual(row["A"][x], wanted, delta=1e-5)
                if row["A"][x] == 0:
                    self.assertEqual([row[color][x] for color in "RGB"], [0, 0, 0])
        self.assertTrue(all(count > 5 for count in kept.values()), kept)
        self.assertNotIn("noisy.A", self.render("opaque.exr", "--denoise").channels)

    def test_light_groups_and_halves(self):
        self.succeed("scene.xml", "-q", "-r", "24x18", "-s", "4", "-o", "half.exr", "--denoise", "--aov",
                     "light_default", env=ENVIRONMENT)
        picture = Exr(self.read("half.exr"))
        self.assertEqual({picture.channels[name] for name in ("R", "noisy.R")}, {"e"})
        self.assertEqual({picture.channels[name] for name in ("denoise_albedo.R", "light_default.R")}, {"f"})

    def filtered(self, row, x, layer, color):
        """What the filter makes of a layer that has noise."""
        axis = dict(zip("RGB", "XYZ"))[color]
        return row[f"noisy.{layer}.{color}"][x] / 2 + 2 * row[f"denoise_albedo.{color}"][x] - 4 * row[f"denoise_normal.{axis}"][x]

    def test_light_groups_are_denoised_like_the_picture(self):
        """One of two alone is what the filter makes of it; all of them still add up to the picture."""
        layers = ("light_key", "light_default")
        self.write("scene.xml", IN_GROUPS)
        noisy = self.render("noisy.exr", "--aov", ",".join(layers))
        alone = self.render("alone.exr", "--denoise", "--aov", "light_key")
        both = self.render("both.exr", "--denoise", "--aov", ",".join(layers))
        self.check(both)
        for color in "RGB":
            for picture, its in ((alone, layers[:1]), (both, layers)):
                for layer in its:
                    self.assertEqual([row[f"noisy.{layer}.{color}"] for row in picture.row_bytes.values()],
                                     [row[f"{layer}.{color}"] for row in noisy.row_bytes.values()])
            for row in alone.rows.values():
                for x in range(alone.width):
                    self.assertAlmostEqual(row[f"light_key.{color}"][x], self.filtered(row, x, "light_key", color), delta=1e-5)
            scaled = 0
            for row in both.rows.values():
                for x in range(both.width):
                    key, rest = (self.filtered(row, x, layer, color) for layer in layers)
                    if key + rest > 0.01:
                        scaled += 1
                        self.assertAlmostEqual(row[f"light_key.{color}"][x], key * row[color][x] / (key + rest), delta=1e-3)
                        self.assertAlmostEqual(sum(row[f"{layer}.{color}"][x] for layer in layers), row[color][x], delta=1e-5)
            self.assertGreater(scaled, 20)
        for tile in range(2):
            self.render(f"{tile}.exr", "--denoise", "--tile", f"{tile}/2", "--aov", ",".join(layers))
        self.succeed("merge", "-q", "0.exr", "1.exr", "-o", "merged.exr", env=ENVIRONMENT)
        self.assertEqual(Exr(self.read("merged.exr")).row_bytes, both.row_bytes)

    def test_passes_still_add_up_to_the_picture_beside_light_groups(self):
        self.write("scene.xml", IN_GROUPS)
        picture = self.render("clean.exr", "--denoise", "--aov", "passes,light_key,light_default")
        self.check(picture)
        passes = {name.rsplit(".", 1)[0] for name in picture.channels if re.match("[a-z]+_(in)?direct[.]", name)}
        passes |= {"emission", "background"}
        self.assertEqual(len(passes), 10)
        groups, scaled = {"light_key", "light_default"}, 0
        for row in picture.rows.values():
            for color in "RGB":
                for x in range(picture.width):
                    for layers in (passes, groups):
                        noisy = sum(row[f"noisy.{layer}.{color}"][x] for layer in layers)
                        self.assertAlmostEqual(noisy, row[f"noisy.{color}"][x], delta=1e-5)
                        if sum(self.filtered(row, x, layer, color) for layer in layers) > 0.01:
                            scaled += 1
                            self.assertAlmostEqual(sum(row[f"{layer}.{color}"][x] for layer in layers), row[color][x],
                                                   delta=1e-4)
        self.assertGreater(scaled, 40)

    def test_light_groups_that_take_light_away_keep_their_noise(self):
        self.write("scene.xml", IN_GROUPS.replace("<scaleradiance>2<", "<scaleradiance>-2<"))
        picture = self.render("clean.exr", "--denoise", "--aov", "light_key,light_default")
        self.assertLess(min(min(row["light_key.R"]) for row in picture.rows.values()), 0)
        for row in picture.row_bytes.values():
            for layer in ("light_key", "light_default"):
                self.assertEqual(row[f"{layer}.R"], row[f"noisy.{layer}.R"])

    def test_statistics(self):
        self.render("clean.exr", "--denoise", "--stats=stats.json")
        self.assertIn('"denoise":', self.read("stats.json").decode())
        self.render("noisy.exr", "--stats=stats.json")
        self.assertNotIn('"denoise":', self.read("stats.json").decode())

    def test_skip_existing(self):
        self.render("a.exr", "-o", "a.png")
        noisy = self.read("a.exr")
        self.render("a.exr", "-o", "a.png", "--denoise", "--skip-existing")
        clean = self.read("a.exr")
        self.assertNotEqual(clean, noisy)
        self.render("a.exr", "-o", "a.png", "--denoise", "--skip-existing")
        self.assertEqual(self.read("a.exr"), clean)
        self.render("a.exr", "-o", "a.png", "--skip-existing")
        self.assertNotIn("noisy.R", Exr(self.read("a.exr")).channels)


class Pieces(DenoiseTest):
    def test_merged_pieces_are_the_whole_picture(self):
        whole = self.render("whole.exr", "--denoise")
        self.render("whole.png", "--denoise")
        names = []
        for tile in range(2):
            for first in (0, 2):
                names.append(f"{tile}.{first}.exr")
                piece = self.render(names[-1], "--denoise", "--tile", f"{tile}/2", "-s", "2", "--sample-offset",
                                    str(first))
                self.assertNotIn("noisy.R", piece.channels)
        self.succeed("merge", *names, "-o", "merged.exr", "-o", "merged.png", env=ENVIRONMENT)
        merged = Exr(self.read("merged.exr"))
        self.assertEqual(set(merged.channels), set(whole.channels))
        self.assertEqual(self.bits(merged, whole.channels), self.bits(whole, whole.channels))
        self.assertEqual(Png(self.read("merged.png")).rows, Png(self.read("whole.png")).rows)
        self.assertEqual(merged.attributes["raytrace:denoised"][1], struct.pack("<i", 1))
        self.assertNotIn("raytrace:denoise", merged.attributes)

        message = self.fail_with(1, "merge", "whole.exr", "-o", "again.exr", env=ENVIRONMENT)
        self.assertIn("whole.exr is denoised", message)

    def test_pieces_that_do_not_ask_for_it(self):
        self.render("0.exr", "--tile", "0/2", "--aov", "denoise_albedo,denoise_normal")
        self.render("1.exr", "--tile", "1/2", "--aov", "denoise_albedo,denoise_normal")
        self.succeed("merge", "0.exr", "1.exr", "-o", "noisy.exr", env=ENVIRONMENT)
        self.assertNotIn("noisy.R", Exr(self.read("noisy.exr")).channels)
        self.succeed("merge", "0.exr", "1.exr", "-o", "clean.exr", "--denoise", env=ENVIRONMENT)
        self.check(Exr(self.read("clean.exr")))

        self.render("0.exr", "--tile", "0/2", "--aov", "denoise_albedo")
        self.render("1.exr", "--tile", "1/2", "--aov", "denoise_albedo")
        message = self.fail_with(1, "merge", "0.exr", "1.exr", "-o", "b.exr", "--denoise", env=ENVIRONMENT)
        self.assertIn("no denoise_normal: render them with --denoise", message)
        self.assertNotIn("b.exr", self.names())

    def test_crops_are_pictures(self):
        self.check(self.render("crop.exr", "--denoise", "--crop", "3,4,20,15"))

    def test_files_that_cannot_be_merged(self):
        for part in (["--tile", "0/2"], ["--sample-offset", "0"]):
            message = self.fail_with(2, "scene.xml", "-o", "a.png", "--denoise", *part, env=ENVIRONMENT)
            self.assertIn("a.png: a picture is denoised as a whole", message)


class Failures(DenoiseTest):
    def test_no_library(self):
        environment = {**os.environ, "RAYTRACE_DENOISER": self.folder}
        message = self.fail_with(1, "scene.xml", "-o", "a.exr", "--denoise", env=environment)
        self.assertIn("denoising needs Open Image Denoise 2", message)
        self.assertIn("RAYTRACE_DENOISER=FOLDER", message)
        self.assertEqual(self.names(), ["scene.xml"])
        self.succeed("scene.xml", *SIZE, "-o", "a.exr", "--denoise", "--tile", "0/1", env=environment)
        self.fail_with(1, "merge", "a.exr", "-o", "b.exr", env=environment)
        self.assertEqual(self.names(), ["a.exr", "scene.xml"])

    def test_a_library_of_another_kind(self):
        os.symlink("/lib64/ld-linux-x86-64.so.2", self.path("libOpenImageDenoise.so.2"))
        environment = {**os.environ, "RAYTRACE_DENOISER": self.folder}
        message = self.fail_with(1, "scene.xml", "-o", "a.exr", "--denoise", env=environment)
        self.assertIn("denoising needs Open Image Denoise 2", message)

    def test_a_filter_that_fails_loses_no_picture(self):
        self.render("noisy.exr", "--aov", "denoise_albedo,denoise_normal")
        for mode, reason in (("fails", "Open Image Denoise fails: it was asked to"),
                             ("memory", "no memory to denoise the picture")):
            message = self.fail_with(1, "scene.xml", *SIZE, "-o", "a.exr", "--denoise", "--checkpoint", f"{mode}.ckpt",
                                     env={**ENVIRONMENT, "FAKE_DENOISER": mode})
            self.assertIn(f"{reason}; it is written with its noise", message)
            self.assertEqual(Exr(self.read("a.exr")).row_bytes, Exr(self.read("noisy.exr")).row_bytes)
        # It is not the picture that was asked for.
        self.check(self.render("a.exr", "--denoise", "--skip-existing"))

    def test_stopped_while_it_filters(self):
        whole = self.render("whole.exr", "--denoise")
        process = self.start_program("scene.xml", *SIZE, "-o", "a.exr", "--denoise", "--checkpoint", "a.ckpt",
                                     "--progress", "json", env={**ENVIRONMENT, "FAKE_DENOISER": "waits"})
        for line in process.stdout:  # until all is rendered
            if '"percent":100.0' in line:
                break
        process.send_signal(signal.SIGTERM)
        _, message = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 75, message)
        self.assertIn("raytrace:partial", Exr(self.read("a.exr")).attributes)
        resumed = self.render("a.exr", "--denoise", "--checkpoint", "a.ckpt", "--resume")
        self.assertEqual(resumed.row_bytes, whole.row_bytes)
        self.assertNotIn("a.ckpt", self.names())


class Library(CommandTest):
    @unittest.skipUnless(os.path.exists(os.path.join(support.REPOSITORY, "build/denoiser/lib")),
                         "cmake/denoiser has not been run")
    @unittest.skipIf(support.SANITIZERS, "which do not know its code")
    def test_open_image_denoise_itself(self):
        environment = {**os.environ, "RAYTRACE_DENOISER": os.path.join(support.REPOSITORY, "build/denoiser/lib")}
        scene = os.path.join(support.REPOSITORY, "scenes", "path.xml")
        options = ["-q", "--float", "-r", "120x90"]
        self.succeed(scene, *options, "-s", "512", "-o", "reference.exr")
        for threads in ("1", "2"):
            self.succeed(scene, *options, "-s", "4", "-o", f"{threads}.exr", "--denoise", "-t", threads,
                         env=environment)
        reference, clean, other = (Exr(self.read(name)).rows for name in ("reference.exr", "1.exr", "2.exr"))
        self.assertEqual(clean, other)

        def error(color):
            return sum((a - b) ** 2 for y, row in reference.items() for a, b in zip(row["G"], clean[y][color]))

        self.assertLess(error("G"), 0.4 * error("noisy.G"))
