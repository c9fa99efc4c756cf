"""Meshes and skies as files that all renderers read."""

import os

import numpy

from .scenes import sky


def write_ply(mesh, folder, name):
    faces = numpy.empty(len(mesh.faces), dtype=[("count", "u1"), ("vertices", "<i4", 3)])
    faces["count"], faces["vertices"] = 3, mesh.faces
    with open(os.path.join(folder, name), "wb") as file:
        file.write(
            (
                "ply\nformat binary_little_endian 1.0\n"
                f"element vertex {len(mesh.vertices)}\nproperty float x\nproperty float y\nproperty float z\n"
                f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
            ).encode()
        )
        file.write(mesh.vertices.astype("<f4").tobytes())
        file.write(faces.tobytes())


def write_sky(folder, rows):
    import OpenEXR

    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    with OpenEXR.File(header, {"RGB": numpy.ascontiguousarray(sky(rows))}) as image:
        image.write(os.path.join(folder, "sky.exr"))
