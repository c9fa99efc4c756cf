"""Runs the program as a user does, and reads what it writes."""

import os
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["RAYTRACE_PROGRAM"]
MAN_PAGE = os.environ["RAYTRACE_MAN_PAGE"]
LONG = bool(os.environ.get("RAYTRACE_LONG_TESTS"))  # docs/testing.md
SANITIZERS = os.environ.get("RAYTRACE_SANITIZERS", "")
REPOSITORY = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

# Two shapes, both materials, every kind of light, and edges for which samples matter.
SCENE = """<raytracer>
  <viewplane>
    <hres>80</hres> <vres>60</vres> <pixelsize>1</pixelsize> <samples>4</samples>
    <background red="0.1" green="0.2" blue="0.4"/>
  </viewplane>
  <camera>
    <eye x="0" y="3" z="8"/> <lookat x="0" y="0.5" z="0"/> <viewdistance>80</viewdistance>
  </camera>
  <lights>
    <ambientlight><scaleradiance>0.5</scaleradiance></ambientlight>
    <pointlights><pointlight><location x="4" y="6" z="4"/><scaleradiance>2</scaleradiance></pointlight></pointlights>
    <directionallights>
      <directionallight><direction x="-1" y="1" z="1"/><color red="1" green="0.5" blue="0.25"/></directionallight>
    </directionallights>
  </lights>
  <materials>
    <mattes><matte><name>floor</name><ka>0.5</ka><kd>0.6</kd><cd red="0.8" green="0.8" blue="0.8"/></matte></mattes>
    <phongs>
      <phong>
        <name>shiny</name><ka>0.3</ka><kd>0.6</kd><ks>0.3</ks>
        <cd red="0.9" green="0.2" blue="0.1"/><cs red="1" green="1" blue="1"/><exp>30</exp>
      </phong>
    </phongs>
  </materials>
  <objects>
    <planes><plane><point x="0" y="0" z="0"/><normal x="0" y="1" z="0"/><material>floor</material></plane></planes>
    <spheres><sphere><center x="0" y="1" z="0"/><radius>1</radius><material>shiny</material></sphere></spheres>
  </objects>
</raytracer>
"""

# So many rays that nobody waits for the end, and yet a tile is done in a moment.
ENDLESS = ["-r", "800x800", "-s", "1000" if SANITIZERS else "100000"]


def samples(count):
    """For -s of a render that must only take a while; fewer with a sanitizer, which makes each take as much longer."""
    return str(max(count // 40, 8) if SANITIZERS else count)


def catches(process, number):
    """Whether a process has a handler for the signal now."""
    with open(f"/proc/{process.pid}/status", encoding="ascii") as file:
        caught = next(line.split()[1] for line in file if line.startswith("SigCgt:"))
    return int(caught, 16) >> (number - 1) & 1 == 1


def processor_seconds(process):
    """What a process has computed so far: what it has come to on a busy machine, unlike the time that has passed."""
    with open(f"/proc/{process.pid}/stat", encoding="ascii") as file:
        fields = file.read().rsplit(")", 1)[1].split()  # from the third, its state
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


class CommandTest(unittest.TestCase):
    """Each test has a folder of its own with scene.xml in it, and runs the program there."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="raytrace-command-")
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.write("scene.xml", SCENE)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)

    def read(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def names(self):
        return sorted(os.listdir(self.folder))

    def run_program(self, *arguments, **keywords):
        keywords.setdefault("stdin", subprocess.DEVNULL)
        if "input" in keywords:
            del keywords["stdin"]
        return subprocess.run([PROGRAM, *arguments], cwd=self.folder, text=True, capture_output=True, check=False,
                              **keywords)

    def start_program(self, *arguments, **keywords):
        return subprocess.Popen([PROGRAM, *arguments], cwd=self.folder, text=True, stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, **keywords)

    def succeed(self, *arguments, **keywords):
        done = self.run_program(*arguments, **keywords)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def fail_with(self, code, *arguments, **keywords):
        """Runs the program, which must end with this code and an error message; returns the message."""
        done = self.run_program(*arguments, **keywords)
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertEqual(done.stdout, "")
        self.assertIn("error: ", done.stderr)
        return done.stderr
