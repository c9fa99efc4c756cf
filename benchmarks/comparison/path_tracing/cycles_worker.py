"""Renders a scene with Cycles, once for each seed that a line of standard input gives:
python -m comparison.path_tracing.cycles_worker scene.pickle THREADS

Writes picture.npy, and then a line with the seconds, without those that it takes to begin: what Cycles keeps from render
to render includes the seed, so nothing is kept. Spheres are fine polyhedra.
"""

import math
import os
import pickle
import sys
import time

import bpy
import mathutils
import numpy

from ..pictures import read_exr
from .scenes import WIDTH, Diffuse, Glass, Lamp, Mesh, Metal, Rectangle, Sphere, Textured


def turned(v):
    """z is up there."""
    return (v[0], -v[2], v[1])


def node_material(name, material):
    result = bpy.data.materials.new(name)
    result.use_nodes = True
    nodes, links = result.node_tree.nodes, result.node_tree.links
    nodes.clear()
    output = nodes.new("ShaderNodeOutputMaterial")
    match material:
        case Diffuse():
            shader = nodes.new("ShaderNodeBsdfDiffuse")
            shader.inputs["Color"].default_value = (*material.color, 1)
        case Textured():
            shader = nodes.new("ShaderNodeBsdfDiffuse")
            picture = nodes.new("ShaderNodeTexImage")
            picture.image = bpy.data.images.load(os.path.abspath("texture.exr"))
            picture.image.colorspace_settings.name = "Linear Rec.709"
            links.new(picture.outputs["Color"], shader.inputs["Color"])
        case Metal():
            shader = nodes.new("ShaderNodeBsdfAnisotropic")
            shader.distribution = "GGX"
            shader.inputs["Color"].default_value = (*material.color, 1)
            shader.inputs["Roughness"].default_value = material.roughness
        case Glass():
            shader = nodes.new("ShaderNodeBsdfGlass")
            shader.inputs["Color"].default_value = (1, 1, 1, 1)
            shader.inputs["Roughness"].default_value = 0
            shader.inputs["IOR"].default_value = material.ior
        case Lamp():
            shader = nodes.new("ShaderNodeEmission")
            shader.inputs["Color"].default_value = (*material.radiance, 1)
            geometry, front = nodes.new("ShaderNodeNewGeometry"), nodes.new("ShaderNodeMath")
            front.operation = "SUBTRACT"
            front.inputs[0].default_value = 1
            links.new(geometry.outputs["Backfacing"], front.inputs[1])
            links.new(front.outputs[0], shader.inputs["Strength"])
            result.cycles.emission_sampling = "FRONT"
    links.new(shader.outputs[0], output.inputs["Surface"])
    return result


def add_mesh(vertices, faces, material, uvs=None):
    mesh = bpy.data.meshes.new("mesh")
    mesh.from_pydata([turned(v) for v in vertices], [], [tuple(face) for face in faces])
    mesh.materials.append(material)
    if uvs is not None:
        mesh.uv_layers.new().data.foreach_set("uv", uvs[numpy.array(faces).reshape(-1)].reshape(-1))
    bpy.context.scene.collection.objects.link(bpy.data.objects.new("object", mesh))
    return mesh


def add_sphere(sphere, material):
    import bmesh

    shape = bmesh.new()
    segments = 24 if sphere.radius < 0.1 else 192
    bmesh.ops.create_uvsphere(shape, u_segments=segments, v_segments=segments // 2, radius=sphere.radius)
    mesh = bpy.data.meshes.new("sphere")
    shape.to_mesh(mesh)
    shape.free()
    mesh.polygons.foreach_set("use_smooth", [sphere.radius >= 0.1] * len(mesh.polygons))
    mesh.materials.append(material)
    item = bpy.data.objects.new("sphere", mesh)
    item.location = turned(sphere.center)
    bpy.context.scene.collection.objects.link(item)


def build(scene, samples, depth, threads):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    here = bpy.context.scene
    materials = {name: node_material(name, material) for name, material in scene.materials.items()}
    for r in scene.of(Rectangle):
        corners = [r.corner, numpy.add(r.corner, r.edge1), numpy.add(numpy.add(r.corner, r.edge1), r.edge2),
                   numpy.add(r.corner, r.edge2)]
        add_mesh(corners, [(0, 1, 2, 3)], materials[r.material])
    for s in scene.of(Sphere):
        add_sphere(s, materials[s.material])
    for mesh in scene.of(Mesh):
        add_mesh(mesh.vertices.tolist(), mesh.faces.tolist(), materials[mesh.material], mesh.uvs)
    here.world = bpy.data.worlds.new("world")
    here.world.use_nodes = True
    background = here.world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (0, 0, 0, 1)
    if scene.sky:
        picture = here.world.node_tree.nodes.new("ShaderNodeTexEnvironment")
        picture.image = bpy.data.images.load(os.path.abspath("sky.exr"))
        picture.image.colorspace_settings.name = "Linear Rec.709"
        here.world.node_tree.links.new(picture.outputs["Color"], background.inputs["Color"])
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit, camera.angle, camera.clip_start = "VERTICAL", math.radians(scene.fov), 1e-3
    viewer = bpy.data.objects.new("camera", camera)
    eye, target = mathutils.Vector(turned(scene.eye)), mathutils.Vector(turned(scene.lookat))
    viewer.location = eye
    viewer.rotation_euler = (target - eye).to_track_quat("-Z", "Y").to_euler()
    here.collection.objects.link(viewer)
    here.camera = viewer

    here.render.engine = "CYCLES"
    here.render.resolution_x = here.render.resolution_y = WIDTH
    here.render.threads_mode, here.render.threads = "FIXED", threads
    here.render.filepath = os.path.abspath("picture.exr")
    here.render.image_settings.file_format = "OPEN_EXR"
    here.render.image_settings.color_depth = "32"
    settings = here.cycles
    settings.device, settings.samples = "CPU", samples
    settings.use_adaptive_sampling = settings.use_denoising = False
    # Bounces are scatterings behind the first.
    for name in ("max_bounces", "diffuse_bounces", "glossy_bounces", "transmission_bounces"):
        setattr(settings, name, depth - 2)
    settings.sample_clamp_direct = settings.sample_clamp_indirect = settings.blur_glossy = 0
    settings.sampling_pattern = "TABULATED_SOBOL"
    settings.pixel_filter_type = "BOX"
    settings.caustics_reflective = settings.caustics_refractive = True


def main():
    with open(sys.argv[1], "rb") as file:
        scene, samples, depth = pickle.load(file)
    # What Blender says goes elsewhere.
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)
    build(scene, samples, depth, int(sys.argv[2]))
    settings = bpy.context.scene.cycles

    def render(count, seed):
        settings.samples, settings.seed = count, seed
        start = time.perf_counter()
        bpy.ops.render.render(write_still=True)
        return time.perf_counter() - start

    setup = min(render(1, 0) for _ in range(2))  # and a sample
    for line in sys.stdin:
        seconds = (render(samples, int(line)) - setup) * samples / (samples - 1)
        numpy.save("picture.npy", read_exr("picture.exr"))
        answers.write(f"{seconds}\n")
        answers.flush()


if __name__ == "__main__":
    main()
