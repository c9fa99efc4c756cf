"""Mitsuba 3, the variant llvm_ad_rgb, with each of two samplers. mitsuba_worker.py runs it."""

import os

import numpy

from ..renderers.mitsuba import _point, _vector, available, llvm_library  # noqa: F401
from .files import rendered_by, write_ply, write_sky, write_texture
from .scenes import WIDTH, Diffuse, Glass, Lamp, Mesh, Metal, Rectangle, Sphere, Textured

VARIANTS = {"Mitsuba, independent": "independent", "Mitsuba, multijitter": "multijitter"}


def _rgb(name, color):
    return f'<rgb name="{name}" value="{_vector(color)}"/>'


def _float(name, value):
    return f'<float name="{name}" value="{value:.9g}"/>'


def _material(name, material):
    match material:
        case Diffuse():
            bsdf = f'<bsdf type="diffuse">{_rgb("reflectance", material.color)}</bsdf>'
        case Textured():
            picture = '<string name="filename" value="texture.exr"/><boolean name="raw" value="true"/>'
            bsdf = f'<bsdf type="diffuse"><texture type="bitmap" name="reflectance">{picture}</texture></bsdf>'
        case Metal():
            rough = f'{_float("alpha", material.roughness**2)}<string name="distribution" value="ggx"/>'
            color = f'<string name="material" value="none"/>{_rgb("specular_reflectance", material.color)}'
            bsdf = f'<bsdf type="roughconductor">{color}{rough}</bsdf>'
            if material.roughness == 0:
                bsdf = f'<bsdf type="conductor">{color}</bsdf>'
        case Glass():
            indices = _float("int_ior", material.ior) + _float("ext_ior", 1)
            return f'<bsdf type="dielectric" id="{name}">{indices}</bsdf>'
        case Lamp():
            return f'<bsdf type="diffuse" id="{name}">{_rgb("reflectance", (0, 0, 0))}</bsdf>'
    return f'<bsdf type="twosided" id="{name}">{bsdf}</bsdf>'


def _surface(scene, name):
    material = scene.materials[name]
    lamp = isinstance(material, Lamp)
    emitter = f'<emitter type="area">{_rgb("radiance", material.radiance)}</emitter>' if lamp else ""
    return f'<ref id="{name}"/>{emitter}</shape>\n'


def _rectangle(r):
    """It is the square from -1 to 1, which looks to +z, under a transform."""
    a, b = numpy.array(r.edge1, float), numpy.array(r.edge2, float)
    matrix = numpy.eye(4)
    matrix[:3, 0], matrix[:3, 1], matrix[:3, 2] = a / 2, b / 2, numpy.cross(a, b) / numpy.linalg.norm(numpy.cross(a, b))
    matrix[:3, 3] = numpy.array(r.corner) + (a + b) / 2
    numbers = " ".join(f"{x:.9g}" for x in matrix.reshape(-1))
    return f'<shape type="rectangle"><transform name="to_world"><matrix value="{numbers}"/></transform>'


def write(scene, folder, chosen):
    with open(os.path.join(folder, "scene.xml"), "w", encoding="utf-8") as file:
        say = file.write
        say(f'<!-- {scene.title} -->\n<scene version="3.0.0">\n<default name="sampler" value="independent"/>\n')
        say(f'<integrator type="path"><integer name="max_depth" value="{chosen.depth}"/></integrator>\n')
        view = f'origin="{_vector(scene.eye)}" target="{_vector(scene.lookat)}" up="0,1,0"'
        say(f'<sensor type="perspective">{_float("fov", scene.fov)}{_float("near_clip", 1e-3)}{_float("far_clip", 1e4)}')
        say(f'<transform name="to_world"><lookat {view}/></transform>\n<sampler type="$sampler">')
        say(f'<integer name="sample_count" value="{chosen.samples}"/></sampler>\n<film type="hdrfilm">')
        say(f'<integer name="width" value="{WIDTH}"/><integer name="height" value="{WIDTH}"/>')
        say('<string name="component_format" value="float32"/><rfilter type="box"/></film></sensor>\n')
        if scene.sky:
            # Its outermost rows lie at the poles themselves.
            write_sky(folder, lambda row, height: row / (height - 1))
            say('<emitter type="envmap"><string name="filename" value="sky.exr"/></emitter>\n')
        if scene.is_textured():
            write_texture(folder)
        for name, material in scene.materials.items():
            say(f"{_material(name, material)}\n")
        for r in scene.of(Rectangle):
            say(_rectangle(r) + _surface(scene, r.material))
        for s in scene.of(Sphere):
            say(f'<shape type="sphere">{_point("center", s.center)}{_float("radius", s.radius)}{_surface(scene, s.material)}')
        for number, mesh in enumerate(scene.of(Mesh)):
            write_ply(mesh, folder, f"{number}.ply")
            say(f'<shape type="ply"><string name="filename" value="{number}.ply"/><boolean name="face_normals" value="true"/>')
            say(_surface(scene, mesh.material))
        say("</scene>\n")


def renders(variant, folder, chosen):
    environment = {"DRJIT_LIBLLVM_PATH": llvm_library()}
    return rendered_by("mitsuba_worker", ["scene.xml", variant, str(chosen.threads)], folder, environment)
