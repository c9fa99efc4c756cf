"""A render that is killed, stopped, limited or asked for a picture: nothing is lost, and the bits are the same."""

import json
import os
import random
import signal
import struct
import subprocess
import time
import unittest

import support
from exr import Exr
from support import CommandTest

# The same command gives the same bytes, header and all.
ENVIRONMENT = dict(os.environ, SOURCE_DATE_EPOCH="0")
LIMIT = 300  # seconds after which whatever a test waits for does not come any more
# Enough for a signal to come in time on a busy machine, with one thread on a fast one: that takes a second.
MANY = ["-t", "1", "-s", support.samples(30000)]
# Of a render that is to be stopped long before its end. Of more, sums are less precise than those of few.
LONG_RENDER = ["-t", "1", "-s", "500000"]


class SafetyTest(CommandTest):
    def run_program(self, *arguments, **keywords):
        return super().run_program(*arguments, env=ENVIRONMENT, **keywords)

    def start(self, *arguments):
        process = self.start_program(*arguments, env=ENVIRONMENT)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.stderr.close)
        return process

    def wait_for(self, condition, process, what):
        end = time.monotonic() + LIMIT
        while not condition():
            if process.poll() is not None:
                self.fail(f"ended with {process.returncode} before {what}: {process.stderr.read()}")
            if time.monotonic() > end:
                self.fail(f"waited in vain for {what}")
            time.sleep(0.01)

    def wait_for_file(self, name, process):
        self.wait_for(lambda: os.path.exists(self.path(name)), process, name)

    def wait_for_rays(self, process):
        # Of this signal: those to stop are caught before, where there is a checkpoint.
        self.wait_for(lambda: support.catches(process, signal.SIGUSR1), process, "its handlers")
        before = support.processor_seconds(process)  # handlers come before rays
        self.wait_for(lambda: support.processor_seconds(process) > before + 0.1, process, "rays")

    def exr(self, name):
        return Exr(self.read(name))

    def assert_same(self, name, wanted):
        self.assertTrue(self.read(name) == wanted, f"{name} has other bytes than an uninterrupted render")

    def stopped_checkpoint(self, *arguments):
        """Makes checkpoint.exr of a render that SIGTERM stopped early."""
        process = self.start("scene.xml", "-q", "-o", "partial.exr", *LONG_RENDER, "--checkpoint", "checkpoint.exr",
                             "--checkpoint-interval", "0.01s", *arguments)
        self.wait_for_file("checkpoint.exr", process)
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(timeout=LIMIT), 75, process.stderr.read())


class Killed(SafetyTest):
    def test_kills_at_random_moments(self):
        moments, samples = (200, support.samples(24000)) if support.LONG else (15, support.samples(3000))
        samples = str(max(int(samples), 250))  # with a sanitizer, too, most of the time must be rendering
        chance = random.Random(1)
        scene = ["scene.xml", "-q", "-s", samples, "--aov", "depth,crypto_object"]
        begin = time.monotonic()
        self.succeed(*scene, "-o", "whole.exr")
        seconds = time.monotonic() - begin
        wanted = self.read("whole.exr")
        command = [*scene, "-o", "a.exr", "--resume", "--checkpoint", "checkpoint.exr", "--checkpoint-interval",
                   "0.02s"]
        kills = resumed = ended = 0
        while kills < moments:
            resumed += os.path.exists(self.path("checkpoint.exr"))
            process = self.start(*command, "-t", str(chance.randint(1, 4)))
            try:
                code = process.wait(timeout=chance.uniform(0, seconds * 0.8))
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
                kills += 1
                continue
            self.assertEqual(code, 0, f"after {kills} kills: {process.stderr.read()}")
            ended += 1
            self.assertEqual([name for name in self.names() if not name.startswith(".")],
                             ["a.exr", "scene.xml", "whole.exr"])
            self.assert_same("a.exr", wanted)
            os.remove(self.path("a.exr"))
        self.succeed(*command)
        self.assert_same("a.exr", wanted)
        self.assertGreater(resumed, 0, f"none of {kills} kills came after a checkpoint")
        if support.LONG:
            print(f"{kills} kills, {resumed} times resumed, {ended + 1} renders ended with the same bits")
        # What stays of a process that was killed while it wrote has a name that nobody takes for a picture.
        for name in self.names():
            self.assertRegex(name, r"^(\.raytrace-.*|a\.exr|scene\.xml|whole\.exr)$")


class Stopped(SafetyTest):
    def test_stop_and_resume(self):
        self.succeed("scene.xml", "-q", "-o", "whole.exr", *MANY)
        for number in (signal.SIGTERM, signal.SIGINT):
            command = ["scene.xml", "-q", "-o", "a.exr", *MANY, "--checkpoint", "checkpoint.exr",
                       "--checkpoint-interval", "0.01s", "--resume"]
            process = self.start(*command)
            self.wait_for_file("checkpoint.exr", process)
            process.send_signal(number)
            self.assertEqual(process.wait(timeout=LIMIT), 75, process.stderr.read())
            self.assertEqual(self.names(), ["a.exr", "checkpoint.exr", "scene.xml", "whole.exr"])
            for name in ("a.exr", "checkpoint.exr"):
                partial = self.exr(name)
                self.assertEqual(partial.attributes["raytrace:partial"], ("int", struct.pack("<i", 1)))
                self.assertEqual((partial.width, partial.height), (80, 60))
            self.assertTrue(self.exr("a.exr").pixels() == self.exr("checkpoint.exr").pixels())
            self.succeed(*command)
            self.assertEqual(self.names(), ["a.exr", "scene.xml", "whole.exr"])
            self.assertNotIn("raytrace:partial", self.exr("a.exr").attributes)
            self.assert_same("a.exr", self.read("whole.exr"))
            os.remove(self.path("a.exr"))

    def test_before_there_are_rays(self):
        """While the scene is read: with a checkpoint, the render is to be begun again; without, the signal ends it."""
        for number in (signal.SIGTERM, signal.SIGHUP, signal.SIGUSR2):
            for checkpoint, code in (["--checkpoint", "c.exr"], 75), ([], -number):
                process = subprocess.Popen([support.PROGRAM, "-", "-q", "-o", "a.exr", *checkpoint], cwd=self.folder,
                                           stdin=subprocess.PIPE, env=ENVIRONMENT)
                self.addCleanup(process.kill)
                process.stdin.write(b"<raytracer>")
                process.stdin.flush()
                if checkpoint:
                    end = time.monotonic() + LIMIT
                    while not support.catches(process, number) and time.monotonic() < end:
                        time.sleep(0.01)
                process.send_signal(number)
                if "thread" in support.SANITIZERS:
                    process.stdin.close()  # the thread sanitizer keeps handlers back until a library's call returns
                self.assertEqual(process.wait(timeout=LIMIT), code)
                process.stdin.close()
                self.assertEqual(self.names(), ["scene.xml"])

    def stop(self, number, *arguments):
        process = self.start("scene.xml", *support.ENDLESS, "--progress=plain", *arguments)
        self.assertIn("rendered", process.stderr.readline())
        process.send_signal(number)
        return process.wait(timeout=LIMIT)

    def test_without_a_checkpoint(self):
        """The picture so far, but never over a complete one."""
        self.succeed("scene.xml", "-q", "-o", "complete.exr", "-s", "1")
        complete = self.read("complete.exr")
        for number in (signal.SIGTERM, signal.SIGINT):
            self.assertEqual(self.stop(number, "-o", "a.exr", "-o", "a.png", "-o", "complete.exr"), 128 + number)
            self.assertEqual(self.names(), ["a.exr", "a.png", "complete.exr", "scene.xml"])
            self.assertIn("raytrace:partial", self.exr("a.exr").attributes)
            self.assertEqual(self.read("complete.exr"), complete)
            earlier = os.stat(self.path("a.exr")).st_mtime_ns
            self.assertEqual(self.stop(number, "-o", "complete.exr"), 128 + number)
            self.assertEqual(self.read("complete.exr"), complete)
            self.assertEqual(self.stop(number, "-o", "a.exr"), 128 + number)
            self.assertGreater(os.stat(self.path("a.exr")).st_mtime_ns, earlier, "it is no newer one")
            os.remove(self.path("a.png"))

    def test_sums_in_what_is_left(self):
        """A piece that was stopped has them, so that it can be merged; a whole picture just shows how far it came."""
        for part, has_sums in (([], False), (["--tile", "0/2"], True), (["--crop", "0,0,400,400"], True)):
            self.assertEqual(self.stop(signal.SIGTERM, "-o", "a.exr", *part), 143)
            self.assertEqual("sums.samples" in self.exr("a.exr").channels, has_sums, part)
            if not has_sums:
                self.assertIn("a.exr holds some of the samples only, without their sums",
                              self.fail_with(1, "merge", "a.exr", "--partial", "-o", "b.exr"))
            os.remove(self.path("a.exr"))

    def test_what_would_be_skipped(self):
        """No PNG tells that it is not complete: with --skip-existing there is none, or a checkpoint beside it."""
        self.assertEqual(self.stop(signal.SIGTERM, "-o", "a.exr", "-o", "a.png", "--skip-existing"), 143)
        self.assertEqual(self.names(), ["a.exr", "scene.xml"])
        command = ["-o", "b.png", "--checkpoint", "c.exr", "--resume", "--skip-existing"]
        for _ in range(2):
            self.assertEqual(self.stop(signal.SIGTERM, *command), 75)
            self.assertEqual(self.names(), ["a.exr", "b.png", "c.exr", "scene.xml"])

    def test_picture_on_request(self):
        process = self.start("scene.xml", "-q", "-o", "a.exr", "-o", "a.png", *LONG_RENDER)
        self.wait_for_rays(process)
        for _ in range(2):
            process.send_signal(signal.SIGUSR1)
            self.wait_for_file("a.exr", process)
            self.assertIn("raytrace:partial", self.exr("a.exr").attributes)
            self.wait_for_file("a.png", process)
            os.remove(self.path("a.exr"))
            os.remove(self.path("a.png"))
        self.assertIsNone(process.poll(), "the render goes on")

    def test_a_picture_on_request_changes_no_bit(self):
        self.succeed("scene.xml", "-q", "-o", "whole.exr", *MANY)
        process = self.start("scene.xml", "-q", "-o", "a.exr", "-o", "a.png", *MANY)
        self.wait_for_rays(process)
        process.send_signal(signal.SIGUSR1)
        self.assertEqual(process.wait(timeout=LIMIT), 0, process.stderr.read())
        self.assert_same("a.exr", self.read("whole.exr"))
        self.assertEqual(self.names(), ["a.exr", "a.png", "scene.xml", "whole.exr"])

    def test_an_early_picture_is_whole(self):
        """Passes go over the whole picture: of a render of hours, the first seconds show all of it."""
        width, height = (200, 150) if support.SANITIZERS else (400, 300)
        process = self.start("scene.xml", "-q", "-o", "a.exr", "-r", f"{width}x{height}", "-s", "1000000",
                             "--checkpoint", "checkpoint.exr", "--checkpoint-interval", "0.01s")
        self.wait_for(lambda: os.path.exists(self.path("checkpoint.exr")) and
                      fewest_samples(self.exr("checkpoint.exr")) >= 4, process, "a first pass in the checkpoint")
        process.send_signal(signal.SIGUSR1)
        self.wait_for_file("a.exr", process)
        picture = self.exr("a.exr")
        self.assertEqual((picture.width, picture.height), (width, height))
        self.assertGreaterEqual(fewest_samples(picture), 4)

    def test_a_second_signal_ends_at_once(self):
        # So many lights on the floor that a stop, which is looked for every few samples, takes a while.
        light = '<pointlight><location x="4" y="6" z="4"/></pointlight>'
        self.write("scene.xml", support.SCENE.replace("</pointlights>", 200000 * light + "</pointlights>"))
        for _ in range(20):  # the second one may still come too late
            self.write("a.exr", "old")
            process = self.start("scene.xml", "-q", "-o", "a.exr", "-s", "20000", "--crop", "0,50,80,60",
                                 "--checkpoint", "checkpoint.exr", "--resume")
            self.wait_for_rays(process)
            process.send_signal(signal.SIGTERM)
            while process.poll() is None and support.catches(process, signal.SIGTERM):
                pass
            process.send_signal(signal.SIGTERM)
            if process.wait(timeout=LIMIT) != 75:
                break
        self.assertEqual(process.returncode, -signal.SIGTERM)
        self.assertEqual(self.read("a.exr"), b"old")


def fewest_samples(exr):
    return min(min(row["sums.samples"]) for row in exr.rows.values())


class ForeignCheckpoints(SafetyTest):
    """A checkpoint that does not fit is refused by name, and stays as it is; so does the picture."""

    RESUME = ("-q", "-o", "a.exr", "--checkpoint", "checkpoint.exr", "--resume")

    def refused(self, *arguments, scene="scene.xml"):
        checkpoint = self.read("checkpoint.exr")
        self.write("a.exr", "old")
        message = self.fail_with(1, scene, *self.RESUME, *arguments, timeout=LIMIT)
        self.assertIn("checkpoint.exr", message)
        self.assertEqual(self.read("checkpoint.exr"), checkpoint)
        self.assertEqual(self.read("a.exr"), b"old")
        self.assertFalse([name for name in self.names() if name.startswith(".")])
        return message

    def test_other_renders(self):
        self.stopped_checkpoint()
        self.write("other.xml", support.SCENE.replace("<radius>1</radius>", "<radius>1.01</radius>"))
        self.assertIn("the scene", self.refused(*LONG_RENDER, scene="other.xml"))
        version = self.succeed("--version").stdout
        sets = [name for name in ("x86-64-v2", "x86-64-v3")
                if name in version and f"best here: {name}" not in version]
        for arguments, reason in [(["--seed", "1"], "the seed (0, not 1)"),
                                  (["-r", "40x30"], "the resolution (80 x 60, not 40 x 30)"),
                                  (["--crop", "0,0,40,30"], "crop"),
                                  (["--sample-offset", "8"], "its samples begin at 0, not 8"),
                                  (["--aov", "depth"], "the AOVs (none, not depth)"),
                                  *([(["--isa", sets[0]], "the instruction set")] if sets else [])]:
            with self.subTest(arguments):
                self.assertIn(reason, self.refused(*LONG_RENDER, *arguments))
        self.assertIn("more samples per pixel than are asked for", self.refused("-s", "3"))
        # It is not resumed by chance, either.
        message = self.fail_with(2, "scene.xml", "-q", "-o", "b.exr", "--checkpoint", "checkpoint.exr", timeout=LIMIT)
        self.assertIn("--resume", message)

    def test_files_that_are_no_checkpoint(self):
        self.stopped_checkpoint("-r", "40x30")
        whole = self.read("checkpoint.exr")
        self.succeed("scene.xml", "-q", "-r", "40x30", "-s", "8", "-o", "picture.exr")
        for what, data in [("empty", b""), ("one byte", whole[:1]), ("magic number", whole[:8]),
                           ("header", whole[:600]), ("half", whole[:len(whole) // 2]), ("almost all", whole[:-1]),
                           ("picture", self.read("picture.exr")), ("text", b"hello\n"), ("zeros", bytes(5000)),
                           ("zeros at the end", whole[:-5000] + bytes(5000))]:
            with self.subTest(what):
                with open(self.path("checkpoint.exr"), "wb") as file:
                    file.write(data)
                self.refused("-r", "40x30", *LONG_RENDER)
        os.remove(self.path("checkpoint.exr"))
        os.mkdir(self.path("checkpoint.exr"))
        self.assertIn("checkpoint.exr", self.fail_with(1, "scene.xml", *self.RESUME, timeout=LIMIT))

    def test_flipped_bits(self):
        """In the sums they are noticed; anywhere else they are, or do not matter: never a crash, never other bits."""
        self.stopped_checkpoint("-r", "16x12")
        whole = self.read("checkpoint.exr")
        done = max(max(row["sums.samples"]) for row in Exr(whole).rows.values())
        arguments = ["-r", "16x12", "-s", str(done)]
        self.succeed("scene.xml", "-q", *arguments, "-o", "whole.exr")
        wanted = self.read("whole.exr")
        chance = random.Random(2)
        places = [*chance.sample(range(2000), 12 if not support.LONG else 400),
                  *chance.sample(range(2000, len(whole)), 12 if not support.LONG else 400)]
        refusals = 0
        for place in places:
            damaged = bytearray(whole)
            damaged[place] ^= 1 << chance.randrange(8)
            with open(self.path("checkpoint.exr"), "wb") as file:
                file.write(damaged)
            code = self.run_program("scene.xml", *self.RESUME, *arguments, timeout=LIMIT).returncode
            with self.subTest(byte=place):
                self.assertIn(code, (0, 1))
                if code == 0:
                    self.assert_same("a.exr", wanted)
                else:
                    self.assertEqual(self.read("checkpoint.exr"), damaged)
                    refusals += 1
        self.assertGreater(refusals, 0)
        # What stands in a message is text whatever the file holds.
        with open(self.path("checkpoint.exr"), "wb") as file:
            file.write(whole.replace(b"raytrace 0", b"raytr\x1bce\xad0", 1))
        self.assertIn("it differs in the version (raytr\\x1bce\\xad0", self.refused(*arguments))
        # The last byte is of the last row's sums.
        with open(self.path("checkpoint.exr"), "wb") as file:
            file.write(whole[:-1] + bytes([whole[-1] ^ 1]))
        self.assertIn("damaged", self.refused(*arguments))


class TimeLimit(SafetyTest):
    def test_whole_passes_until_the_time_is_up(self):
        begin = time.monotonic()
        done = self.succeed("scene.xml", "-o", "a.exr", "-s", "1000000000", "--time-limit", "1s", "--stats=stats.json",
                            "--progress=none")
        # No timed test: what passed is only a sign that there is a limit.
        self.assertLess(time.monotonic() - begin, LIMIT)
        samples = json.loads(self.read("stats.json"))["picture"]["samples"]
        self.assertIn(f"the time limit was reached after {samples} samples per pixel", done.stderr)
        picture = self.exr("a.exr")
        self.assertEqual(picture.attributes["raytrace:samples"], ("int", struct.pack("<i", samples)))
        self.assertNotIn("raytrace:partial", picture.attributes)
        self.assertGreaterEqual(samples, 4)
        self.succeed("scene.xml", "-q", "-o", "b.exr", "-s", str(samples), "--sample-offset", "0")
        whole = self.exr("b.exr")
        for y, row in picture.rows.items():
            self.assertEqual(row, {name: whole.rows[y][name] for name in row})

    def test_a_limit_that_is_over_at_once(self):
        self.succeed("scene.xml", "-q", "-o", "a.exr", "-s", "1000", "--time-limit", "0.000001s", "--stats=stats.json")
        self.assertEqual(json.loads(self.read("stats.json"))["picture"]["samples"], 4)

    def test_a_limit_that_is_not_reached(self):
        self.succeed("scene.xml", "-q", "-o", "a.exr", "-s", "10", "--time-limit", "1h")
        self.succeed("scene.xml", "-q", "-o", "b.exr", "-s", "10")
        self.assert_same("a.exr", self.read("b.exr"))


class ErrorLimit(SafetyTest):
    PATHS = ["scene.xml", "-q", "--integrator", "path", "-r", "40x30"]

    def statistics(self, *arguments):
        self.succeed(*self.PATHS, *arguments, "--stats=stats.json")
        statistics = json.loads(self.read("stats.json"))
        return statistics["picture"]["samples"], statistics["estimated_error"]

    def setUp(self):
        super().setUp()
        # In passes, as with a limit that has no effect.
        self.error = self.statistics("-o", "first.exr", "-s", "16", "--time-limit", "10h")[1]
        self.assertGreater(self.error, 0)

    def test_samples_until_the_error_is_small(self):
        limit = self.error * 0.6
        samples, error = self.statistics("-o", "a.exr", "-s", "100000", "--error-limit", str(limit), "-t", "2")
        self.assertLessEqual(error, limit)
        self.assertTrue(16 < samples < 4000, samples)
        self.succeed(*self.PATHS, "-o", "b.exr", "-s", str(samples), "--sample-offset", "0")
        whole, picture = self.exr("b.exr"), self.exr("a.exr")
        for y, row in picture.rows.items():
            self.assertEqual(row, {name: whole.rows[y][name] for name in row})
        # The same as a percentage, on one thread.
        self.assertEqual(self.statistics("-o", "c.exr", "-s", "100000", "--error-limit", f"{100 * limit}%", "-t", "1"),
                         (samples, error))
        # The last pass was needed.
        passes = [4, 8, 16, *range(32, 4000, 32)]
        before = passes[passes.index(samples) - 1]
        self.assertGreater(self.statistics("-o", "d.exr", "-s", str(before), "--time-limit", "10h")[1], limit)

    def test_sixteen_samples_at_least(self):
        self.assertEqual(self.statistics("-o", "a.exr", "-s", "1000", "--error-limit", "100%")[0], 16)
        self.assertEqual(self.statistics("-o", "a.exr", "-s", "7", "--error-limit", "100%")[0], 7)

    def test_what_is_said(self):
        arguments = self.PATHS[:1] + self.PATHS[2:]
        said = self.succeed(*arguments, "-o", "a.exr", "-s", "1000", "--error-limit", "1").stderr
        self.assertIn("the error limit was reached after 16 samples per pixel", said)
        said = self.succeed(*arguments, "-o", "a.exr", "-s", "16", "--error-limit", str(self.error / 2)).stderr
        self.assertRegex(said, r"the error is [\d.]+ % after all samples, above the limit of [\d.]+ %")
        said = self.succeed("scene.xml", "-o", "a.exr", "-s", "16", "--error-limit", "1%").stderr
        self.assertIn("the error limit has no effect", said)

    def stopped_with(self, least):
        """Makes checkpoint.exr, of so many samples at least; the numbers of samples that its pixels have."""
        checkpoint = ["--checkpoint", "checkpoint.exr", "--checkpoint-interval", "0.001s"]
        process = self.start(*self.PATHS, "-o", "a.exr", "-s", "500000", "-t", "1", *checkpoint)

        def samples():
            return {count for row in self.exr("checkpoint.exr").rows.values() for count in row["sums.samples"]}

        self.wait_for_file("checkpoint.exr", process)
        self.wait_for(lambda: min(samples()) >= least, process, "samples")
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(timeout=LIMIT), 75)
        return samples()

    def test_a_checkpoint_knows_the_error_so_far(self):
        had = self.stopped_with(17)  # beyond the 16 of setUp(), whose error is compared
        done, error = self.statistics("-o", "a.exr", "-s", "500000", "--checkpoint", "checkpoint.exr", "--resume",
                                      "--error-limit", "100%")
        # Nothing but the rest of the pass that was stopped.
        self.assertTrue(max(had) <= done <= min(had) + 32, (had, done))
        if len(had) == 1:
            self.assertEqual(done, max(had))
        self.assertLess(error, self.error)

    def test_all_pixels_have_the_same_samples_after_a_stop(self):
        for limit in (["--error-limit", "100%"], ["--time-limit", "0.000001s"]):
            with self.subTest(limit):
                self.stopped_with(8)
                done = self.statistics("-o", "a.exr", "-s", "500000", "--checkpoint", "checkpoint.exr", "--resume",
                                       *limit)[0]
                self.succeed(*self.PATHS, "-o", "b.exr", "-s", str(done), "--sample-offset", "0")
                whole = self.exr("b.exr")
                for y, row in self.exr("a.exr").rows.items():
                    self.assertEqual(row, {name: whole.rows[y][name] for name in row})

    def test_invalid(self):
        for value in ("0", "-1", "2", "200%", "abc", "2%%", "nan", "inf"):
            with self.subTest(value):
                self.assertIn("is not an error; use a percentage such as 2%",
                              self.fail_with(2, "scene.xml", "-o", "a.exr", f"--error-limit={value}"))
        for piece in (["--tile", "0/2"], ["--sample-offset", "4"]):
            self.assertIn("--error-limit is for whole pictures and crops",
                          self.fail_with(2, "scene.xml", "-o", "a.exr", "--error-limit", "2%", *piece))
        self.assertIn("--error-limit", self.fail_with(2, "scene.xml", "-o", "a.exr", "--noise-threshold", "0.01"))


class NotFinite(SafetyTest):
    def test_they_are_counted_and_shown(self):
        scene = support.SCENE.replace("<scaleradiance>2</scaleradiance>", "<scaleradiance>1e17</scaleradiance>"
                                      '<color red="1e17" green="1" blue="1"/>')
        self.write("scene.xml", scene.replace("<kd>0.6</kd>", "<kd>1e17</kd>"))
        done = self.succeed("scene.xml", "-o", "a.exr", "-s", "2", "--float", "--progress=none")
        self.assertRegex(done.stderr, r"\d+ samples without a finite radiance, counted as black: "
                                      r"sample \d+ of pixel \d+,\d+;")
        place = done.stderr.split("--pixel ")[1].split()[0]
        self.assertIn("not finite", self.succeed("scene.xml", "-s", "2", "--pixel", place).stdout)
        # In pixels whose samples are set aside and in all others.
        for pixel in self.exr("a.exr").pixels().values():
            self.assertTrue(all(abs(value) < float("inf") for value in pixel), pixel)


if __name__ == "__main__":
    unittest.main()
