"""Runs benchmarks/compare_commits in repositories whose benchmark prints times that the test chose."""

import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "benchmarks" / "compare_commits"

# The program is a script of the commit itself.
CMAKE_LISTS = """\
cmake_minimum_required(VERSION 3.24)
project(stand_in LANGUAGES NONE)
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
add_custom_target(raytrace_benchmark
  COMMAND ${CMAKE_COMMAND} -E copy ${PROJECT_SOURCE_DIR}/program ${PROJECT_BINARY_DIR}/bin/raytrace_benchmark)
"""
PROGRAM = """\
#!/bin/sh
case $1 in
  --help) echo --json ;;
  *) echo '[{{"scene": "mix:5000", "threads": 1, "render": {render}, "embree": {bare}}}]' ;;
esac
"""


class CompareCommits(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="raytrace-benchmarks-")
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        (self.root / "benchmarks").mkdir()
        shutil.copy(SCRIPT, self.root / "benchmarks")
        who = {f"GIT_{role}_{what}": "test@localhost" for role in ("AUTHOR", "COMMITTER") for what in ("NAME", "EMAIL")}
        self.environment = {**os.environ, **who, "GIT_CEILING_DIRECTORIES": str(self.root.parent)}

    def git(self, *arguments):
        subprocess.run(["git", *arguments], cwd=self.root, env=self.environment, check=True, capture_output=True)

    def commit(self, **files):
        if not (self.root / ".git").exists():
            self.git("init", "--quiet")
        for name, text in files.items():
            (self.root / name).write_text(text, encoding="utf-8")
            (self.root / name).chmod(0o755)
        self.git("add", "--all", "--", ":!build")
        self.git("commit", "--quiet", "--allow-empty", "--message", "one more")

    def commit_program(self, render, bare):
        self.commit(**{"CMakeLists.txt": CMAKE_LISTS, "program": PROGRAM.format(render=render, bare=bare)})

    def compare(self, *arguments):
        script = self.root / "benchmarks" / "compare_commits"
        return subprocess.run(
            [script, *arguments], cwd=self.root, env=self.environment, check=False, capture_output=True, text=True
        )

    def assert_skipped(self, result):
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("skipped", result.stdout)
        self.assertEqual(result.stdout.count("\n"), 1)

    def line_of(self, result, benchmark):
        return next(line for line in result.stdout.splitlines() if line.startswith(benchmark)).split()

    def test_skips_without_repository(self):
        self.assert_skipped(self.compare())

    def test_skips_first_commit(self):
        self.commit()
        self.assert_skipped(self.compare("--quick"))

    def test_refuses_unknown_commit(self):
        self.commit()
        result = self.compare("no-such-commit")
        self.assertEqual(result.returncode, 2)
        self.assertIn("no-such-commit", result.stderr)

    def test_says_what_cannot_be_built(self):
        self.commit()
        self.commit()
        result = self.compare()
        self.assertEqual(result.returncode, 1)
        self.assertIn("CMakeLists.txt", result.stderr)

    def test_marks_differences_and_succeeds(self):
        self.commit_program(render=0.5, bare=0.4)
        self.commit_program(render=0.6, bare=0.3)
        result = self.compare("--rounds", "2")
        self.assertEqual(result.returncode, 0, result.stderr)
        slower = ["render/mix:5000/threads:1", "500", "ms", "600", "ms", "1.200", "1.200", "1.200", "slower"]
        faster = ["embree/mix:5000/threads:1", "400", "ms", "300", "ms", "0.750", "0.750", "0.750", "faster"]
        self.assertEqual(self.line_of(result, "render"), slower)
        self.assertEqual(self.line_of(result, "embree"), faster)

    def test_follows_new_commits(self):
        self.commit_program(render=0.5, bare=0.4)
        self.commit_program(render=0.5, bare=0.4)
        self.compare("--rounds", "1")
        self.commit_program(render=1, bare=0.404)
        result = self.compare("--rounds", "1")
        self.assertEqual(self.line_of(result, "render")[-1], "slower", result.stderr)
        self.assertEqual(self.line_of(result, "embree")[5:], ["1.010", "1.010", "1.010"])

    def test_tells_where_a_benchmark_is_missing(self):
        self.commit(**{"CMakeLists.txt": "cmake_minimum_required(VERSION 3.24)\nproject(none LANGUAGES NONE)\n"})
        self.commit_program(render=0.5, bare=0.4)
        result = self.compare("--rounds", "1")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("only in the new one", result.stdout)


if __name__ == "__main__":
    unittest.main()
