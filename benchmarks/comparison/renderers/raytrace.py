"""raytrace itself."""

import json
import os
import subprocess

from ..paths import PROGRAM
from ..process import Times, run
from ..scenes import BACKGROUND, EYE, FLOOR, LOOKAT, VIEW_HEIGHT, Cylinder, Sphere, Torus, Triangle

NAME = "raytrace"
COMMAND = "raytrace scene.xml -q -t THREADS -o picture.exr --stats=stats.json"
NOTE = "Render only: `seconds.render` of `--stats`."


def available():
    return None if os.path.exists(PROGRAM) else f"{PROGRAM} is not built"


def version():
    text = subprocess.run([PROGRAM, "--version"], capture_output=True, text=True, check=True).stdout
    return ", ".join(line.strip() for line in text.splitlines() if line.strip())


def can(scene):
    return True


def _vector(name, v):
    return f'<{name} x="{v[0]:.9g}" y="{v[1]:.9g}" z="{v[2]:.9g}"/>'


def _color(name, c):
    return f'<{name} red="{c[0]:.9g}" green="{c[1]:.9g}" blue="{c[2]:.9g}"/>'


def write(scene, folder):
    with open(os.path.join(folder, "scene.xml"), "w", encoding="utf-8") as file:
        say = file.write
        say(f"<raytracer>\n<!-- {scene.title} -->\n")
        say(
            f"<viewplane><hres>{scene.width}</hres><vres>{scene.height}</vres><pixelsize>1</pixelsize>"
            f"<samples>{scene.samples}</samples>{_color('background', BACKGROUND)}</viewplane>\n"
        )
        distance = f"<viewdistance>{scene.height / VIEW_HEIGHT:.9g}</viewdistance>"
        say(f"<camera>{_vector('eye', EYE)}{_vector('lookat', LOOKAT)}{distance}</camera>\n<lights><pointlights>\n")
        for light in scene.lights:
            radiance = f"<scaleradiance>{light.radiance:.9g}</scaleradiance>"
            say(f"<pointlight>{_vector('location', light.location)}{radiance}</pointlight>\n")
        say("</pointlights></lights>\n<materials><mattes>\n")
        for index, color in enumerate(scene.materials):
            say(f"<matte><name>m{index}</name><ka>0</ka><kd>1</kd>{_color('cd', color)}</matte>\n")
        say("</mattes></materials>\n<objects>\n<planes>\n")
        point, normal = FLOOR
        material = _material(len(scene.materials) - 1)
        say(f"<plane>{_vector('point', point)}{_vector('normal', normal)}{material}</plane>\n")
        say("</planes>\n<spheres>\n")
        for s in scene.of(Sphere):
            shape = f"{_vector('center', s.center)}<radius>{s.radius:.9g}</radius>"
            say(f"<sphere>{shape}{_material(s.material)}</sphere>\n")
        say("</spheres>\n<cylinders>\n")
        for c in scene.of(Cylinder):
            shape = f"{_vector('bottom', c.bottom)}{_vector('top', c.top)}<radius>{c.radius:.9g}</radius>"
            say(f"<cylinder>{shape}{_material(c.material)}</cylinder>\n")
        say("</cylinders>\n<toruses>\n")
        for t in scene.of(Torus):
            radii = f"<sweptradius>{t.swept_radius:.9g}</sweptradius><tuberadius>{t.tube_radius:.9g}</tuberadius>"
            place = _vector("center", t.center) + _vector("axis", t.axis)
            say(f"<torus>{place}{radii}{_material(t.material)}</torus>\n")
        say("</toruses>\n<triangles>\n")
        for t in scene.of(Triangle):
            corners = "".join(_vector(f"vertexposition{i}", v) for i, v in enumerate(t.corners, 1))
            say(f"<triangle>{corners}{_material(t.material)}</triangle>\n")
        say("</triangles>\n</objects>\n</raytracer>\n")


def _material(index):
    return f"<material>m{index}</material>"


def render(folder, threads, limit):
    command = [PROGRAM, "scene.xml", "-q", "-t", threads, "-o", "picture.exr", "--stats=stats.json"]
    _, whole, processors = run(command, folder, limit)
    with open(os.path.join(folder, "stats.json"), encoding="utf-8") as file:
        return Times(json.load(file)["seconds"]["render"], whole, processors)


def picture(scene, folder, limit):
    from ..pictures import read_exr

    run([PROGRAM, "scene.xml", "-q", "-s", 1, "-o", "check.exr"], folder, limit)
    return read_exr(os.path.join(folder, "check.exr"))
