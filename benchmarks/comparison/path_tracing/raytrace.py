"""raytrace itself."""

import json
import os

from ..paths import PROGRAM
from ..pictures import read_exr
from ..process import run
from .files import write_ply, write_sky, write_texture
from .scenes import WIDTH, Diffuse, Glass, Lamp, Mesh, Metal, Rectangle, Sphere, Textured

LIMIT = 3600  # seconds for one render


def available():
    return None if os.path.exists(PROGRAM) else f"{PROGRAM} is not built"


def variants(scene):
    """With its defaults, and with what its documents advise for what the scene's noise is mostly of."""
    tuned = {"raytrace, tuned": "tuned.xml"} if scene.focused or scene.bounced else {}
    return {"raytrace": "scene.xml"} | tuned


def _vector(name, v):
    return f'<{name} x="{v[0]:.9g}" y="{v[1]:.9g}" z="{v[2]:.9g}"/>'


def _color(name, c):
    return f'<{name} red="{c[0]:.9g}" green="{c[1]:.9g}" blue="{c[2]:.9g}"/>'


def _material(name, material):
    name = f"<name>{name}</name>"
    match material:
        case Diffuse():
            return f"<mattes><matte>{name}<ka>0</ka><kd>1</kd>{_color('cd', material.color)}</matte></mattes>"
        case Textured():
            return f'<mattes><matte>{name}<ka>0</ka><kd>1</kd><cd texture="texture"/></matte></mattes>'
        case Metal():
            roughness = f"<roughness>{material.roughness:.9g}</roughness>"
            return f"<conductors><conductor>{name}{_color('cr', material.color)}{roughness}</conductor></conductors>"
        case Glass():
            return f"<dielectrics><dielectric>{name}<ior>{material.ior:.9g}</ior></dielectric></dielectrics>"
        case Lamp():
            return f"<emissives><emissive>{name}{_color('ce', material.radiance)}</emissive></emissives>"


def write(scene, folder, chosen):
    # A depth here is a scattering: one less than the segments of a path, which the others count.
    depth = f"<maxdepth>{chosen.depth - 1}</maxdepth>"
    _write(scene, folder, chosen, "scene.xml", depth + ("<caustics>light</caustics>" if scene.caustics else ""))
    photons = "<caustics>photons</caustics>" if scene.focused else ""
    branches = "<indirectsamples>4</indirectsamples>" if scene.bounced else ""
    _write(scene, folder, chosen, "tuned.xml", depth + photons + branches)


def _write(scene, folder, chosen, name, settings):
    with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
        say = file.write
        say(f"<raytracer>\n<!-- {scene.title} -->\n<viewplane><hres>{WIDTH}</hres><vres>{WIDTH}</vres>")
        say(f"<samples>{chosen.samples}</samples></viewplane>\n<camera>{_vector('eye', scene.eye)}")
        say(f"{_vector('lookat', scene.lookat)}<fov>{scene.fov:.9g}</fov></camera>\n")
        say(f"<integrator><path>{settings}</path></integrator>\n<lights>")
        if scene.sky:
            say("<environmentlights><environmentlight><file>sky.exr</file></environmentlight></environmentlights>")
            write_sky(folder, lambda row, height: (row + 0.5) / height)
        say("</lights>\n")
        if scene.is_textured():
            say("<textures><images><image><name>texture</name><file>texture.exr</file></image></images></textures>\n")
            write_texture(folder)
        say("<materials>\n")
        for name, material in scene.materials.items():
            say(f"{_material(name, material)}\n")
        say("</materials>\n<objects>\n<rectangles>\n")
        for r in scene.of(Rectangle):
            shape = _vector("corner", r.corner) + _vector("edge1", r.edge1) + _vector("edge2", r.edge2)
            say(f"<rectangle>{shape}<material>{r.material}</material></rectangle>\n")
        say("</rectangles>\n<spheres>\n")
        for s in scene.of(Sphere):
            shape = f"{_vector('center', s.center)}<radius>{s.radius:.9g}</radius>"
            say(f"<sphere>{shape}<material>{s.material}</material></sphere>\n")
        say("</spheres>\n<meshes>\n")
        for number, mesh in enumerate(scene.of(Mesh)):
            write_ply(mesh, folder, f"{number}.ply")
            say(f"<mesh><file>{number}.ply</file><material>{mesh.material}</material></mesh>\n")
        say("</meshes>\n</objects>\n</raytracer>\n")


def renders(scene_file, folder, chosen):
    """Yields (seconds, picture), without end."""
    for seed in range(1, 1 << 30):
        command = [PROGRAM, scene_file, "-q", "-t", chosen.threads, "--float", "-o", "picture.exr", "--stats=stats.json"]
        run([*command, "--seed", seed], folder, LIMIT)
        with open(os.path.join(folder, "stats.json"), encoding="utf-8") as file:
            seconds = json.load(file)["seconds"]["render"]
        yield seconds, read_exr(os.path.join(folder, "picture.exr"))
