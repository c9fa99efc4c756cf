"""Cycles, Blender's path tracer, on processors. cycles_worker.py runs it."""

import importlib.util
import os

from .files import rendered_by, write_pickle
from .scenes import sky

VARIANTS = {"Cycles": "cycles"}


def available():
    return None if importlib.util.find_spec("bpy") else "the Python package bpy is not installed"


def write(scene, folder, chosen):
    if scene.sky:
        # Its picture has +x in the middle, where y is ahead.
        import numpy

        from .files import write_exr

        picture = sky(lambda row, height: (row + 0.5) / height)
        write_exr(numpy.roll(picture, picture.shape[1] // 4, axis=1), os.path.join(folder, "sky.exr"))
    write_pickle(scene, folder, chosen)


def renders(variant, folder, chosen):
    return rendered_by("cycles_worker", ["scene.pickle", str(chosen.threads)], folder, {})
