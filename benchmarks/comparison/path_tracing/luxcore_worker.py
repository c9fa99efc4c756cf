"""Renders a scene with LuxCore, once for each seed that a line of standard input gives:
python -m comparison.path_tracing.luxcore_worker scene.pickle THREADS

Writes picture.npy, and then a line with the seconds between its first sample and its last.
"""

import os
import pickle
import sys
import time

import numpy
import pyluxcore

from .scenes import WIDTH, Diffuse, Glass, Lamp, Mesh, Metal, Rectangle, Textured


def numbers(values):
    return " ".join(f"{x:.9g}" for x in values)


def material_lines(name, material):
    start = f"scene.materials.{name}"
    match material:
        case Diffuse():
            return [f"{start}.type = matte", f"{start}.kd = {numbers(material.color)}"]
        case Textured():
            picture = "scene.textures.picture"
            return [f"{picture}.type = imagemap", f"{picture}.file = texture.exr", f"{picture}.gamma = 1",
                    f"{start}.type = matte", f"{start}.kd = picture"]
        case Metal():
            return [f"{start}.type = mirror", f"{start}.kr = {numbers(material.color)}"]
        case Glass():
            return [f"{start}.type = glass", f"{start}.kr = 1 1 1", f"{start}.kt = 1 1 1",
                    f"{start}.interiorior = {material.ior:.9g}"]
        case Lamp():
            return [f"{start}.type = matte", f"{start}.kd = 0 0 0", f"{start}.emission = {numbers(material.radiance)}"]
    raise ValueError(material)


def meshes(scene):
    for r in scene.of(Rectangle):
        a, b, c = (numpy.array(v, float) for v in (r.corner, r.edge1, r.edge2))
        yield Mesh(numpy.array([a, a + b, a + b + c, a + c]), numpy.array([(0, 1, 2), (0, 2, 3)]), r.material)
    yield from scene.of(Mesh)


def build(scene):
    result = pyluxcore.Scene()
    lines = ["scene.camera.type = perspective", f"scene.camera.lookat.orig = {numbers(scene.eye)}",
             f"scene.camera.lookat.target = {numbers(scene.lookat)}", "scene.camera.up = 0 1 0",
             f"scene.camera.fieldofview = {scene.fov:.9g}", "scene.camera.cliphither = 1e-3",
             "scene.camera.clipyon = 1e4", "scene.camera.screenwindow = -1 1 -1 1"]
    for name, material in scene.materials.items():
        lines += material_lines(name, material)
    for i, mesh in enumerate(meshes(scene)):
        uvs = None if mesh.uvs is None else [(float(u), float(v)) for u, v in mesh.uvs]
        result.DefineMesh(f"mesh{i}", [tuple(map(float, v)) for v in mesh.vertices],
                          [tuple(map(int, f)) for f in mesh.faces], None, uvs, None, None)
        lines += [f"scene.objects.object{i}.shape = mesh{i}", f"scene.objects.object{i}.material = {mesh.material}"]
    properties = pyluxcore.Properties()
    properties.SetFromString("\n".join(lines))
    result.Parse(properties)
    return result


def settings(scene, samples, depth, threads, seed):
    lines = ["renderengine.type = PATHCPU", "sampler.type = SOBOL", "sampler.sobol.adaptive.strength = 0",
             f"renderengine.seed = {seed}", f"native.threads.count = {threads}", f"batch.haltspp = {samples}",
             f"film.width = {WIDTH}", f"film.height = {WIDTH}", "film.filter.type = NONE", "film.noiseestimation.warmup = 0",
             "film.outputs.0.type = RGB", "film.outputs.0.filename = none.exr", "path.russianroulette.depth = 3",
             "path.clamping.variance.maxvalue = 0"]
    # Its depths are those of scatterings, and the first is 1 in each.
    lines += [f"path.pathdepth.{kind} = {depth - 1}" for kind in ("total", "diffuse", "glossy", "specular")]
    if scene.caustics:
        lines += ["path.hybridbackforward.enable = 1", "path.hybridbackforward.partition = 0.5"]
    properties = pyluxcore.Properties()
    properties.SetFromString("\n".join(lines))
    return properties


def main():
    with open(sys.argv[1], "rb") as file:
        scene, samples, depth = pickle.load(file)
    # What LuxCore says goes elsewhere.
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)
    pyluxcore.Init(lambda message: None)
    built = build(scene)
    picture = numpy.zeros((WIDTH, WIDTH, 3), numpy.float32)
    for line in sys.stdin:
        config = pyluxcore.RenderConfig(settings(scene, samples, depth, int(sys.argv[2]), int(line) + 1), built)
        session = pyluxcore.RenderSession(config)
        session.Start()
        start = time.perf_counter()
        while not session.HasDone():
            time.sleep(0.005)
            session.UpdateStats()
        seconds = time.perf_counter() - start
        session.Stop()
        session.GetFilm().GetOutputFloat(pyluxcore.FilmOutputType.RGB, picture)
        numpy.save("picture.npy", picture[::-1])
        answers.write(f"{seconds}\n")
        answers.flush()


if __name__ == "__main__":
    main()
