"""Tachyon, John Stone's parallel ray tracer."""

import math
import os
import re
import shutil
import subprocess

from ..process import Times, run
from ..scenes import BACKGROUND, EYE, FLOOR, LOOKAT, VIEW_HEIGHT, Cylinder, Sphere, Torus, Triangle

NAME = "Tachyon"
EXECUTABLE = "tachyon"
COMMAND = "tachyon scene.dat -numthreads THREADS -format PNG -o picture.png"
NOTE = (
    "Render only: the `Ray Tracing Time` that it prints. The first sample of a pixel is its centre, the others are"
    " random. It has no torus."
)


def available():
    return None if shutil.which(EXECUTABLE) else "tachyon is not installed"


def version():
    text = subprocess.run([EXECUTABLE, "-version"], capture_output=True, text=True, check=False).stdout
    return f"Tachyon {text.strip()}"


def can(scene):
    return Torus not in scene.shapes()


def _vector(v):
    return " ".join(f"{x:.9g}" for x in v)


def write(scene, folder):
    with open(os.path.join(folder, "scene.dat"), "w", encoding="utf-8") as file:
        say = file.write
        say(f"BEGIN_SCENE\nRESOLUTION {scene.width} {scene.height}\n")
        say(_camera(scene))
        say(f"BACKGROUND {_vector(BACKGROUND)}\n")
        for light in scene.lights:
            color = _vector([light.radiance / math.pi] * 3)
            say(f"LIGHT CENTER {_vector(light.location)} RAD 0 COLOR {color}\n")
        for index, color in enumerate(scene.materials):
            say(f"TEXDEF m{index} AMBIENT 0 DIFFUSE 1 SPECULAR 0 OPACITY 1 COLOR {_vector(color)} TEXFUNC 0\n")
        point, normal = FLOOR
        say(f"PLANE CENTER {_vector(point)} NORMAL {_vector(normal)} m{len(scene.materials) - 1}\n")
        for s in scene.of(Sphere):
            say(f"SPHERE CENTER {_vector(s.center)} RAD {s.radius:.9g} m{s.material}\n")
        for c in scene.of(Cylinder):
            ends = f"BASE {_vector(c.bottom)} APEX {_vector(c.top)}"
            say(f"FCYLINDER {ends} RAD {c.radius:.9g} m{c.material}\n")
        for t in scene.of(Triangle):
            corners = " ".join(f"V{i} {_vector(v)}" for i, v in enumerate(t.corners))
            say(f"TRI {corners} m{t.material}\n")
        say("END_SCENE\n")


def _camera(scene):
    view = tuple(a - b for a, b in zip(LOOKAT, EYE))
    length = math.sqrt(sum(x * x for x in view))
    view = tuple(x / length for x in view)
    # The frustum is that of the whole view at distance 1, half a pixel to the left and down, since Tachyon counts
    # pixels from 1 and takes the number for the pixel's place. Left is right, since its coordinates are left-handed.
    pixel = VIEW_HEIGHT / scene.height
    right = (scene.width / 2 - 0.5) * pixel
    left = (-scene.width / 2 - 0.5) * pixel
    top = (scene.height / 2 - 0.5) * pixel
    bottom = (-scene.height / 2 - 0.5) * pixel
    return (
        f"CAMERA ZOOM 1 ASPECTRATIO 1 ANTIALIASING {scene.samples - 1} RAYDEPTH 1\n"
        f"CENTER {_vector(EYE)} VIEWDIR {_vector(view)} UPDIR 0 1 0\n"
        f"FRUSTUM {-left:.12g} {-right:.12g} {bottom:.12g} {top:.12g}\nEND_CAMERA\n"
    )


def render(folder, threads, limit):
    command = [EXECUTABLE, "scene.dat", "-numthreads", threads, "-format", "PNG", "-o", "picture.png"]
    text, whole, processors = run(command, folder, limit)
    return Times(float(re.search(r"Ray Tracing Time:\s*([\d.]+) seconds", text).group(1)), whole, processors)


def picture(scene, folder, limit):
    from ..pictures import read_ppm48

    run([EXECUTABLE, "scene.dat", "-aasamples", 0, "-format", "PPM48", "-o", "check.ppm"], folder, limit)
    return read_ppm48(os.path.join(folder, "check.ppm"))
