"""Every command with a picture that README.md and docs/ show does what it is shown for: it is run as it stands there, in a
folder that has the files which it names. Pictures are small and have few samples."""

import base64
import glob
import json
import os
import re
import struct
import subprocess
import unittest

import support
import test_densities
from support import SCENE, CommandTest

# Of the pages that show commands, and what they take for granted: scenes, models, and pieces to merge.
PAGES = ["README.md", *sorted(os.path.relpath(page, support.REPOSITORY)
                              for page in glob.glob(os.path.join(support.REPOSITORY, "docs", "*.md")))]
SCENES = ["first.xml", "scene.xml", "second.xml", "shot.0010.xml", "shot.0015.xml", "shot.0020.xml", "turntable.xml"]
MODELS = ["chair.glb", "fox.glb", "model.glb", "monkey.glb", "scene.glb"]
# A triangle in Collada.
DAE = """<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><up_axis>Y_UP</up_axis></asset>
  <library_geometries><geometry id="g"><mesh>
    <source id="p"><float_array id="a" count="9">0 0 0 1 0 0 0 1 0</float_array><technique_common>
      <accessor source="#a" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
      <param name="Z" type="float"/></accessor></technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="w"><node><instance_geometry url="#g"/></node></visual_scene>
  </library_visual_scenes>
  <scene><instance_visual_scene url="#w"/></scene>
</COLLADA>
"""
# What stands in the program's place: it adds a size and, unless they are said, samples.
SMALL = """#!/bin/sh
case " $* " in
  *" merge "* | *" --list "* | *" --help "* | *" --version "*) exec '{program}' "$@" ;;
  *" -s "*) exec '{program}' "$@" -r 32x18 ;;
esac
exec '{program}' "$@" -r 32x18 -s 2
"""


def shown_in(page):
    """The lines of a page's blocks of commands, and the commands with an output in its text, in their order."""
    with open(os.path.join(support.REPOSITORY, page), encoding="utf-8") as file:
        text = file.read()
    for block, code in re.findall(r"^```\n(.*?)^```$|`(raytrace [^`\n]* (?:-o|>) [^`\n]*)`", text, re.M | re.S):
        for line in (block or code).replace("\\\n", "").splitlines():
            if re.match(r"(nohup )?(build/release/bin/)?raytrace (?!SCENE)", line):
                yield line


def glb():
    """A square, which an animation moves."""
    data = struct.pack("<12f6H2f6f", -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, 0, 1, 2, 0, 2, 3, 0, 1, 0, 0, 0, 1, 0, 0)
    text = json.dumps({
        "asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "animations": [{"name": "Run", "samplers": [{"input": 2, "output": 3}],
                        "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}],
        "buffers": [{"byteLength": len(data), "uri": "data:;base64," + base64.b64encode(data).decode()}],
        "bufferViews": [{"buffer": 0, "byteOffset": offset, "byteLength": length}
                        for offset, length in ((0, 48), (48, 12), (60, 8), (68, 24))],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                      {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
                      {"bufferView": 2, "componentType": 5126, "count": 2, "type": "SCALAR"},
                      {"bufferView": 3, "componentType": 5126, "count": 2, "type": "VEC3"}]}).encode()
    text += b" " * (-len(text) % 4)
    return b"glTF" + struct.pack("<2I", 2, 20 + len(text)) + struct.pack("<I4s", len(text), b"JSON") + text


class DocumentedCommands(CommandTest):
    def setUp(self):
        super().setUp()
        for name in SCENES:
            self.write(name, SCENE.replace("<samples>4", "<samples>${samples:-4}"))
        for name in MODELS:
            with open(self.path(name), "wb") as file:
                file.write(glb())
        self.write("chair.dae", DAE)
        with open(self.path("smoke.vdb"), "wb") as file:
            file.write(test_densities.vdb())
        os.symlink(os.path.join(support.REPOSITORY, "scenes"), self.path("scenes"))
        for folder in ("bin", "pictures/pieces", "build/release/bin"):
            os.makedirs(self.path(folder))
        for place in ("bin", "build/release/bin"):
            self.write(place + "/raytrace", SMALL.format(program=support.PROGRAM))
            os.chmod(self.path(place + "/raytrace"), 0o755)
        for tile in range(4):
            self.succeed("scene.xml", "-r", "32x18", "--tile", f"{tile}/4", "-o", f"pictures/pieces/large.{tile}.0007.exr")

    def run_line(self, line):
        environment = {**os.environ, "PATH": self.path("bin") + ":" + os.environ["PATH"],
                       "RAYTRACE_DENOISER": os.environ["RAYTRACE_FAKE_DENOISER"]}
        script = line.replace("-t THREADS", "-t 2") + "\nwait"
        return subprocess.run(["bash", "-eu", "-c", script], cwd=self.folder, env=environment, text=True,
                              stdin=subprocess.DEVNULL, capture_output=True, check=False)

    def outputs(self, line):
        names = re.findall(r" (?:-o|--output|>) '?([^\s']+)", line)
        return [re.sub(r"#+|\{scene\}|%0?\d*d", "*", name) for name in names if name != "/dev/null"]

    def test_all(self):
        count = 0
        for page in PAGES:
            for line in shown_in(page):
                with self.subTest(page=page, line=line):
                    count += 1
                    for name in self.outputs(line):
                        for old in glob.glob(self.path(name)):
                            os.remove(old)
                    done = self.run_line(line)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    for name in self.outputs(line):
                        self.assertTrue(glob.glob(self.path(name)), f"there is no {name}")
        self.assertGreater(count, 30)


if __name__ == "__main__":
    unittest.main()
