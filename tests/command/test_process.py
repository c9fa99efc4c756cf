"""What a process is started with, and what it is sent: closed files, limits, signals."""

import os
import re
import resource
import signal
import struct
import subprocess
import unittest

import support
from exr import Exr
from support import CommandTest
from test_never_lost import LIMIT, LONG_RENDER, SafetyTest

SMALL = ["-r", "16x12", "-s", "1"]


class ClosedFiles(CommandTest):
    """Standard input, output and error that are closed, or that nobody reads."""

    def shell(self, command):
        """Of $0, the program. Its exit code, and what it told."""
        done = subprocess.run(["bash", "-c", command, support.PROGRAM], cwd=self.folder, capture_output=True, text=True,
                              check=False, timeout=LIMIT)
        return done.returncode, done.stderr

    def test_standard_error(self):
        """It is ignored: the render goes on, and ends as it would have."""
        for closed in ("2>&-", "2>/dev/full", "<&- >&- 2>&-"):
            code, _ = self.shell(f'"$0" scene.xml -v --stats --progress=plain -o a.exr {closed}')
            self.assertEqual(code, 0, closed)
            self.assertEqual(Exr(self.read("a.exr")).width, 80)
            os.remove(self.path("a.exr"))
            self.assertEqual(self.shell(f'"$0" missing.xml -o a.exr {closed}')[0], 1, closed)
            self.assertEqual(self.shell(f'"$0" --unknown {closed}')[0], 2, closed)
        self.assertEqual(self.names(), ["scene.xml"])

    def test_standard_error_that_nobody_reads(self):
        reader, writer = os.pipe()
        os.close(reader)
        command = [support.PROGRAM, "scene.xml", "-v", "--stats", "--progress=bar", "-o", "a.exr"]
        for stdout in (subprocess.DEVNULL, writer):
            done = subprocess.run(command, cwd=self.folder, stdout=stdout, stderr=writer, check=False, timeout=LIMIT)
            self.assertEqual(done.returncode, 0)
            self.assertIn("a.exr", self.names())
            os.remove(self.path("a.exr"))
        merging = subprocess.run([support.PROGRAM, "merge", "missing.exr", "-o", "b.exr"], cwd=self.folder, stderr=writer,
                                 check=False, timeout=LIMIT)
        self.assertEqual(merging.returncode, 1)
        os.close(writer)

    def test_no_picture_gets_the_messages(self):
        """The first file that is opened would get the number of the one that is closed."""
        self.succeed("scene.xml", "-q", "-o", "a.exr", env={**os.environ, "SOURCE_DATE_EPOCH": "0"})
        wanted = self.read("a.exr")
        for closed in ("2>&-", ">&-", "<&- >&- 2>&-"):
            code, _ = self.shell("SOURCE_DATE_EPOCH=0 \"$0\" scene.xml -vv --progress=json --log-file run.log -o a.exr "
                                 f"--checkpoint c.exr {closed}")
            self.assertEqual(code, 0, closed)
            self.assertTrue(self.read("a.exr") == wanted, closed)
            self.assertTrue(all(re.match(r"\d{4}-\d\d-\d\dT", line) for line in self.read("run.log").decode().splitlines()))

    def test_standard_output(self):
        """Where something was to be printed, that is the failure."""
        for asked in ("--help", "--version", "--list shapes", "merge --help", "scene.xml --validate",
                      "scene.xml --print-scene", "scene.xml --pixel 3,4"):
            for closed, reason in ((">&-", "Bad file descriptor"), (">/dev/full", "No space left on device")):
                told = self.shell(f'"$0" {asked} {closed}')
                self.assertEqual(told, (1, f"raytrace: error: cannot write to standard output: {reason}\n"), asked)
        self.assertEqual(self.shell('"$0" scene.xml --validate -q >&-'), (0, ""))

    def test_standard_output_that_nobody_reads(self):
        code, told = self.shell('"$0" scene.xml --pixel 3,4 -s 2147483647 | head -1 >lines; exit ${PIPESTATUS[0]}')
        self.assertEqual((code, told), (1, "raytrace: error: cannot write to standard output: Broken pipe\n"))
        self.assertTrue(self.read("lines").startswith(b"sample 0: "))

    def test_standard_input(self):
        code, told = self.shell('"$0" - -o a.exr <&-')
        self.assertEqual((code, told), (1, "<stdin>: error: cannot read the scene: Bad file descriptor\n"))


class Pixel(CommandTest):
    def test_samples_are_printed_as_they_come(self):
        process = self.start_program("scene.xml", "--pixel", "40,30", "-s", "2147483647")
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        self.assertTrue(process.stdout.readline().startswith("sample 0: "))
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=LIMIT), -signal.SIGINT)


class FileSizeLimit(CommandTest):
    def test_signal_of_the_limit(self):
        """It does not kill: the file is named, and none of it stays."""
        def small_files_only():
            resource.setrlimit(resource.RLIMIT_FSIZE, (8000, resource.RLIM_INFINITY))

        for name in ("a.exr", "a.png", "a.tif"):
            message = self.fail_with(1, "scene.xml", "-q", "-r", "400x300", "--bit-depth", "16", "-o", name,
                                     preexec_fn=small_files_only)
            self.assertRegex(message, rf"^raytrace: error: cannot write {name}: .*\n$")
            self.assertIn("TIFFWrite" if name == "a.tif" else "File too large", message)
            self.assertEqual(self.names(), ["scene.xml"])
        self.succeed("scene.xml", "-q", "-r", "400x300", "-o", "piece.exr")
        message = self.fail_with(1, "merge", "piece.exr", "-o", "b.exr", preexec_fn=small_files_only)
        self.assertEqual(message, "raytrace: error: cannot write b.exr: File too large\n")
        self.assertEqual(self.names(), ["piece.exr", "scene.xml"])


@unittest.skipIf(support.SANITIZERS, "a sanitizer needs a large stack before main() begins")
class SmallStack(CommandTest):
    def test_stack_of_16_kib(self):
        def small_stack():
            resource.setrlimit(resource.RLIMIT_STACK, (16 << 10, 16 << 10))

        # What stands in the environment stands on the stack.
        limited = {"env": {"PATH": os.environ["PATH"]}, "preexec_fn": small_stack}
        self.succeed("--version", **limited)
        self.succeed("scene.xml", "--validate", **limited)
        self.succeed("scene.xml", "-q", "-t", "4", "-o", "a.exr", "-o", "a.tif", "--checkpoint", "c.exr", **limited)
        self.succeed("merge", "a.exr", "-o", "b.exr", **limited)
        self.assertEqual(self.names(), ["a.exr", "a.tif", "b.exr", "scene.xml"])
        self.fail_with(2, "--unknown", **limited)


class Signals(SafetyTest):
    STOPS = {signal.SIGINT: "SIGINT", signal.SIGTERM: "SIGTERM", signal.SIGHUP: "SIGHUP", signal.SIGXCPU: "SIGXCPU",
             signal.SIGUSR2: "SIGUSR2"}
    CHECKPOINT = ["--checkpoint", "c.exr", "--resume"]

    def stop(self, number, *arguments):
        """Exit code, and what it told."""
        process = self.start("scene.xml", *LONG_RENDER, "--progress=none", "-o", "a.exr", *arguments)
        self.wait_for_rays(process)
        process.send_signal(number)
        return process.wait(timeout=LIMIT), process.stderr.read()

    def assert_counts(self, name, least, most, samples):
        for key, value in (("leastSamples", least), ("mostSamples", most), ("samples", samples)):
            self.assertEqual(self.exr(name).attributes[f"raytrace:{key}"], ("int", struct.pack("<i", int(value))), key)

    def test_all_that_stop(self):
        for number, name in self.STOPS.items():
            with self.subTest(name):
                code, told = self.stop(number, *self.CHECKPOINT)
                self.assertEqual(code, 75)
                counts = re.fullmatch(rf"raytrace: stopped by {name}: (\d+)(?: to (\d+))? of (\d+) samples per pixel: "
                                      "checkpoint c.exr written, --resume goes on from it; picture so far in a.exr\n", told)
                self.assertTrue(counts, told)
                least, most, samples = counts.groups()
                self.assert_counts("a.exr", least, most or least, samples)
                self.assert_counts("c.exr", least, most or least, samples)
                os.remove(self.path("a.exr"))
                os.remove(self.path("c.exr"))
                code, told = self.stop(number)
                self.assertEqual(code, 128 + number)
                self.assertRegex(told, rf"^raytrace: stopped by {name}: 0 to \d+ of \d+ samples per pixel: picture so far in "
                                       r"a\.exr\n$")
                self.assertEqual(self.names(), ["a.exr", "scene.xml"])
                os.remove(self.path("a.exr"))

    def test_nothing_kept(self):
        self.succeed("scene.xml", "-q", *SMALL, "-o", "a.exr")
        _, told = self.stop(signal.SIGTERM)
        self.assertEqual(told, "raytrace: stopped by SIGTERM: nothing kept; a.exr is complete, from an earlier run, and "
                               "stays\n")
        os.remove(self.path("a.exr"))
        _, told = self.stop(signal.SIGINT, "-o", "a.png", "--skip-existing")
        self.assertTrue(told.endswith("picture so far in a.exr; a.png could not say that it is partial, and would be "
                                      "skipped\n"), told)

    def test_which_of_several_renders(self):
        process = self.start("scene.xml", *LONG_RENDER, "--progress=none", "--frames", "3-7", "-o", "a.#.exr")
        self.wait_for_rays(process)
        process.send_signal(signal.SIGHUP)
        self.assertEqual(process.wait(timeout=LIMIT), 128 + signal.SIGHUP)
        self.assertTrue(process.stderr.read().endswith("raytrace: stopped at scene.xml, frame 3, 1 of 5 renders\n"))
        self.assertEqual(self.names(), ["a.3.exr", "scene.xml"])

    def test_those_that_are_ignored(self):
        """nohup: SIGHUP stays ignored, and so does any other."""
        for number in (signal.SIGHUP, signal.SIGXCPU, signal.SIGUSR2):
            def ignore():
                signal.signal(number, signal.SIG_IGN)

            process = self.start_program("scene.xml", "-q", *LONG_RENDER, "-o", "a.exr", preexec_fn=ignore)
            self.addCleanup(process.stdout.close)
            self.addCleanup(process.stderr.close)
            self.wait_for_rays(process)
            process.send_signal(number)
            process.send_signal(signal.SIGTERM)
            self.assertEqual(process.wait(timeout=LIMIT), 128 + signal.SIGTERM)

    def test_limit_on_processor_time(self):
        """Beyond it the system sends SIGXCPU each second; none of these is the second one that ends it at once."""
        def one_second():
            resource.setrlimit(resource.RLIMIT_CPU, (1, resource.RLIM_INFINITY))

        # Large enough that two seconds pass before all is written.
        done = self.run_program("scene.xml", "-r", "1600x1000", "-s", "100000", "-t", "1", "-o", "a.exr", "--aov", "all",
                                *self.CHECKPOINT, preexec_fn=one_second)
        self.assertEqual(done.returncode, 75, done.stderr)
        self.assertIn("stopped by SIGXCPU: ", done.stderr)
        self.assertEqual(self.names(), ["a.exr", "c.exr", "scene.xml"])

    def test_picture_so_far(self):
        process = self.start("scene.xml", *LONG_RENDER, "--progress=none", "-o", "a.exr", "-o", "a.tif")
        self.wait_for_rays(process)
        process.send_signal(signal.SIGUSR1)
        told = process.stderr.readline()
        counts = re.fullmatch(r"raytrace: picture so far, 0 to (\d+) of (\d+) samples per pixel, in a.exr, a.tif\n", told)
        self.assertTrue(counts, told)
        self.assert_counts("a.exr", 0, *counts.groups())
        self.assertIn(b", seed 0, partial\0", self.read("a.tif"))

    def test_a_merge_that_is_stopped_leaves_nothing(self):
        self.succeed("scene.xml", "-q", "-r", "4000x4000", "-s", "1", "--float", "-o", "piece.exr")
        for number in (signal.SIGTERM, signal.SIGHUP):
            process = self.start("merge", "piece.exr", "-o", "b.exr")
            self.wait_for(lambda: any(name.startswith(".raytrace-") for name in self.names()), process, "a temporary file")
            process.send_signal(number)
            self.assertEqual(process.wait(timeout=LIMIT), 128 + number)
            self.assertEqual(process.stderr.read(), f"raytrace: stopped by {self.STOPS[number]}: nothing written\n")
            self.assertEqual(self.names(), ["piece.exr", "scene.xml"])


if __name__ == "__main__":
    unittest.main()
