"""LuxCore, its path tracer on processors, with paths from the lights where the scene has caustics. luxcore_worker.py runs
it. It has no spheres, and its rough metals are of another distribution."""

import importlib.util

from .files import rendered_by, write_pickle
from .scenes import Metal, Sphere

VARIANTS = {"LuxCore": "luxcore"}


def available():
    return None if importlib.util.find_spec("pyluxcore") else "the Python package pyluxcore is not installed"


def can(scene):
    rough = any(isinstance(material, Metal) and material.roughness > 0 for material in scene.materials.values())
    return not (rough or scene.of(Sphere) or scene.sky)


def write(scene, folder, chosen):
    write_pickle(scene, folder, chosen)


def renders(variant, folder, chosen):
    return rendered_by("luxcore_worker", ["scene.pickle", str(chosen.threads)], folder, {})
