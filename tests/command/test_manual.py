"""--help, the man page and the document tell of the same options."""

import os
import re
import shutil
import subprocess
import unittest

import support
from support import CommandTest

OPTION = re.compile(r"(?<![\w-])(--[a-z][a-z-]*|-[a-zA-Z])(?![\w-])")


def read(*path):
    with open(os.path.join(*path), encoding="utf-8") as file:
        return file.read()


class Manual(CommandTest):
    def setUp(self):
        super().setUp()
        self.help = self.succeed("--help").stdout
        self.man_page = read(support.MAN_PAGE)

    def defined_in_help(self):
        return {name for line in self.help.splitlines() if re.match(r"  -", line)
                for name in OPTION.findall(line.split("   ")[0])}

    def test_help_is_made_for_a_terminal(self):
        for line in self.help.splitlines():
            self.assertLessEqual(len(line), 80, line)
        self.assertEqual(self.help, self.succeed("-h").stdout)
        tail = self.help[self.help.index("\nExamples:"):]
        self.assertEqual(len(re.findall(r"^  raytrace .*-o", tail, re.M)), 6)
        for code in ("0 ", "1 ", "2 ", "33 ", "75 ", "130, 143"):
            self.assertIn(f"\n  {code}", tail)

    def test_the_options_are_those_we_know(self):
        self.assertEqual(self.defined_in_help(), {
            "-o", "--output", "--float", "--denoise", "--bit-depth", "-r", "--resolution", "--fit", "--scale", "--crop", "-s", "--spp",
            "--seed", "-t", "--threads", "--isa", "-q", "--quiet", "-v", "--verbose", "--progress", "--stats",
            "--validate", "--print-scene", "--list", "--version", "-h", "--help", "--tile", "--sample-offset", "--pixel",
            "--time-limit", "--error-limit", "--checkpoint", "--checkpoint-interval", "--resume", "--log-file", "--display-server",
            "--frames", "-D", "--define", "--skip-existing", "--aov", "--transparent", "--exposure",
            "--integrator", "--clamp-indirect", "--clay", "--missing-texture", "--texture-memory", "--view", "--camera", "--animation", "--fps",
            "--variant", "--up", "--turntable", "--floor", "--environment", "--sun", "--view-transform", "--auto-exposure",
            "--white-balance",
            "--dither",
            "--ocio", "--ocio-display", "--ocio-view", "--ocio-colorspace"})

    def test_man_page_has_the_same_options(self):
        terms = re.findall(r"^\.TP\n\\fB(.*)\\fR$", self.man_page.replace(r"\-", "-"), re.M)
        defined = {name for term in terms if term.startswith("-") for name in OPTION.findall(term)}
        self.assertEqual(defined, self.defined_in_help())

    def test_man_page_has_the_same_words(self):
        plain = re.sub(r"\\f[BR]|\\&", "", self.man_page.replace(r"\-", "-"))
        words = " ".join(self.help.split())
        for line in plain.splitlines():
            if line and not line.startswith("."):
                self.assertIn(" ".join(line.split()).replace("raytrace - render", "raytrace: render"), words)

    def test_man_page_is_good_troff(self):
        if not shutil.which("groff"):
            self.skipTest("groff is not installed")
        done = subprocess.run(["groff", "-man", "-Tutf8", "-ww", "-z", support.MAN_PAGE], capture_output=True,
                              text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_document_has_every_option(self):
        document = read(support.REPOSITORY, "docs", "command-line.md")
        mentioned = set(OPTION.findall(document))
        self.assertEqual(self.defined_in_help() - mentioned, set())

    def test_document_shows_no_option_that_is_not_there(self):
        document = read(support.REPOSITORY, "docs", "command-line.md")
        defined = {name for line in document.splitlines() if line.startswith("| `-")
                   for name in OPTION.findall(line.split("|")[1])}
        self.assertEqual(defined, self.defined_in_help())


if __name__ == "__main__":
    unittest.main()
