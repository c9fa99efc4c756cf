"""What renderers share: meshes and skies as files, and a process that renders."""

import os
import pickle
import subprocess
import sys

import numpy

from ..paths import REPOSITORY
from .scenes import sky, texture


def write_ply(mesh, folder, name):
    faces = numpy.empty(len(mesh.faces), dtype=[("count", "u1"), ("vertices", "<i4", 3)])
    faces["count"], faces["vertices"] = 3, mesh.faces
    vertices, more = mesh.vertices, ""
    if mesh.uvs is not None:
        vertices, more = numpy.concatenate([mesh.vertices, mesh.uvs], axis=1), "property float s\nproperty float t\n"
    with open(os.path.join(folder, name), "wb") as file:
        file.write(
            (
                "ply\nformat binary_little_endian 1.0\n"
                f"element vertex {len(vertices)}\nproperty float x\nproperty float y\nproperty float z\n{more}"
                f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
            ).encode()
        )
        file.write(vertices.astype("<f4").tobytes())
        file.write(faces.tobytes())


def write_exr(picture, file):
    import OpenEXR

    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    with OpenEXR.File(header, {"RGB": numpy.ascontiguousarray(picture)}) as image:
        image.write(file)


def write_sky(folder, rows):
    write_exr(sky(rows), os.path.join(folder, "sky.exr"))


def write_texture(folder):
    write_exr(texture(), os.path.join(folder, "texture.exr"))


def write_pickle(scene, folder, chosen):
    """For a worker in Python, with the samples and the depth."""
    if scene.is_textured():
        write_texture(folder)
    with open(os.path.join(folder, "scene.pickle"), "wb") as file:
        pickle.dump((scene, chosen.samples, chosen.depth), file)


def rendered_by(module, arguments, folder, environment):
    """Yields (seconds, picture), without end. One process renders all, after one render that does not count; it gets the
    seeds as lines, writes picture.npy, and answers with the seconds."""
    command = [sys.executable, "-B", "-m", f"comparison.path_tracing.{module}", *arguments]
    environment = {**os.environ, "PYTHONPATH": os.path.join(REPOSITORY, "benchmarks"), **environment}
    process = subprocess.Popen(command, cwd=folder, env=environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    try:
        for seed in range(1 << 30):
            process.stdin.write(f"{seed}\n")
            process.stdin.flush()
            answer = process.stdout.readline()
            if not answer:
                raise RuntimeError(f"{module} has ended")
            if seed > 0:
                yield float(answer), numpy.load(os.path.join(folder, "picture.npy"))
    finally:
        process.stdin.close()
        process.wait()
