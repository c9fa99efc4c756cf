"""What the program says, where, and how it stops."""

import json
import os
import pty
import re
import signal
import subprocess
import time
import unittest

import jsonschema

import support
from exr import Exr
from support import CommandTest

STRAY = support.SCENE.replace("</pointlight>", "<shadows>>true</shadows></pointlight>", 1)

# One line at the end, and before it as many as the render had seconds.
PLAIN = r"^(raytrace: rendered \d+ %(, [^\r\n]* left)?\r?\n)*raytrace: rendered 100 %\r?\n$"


class Messages(CommandTest):
    def test_silence(self):
        self.write("warned.xml", STRAY)
        done = self.succeed("warned.xml", "-q", "-o", "a.exr")
        self.assertEqual((done.stdout, done.stderr), ("", ""))

    def test_warnings(self):
        self.write("warned.xml", STRAY)
        done = self.succeed("warned.xml", "-o", "a.exr", "--progress=none")
        self.assertEqual(done.stdout, "")
        self.assertRegex(done.stderr, r"^warned\.xml:\d+:\d+: warning: .*\n$")

    def test_verbose(self):
        done = self.succeed("scene.xml", "-v", "-o", "a.exr", "--progress=none")
        self.assertEqual(done.stdout, "")
        for line in done.stderr.splitlines():
            self.assertTrue(line.startswith("raytrace: "), line)
        self.assertIn("2 objects, 3 lights", done.stderr)
        self.assertIn("wrote a.exr", done.stderr)
        self.assertNotIn("peak memory", done.stderr)
        self.assertIn("peak memory", self.succeed("scene.xml", "-vv", "-o", "a.exr").stderr)

    def test_validate(self):
        done = self.succeed("scene.xml", "--validate", "-o", "a.exr")
        self.assertEqual(done.stdout, "scene.xml: ok (2 objects, 3 lights)\n")
        self.assertEqual(done.stderr, "")
        self.assertEqual(self.names(), ["scene.xml"])
        self.assertEqual(self.succeed("-", "--validate", input=support.SCENE).stdout,
                         "<stdin>: ok (2 objects, 3 lights)\n")
        self.assertEqual(self.succeed("scene.xml", "--validate", "-q").stdout, "")
        self.write("bad.xml", "<raytracer/>")
        self.assertIn("bad.xml:1:1: error: ", self.fail_with(1, "bad.xml", "--validate", "-q"))

    def test_print_scene(self):
        printed = self.succeed("scene.xml", "--print-scene").stdout
        self.write("printed.xml", printed)
        self.assertEqual(self.succeed("printed.xml", "--print-scene").stdout, printed)
        self.succeed("scene.xml", "-q", "-o", "a.exr", "--float")
        self.succeed("printed.xml", "-q", "-o", "b.exr", "--float")
        self.assertEqual(Exr(self.read("a.exr")).pixels(), Exr(self.read("b.exr")).pixels())

    def test_print_scene_shows_what_the_options_ask_for(self):
        printed = self.succeed("scene.xml", "--print-scene", "-r", "40x30", "-s", "7").stdout
        self.assertIn("<hres>40</hres>", printed)
        self.assertIn("<pixelsize>2</pixelsize>", printed)
        self.assertIn("<samples>7</samples>", printed)

    def test_list(self):
        for kind, member in [("shapes", "sphere"), ("shapes", "mesh"), ("shapes", "instance"), ("materials", "phong"), ("lights", "pointlight"),
                             ("cameras", "pinhole"), ("integrators", "raycast")]:
            self.assertIn(member, self.succeed("--list", kind).stdout.splitlines())
        self.assertIn("did you mean 'shapes'?", self.fail_with(2, "--list", "shape"))

    def test_version(self):
        version = self.succeed("--version").stdout
        self.assertRegex(version, r"^raytrace \d+\.\d+\.\d+\nEmbree \d+\.\d+\.\d+\nOpenImageIO \d+\.\d+\.\d+\noneTBB \d+")


class NamesWithControlCharacters(CommandTest):
    # A line end, a terminal's command in both encodings, and a byte that is no UTF-8.
    EVIL = b"a\nraytrace: error: \x1b[31m\xc2\x9b31m\x07\xff"

    def run_program(self, *arguments, **keywords):
        done = subprocess.run([os.fsencode(support.PROGRAM), *(a if isinstance(a, bytes) else a.encode() for a in arguments)],
                              cwd=self.folder, capture_output=True, stdin=subprocess.DEVNULL, check=False, **keywords)
        for text in (done.stdout, done.stderr, self.read("log") if os.path.exists(self.path("log")) else b""):
            for line in text.decode().splitlines():  # which must be UTF-8
                self.assertTrue(line.isprintable(), line)
                self.assertFalse(line.startswith(r"raytrace: error: \x1b"), line)  # from the name
        return done.returncode, done.stdout.decode(), done.stderr.decode()

    def test_none_reaches_the_terminal_or_the_log(self):
        scene, picture = self.EVIL + b".xml", self.EVIL + b".exr"
        os.rename(os.fsencode(self.path("scene.xml")), os.fsencode(self.folder) + b"/" + scene)
        shown = r"a\x0araytrace: error: \x1b[31m\xc2\x9b31m\x07\xff"
        small = ["-r", "8x8", "-s", "1", "--log-file", "log"]
        code, _, told = self.run_program(scene, *small, "-vv", "-o", picture, b"--stats=" + self.EVIL)
        self.assertEqual(code, 0, told)
        self.assertIn(f"wrote {shown}.exr", told)
        code, _, told = self.run_program(scene, *small, "--skip-existing", "--progress=openjd", "-o", picture)
        self.assertEqual(code, 0, told)
        self.assertIn(f"{shown}.exr: there already", told)
        self.assertIn(shown, self.run_program(scene, "--validate")[1])
        for code, arguments in ((2, [scene, "-o", picture, "-o", picture]), (1, [b"missing" + scene, "-o", picture]),
                                (1, [scene, "-o", self.EVIL + b"/" + picture]), (2, [scene, "-o", "b.exr", "--spp", self.EVIL]),
                                (1, ["merge", picture, b"no" + picture, "-o", "c.exr"]),
                                (2, [scene, "-o", picture, b"--" + self.EVIL])):
            got, _, told = self.run_program(*arguments)
            self.assertEqual(got, code, told)
            self.assertIn(r"a\x0aray", told)

    def test_our_own_lines_stay(self):
        _, _, told = self.run_program("x.xml", "y.xml", "-o", "{scene}.exr")
        self.assertTrue(told.endswith("2 of 2 renders failed:\n  x.xml\n  y.xml\n"), told)


def closed(schema):
    """The schema, but with no keys allowed other than those that it has."""
    if isinstance(schema, list):
        return [closed(part) for part in schema]
    if not isinstance(schema, dict):
        return schema
    result = {name: closed(part) for name, part in schema.items()}
    return result | {"additionalProperties": False} if "properties" in schema else result


class Statistics(CommandTest):
    def test_text(self):
        done = self.succeed("scene.xml", "-o", "a.exr", "--stats", "--progress=none")
        self.assertEqual(done.stdout, "")
        names = [line[:16].strip() for line in done.stderr.splitlines()]
        self.assertEqual(names, ["scene", "picture", "load", "build", "render", "write", "total", "camera rays",
                                 "shadow rays", "rays per second", "primitives", "BVH", "peak memory", "threads",
                                 "instructions", "Embree"])

    def test_json(self):
        self.succeed("scene.xml", "-q", "-o", "a.exr", "-o", "b.png", "--stats=stats.json", "-t", "2", "-s", "3",
                     "--crop", "0,0,40,30", "--seed", "5")
        report = json.loads(self.read("stats.json"))
        self.assertEqual(report["scene"], "scene.xml")
        self.assertEqual(report["outputs"], ["a.exr", "b.png"])
        self.assertEqual(report["picture"], {"width": 80, "height": 60, "region": [0, 0, 40, 30], "samples": 3, "seed": 5,
                                             "view_transform": "srgb", "exposure": 0, "white_balance": 0})
        self.assertEqual(report["threads"], 2)
        self.assertEqual(report["primitives"], 2)
        self.assertGreaterEqual(report["rays"]["camera"], 40 * 30 * 3)
        self.assertEqual(report["rays"]["total"], report["rays"]["camera"] + report["rays"]["shadow"] + report["rays"]["indirect"])
        self.assertGreater(report["rays"]["shadow"], 0)
        self.assertGreater(report["rays"]["per_second"], 0)
        self.assertAlmostEqual(report["seconds"]["total"],
                               sum(report["seconds"][phase] for phase in ("load", "build", "render", "write")))
        self.assertGreater(report["memory"]["peak_bytes"], 1 << 20)
        peaks = [report["memory"]["peak_bytes_by_phase"][phase] for phase in ("load", "build", "render", "write")]
        self.assertGreater(peaks[0], 1 << 20)
        self.assertEqual(peaks, sorted(peaks))
        self.assertLessEqual(peaks[-1], report["memory"]["peak_bytes"])
        self.assertGreater(report["memory"]["bvh_bytes"], 0)
        self.assertIn(report["instruction_set"]["name"], self.succeed("--version").stdout)
        self.assertGreaterEqual(report["instruction_set"]["lanes"], 1)
        self.assertRegex(report["embree"], r"^\d+\.\d+")
        self.assertRegex(report["software"], r"^raytrace \d")

    def test_stages_of_path_tracing(self):
        stages = ["camera", "trace", "surface", "texture", "lights", "shade", "film", "light_paths"]
        self.succeed("scene.xml", "-q", "-o", "a.exr", "--stats=stats.json", "-s", "64", "--integrator", "path")
        report = json.loads(self.read("stats.json"))
        self.assertEqual(list(report["stage_seconds"]), stages)
        for stage in stages:
            self.assertEqual(report["stage_seconds"][stage] > 0, stage != "light_paths", stage)
        self.assertGreater(report["processor_seconds"], 0)
        # A thread may have been on its processor for no longer than the render took.
        self.assertLessEqual(report["processor_seconds"], 1.05 * report["threads"] * report["seconds"]["render"])
        self.assertAlmostEqual(sum(report["stage_seconds"].values()), report["processor_seconds"])
        done = self.succeed("scene.xml", "-o", "a.exr", "-s", "16", "--stats", "--integrator", "path", "--progress=none")
        self.assertRegex(done.stderr, r"(?m)^stages +" + ", ".join(stage + r" \d+\.\d{3} s" for stage in stages) + "$")
        # Ray casting is not timed stage by stage.
        self.succeed("scene.xml", "-q", "-o", "a.exr", "--stats=stats.json")
        report = json.loads(self.read("stats.json"))
        self.assertEqual(report["stage_seconds"], {})
        self.assertGreater(report["processor_seconds"], 0)

    def test_memory_of_whoever_starts_it_does_not_count(self):
        ballast = b"x" * (400 << 20)
        self.succeed("scene.xml", "-q", "-o", "a.exr", "--stats=stats.json")
        self.assertLess(json.loads(self.read("stats.json"))["memory"]["peak_bytes"], len(ballast))

    def test_schema(self):
        with open(os.path.join(support.REPOSITORY, "share", "statistics.schema.json"), encoding="utf-8") as file:
            schema = json.load(file)
        jsonschema.Draft202012Validator.check_schema(schema)
        lenient, strict = (jsonschema.Draft202012Validator(form) for form in (schema, closed(schema)))
        for arguments in ([], ["-t", "2", "--crop", "0,0,1,1"], ["--integrator", "path"],
                          ["-", "--seed", "18446744073709551615", "-o", "b.png"]):
            scene = [] if "-" in arguments else ["scene.xml"]
            self.succeed(*scene, "-q", "-o", "a.exr", "--stats=stats.json", *arguments, input=support.SCENE)
            report = json.loads(self.read("stats.json"))
            strict.validate(report)
        # What is wrong must be found, and what a later version adds must not.
        lenient.validate(report | {"later": 1})
        self.assertFalse(strict.is_valid(report | {"later": 1}))
        for wrong in ({"schema_version": 2}, {"threads": "2"}, {"rays": {}}, {"primitives": -1}):
            self.assertFalse(lenient.is_valid(report | wrong), wrong)
        for key in report:
            self.assertFalse(lenient.is_valid({name: report[name] for name in report if name != key}), key)

    def test_every_key_is_documented(self):
        self.succeed("scene.xml", "-q", "-o", "a.exr", "--stats=stats.json", "--integrator", "path")
        with open(os.path.join(support.REPOSITORY, "docs", "command-line.md"), encoding="utf-8") as file:
            document = file.read()
        for key, value in json.loads(self.read("stats.json")).items():
            for name in value if isinstance(value, dict) else ():
                self.assertIn(f"`{key}.{name}`", document)
            if not isinstance(value, dict):
                self.assertIn(f"`{key}`", document)


class ProgressOnTerminal(CommandTest):
    def on_terminal(self, *arguments, kind="xterm"):
        """What the program writes to a terminal as its standard error."""
        ours, theirs = pty.openpty()
        process = subprocess.Popen([support.PROGRAM, *arguments], cwd=self.folder, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=theirs, env=dict(os.environ, TERM=kind))
        os.close(theirs)
        shown = b""
        while True:
            try:
                part = os.read(ours, 65536)
            except OSError:  # the program's end of a closed terminal
                break
            if not part:
                break
            shown += part
        os.close(ours)
        self.assertEqual(process.wait(), 0, shown)
        return shown.decode()

    def test_bar(self):
        shown = self.on_terminal("scene.xml", "-o", "a.exr")
        self.assertRegex(shown, r"\r\[#* *\] \d+ %")
        self.assertTrue(shown.endswith("\r\x1b[K"), repr(shown))
        self.assertNotIn("\n", shown)

    def test_bar_is_gone_before_messages(self):
        shown = self.on_terminal("scene.xml", "-v", "-o", "a.exr")
        self.assertIn("\r\x1b[Kraytrace: rendered ", shown)

    def test_none_and_quiet_and_plain(self):
        self.assertEqual(self.on_terminal("scene.xml", "-o", "a.exr", "--progress=none"), "")
        self.assertEqual(self.on_terminal("scene.xml", "-o", "a.exr", "-q"), "")
        self.assertRegex(self.on_terminal("scene.xml", "-o", "a.exr", "--progress=plain"), PLAIN)
        self.assertRegex(self.on_terminal("scene.xml", "-o", "a.exr", kind="dumb"), PLAIN)


class ProgressInLog(CommandTest):
    def test_plain_lines(self):
        done = self.succeed("scene.xml", "-o", "a.exr")
        self.assertRegex(done.stderr, PLAIN)
        self.assertEqual(done.stdout, "")

    def test_bar_where_asked_for(self):
        self.assertIn("] ", self.succeed("scene.xml", "-o", "a.exr", "--progress=bar").stderr)

    def test_lines_come_while_it_renders(self):
        process = self.start_program("scene.xml", "-o", "a.exr", *support.ENDLESS)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.stderr.close)
        line = process.stderr.readline()
        process.kill()
        process.wait()
        self.assertRegex(line, r"^raytrace: rendered \d+ %(, .* left)?\n$")


class ProgressForPrograms(CommandTest):
    """Lines on standard output that farms and scripts read; people have standard error."""

    def test_openjd(self):
        done = self.succeed("scene.xml", "-o", "a.exr", "--progress=openjd")
        self.assertEqual(done.stderr, "")
        for line in done.stdout.splitlines():
            self.assertRegex(line, r"^(openjd_progress: \d{1,3}\.\d|openjd_status: \S.*)$")
        amounts = [float(amount) for amount in re.findall(r"^openjd_progress: (.*)$", done.stdout, re.M)]
        self.assertEqual(amounts, sorted(amounts))
        self.assertEqual(amounts[-1], 100)
        self.assertGreaterEqual(amounts[0], 0)
        self.assertIn("openjd_status: wrote a.exr\n", done.stdout)

    def test_alf(self):
        done = self.succeed("scene.xml", "-o", "a.exr", "--progress=alf")
        self.assertEqual(done.stderr, "")
        self.assertRegex(done.stdout, r"^(ALF_PROGRESS \d+%\n)*ALF_PROGRESS 100%\n$")

    def test_json(self):
        done = self.succeed("scene.xml", "-o", "a.exr", "--progress=json")
        self.assertEqual(done.stderr, "")
        events = [json.loads(line) for line in done.stdout.splitlines()]
        progress = [event for event in events if event["event"] == "progress"]
        for event in progress:
            self.assertLessEqual(set(event), {"event", "percent", "seconds", "seconds_left", "samples"})
            self.assertGreaterEqual(event["seconds"], 0)
        self.assertEqual((progress[-1]["percent"], progress[-1]["seconds_left"]), (100, 0))
        self.assertEqual(progress[-1]["samples"], [4, 4])
        self.assertIn({"event": "status", "text": "wrote a.exr"}, events)
        self.assertEqual({event["event"] for event in events}, {"progress", "status"})

    def test_error_of_what_is_drawn_by_chance(self):
        command = ["scene.xml", "-o", "a.exr", "-s", "16", "--integrator", "path"]
        self.assertRegex(self.succeed(*command, "--progress=plain").stderr,
                         r"raytrace: rendered 100 %, error \d+(\.\d+)? %\n$")
        self.succeed(*command, "-q", "--stats=stats.json")
        error = json.loads(self.read("stats.json"))["estimated_error"]
        self.assertTrue(0 < error < 1, error)
        events = [json.loads(line) for line in self.succeed(*command, "--progress=json").stdout.splitlines()]
        last = [event for event in events if event["event"] == "progress"][-1]
        self.assertEqual((last["samples"], last["error"]), ([16, 16], error))
        # In passes, of which each tells less than the whole.
        self.succeed(*command, "-q", "--stats=stats.json", "--checkpoint", "a.checkpoint")
        self.assertTrue(error / 2 < json.loads(self.read("stats.json"))["estimated_error"] < 2 * error)
        # Ray casting draws nothing by chance.
        self.succeed("scene.xml", "-o", "a.exr", "-q", "--stats=stats.json")
        self.assertIsNone(json.loads(self.read("stats.json"))["estimated_error"])

    def test_radius_of_photons(self):
        with open(os.path.join(support.REPOSITORY, "scenes", "photons.xml"), encoding="utf-8") as file:
            text = file.read()
        self.write("photons.xml", text)
        self.write("given.xml", text.replace("<caustics>", "<photonradius>0.125</photonradius> <caustics>"))
        options = ["-o", "a.exr", "-q", "-s", "2", "-r", "32x24", "--stats=stats.json"]
        self.succeed("photons.xml", *options)
        self.assertTrue(0 < json.loads(self.read("stats.json"))["photon_radius"] < 0.5)
        self.succeed("given.xml", *options)
        self.assertEqual(json.loads(self.read("stats.json"))["photon_radius"], 0.125)
        self.succeed("scene.xml", *options)
        self.assertIsNone(json.loads(self.read("stats.json"))["photon_radius"])

    def test_quiet_and_verbose_change_nothing_on_standard_output(self):
        for verbosity in ("-q", "-vv"):
            done = self.succeed("scene.xml", "-o", "a.exr", "--progress=openjd", "--stats", verbosity)
            for line in done.stdout.splitlines():
                self.assertRegex(line, r"^openjd_(progress|status): ")
            self.assertIn("openjd_status: wrote a.exr\n", done.stdout)

    def test_why_a_run_fails(self):
        self.write("bad.xml", "<raytracer/>")
        for scene, output, reason in [("bad.xml", "a.exr", r"bad\.xml:1:1: error: .*viewplane.*"),
                                      ("missing.xml", "a.exr", r".*missing\.xml.*No such file.*"),
                                      ("scene.xml", "missing/a.exr", r"cannot write missing/a\.exr.*")]:
            done = self.run_program(scene, "-o", output, "--progress=openjd")
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stdout, rf"(?m)^openjd_fail: {reason}$")
            self.assertIn("error: ", done.stderr)
            done = self.run_program(scene, "-o", output, "--progress=json")
            last = json.loads(done.stdout.splitlines()[-1])
            self.assertEqual(last["event"], "failure")
            self.assertRegex(last["text"], rf"^{reason}$")
            self.assertNotIn("fail", self.run_program(scene, "-o", output, "--progress=alf").stdout)

    def test_a_file_name_begins_no_line(self):
        name = "a\nopenjd_env: PATH=x.exr"
        done = self.succeed("scene.xml", "-o", name, "--progress=openjd")
        self.assertIn("openjd_status: wrote a openjd_env: PATH=x.exr\n", done.stdout)
        self.assertNotRegex(done.stdout, r"(?m)^openjd_env")

    def test_each_line_comes_at_once(self):
        process = self.start_program("scene.xml", "-o", "a.exr", "--progress=openjd", *support.ENDLESS)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.stderr.close)
        seen = ""
        while "openjd_progress: " not in seen:
            line = process.stdout.readline()
            self.assertTrue(line, "the program ended without a line of progress")
            seen += line
        self.assertIsNone(process.poll())
        process.kill()
        process.wait()

    def test_a_reader_that_goes_away_does_not_stop_the_run(self):
        reader, writer = os.pipe()
        os.close(reader)
        with os.fdopen(writer, "w") as gone:
            done = subprocess.run([support.PROGRAM, "scene.xml", "-o", "a.exr", "--progress=openjd"], cwd=self.folder,
                                  stdout=gone, stderr=subprocess.PIPE, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        self.assertEqual(self.names(), ["a.exr", "scene.xml"])


class LogFile(CommandTest):
    TIME = r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ "

    def log(self):
        return self.read("run.log").decode()

    def test_messages_with_their_times(self):
        done = self.succeed("scene.xml", "-v", "-o", "a.exr", "--stats", "--progress=plain", "--log-file", "run.log")
        for line in self.log().splitlines():
            self.assertRegex(line, f"^{self.TIME}")
        logged = re.sub(f"(?m)^{self.TIME}", "", self.log())
        shown = re.sub(r"(?m)^raytrace: rendered \d+ %.*\n", "", done.stderr)
        self.assertEqual(logged, shown)
        self.assertIn("raytrace: wrote a.exr\n", logged)

    def test_it_is_added_to(self):
        self.write("run.log", "before\n")
        self.write("bad.xml", "<raytracer/>")
        self.fail_with(1, "bad.xml", "-o", "a.exr", "--log-file", "run.log")
        self.fail_with(1, "missing.xml", "-o", "a.exr", "--log-file=run.log")
        self.assertTrue(self.log().startswith("before\n"))
        self.assertRegex(self.log(), rf"(?m)^{self.TIME}bad\.xml:1:1: error: ")
        self.assertRegex(self.log(), rf"(?m)^{self.TIME}missing\.xml: error: ")

    def test_one_that_cannot_be_written(self):
        message = self.fail_with(1, "scene.xml", "-o", "a.exr", *support.ENDLESS, "--log-file", "missing/run.log",
                                 timeout=60)
        self.assertIn("cannot write the log file missing/run.log: No such file or directory", message)

    def test_a_full_disk_does_not_stop_the_run(self):
        done = self.succeed("scene.xml", "-v", "-o", "a.exr", "--progress=none", "--log-file", "/dev/full")
        warning = "raytrace: warning: /dev/full takes no more: No space left on device\n"
        self.assertEqual(done.stderr.count(warning), 1)
        self.assertIn("wrote a.exr", done.stderr)


class Signals(CommandTest):
    def wait_until(self, condition, process):
        while not condition():
            if process.poll() is not None:
                self.fail(f"the program ended with {process.returncode}: {process.stderr.read()}")
            time.sleep(0.001)

    def rendering(self, *arguments, **keywords):
        """A process that is in its render, as its handlers tell."""
        process = self.start_program("scene.xml", "-q", "-o", "a.exr", *arguments, **keywords)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.stderr.close)
        self.wait_until(lambda: support.catches(process, signal.SIGTERM), process)
        return process

    def test_first_signal_stops(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            process = self.rendering(*support.ENDLESS)
            process.send_signal(number)
            self.assertEqual(process.wait(timeout=300), 128 + number)
            self.assertEqual(self.names(), ["a.exr", "scene.xml"])

    def test_second_signal_ends_at_once(self):
        # So many lights on the floor that a stop, which is looked for every few samples, takes a while.
        light = '<pointlight><location x="4" y="6" z="4"/></pointlight>'
        self.write("scene.xml", support.SCENE.replace("</pointlights>", 200000 * light + "</pointlights>"))
        process = self.rendering("-s", "20000", "--crop", "0,50,80,60")
        before = support.processor_seconds(process)  # handlers come before rays
        self.wait_until(lambda: support.processor_seconds(process) > before + 0.5, process)
        process.send_signal(signal.SIGINT)
        self.wait_until(lambda: not support.catches(process, signal.SIGTERM), process)
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(timeout=300), -signal.SIGTERM)
        # A sanitizer may run the first signal's handler so late that the picture was being written by then.
        self.assertEqual([name for name in self.names() if not name.startswith(".raytrace-")], ["scene.xml"])

    def test_ignored_signals_stay_ignored(self):
        process = self.rendering(*support.ENDLESS, preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_IGN))
        process.send_signal(signal.SIGINT)
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(timeout=300), 128 + signal.SIGTERM)


if __name__ == "__main__":
    unittest.main()
