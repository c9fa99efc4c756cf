"""The OpenJD templates of share/openjd, checked and run by openjd-cli."""

import os
import re
import shutil
import subprocess
import unittest

import support
from farm import SHARE, FarmTest, skip_all

OPENJD = os.environ["RAYTRACE_OPENJD"]
TEMPLATES = os.path.join(SHARE, "openjd")


def setUpModule():
    if not os.path.exists(OPENJD):
        skip_all(f"no {OPENJD}: tests/farm/environment.sh, which cmake/test runs, could not install openjd-cli")


class Template(FarmTest):
    def start(self, *arguments):
        # Its own temporary files go where the test's are.
        return subprocess.Popen([OPENJD, *arguments], cwd=self.folder, env={**os.environ, "TMPDIR": self.folder},
                                text=True, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def start_template(self, template, *arguments, **parameters):
        parameters = {"Scene": "scene.xml", "OutDir": "it's out", "CheckpointDir": "check points",
                      "Raytrace": support.PROGRAM, "InstructionSet": self.instruction_set, **parameters}
        for name, value in parameters.items():
            arguments += ("-p", f"{name}={value}")
        return self.start("run", os.path.join(TEMPLATES, template), *arguments)

    def run_template(self, template, *arguments, **parameters):
        """Exit code, and for each task that ran the lines of its log."""
        with self.start_template(template, *arguments, **parameters) as running:
            log = running.stdout.read()
        return running.returncode, _tasks(log)

    def succeed_with(self, template, *arguments, **parameters):
        code, tasks = self.run_template(template, *arguments, **parameters)
        self.assertEqual(code, 0, tasks)
        return tasks

    def progress(self, task):
        """The percentages of a task, in order, which openjd has understood and which never fall."""
        percentages = [float(line.split()[1]) for line in task if re.fullmatch(r"openjd_progress: [\d.]+", line)]
        self.assertEqual(len(percentages), sum("openjd_progress" in line for line in task), task)
        self.assertEqual(percentages, sorted(percentages))
        return percentages

    def assert_whole_progress(self, tasks):
        for task in tasks:
            percentages = self.progress(task)
            self.assertTrue(percentages, task)
            self.assertEqual(percentages[-1], 100)


class Templates(Template):
    def test_all_are_valid(self):
        templates = sorted(os.listdir(TEMPLATES))
        self.assertEqual(templates, ["frames.yaml", "samples.yaml", "tiles.yaml"])
        for template in templates:
            with self.start("check", os.path.join(TEMPLATES, template)) as checking:
                output = checking.stdout.read()
            self.assertEqual(checking.returncode, 0, output)

    def test_frames(self):
        tasks = self.succeed_with("frames.yaml", Frames="1-3,5", ChunkSize=2, Options="-s 9")
        self.assertEqual(len(tasks), 2)
        self.assert_whole_progress(tasks)
        for frame in [1, 2, 3, 5]:
            self.assert_same(self.picture(f"it's out/picture.{frame:04}.exr"), self.whole_picture(frame, "-s", "9"))
        self.assertEqual(os.listdir(self.path("check points")), [])

    def test_tiles(self):
        tasks = self.succeed_with("tiles.yaml", "--step", "Merge", "--run-dependencies",
                                  Frames="1-2", ChunkSize=2, Tiles=3)
        self.assertEqual(len(tasks), 3 + 2)
        self.assert_whole_progress(tasks[:3])
        for frame in [1, 2]:
            self.assert_same(self.picture(f"it's out/picture.{frame:04}.exr"), self.whole_picture(frame))

    def test_samples(self):
        tasks = self.succeed_with("samples.yaml", "--step", "Merge", "--run-dependencies",
                                  Frames=2, Ranges=3, SamplesPerRange=5)
        self.assertEqual(len(tasks), 3 + 1)
        self.assert_whole_progress(tasks[:3])
        self.assert_same(self.picture("it's out/picture.0002.exr"), self.whole_picture(2, "-s", "15"))

    def test_failed_task_stops_the_merge(self):
        self.write("scene.xml", "<raytracer/>")
        code, tasks = self.run_template("tiles.yaml", "--step", "Merge", "--run-dependencies",
                                        Frames=1, Tiles=2)
        self.assertEqual(code, 1)
        self.assertEqual(len(tasks), 1, "tasks that ran")
        self.assertTrue(any(line.startswith("openjd_fail: ") for line in tasks[0]), tasks[0])


class Installed(Template):
    def test_nothing_is_written_beside_the_template(self):
        """Checkpoints go to where the pictures go, where none was named for them."""
        shutil.copytree(TEMPLATES, self.path("installed"))
        self.write("stand-in", '#!/bin/sh\necho "called with $*"\n')
        os.chmod(self.path("stand-in"), 0o755)
        before = sorted(os.listdir(self.path("installed")))
        for template in before:
            with self.start("run", self.path(f"installed/{template}"), "-p", "Scene=scene.xml", "-p", "OutDir=out", "-p",
                            f"Raytrace={self.path('stand-in')}", "-p", "Frames=2", "--step", "Render") as running:
                calls = [line for line in running.stdout.read().splitlines() if "called with" in line]
            self.assertEqual(running.returncode, 0)
            self.assertTrue(calls)
            for call in calls:
                self.assertRegex(call, f"-o {self.folder}/out/.* --checkpoint {self.folder}/out/checkpoints/picture\\.")
        self.assertEqual(sorted(os.listdir(self.path("installed"))), before)
        self.assertEqual(os.listdir(self.path("out/checkpoints")), [])


class Cancelled(Template):
    def test_goes_on_from_its_checkpoint(self):
        samples = self.samples_for(2)  # and so each of the two frames
        settings = {"Frames": "1-2", "ChunkSize": 2, "Options": f"-s {samples} -t 1"}

        with self.start_template("frames.yaml", **settings) as running:
            log = ""
            for line in running.stdout:
                log += line
                if re.search(r"\topenjd_progress: 0*[1-9]", line):
                    # openjd cancels the task, in the way that the template says.
                    running.terminate()
                    break
            log += running.stdout.read()
        tasks = _tasks(log)
        self.assertEqual(running.returncode, 1, log)
        self.assertIn("exited with code: 75 ", log)
        reached = self.progress(tasks[0])[-1]
        self.assertLess(reached, 100)
        self.assertEqual(len(os.listdir(self.path("check points"))), 1)

        tasks = self.succeed_with("frames.yaml", **settings)
        self.assert_whole_progress(tasks)
        self.assertGreater(self.progress(tasks[0])[0], 0, "where it goes on")
        self.assertGreater(len(set(self.progress(tasks[0]))), 3)
        self.assertEqual(os.listdir(self.path("check points")), [])
        for frame in [1, 2]:
            self.assert_same(self.picture(f"it's out/picture.{frame:04}.exr"),
                             self.whole_picture(frame, "-s", str(samples)))


def _tasks(log):
    """For each task that ran the lines of its log."""
    lines = [line.split("\t", 1)[-1] for line in log.splitlines()]
    starts = [number for number, line in enumerate(lines) if line == "--------- Running Task"]
    return [lines[start:end] for start, end in zip(starts, starts[1:] + [len(lines)])]


if __name__ == "__main__":
    unittest.main()
