"""POV-Ray 3.7."""

import math
import os
import re
import shutil
import subprocess

from ..process import Times, run
from ..scenes import BACKGROUND, EYE, FLOOR, LOOKAT, VIEW_HEIGHT, Cylinder, Sphere, Torus, Triangle

NAME = "POV-Ray"
COMMAND = "povray scene.ini +WTTHREADS"
MOST_SAMPLES_AN_EDGE = 9  # of a pixel; more are left out without a word
NOTE = (
    "Render only: the `Trace Time` that it prints, which is up to 0.1 s too long."
    " Its antialiasing is adaptive; threshold 0 makes it take all N x N samples of every pixel, and one more that its"
    " method needs, 17 for 16. It takes 9 x 9 of a pixel at most: 256 are 8 x 8 in each of four pixels, of a picture"
    " twice as wide and high. Triangles are in meshes, one for each material."
)


def available():
    return None if shutil.which("povray") else "povray is not installed"


def version():
    text = subprocess.run(["povray", "--version"], capture_output=True, text=True, check=False)
    return re.search(r"POV-Ray [\d.]+\d", text.stdout + text.stderr).group(0)


def can(scene):
    return True


def _vector(v):
    return f"<{v[0]:.9g},{v[1]:.9g},{v[2]:.9g}>"


def write(scene, folder):
    with open(os.path.join(folder, "scene.pov"), "w", encoding="utf-8") as file:
        say = file.write
        say(f"// {scene.title}\n#version 3.7;\nglobal_settings {{ assumed_gamma 1 }}\n")
        say(f"background {{ rgb {_vector(BACKGROUND)} }}\n")
        # right is negative, since POV-Ray's coordinates are left-handed.
        width = VIEW_HEIGHT * scene.width / scene.height
        say(f"camera {{ location {_vector(EYE)} right {-width:.9g}*x up {VIEW_HEIGHT:.9g}*y direction z")
        say(f" look_at {_vector(LOOKAT)} }}\n")
        for light in scene.lights:
            say(f"light_source {{ {_vector(light.location)} rgb {light.radiance / math.pi:.9g} }}\n")
        for index, color in enumerate(scene.materials):
            say(f"#declare M{index} = texture {{ pigment {{ rgb {_vector(color)} }}")
            say(" finish { ambient 0 diffuse 1 } }\n")
        point, normal = FLOOR
        offset = sum(a * b for a, b in zip(point, normal))
        say(f"plane {{ {_vector(normal)}, {offset:.9g} texture {{ M{len(scene.materials) - 1} }} }}\n")
        for s in scene.of(Sphere):
            say(f"sphere {{ {_vector(s.center)}, {s.radius:.9g} texture {{ M{s.material} }} }}\n")
        for c in scene.of(Cylinder):
            ends = f"{_vector(c.bottom)}, {_vector(c.top)}, {c.radius:.9g}"
            say(f"cylinder {{ {ends} open texture {{ M{c.material} }} }}\n")
        for t in scene.of(Torus):
            radii = f"{t.swept_radius:.9g}, {t.tube_radius:.9g}"
            say(f"torus {{ {radii} {_placement(t.axis, t.center)} texture {{ M{t.material} }} }}\n")
        _write_meshes(scene, say)
    _write_settings(scene, folder)


def _placement(axis, center):
    """Takes y to the axis and the origin to the centre."""
    x, y, z = axis
    side = (y, -x, 0.0) if abs(z) < 0.9 else (0.0, z, -y)
    length = math.sqrt(sum(a * a for a in side))
    u = tuple(a / length for a in side)
    w = (u[1] * z - u[2] * y, u[2] * x - u[0] * z, u[0] * y - u[1] * x)
    numbers = ",".join(f"{a:.9g}" for row in (u, axis, w, center) for a in row)
    return f"matrix <{numbers}>"


def _write_meshes(scene, say):
    meshes = {}
    for triangle in scene.of(Triangle):
        meshes.setdefault(triangle.material, []).append(triangle)
    for material, triangles in sorted(meshes.items()):
        say("mesh {\n")
        for triangle in triangles:
            say(f"triangle {{ {', '.join(map(_vector, triangle.corners))} }}\n")
        say(f"texture {{ M{material} }} }}\n")


def _sampling(scene):
    """How many pixels for each of the picture's edge, and how many samples for each of theirs."""
    pixels, samples = 1, math.isqrt(scene.samples)
    while samples > MOST_SAMPLES_AN_EDGE:
        pixels, samples = 2 * pixels, samples // 2
    return pixels, samples


def _write_settings(scene, folder):
    pixels, samples = _sampling(scene)
    settings = {
        "Input_File_Name": "scene.pov",
        "Output_File_Name": "picture.png",
        "Output_File_Type": "N",
        "Bits_Per_Color": 8,
        "Width": scene.width * pixels,
        "Height": scene.height * pixels,
        "Display": "off",
        "Antialias": "off",
    }
    if scene.samples > 1:
        settings |= {"Antialias": "on", "Sampling_Method": 1, "Antialias_Threshold": "0.0", "Jitter": "off"}
        settings |= {"Antialias_Depth": samples}
    with open(os.path.join(folder, "scene.ini"), "w", encoding="utf-8") as file:
        file.writelines(f"{key}={value}\n" for key, value in settings.items())


def render(folder, threads, limit):
    text, whole, processors = run(["povray", "scene.ini", f"+WT{threads}"], folder, limit)
    return Times(float(re.search(r"Trace Time:.*\(([\d.]+) seconds\)", text).group(1)), whole, processors)


def picture(scene, folder, limit):
    from ..pictures import read_exr

    size = [f"+W{scene.width}", f"+H{scene.height}"]
    run(["povray", "scene.ini", *size, "+Ocheck.exr", "+FE", "-A"], folder, limit)
    return read_exr(os.path.join(folder, "check.exr"))
