"""The scripts of share/slurm in a real Slurm of one node, which the test starts and stops."""

import os
import tempfile
import unittest

import support
from farm import SHARE, FarmTest
from slurm_cluster import start_or_skip

SCRIPTS = os.path.join(SHARE, "slurm")
cluster = None
cluster_folder = tempfile.TemporaryDirectory(prefix="raytrace-slurm-")


def setUpModule():
    global cluster
    cluster = start_or_skip(cluster_folder)


def tearDownModule():
    cluster.stop()
    left = cluster.processes()
    cluster_folder.cleanup()
    assert not left, f"still running: {left}"


class Scripts(FarmTest):
    def submit(self, script, *options, **parameters):
        """The number of the new job, which runs in the test's folder."""
        return cluster.submit(os.path.join(SCRIPTS, script), "--cpus-per-task=1", f"--chdir={self.folder}", *options,
                              RAYTRACE=support.PROGRAM, INSTRUCTION_SET=self.instruction_set, **parameters)

    def submit_merge(self, job, count, **parameters):
        """After each task of an array by itself: one that has been requeued fails the array as a whole for afterok."""
        dependency = "afterok" + "".join(f":{job}_{index}" for index in range(count))
        return self.submit("merge.sbatch", f"--dependency={dependency}", "--kill-on-invalid-dep=yes", **parameters)

    def complete(self, job):
        cluster.wait_for(job, "COMPLETED", "FAILED", "CANCELLED")
        self.assertEqual(set(cluster.states(job)), {"COMPLETED"}, self.logs())

    def logs(self):
        names = [name for name in self.names() if name.startswith("slurm-")]
        return {name: self.read(name).decode() for name in names}

    def test_tiles(self):
        job = self.submit("tiles.sbatch", "--array=0-2", TILES="3", FRAME="2", PICTURES="my pictures")
        merge = self.submit_merge(job, 3, FRAME="2", PICTURES="my pictures")
        self.complete(merge)
        self.assert_same(self.picture("my pictures/picture.0002.exr"), self.whole_picture(2))
        self.assertEqual(os.listdir(self.path("checkpoints")), [])

    def test_samples(self):
        job = self.submit("samples.sbatch", "--array=0-1", SAMPLES="6", OPTIONS="-r 40x30")
        self.complete(self.submit_merge(job, 2, TOTAL_SAMPLES="12"))
        self.assert_same(self.picture("pictures/picture.0001.exr"), self.whole_picture(1, "-r", "40x30", "-s", "12"))

    def test_frames(self):
        self.complete(self.submit("frames.sbatch", "--array=1,3"))
        for frame in [1, 3]:
            self.assert_same(self.picture(f"pictures/picture.{frame:04}.exr"), self.whole_picture(frame))

    def test_failed_tile_cancels_the_merge(self):
        os.makedirs(self.path("pictures/pieces/picture.1.0001.exr"))  # a folder where the piece should be
        job = self.submit("tiles.sbatch", "--array=0-1", TILES="2")
        merge = self.submit_merge(job, 2)
        cluster.wait_for(merge, "COMPLETED", "FAILED", "CANCELLED")
        self.assertEqual(cluster.states(job), ["COMPLETED", "FAILED"], self.logs())
        self.assertEqual(cluster.states(merge), ["CANCELLED"])
        self.assertEqual(cluster.facts(merge)[0]["Reason"], "DependencyNeverSatisfied")
        self.assertFalse(os.path.exists(self.path("pictures/picture.0001.exr")))

    def test_stopped_task_is_requeued_and_goes_on_from_its_checkpoint(self):
        samples = str(self.samples_for(6))  # each tile three seconds
        job = self.submit("tiles.sbatch", "--array=0-1", TILES="2", OPTIONS=f"-s {samples} --progress=plain")
        merge = self.submit_merge(job, 2)
        log = f"slurm-{job}_0.out"
        cluster.wait_until("the first tile's progress", lambda: log in self.names() and b"%" in self.read(log))
        cluster.ask("scancel", "--signal=TERM", "--batch", f"{job}_0")
        cluster.wait_until("the first tile to be pending again or at its end",
                           lambda: cluster.facts(f"{job}_0")[0]["JobState"] not in ("RUNNING", "COMPLETING"))
        stopped = cluster.facts(f"{job}_0")[0]
        self.assertEqual((stopped["JobState"], stopped["ExitCode"], stopped["Restarts"]), ("PENDING", "75:0", "1"))
        self.assertEqual(os.listdir(self.path("checkpoints")), ["picture.0.0001.checkpoint"])
        self.complete(merge)
        self.assertEqual(cluster.facts(f"{job}_0")[0]["Restarts"], "1")
        self.assert_same(self.picture("pictures/picture.0001.exr"), self.whole_picture(1, "-s", samples))
        self.assertEqual(os.listdir(self.path("checkpoints")), [])

    @unittest.skipIf(support.SANITIZERS, "a sanitizer needs more address space than any limit leaves")
    def test_too_little_memory(self):
        job = self.submit("tiles.sbatch", "--array=0", TILES="1", OPTIONS="-r 16384x16384", ADDRESS_SPACE=str(1 << 20))
        cluster.wait_for(job, "COMPLETED", "FAILED")
        self.assertEqual(cluster.facts(job)[0]["ExitCode"], "33:0")
        self.assertIn("out of memory", self.logs()[f"slurm-{job}_0.out"])


if __name__ == "__main__":
    unittest.main()
