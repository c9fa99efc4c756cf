"""Mitsuba 3, the variant llvm_ad_rgb. mitsuba_render.py runs it."""

import glob
import importlib.metadata
import importlib.util
import math
import os
import re
import struct
import sys

from ..paths import REPOSITORY
from ..process import Times, run
from ..scenes import BACKGROUND, EYE, FLOOR, LOOKAT, VIEW_HEIGHT, Cylinder, Sphere, Torus, Triangle

NAME = "Mitsuba 3"
VARIANT = "llvm_ad_rgb"
COMMAND = "python -m comparison.mitsuba_render scene.xml picture.exr THREADS"
NOTE = (
    "Variant `llvm_ad_rgb`, integrator `direct` with as many emitter samples as there are lights, box filter."
    " Render only is its steady state: the median of renders after the first in one process, which compiles."
    " The whole process finds the compiled code in Dr.Jit's cache on disk, from the run before."
    " Dr.Jit, which it runs on, counts the main thread, and alone that one waits for ever when the picture is written:"
    " so 1 thread is two that are bound to one processor, which render as fast as the main thread alone."
    " Its `mitsuba` command is not used, since it hangs in the same way."
    " Its lights fall off with the square of the distance."
    " The floor is a rectangle of 40,000 x 40,000, as far as single precision allows."
    " Triangles are in meshes, one for each material, and rays may slip through their edges: it does not ask Embree for"
    " its robust mode, as raytrace does."
    " Spheres are its `sphere`, a shape for each; its `ellipsoids`, many in one shape, render 1,000 in 0.75 of the time"
    " and 100,000 in 0.05, but holes appear in small ones, and the pictures do not agree. It has no torus."
)
FLOOR_SIZE = 2e4
LIBRARIES = ("/usr/lib/llvm-{0}/lib/libLLVM*.so*", "/usr/lib/*/libLLVM-{0}.so*", "/usr/lib*/libLLVM-{0}.so*")


def llvm_library():
    """Of the versions that Dr.Jit is known to work with."""
    given = os.environ.get("DRJIT_LIBLLVM_PATH")
    if given:
        return given
    for number in (16, 19):
        for pattern in LIBRARIES:
            for path in sorted(glob.glob(pattern.format(number))):
                return path
    return None


def available():
    if importlib.util.find_spec("mitsuba") is None:
        return "the Python package mitsuba is not installed"
    return None if llvm_library() else "there is no libLLVM 16 or 19"


def version():
    name = os.path.basename(os.path.realpath(llvm_library()))
    return f"Mitsuba {importlib.metadata.version('mitsuba')}, {re.sub(r'^lib|[.]so', '', name)}"


def can(scene):
    return Torus not in scene.shapes()


def shares_shading(scene):
    """Of several lights it takes a random one for each shadow ray, so that single samples differ."""
    return len(scene.lights) == 1


def _vector(v):
    return ",".join(f"{x:.9g}" for x in v)


def _point(name, v):
    return f'<point name="{name}" x="{v[0]:.9g}" y="{v[1]:.9g}" z="{v[2]:.9g}"/>'


def write(scene, folder):
    with open(os.path.join(folder, "scene.xml"), "w", encoding="utf-8") as file:
        say = file.write
        say(f'<!-- {scene.title} -->\n<scene version="3.0.0">\n<integrator type="direct">')
        say(f'<integer name="emitter_samples" value="{len(scene.lights)}"/>')
        say('<integer name="bsdf_samples" value="0"/></integrator>\n')
        say(_sensor(scene))
        for light in scene.lights:
            # Its intensity at the origin is that of a light without fall-off.
            intensity = light.radiance * sum(x * x for x in light.location)
            say(f'<emitter type="point">{_point("position", light.location)}')
            say(f'<rgb name="intensity" value="{intensity:.9g}"/></emitter>\n')
        for index, color in enumerate(scene.materials):
            reflectance = f'<rgb name="reflectance" value="{_vector(color)}"/>'
            say(f'<bsdf type="twosided" id="m{index}"><bsdf type="diffuse">{reflectance}</bsdf></bsdf>\n')
        floor = FLOOR[0][1]
        say(f'<shape type="rectangle"><transform name="to_world"><scale value="{FLOOR_SIZE:g}"/>')
        say(f'<rotate x="1" angle="-90"/><translate y="{floor:.9g}"/></transform>')
        say(f'<ref id="m{len(scene.materials) - 1}"/></shape>\n')
        for s in scene.of(Sphere):
            say(f'<shape type="sphere">{_point("center", s.center)}')
            say(f'<float name="radius" value="{s.radius:.9g}"/><ref id="m{s.material}"/></shape>\n')
        for c in scene.of(Cylinder):
            say(f'<shape type="cylinder">{_point("p0", c.bottom)}{_point("p1", c.top)}')
            say(f'<float name="radius" value="{c.radius:.9g}"/><ref id="m{c.material}"/></shape>\n')
        _write_meshes(scene, folder, say)
        say("</scene>\n")


def _sensor(scene):
    angle = 2 * math.degrees(math.atan(VIEW_HEIGHT / 2))
    view = f'origin="{_vector(EYE)}" target="{_vector(LOOKAT)}" up="0,1,0"'
    return (
        f'<sensor type="perspective"><string name="fov_axis" value="y"/><float name="fov" value="{angle:.12g}"/>'
        f'<float name="far_clip" value="1e6"/><transform name="to_world"><lookat {view}/></transform>\n'
        f'<sampler type="independent"><integer name="sample_count" value="{scene.samples}"/></sampler>\n'
        f'<film type="hdrfilm"><integer name="width" value="{scene.width}"/>'
        f'<integer name="height" value="{scene.height}"/><rfilter type="box"/></film></sensor>\n'
    )


def _write_meshes(scene, folder, say):
    meshes = {}
    for triangle in scene.of(Triangle):
        meshes.setdefault(triangle.material, []).append(triangle)
    for material, triangles in sorted(meshes.items()):
        name = f"triangles-{material}.ply"
        with open(os.path.join(folder, name), "wb") as file:
            header = (
                "ply\nformat binary_little_endian 1.0\n"
                f"element vertex {3 * len(triangles)}\nproperty float x\nproperty float y\nproperty float z\n"
                f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
            )
            file.write(header.encode())
            for triangle in triangles:
                for corner in triangle.corners:
                    file.write(struct.pack("<3f", *corner))
            for i in range(len(triangles)):
                file.write(struct.pack("<B3i", 3, 3 * i, 3 * i + 1, 3 * i + 2))
        say(f'<shape type="ply"><string name="filename" value="{name}"/><boolean name="face_normals" value="true"/>')
        say(f'<ref id="m{material}"/></shape>\n')


def _run(folder, limit, *arguments):
    environment = {"DRJIT_LIBLLVM_PATH": llvm_library(), "PYTHONPATH": os.path.join(REPOSITORY, "benchmarks")}
    return run([sys.executable, "-m", "comparison.mitsuba_render", *arguments], folder, limit, environment)


def render(folder, threads, limit):
    _, whole, processors = _run(folder, limit, "scene.xml", "picture.exr", threads)
    text, _, _ = _run(folder, limit, "scene.xml", "steady", threads)
    return Times(float(text.split()[-1]), whole, processors)


def picture(scene, folder, limit):
    import numpy

    _run(folder, limit, "scene.xml", "check.npz", os.cpu_count())
    with numpy.load(os.path.join(folder, "check.npz")) as saved:
        color, alpha, position = saved["color"], saved["alpha"], saved["position"]
    if len(scene.lights) == 1:
        # Without the light's fall-off.
        location = numpy.array(scene.lights[0].location)
        color *= (numpy.square(position - location).sum(axis=2) / numpy.square(location).sum())[..., None]
    color[alpha == 0] = BACKGROUND
    return color
