"""The batch scripts of share/slurm, run by bash alone: what they make of their parameters. A stand-in for the program
writes down how it was called."""

import os
import subprocess
import unittest

import support
from farm import SHARE


class Scripts(support.CommandTest):
    def setUp(self):
        super().setUp()
        self.write("stand-in", '#!/bin/sh\nprintf "%s\\n" "$@" >called\n')
        os.chmod(self.path("stand-in"), 0o755)

    def run_script(self, script, index=None, **parameters):
        if index is not None:
            parameters["SLURM_ARRAY_TASK_ID"] = str(index)
        environment = {"PATH": os.environ["PATH"], "RAYTRACE": "./stand-in", "SLURM_CPUS_PER_TASK": "2", **parameters}
        return subprocess.run(["bash", os.path.join(SHARE, "slurm", script)], cwd=self.folder, env=environment, text=True,
                              capture_output=True, check=False)

    def call(self, script, index=None, **parameters):
        """The arguments of the program."""
        done = self.run_script(script, index, **parameters)
        self.assertEqual(done.returncode, 0, done.stderr)
        return self.read("called").decode().splitlines()

    def pieces(self, *names):
        os.makedirs(self.path("pictures/pieces"), exist_ok=True)
        for name in names:
            self.write(f"pictures/pieces/{name}", "")

    def test_numbers_are_decimal(self):
        self.pieces("picture.0.0010.exr", "picture.1.0008.exr")
        self.assertEqual(self.call("merge.sbatch", FRAME="010", TOTAL_SAMPLES="64"),
                         ["merge", "pictures/pieces/picture.0.0010.exr", "-s", "64", "-o", "pictures/picture.0010.exr"])
        called = self.call("samples.sbatch", 3, FRAME="010", SAMPLES="010")
        self.assertEqual(called[called.index("--frames") + 1], "10")
        self.assertEqual(called[called.index("--sample-offset") + 1], "30")
        called = self.call("tiles.sbatch", 9, FRAME="-08", TILES="016")
        self.assertEqual(called[called.index("--frames") + 1], "-8")
        self.assertEqual(called[called.index("--tile") + 1], "9/16")
        self.assertEqual(self.call("frames.sbatch", 8)[2], "8")

    def test_no_parameter_is_run(self):
        trap = "a[$(touch trapped)]"
        for script, parameter in (("samples.sbatch", "SAMPLES"), ("samples.sbatch", "FRAME"), ("tiles.sbatch", "FRAME"),
                                  ("tiles.sbatch", "TILES"), ("merge.sbatch", "FRAME")):
            for text in (trap, "8+8", "0x10", "eight", "", "1 2", "99999999999"):
                done = self.run_script(script, 0, **{parameter: text})
                if text == "":
                    self.assertEqual(done.returncode, 0, "the default")
                    continue
                self.assertEqual((done.returncode, done.stderr), (2, f"{parameter} is '{text}', which is no whole number\n"))
        self.call("samples.sbatch", 1, NAME=trap, PICTURES=trap, SCENE=trap, OPTIONS=trap)
        self.assertNotIn("trapped", self.names())

    def test_pieces_of_other_names(self):
        self.pieces("picture.0.0001.exr", "picture.64.0001.exr", "picture.old.0.0001.exr", "picture.0.0002.exr",
                    "picture.2.0.0001.exr", "picture..0001.exr", "other.0.0001.exr")
        self.assertEqual(self.call("merge.sbatch")[1:3],
                         ["pictures/pieces/picture.0.0001.exr", "pictures/pieces/picture.64.0001.exr"])
        self.assertEqual(self.call("merge.sbatch", NAME="picture.old")[1:3], ["pictures/pieces/picture.old.0.0001.exr", "-o"])


if __name__ == "__main__":
    unittest.main()
