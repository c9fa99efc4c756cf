"""From a build to a film, by the very lines of README.md and docs/farms.md: the program is installed, renders a model from a
package, in another light, on a turntable, its frames on a Slurm of one node, and one of them in tiles that are merged."""

import os
import re
import shutil
import subprocess
import tempfile
import unittest

import support
from farm import FarmTest, skip_all
from slurm_cluster import start_or_skip

MODEL = os.path.join(support.REPOSITORY, "build", "models", "assimp", "glTF2", "BoxTextured-glTF-Binary", "BoxTextured.glb")
SIZE = "-r 48x27 -s 4"  # what is added to the lines, for the test's time
FIRST_COMMAND = "cmake/run chair.glb -o chair.png"
cluster = None
cluster_folder = tempfile.TemporaryDirectory(prefix="raytrace-newcomer-")


def setUpModule():
    global cluster
    if not os.path.exists(MODEL):
        cluster_folder.cleanup()
        skip_all("there is no model: tests/models/environment.sh brings it")
    cluster = start_or_skip(cluster_folder)


def tearDownModule():
    cluster.stop()
    cluster_folder.cleanup()


def documented(file, heading, first_word):
    """The lines of the first block of commands below a heading that begins so."""
    with open(os.path.join(support.REPOSITORY, file), encoding="utf-8") as text:
        section = text.read().split(f"\n## {heading}\n", 1)[1]
    return re.search(rf"\n```\n({first_word} .*?)\n```\n", section, re.S).group(1).splitlines()


class Newcomer(FarmTest):
    def setUp(self):
        super().setUp()
        shutil.copy(MODEL, self.path("chair.glb"))

    def run_script(self, script, **environment):
        done = subprocess.run(["bash", "-eu", "-o", "pipefail", "-c", script], cwd=self.folder, text=True,
                              env={**os.environ, **environment}, stdin=subprocess.DEVNULL, capture_output=True, timeout=900)
        logs = {name: self.read(name).decode() for name in self.names() if name.startswith("slurm-")}
        self.assertEqual(done.returncode, 0, f"{done.stderr} {logs}")

    def test_lines_of_the_manual(self):
        prefix, build = self.path("local"), os.path.dirname(os.path.dirname(support.PROGRAM))
        install = documented("README.md", "Two commands", "cmake --preset")[-1]
        self.assertEqual(install, "cmake --install build/release --prefix /usr/local")
        self.run_script(install.replace("build/release", f"'{build}'").replace("/usr/local", prefix))
        script = "\n".join(documented("docs/farms.md", "From a model to a film", "raytrace")).replace("/usr/local", prefix)
        script = re.sub(r"^(raytrace .*) -o", rf"\1 {SIZE} -o", script, flags=re.M).replace("24\"", f"24 {SIZE}\"")
        self.run_script(script, **{**cluster.environment, "PATH": f"{prefix}/bin:{os.environ['PATH']}",
                                   "INSTRUCTION_SET": self.instruction_set, "SLURM_CPUS_PER_TASK": "1"})
        self.assertEqual(self.read("chair.png")[1:4], b"PNG")
        turn = [f"chair.{frame:02}.png" for frame in range(1, 25)]
        self.assertLessEqual(set(turn), set(self.names()))
        self.assertEqual(len({self.read(name) for name in turn}), 24)
        self.assertEqual(sorted(os.listdir(self.path("pictures"))),
                         ["large.0007.exr", *(f"picture.{frame:04}.exr" for frame in range(1, 25)), "pieces"])
        self.assert_same(self.picture("pictures/large.0007.exr"), self.picture("pictures/picture.0007.exr"))

    def test_readme_leads_there(self):
        with open(os.path.join(support.REPOSITORY, "README.md"), encoding="utf-8") as text:
            readme = text.read()
        for link in (FIRST_COMMAND, "docs/models.md", "docs/farms.md"):
            self.assertIn(link, readme)

    @unittest.skipUnless(support.LONG, "RAYTRACE_LONG_TESTS is not set: it may have to build")
    def test_first_command(self):
        self.run_script(FIRST_COMMAND.replace("cmake/run", f"'{support.REPOSITORY}/cmake/run'"))
        self.assertEqual(self.read("chair.png")[1:4], b"PNG")


if __name__ == "__main__":
    unittest.main()
