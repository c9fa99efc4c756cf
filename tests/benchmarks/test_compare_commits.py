"""Runs benchmarks/compare_commits with programs that write the times that the test chose."""

import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

BENCHMARKS = pathlib.Path(__file__).resolve().parents[2] / "benchmarks"

# The program is a script of the commit itself.
CMAKE_LISTS = """\
cmake_minimum_required(VERSION 3.24)
project(stand_in LANGUAGES NONE)
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
add_custom_target(raytrace_program
  COMMAND ${CMAKE_COMMAND} -E copy ${PROJECT_SOURCE_DIR}/program ${PROJECT_BINARY_DIR}/bin/raytrace)
"""
# Appends its arguments to a log beside it.
PROGRAM = """\
#!/bin/sh
[ "$1" = --version ] && echo 'instruction sets: {isas}' && exit
echo "$(basename "$0") $* $(head -c 11 "$1")" >>"$(dirname "$0")/log"
{before}
echo '{{"seconds": {{"render": {render}}}}}' >stats.json
"""
MICRO = """\
#!/bin/sh
for option; do case $option in --benchmark_out=*) out=${{option#*=}} ;; --benchmark_filter=*) filter=${{option#*=}} ;; esac; done
echo '{{"benchmarks": [{{"name": "'"$filter"'", "cpu_time": {time}, "time_unit": "us"}},' >"$out"
echo '{{"name": "{name}", "cpu_time": 1, "time_unit": "ms"}}]}}' >>"$out"
"""
HALF_A_SECOND_OF_PROCESSOR = """\
python3 -c 'import time
while time.process_time() < 0.5: pass'"""


class CompareCommits(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="raytrace-benchmarks-")
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        shutil.copytree(BENCHMARKS, self.root / "benchmarks", ignore=shutil.ignore_patterns("__pycache__"))
        who = {f"GIT_{role}_{what}": "test@localhost" for role in ("AUTHOR", "COMMITTER") for what in ("NAME", "EMAIL")}
        self.environment = {**os.environ, **who, "GIT_CEILING_DIRECTORIES": str(self.root.parent)}

    def git(self, *arguments):
        subprocess.run(["git", *arguments], cwd=self.root, env=self.environment, check=True, capture_output=True)

    def write(self, name, text):
        (self.root / name).write_text(text, encoding="utf-8")
        (self.root / name).chmod(0o755)

    def program(self, name, render=1, isas="generic (best here: generic)", before=""):
        self.write(name, PROGRAM.format(render=render, isas=isas, before=before))

    def commit(self, **program):
        if not (self.root / ".git").exists():
            self.git("init", "--quiet")
        if program:
            self.write("CMakeLists.txt", CMAKE_LISTS)
            self.program("program", **program)
        self.git("add", "--all", "--", ":!build")
        self.git("commit", "--quiet", "--allow-empty", "--message", "one more")

    def command(self, *arguments):
        """With two rounds of one scene, unless the arguments say more."""
        return [self.root / "benchmarks" / "compare_commits", "--scenes", "spheres-10", "--rounds", "2", *arguments]

    def compare(self, *arguments):
        return subprocess.run(
            self.command(*arguments), cwd=self.root, env=self.environment, check=False, capture_output=True, text=True
        )

    def log(self):
        return (self.root / "log").read_text(encoding="utf-8").splitlines()

    def assert_skipped(self, result):
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("skipped", result.stdout)
        self.assertEqual(result.stdout.count("\n"), 1)

    def assert_fails(self, result, *words):
        self.assertEqual(result.returncode, 2, result.stdout)
        self.assertNotIn("Traceback", result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)

    def line_of(self, result, benchmark):
        lines = [line.split() for line in result.stdout.splitlines() if line.startswith(benchmark + " ")]
        self.assertEqual(len(lines), 1, result.stdout + result.stderr)
        return lines[0][1:]

    # What is run.

    def test_programs_take_turns(self):
        self.program("old")
        self.program("new")
        self.compare("old", "new", "--rounds", "4")
        turns = [line.split()[0] for line in self.log()]
        self.assertEqual(turns, ["old", "new", "new", "old", "old", "new", "new", "old"])

    def test_runs_15_rounds(self):
        self.program("old")
        self.program("new")
        script = self.root / "benchmarks" / "compare_commits"
        command = [script, "old", "new", "--scenes", "spheres-10"]
        subprocess.run(command, cwd=self.root, check=False, capture_output=True)
        self.assertEqual(len(self.log()), 30)

    def test_renders_each_scene_by_each_instruction_set_that_both_run(self):
        self.program("old", isas="a, b, c, d (best here: c)")
        self.program("new", isas="b, c, d (best here: d)")
        result = self.compare("old", "new", "--scenes", "spheres-10", "tori-1k", "--limit", "inf")
        names = [line.split()[0] for line in result.stdout.splitlines() if "/render " in line]
        self.assertEqual(names, [f"{scene}/{isa}/render" for scene in ("spheres-10", "tori-1k") for isa in "bc"])
        for isa in "bc":
            command = f"new scene.xml --isa {isa} -t 1 -q -o picture.exr --stats=stats.json <raytracer>"
            self.assertEqual(self.log().count(command), 4)

    def test_isa_limits_them(self):
        self.program("program", isas="a, b (best here: b)")
        result = self.compare("program", "program", "--isa", "b", "--limit", "inf")
        self.assertIn("/b/render", result.stdout)
        self.assertNotIn("/a/render", result.stdout)

    def test_threads(self):
        self.program("program")
        self.compare("program", "program", "--threads", "3")
        self.assertIn(" -t 3 ", self.log()[0])

    # What is said about it.

    def test_medians_and_quartiles(self):
        # The new one takes 1, 2, 4, 8 and 16 times as long.
        self.program("old", render=0.01)
        self.program("new", render="'$n'", before='n=$(head -n 1 "$0.n"); sed -i 1d "$0.n"')
        self.write("new.n", "0.01\n0.02\n0.04\n0.08\n0.16\n")
        result = self.compare("old", "new", "--rounds", "5")
        expected = ["10", "ms", "40", "ms", "4.000", "2.000", "8.000", "slower"]
        self.assertEqual(self.line_of(result, "spheres-10/generic/render"), expected)

    def test_marks_what_is_faster(self):
        self.program("old", render=0.4)
        self.program("new", render=0.3)
        result = self.compare("old", "new")
        expected = ["400", "ms", "300", "ms", "0.750", "0.750", "0.750", "faster"]
        self.assertEqual(self.line_of(result, "spheres-10/generic/render"), expected)

    def test_fails_above_1_05(self):
        self.program("old", render=1)
        self.program("new", render=1.051)
        result = self.compare("old", "new")
        self.assertEqual(result.returncode, 1)
        self.assertIn("above the limit 1.05: spheres-10/generic/render, 1.051", result.stdout)

    def test_succeeds_at_the_limit(self):
        self.program("old", render=1)
        self.program("new", render=64)
        result = self.compare("old", "new", "--limit", "64")
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertNotIn("above", result.stdout)

    def test_fails_for_processor_time(self):
        self.program("old")
        self.program("new", before=HALF_A_SECOND_OF_PROCESSOR)
        result = self.compare("old", "new", "--limit", "2")
        self.assertEqual(result.returncode, 1)
        self.assertIn("above the limit 2: spheres-10/generic/processor", result.stdout)
        self.assertNotIn("above the limit 2: spheres-10/generic/render", result.stdout)

    # Micro benchmarks.

    def test_micro_benchmarks(self):
        self.write("old", MICRO.format(time=2, name="older"))
        self.write("new", MICRO.format(time=3, name="newer"))
        result = self.compare("old", "new", "--micro", "torus")
        self.assertEqual(result.returncode, 0, result.stderr)
        expected = ["2", "us", "3", "us", "1.500", "1.500", "1.500", "slower"]
        self.assertEqual(self.line_of(result, "torus"), expected)
        self.assertEqual(self.line_of(result, "older"), ["only", "in", "the", "old", "one"])
        self.assertEqual(self.line_of(result, "newer"), ["only", "in", "the", "new", "one"])

    def test_micro_benchmarks_keep_a_limit_that_is_given(self):
        self.write("old", MICRO.format(time=2, name="other"))
        self.write("new", MICRO.format(time=3, name="other"))
        self.assertEqual(self.compare("old", "new", "--micro", "torus", "--limit", "1.4").returncode, 1)

    def test_refuses_pattern_that_matches_none(self):
        self.write("program", "#!/bin/sh\n")
        self.assert_fails(self.compare("program", "program", "--micro", "tortoise"), "tortoise")

    # Commits.

    def test_skips_without_repository(self):
        self.assert_skipped(self.compare())

    def test_skips_first_commit(self):
        self.commit()
        self.assert_skipped(self.compare())

    def test_refuses_unknown_commit(self):
        self.commit()
        self.assert_fails(self.compare("no-such-commit"), "no-such-commit")

    def test_says_what_cannot_be_built(self):
        self.commit()
        self.commit()
        self.assert_fails(self.compare(), "CMakeLists.txt")

    def test_builds_commits(self):
        self.commit(render=0.5)
        self.commit(render=0.6)
        result = self.compare()
        self.assertEqual(self.line_of(result, "spheres-10/generic/render")[:5], ["500", "ms", "600", "ms", "1.200"])

    def test_builds_instruction_sets_that_are_asked_for_else_the_default(self):
        self.commit()
        configuration = 'set(RAYTRACE_ISAS default CACHE STRING "")\nmessage(FATAL_ERROR "builds ${RAYTRACE_ISAS}.")\n'
        self.write("CMakeLists.txt", configuration)
        self.commit()
        self.assert_fails(self.compare("HEAD", "HEAD", "--isa", "a", "b"), "builds a;b.")
        self.assert_fails(self.compare("HEAD", "HEAD"), "builds default.")

    def test_follows_new_commits(self):
        self.commit(render=0.5)
        self.commit(render=0.5)
        self.compare()
        self.commit(render=1)
        self.assertEqual(self.line_of(self.compare(), "spheres-10/generic/render")[4], "2.000")

    def test_compares_a_program_with_a_commit(self):
        self.commit(render=0.6)
        self.program("old", render=0.5)
        self.assertEqual(self.line_of(self.compare("old", "HEAD"), "spheres-10/generic/render")[4], "1.200")

    # Programs that fail.

    def test_says_which_program_failed_and_how(self):
        self.program("old")
        self.program("new", before="echo out of oil >&2; exit 3")
        self.assert_fails(self.compare("old", "new"), "/new scene.xml", "exit code 3", "out of oil")

    def test_says_what_signal_ended_a_program(self):
        self.program("old")
        self.program("new", before="kill -TERM $$")
        self.assert_fails(self.compare("old", "new"), "/new scene.xml", "SIGTERM")

    def test_takes_no_time_of_an_earlier_run(self):
        self.program("old")
        self.program("new", before="exit 0")
        self.assert_fails(self.compare("old", "new"), "/new wrote no seconds.render")

    def test_refuses_what_is_no_program(self):
        self.program("old")
        self.write("new", "#!/bin/sh\n")
        self.assert_fails(self.compare("old", "new"), "/new --version")
        (self.root / "new").chmod(0o644)
        self.assert_fails(self.compare("old", "new"), "/new cannot be run")

    def test_refuses_instruction_sets_that_not_both_run(self):
        self.program("old", isas="a, b (best here: b)")
        self.program("new", isas="b, c (best here: c)")
        self.assert_fails(self.compare("old", "new", "--isa", "b", "c"), "run here: b\n")
        self.program("new", isas="c (best here: c)")
        self.assert_fails(self.compare("old", "new"), "run here: none\n")

    def test_says_that_it_was_interrupted(self):
        self.program("program", before="exec sleep 60")
        command = self.command("program", "program")
        process = subprocess.Popen(command, cwd=self.root, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        while not (self.root / "log").exists() and process.poll() is None:
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate()
        self.assertEqual(process.returncode, 130)
        self.assertEqual(errors.splitlines()[-1], "compare_commits: interrupted")
        self.assertNotIn("Traceback", errors)


if __name__ == "__main__":
    unittest.main()
