"""What the shells offer when a person types a command line and the tab key. bash and, where it is installed, fish complete
really; zsh at least reads its file."""

import os
import shlex
import shutil
import subprocess
import unittest

import support
from support import CommandTest

SHARE = os.path.dirname(os.path.dirname(os.path.dirname(support.MAN_PAGE)))
BASH = os.path.join(SHARE, "bash-completion", "completions", "raytrace")
ZSH = os.path.join(SHARE, "zsh", "site-functions", "_raytrace")
FISH = os.path.join(SHARE, "fish", "vendor_completions.d", "raytrace.fish")


def shell(*command, folder):
    done = subprocess.run(command, cwd=folder, text=True, capture_output=True, check=False, stdin=subprocess.DEVNULL,
                          env=dict(os.environ, HOME=folder, XDG_CONFIG_HOME=folder, XDG_DATA_HOME=folder))
    if done.returncode != 0 or done.stderr:
        raise AssertionError(f"{command}: {done.returncode}\n{done.stderr}")
    return done.stdout.splitlines()


class Completion(CommandTest):
    def setUp(self):
        super().setUp()
        self.write("two words.exr", "")
        os.mkdir(self.path("pictures"))
        self.help = self.succeed("--help").stdout

    def isas(self):
        return self.help.split("Instruction set: ")[1].split(" (")[0].replace("\n", "").replace(",", "").split()

    def bash(self, *words):
        """words: as readline cuts the line, the last one up to the cursor."""
        line = " ".join(map(shlex.quote, ("raytrace", *words)))
        script = (f"source {shlex.quote(BASH)}; COMP_WORDS=({line}); COMP_CWORD={len(words)}; _raytrace; "
                  "((${#COMPREPLY[@]})) && printf '%s\\n' \"${COMPREPLY[@]}\"; complete -p raytrace > /dev/null")
        return sorted(shell("bash", "--norc", "-c", script, folder=self.folder))

    def test_bash_offers_all_options(self):
        for command in ([], ["merge"]):
            text = self.succeed(*command, "--help").stdout
            options = sorted({word.split("[")[0].rstrip(",") for line in text.splitlines() if line.startswith("  -")
                              for word in line.split("   ")[0].split() if word.startswith("--")})
            self.assertGreater(len(options), 7)
            self.assertEqual(self.bash(*command, "--"), options)
        self.assertEqual(self.bash("scene.xml", "--check"), ["--checkpoint", "--checkpoint-interval"])

    def test_bash_offers_values(self):
        self.assertEqual(self.bash("--list", ""), ["aovs", "cameras", "integrators", "lights", "materials", "shapes", "textures"])
        self.assertEqual(self.bash("--progress", "=", "p"), ["plain"])
        self.assertEqual(self.bash("--progress", "="), ["alf", "auto", "bar", "json", "none", "openjd", "plain"])
        self.assertEqual(self.bash("--isa", ""), sorted(self.isas()))
        self.assertEqual(self.bash("--aov", "dep"), ["depth"])
        self.assertEqual(self.bash("--aov", "depth,no"), ["depth,normal"])
        self.assertEqual(self.bash("merge", "--bit-depth", "="), ["16", "8"])
        self.assertEqual(self.bash("--frames", ""), [])

    def test_bash_offers_files_and_commands(self):
        files = ["pictures", "scene.xml", "two words.exr"]
        self.assertEqual(self.bash("me"), ["merge"])
        self.assertEqual(self.bash(""), sorted([*files, "help", "merge"]))
        for words in (["scene.xml", ""], ["scene.xml", "-o", ""], ["--output", "="], ["--stats", "="], ["merge", ""],
                      ["--stats", ""]):
            self.assertEqual(self.bash(*words), files, words)
        self.assertEqual(self.bash("scene.xml", "-o", "two"), ["two words.exr"])

    @unittest.skipUnless(shutil.which("fish"), "fish is not installed")
    def test_fish(self):
        def fish(line):
            script = f"source {shlex.quote(FISH)}; complete -C {shlex.quote('raytrace ' + line)}"
            return [found.split("\t")[0] for found in shell("fish", "--no-config", "-c", script, folder=self.folder)]

        self.assertIn("merge", fish("me"))
        self.assertEqual(fish("--isa "), sorted(self.isas()))
        self.assertEqual(fish("--progress=p"), ["--progress=plain"])
        self.assertIn("--sample-offset", fish("scene.xml --sam"))
        self.assertEqual(fish("merge --par"), ["--partial"])
        self.assertEqual(fish("scene.xml -o pic"), ["pictures/"])
        self.assertNotIn("scene.xml", fish("--list sc"))

    @unittest.skipUnless(shutil.which("zsh"), "zsh is not installed")
    def test_zsh_reads_its_file(self):
        self.assertEqual(shell("zsh", "-f", "-n", ZSH, folder=self.folder), [])
        # _arguments, in place of that of zsh, shows what it was given.
        script = (f"_arguments() {{ print -rl -- $@ }}; words=(raytrace scene.xml); CURRENT=2; source {shlex.quote(ZSH)}")
        given = shell("zsh", "-f", "-c", script, folder=self.folder)
        for part in ("*--isa=[Instruction set]:NAME:(" + " ".join(self.isas()) + ")", "*--display-server=",
                     ":HOST\\:PORT:", "*--stats=-[", "::FILE.json:_files"):
            self.assertTrue(any(part in line for line in given), part)


if __name__ == "__main__":
    unittest.main()
