"""Disks, folders, pipes and memory that fail while a render writes: a clear message, no truncated file, nothing lost."""

import contextlib
import os
import shutil
import signal
import subprocess
import unittest

import support
from test_never_lost import LIMIT, SafetyTest


class MountTest(SafetyTest):
    """disk/ is a file system of its own, of 400 KiB: more than the small picture, less than the large one."""

    def setUp(self):
        super().setUp()
        os.mkdir(self.path("disk"))
        done = self.mount("-t", "tmpfs", "-o", "size=400k", "none", self.path("disk"))
        if done.returncode != 0:
            self.skipTest("needs the right to mount a small tmpfs: " + done.stderr.strip())
        self.addCleanup(subprocess.run, ["umount", "--lazy", self.path("disk")], check=True)
        self.succeed("scene.xml", "-q", "-o", "disk/a.exr")
        self.before = self.read("disk/a.exr")

    def mount(self, *arguments):
        try:
            return subprocess.run(["mount", *arguments], capture_output=True, text=True, check=False)
        except FileNotFoundError as error:
            return subprocess.CompletedProcess(arguments, 1, "", str(error))

    def assert_kept(self):
        self.assertEqual(self.read("disk/a.exr"), self.before)
        self.assertEqual(os.listdir(self.path("disk")), ["a.exr"])


@contextlib.contextmanager
def halted(process):
    """It does not get on with its work meanwhile."""
    process.send_signal(signal.SIGSTOP)
    yield
    process.send_signal(signal.SIGCONT)


# Floats that no compression makes small enough for the disk.
LARGE = ["-r", "800x600"]
LARGE_FILES = [*LARGE, "--float"]
# A render that is not over when it has been seen to run.
LONG = ["scene.xml", "-s", support.samples(40000)]


class FullDisk(MountTest):
    def test_picture(self):
        for name in ("disk/a.exr", "disk/b.exr", "disk/b.png", "disk/b.tif"):
            with self.subTest(name):
                arguments = ["-r", "3000x2000", "-s", "1", "--bit-depth", "16"] if name.endswith("png") else LARGE_FILES
                message = self.fail_with(1, "scene.xml", "-q", *arguments, "-o", name)
                self.assertEqual(message, f"raytrace: error: cannot write {name}: No space left on device\n")
                self.assert_kept()

    def test_the_other_outputs_are_written(self):
        self.fail_with(1, "scene.xml", "-q", *LARGE_FILES, "-o", "disk/a.exr", "-o", "b.exr")
        self.assert_kept()
        self.succeed("scene.xml", "-q", *LARGE_FILES, "-o", "c.exr")
        self.assertEqual(self.read("b.exr"), self.read("c.exr"))

    def test_checkpoint(self):
        """It is reported, and the render goes on."""
        done = self.run_program("scene.xml", "-q", *LARGE, "-s", support.samples(64), "-o", "b.exr", "--checkpoint",
                                "disk/c.exr", "--checkpoint-interval", "0.01s")
        self.assertIn("cannot write disk/c.exr: No space left on device", done.stderr)
        self.assertEqual(done.returncode, 0)
        self.succeed("scene.xml", "-q", *LARGE, "-s", support.samples(64), "-o", "whole.exr")
        self.assert_same("b.exr", self.read("whole.exr"))
        self.assert_kept()

    def test_checkpoint_of_a_stop(self):
        """What cannot be resumed must not say that it can: 1, not 75. The picture so far is written."""
        process = self.start("scene.xml", *LARGE, "-s", "100000", "-o", "b.exr", "--checkpoint", "disk/c.exr",
                             "--progress=plain")
        self.assertIn("rendered", process.stderr.readline())
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(timeout=LIMIT), 1)
        self.assertIn("cannot write disk/c.exr: No space left on device", process.stderr.read())
        self.assertIn("raytrace:partial", self.exr("b.exr").attributes)
        self.assert_kept()

    def test_picture_on_request(self):
        """One that finds no room is reported, and the render goes on."""
        process = self.start("scene.xml", *LARGE_FILES, "-s", "100000", "-o", "disk/a.exr", "--progress=plain",
                             "--checkpoint", "c.exr")
        self.assertIn("rendered", process.stderr.readline())
        for line in process.stderr:
            if "error" in line:
                break
            process.send_signal(signal.SIGUSR1)  # the first picture may be so black that it fits
        self.assertEqual(line, "raytrace: error: cannot write disk/a.exr: No space left on device\n")
        self.assertIn("rendered", process.stderr.readline())
        self.assert_kept()


class ReadOnlyFileSystem(MountTest):
    def test_from_the_start(self):
        self.assertEqual(self.mount("-o", "remount,ro", self.path("disk")).returncode, 0)
        for name in ("disk/a.exr", "disk/b.png"):
            message = self.fail_with(1, "scene.xml", *support.ENDLESS, "-q", "-o", name, timeout=LIMIT)
            self.assertEqual(message, f"raytrace: error: cannot write {name}: Read-only file system\n")
        self.assert_kept()

    def test_during_the_render(self):
        process = self.start(*LONG, "-o", "disk/a.exr", "-o", "b.exr", "-q", "--checkpoint", "disk/c.exr")
        self.wait_for_rays(process)
        with halted(process):
            self.assertEqual(self.mount("-o", "remount,ro", self.path("disk")).returncode, 0)
        code, told = process.wait(timeout=LIMIT), process.stderr.read()
        self.assertEqual(code, 1, told)
        self.assertIn("error: cannot write disk/a.exr: Read-only file system\n", told)
        self.assertIn("b.exr", self.names())
        self.assert_kept()


class LostFolders(SafetyTest):
    def lose(self, action):
        """What a render tells whose folder is lost by the action."""
        os.mkdir(self.path("folder"))
        process = self.start(*LONG, "-o", "folder/a.exr", "-o", "b.exr", "-q",
                             "--checkpoint", "folder/c.exr", "--checkpoint-interval", "0.2s")
        self.wait_for_rays(process)
        with halted(process):
            action(self.path("folder"))
        code, told = process.wait(timeout=LIMIT), process.stderr.read()
        self.assertEqual(code, 1, told)
        self.succeed(*LONG, "-q", "-o", "whole.exr")
        self.assert_same("b.exr", self.read("whole.exr"))
        return told

    def test_permission(self):
        # The program refuses a folder without write permission even to root, as it does such files.
        message = self.lose(lambda folder: os.chmod(folder, 0o555))
        self.assertIn("error: cannot write folder/a.exr: the folder folder is read-only\n", message)
        self.assertNotIn("a.exr", os.listdir(self.path("folder")))

    def test_folder_removed(self):
        message = self.lose(shutil.rmtree)
        self.assertIn("error: cannot write folder/a.exr: there is no folder folder\n", message)


class Pipes(SafetyTest):
    """A picture appears whole or not at all, which no pipe can promise."""

    def test_they_are_refused_before_the_render(self):
        os.mkfifo(self.path("fifo.exr"))
        os.symlink("/dev/stdout", self.path("stdout.exr"))
        for name in ("fifo.exr", "stdout.exr"):
            message = self.fail_with(1, "scene.xml", *support.ENDLESS, "-q", "-o", name, timeout=LIMIT)
            self.assertIn(f"cannot write {name}: it is not a regular file, which alone appears whole or not at all; "
                          "write to one, and copy it", message)
        self.assertIn("cannot write /dev/stdout: ", self.fail_with(2, "scene.xml", "-q", "-o", "/dev/stdout"))

    def test_messages_into_a_slow_pipe(self):
        """Nobody reads what the program tells until it has filled the pipe: it waits, and loses nothing."""
        scenes = [f"missing-{number}-{100 * 'x'}.xml" for number in range(800)]
        process = self.start(*scenes, "scene.xml", "-o", "{scene}.exr")
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(timeout=1)
        _, told = process.communicate(timeout=LIMIT)
        self.assertEqual(process.returncode, 1)
        self.assertIn("scene.exr", self.names())
        for scene in scenes:
            self.assertIn(f"{scene}: error: ", told)


# What else may be told is the limit of a control group that the tests run in.
OUT_OF_MEMORY = (r"^raytrace: error: out of memory: the (address-space limit of this process \(ulimit -v\)|"
                 r"control group of this process) allows \d+ MiB\n$")


def limited(kibibytes):
    """A shell with `ulimit -v` that becomes the program."""
    return ["sh", "-c", f'ulimit -v {kibibytes} && exec "$0" "$@"', support.PROGRAM]


@unittest.skipIf(support.SANITIZERS, "a sanitizer needs more address space than any limit leaves")
class LittleMemory(SafetyTest):
    def test_ulimit(self):
        self.write("a.exr", "old")
        for arguments in (["-r", "16384x16384", "--sample-offset", "0"], ["-r", "12000x12000", "--checkpoint", "c.exr"],
                          ["-r", "8192x8192", "--aov", "all"]):
            with self.subTest(arguments):
                done = subprocess.run([*limited(1 << 20), "scene.xml", "-q", "-o", "a.exr", "-t", "2", *arguments],
                                      cwd=self.folder, capture_output=True, text=True, check=False, timeout=LIMIT)
                self.assertEqual(done.returncode, 33, done.stderr)
                self.assertRegex(done.stderr, OUT_OF_MEMORY)
                self.assertEqual(self.names(), ["a.exr", "scene.xml"])
                self.assertEqual(self.read("a.exr"), b"old")

    def test_the_limit_that_was_met_is_named(self):
        """What is asked for counts for both; the smaller one is what it fails at."""
        space, data = "address-space limit of this process (ulimit -v)", "data limit of this process (ulimit -d)"
        for limits, name, mebibytes in (("-v 2000000", space, 1953), ("-v 2000000 && ulimit -d 1000000", data, 976),
                                        ("-v 1000000 && ulimit -d 1900000", space, 976)):
            with self.subTest(limits):
                done = subprocess.run(["sh", "-c", f'ulimit {limits} && exec "$0" "$@"', support.PROGRAM, "scene.xml",
                                       "-q", "-o", "a.exr", "-t", "2", "-r", "16384x16384", "--checkpoint", "c.exr"],
                                      cwd=self.folder, capture_output=True, text=True, check=False, timeout=LIMIT)
                self.assertEqual((done.returncode, done.stderr),
                                 (33, f"raytrace: error: out of memory: the {name} allows {mebibytes} MiB\n"))

    def test_any_ulimit(self):
        """From too little to begin to enough: done, out of memory, or not even started; never a crash."""
        codes = []
        for mebibytes in range(100, 1200, 50):
            done = subprocess.run([*limited(mebibytes << 10), "scene.xml", "-q", "-o", "a.exr", "-t", "2", "-r",
                                   "1500x1500", "-s", "1"], cwd=self.folder, capture_output=True, text=True,
                                  check=False, timeout=LIMIT)
            self.assertEqual([name for name in self.names() if name not in ("a.exr", "scene.xml")], [])
            codes.append(done.returncode)
            with self.subTest(mebibytes):
                if done.returncode == 33:
                    self.assertRegex(done.stderr, OUT_OF_MEMORY)
                elif done.returncode == 127:
                    self.assertIn("shared librar", done.stderr)
                else:
                    self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(0, codes)
        self.assertIn(33, codes)

    def test_more_threads_than_fit(self):
        """Fewer are used, or it is out of memory, also where a library is what finds no room."""
        codes = {}
        for name in ("a.exr", "a.jpg"):
            for mebibytes in (120, 200, 400, 500, 700, 900, 2000):
                done = subprocess.run([*limited(mebibytes << 10), "scene.xml", "-q", "-o", name, "-t", "256"],
                                      cwd=self.folder, capture_output=True, text=True, check=False, timeout=LIMIT)
                codes[name, mebibytes] = done.returncode
                self.assertIn(done.returncode, (0, 33), (name, mebibytes, done.stderr))
                self.assertRegex(done.stderr, OUT_OF_MEMORY if done.returncode == 33 else "^$")
        self.assertEqual((codes["a.exr", 120], codes["a.exr", 900], codes["a.jpg", 400], codes["a.jpg", 2000]),
                         (33, 0, 33, 0))
        done = subprocess.run([*limited(900 << 10), "scene.xml", "-o", "b.exr", "-t", "256", "--progress=none"],
                              cwd=self.folder, capture_output=True, text=True, check=False, timeout=LIMIT)
        self.assertRegex(done.stderr, r"^raytrace: warning: there is no room for 256 threads: \d+ threads used\n$")


def new_memory_group(mebibytes):
    """The folder of a control group for that much; None where that may not be made."""
    with open("/proc/self/cgroup", encoding="ascii") as file:
        paths = dict(line.strip().split(":", 2)[1:] for line in file)
    own = os.path.join("/sys/fs/cgroup/memory" if "memory" in paths else "/sys/fs/cgroup",
                       paths.get("memory", paths.get("", "/")).lstrip("/"))
    group = os.path.join(os.environ.get("RAYTRACE_TEST_CGROUP", own), f"raytrace-test-{os.getpid()}")
    try:
        os.mkdir(group)
    except OSError:
        return None
    for name in ("memory.limit_in_bytes", "memory.max"):
        with contextlib.suppress(OSError), open(os.path.join(group, name), "r+", encoding="ascii") as file:
            file.write(str(mebibytes << 20))
            return group
    os.rmdir(group)
    return None


@unittest.skipIf(support.SANITIZERS, "a sanitizer reserves more than any limit leaves")
class MemoryGroup(SafetyTest):
    """The kernel would kill what its control group has no room for; the program says it instead."""

    def setUp(self):
        super().setUp()
        self.group = new_memory_group(200)
        if not self.group:
            self.skipTest("no control group with a memory limit may be made here; RAYTRACE_TEST_CGROUP can name its parent")
        self.addCleanup(os.rmdir, self.group)

    def run_in_group(self, *arguments):
        join = f'echo $$ > "{self.group}/cgroup.procs" && exec "$0" "$@"'
        return subprocess.run(["sh", "-c", join, support.PROGRAM, *arguments, "-q"], cwd=self.folder,
                              capture_output=True, text=True, check=False, timeout=LIMIT)

    def test_a_picture_that_does_not_fit(self):
        self.write("a.exr", "old")
        for arguments in (["-r", "16384x16384"], ["-r", "5000x5000", "--checkpoint", "c.exr"]):
            done = self.run_in_group("scene.xml", "-s", "1", "-o", "a.exr", *arguments)
            self.assertEqual((done.returncode, done.stderr), (33, "raytrace: error: out of memory: the control group of this "
                                                                  "process allows 200 MiB\n"))
            self.assertEqual(self.names(), ["a.exr", "scene.xml"])
            self.assertEqual(self.read("a.exr"), b"old")

    def test_a_scene_that_does_not_fit(self):
        """It grows little by little."""
        sphere = '<sphere><center x="{}" y="0" z="0"/><radius>1</radius><material>shiny</material></sphere>\n'
        many = "".join(sphere.format(number) for number in range(1000000))
        self.write("large.xml", support.SCENE.replace("</spheres>", many + "</spheres>"))
        for threads in ("1", "4"):
            done = self.run_in_group("large.xml", "-o", "a.exr", "-t", threads)
            self.assertEqual(done.returncode, 33, f"{threads} threads: {done.stderr}")
            self.assertEqual(self.names(), ["large.xml", "scene.xml"])

    def test_a_picture_that_fits(self):
        self.assertEqual(self.run_in_group("scene.xml", "-s", "1", "-o", "a.exr", "-t", "4").returncode, 0)


if __name__ == "__main__":
    unittest.main()
