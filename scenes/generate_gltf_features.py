#!/usr/bin/env python3
"""generate_gltf_features.py [FOLDER]: writes a small glTF file for each feature and extension of glTF that is read, to
FOLDER (build/models/features). docs/render-models renders them for docs/models.md."""
import colorsys
import math
import os
import sys

from gltf_file import (BYTE, CLAMP_TO_EDGE, FAN, MIRRORED_REPEAT, REPEAT, SHORT, STRIP, UNSIGNED_BYTE, UNSIGNED_INT,
                       UNSIGNED_SHORT, Gltf)
from gltf_pictures import arrow, dots, png, stripes, studs
from gltf_shapes import COLUMN, DOME, PAWN, VASE, Shape, knot, lathe, panel, rounded_box, sphere, surface
from scene_xml import add, cross, srgb, unit

HERE = os.path.dirname(os.path.abspath(__file__))
BLUE, CORAL, CREAM, INK, OCHRE = (srgb(c) for c in ("#2f6fa8", "#d9593d", "#f2e9d8", "#1d2430", "#d99a2b"))
GOLD = (1.0, 0.77, 0.34)


def row(count, step=2.3):
    """Places side by side."""
    return [((i - (count - 1) / 2) * step, 0, 0) for i in range(count)]


def show_row(file, materials, shape=None, step=2.3):
    shape = shape or sphere()
    for material, place in zip(materials, row(len(materials), step)):
        file.show(shape, material, place)


def turned(x, y, z, angle):
    """The quaternion of a turn about an axis, in degrees."""
    half = math.radians(angle) / 2
    return [c * math.sin(half) for c in unit((x, y, z))] + [math.cos(half)]


def after(first, then):
    """The quaternion of two turns."""
    (a, b, c, d), (x, y, z, w) = then, first
    return [d * x + a * w + b * z - c * y, d * y - a * z + b * w + c * x, d * z + a * y - b * x + c * w,
            d * w - a * x - b * y - c * z]


def raised(shape, height):
    return shape._replace(positions=[add(p, (0, height, 0)) for p in shape.positions])


# Features of glTF

def nodes(file):
    """Each ball carries seven smaller ones, turned with it."""
    meshes = [file.mesh(file.primitive(sphere(1, 48, 24), file.material(c, roughness=0.3))) for c in (CREAM, BLUE, CORAL)]

    def ball(level, **place):
        children = []
        for i in range(7 if level < 2 else 0):
            polar, around = (0, 0) if i == 6 else (80, 60 * i + 30)
            out = math.sin(math.radians(polar))
            n = out * math.sin(math.radians(around)), math.cos(math.radians(polar)), out * math.cos(math.radians(around))
            children.append(ball(level + 1, translation=[n[0], 1 + n[1], n[2]], scale=[0.42] * 3,
                                 rotation=turned(n[2], 0, -n[0], polar) if polar else [0, 0, 0, 1]))
        more = {"children": children} if children else {}
        return file.node(root=level == 0, mesh=meshes[level], **place, **more)

    ball(0)


def primitives(file):
    """Triangles; a strip, a band around a cylinder; a fan, a pleated parasol."""
    box = raised(rounded_box((1.7, 1.7, 1.7), 0.35), 0.85)
    file.show(box, file.material(CORAL, roughness=0.3), (-2.5, 0, 0), rotation=turned(0, 1, 0, 30))
    positions, normals = [], []
    for i in range(240):
        around, height = 2 * math.pi * i / 80, 1.85 * i / 240
        normals += [(math.sin(around), 0, math.cos(around))] * 2
        positions += [(0.85 * math.sin(around), height + 0.36, 0.85 * math.cos(around)),
                      (0.85 * math.sin(around), height, 0.85 * math.cos(around))]
    band = Shape(positions, normals, [], [])
    file.node(mesh=file.mesh(file.primitive(band, file.material(OCHRE, roughness=0.3), STRIP)))
    rim = [(1.15 * r * math.sin(a), 1.9 * (1 - r), 1.15 * r * math.cos(a))
           for a, r in ((2 * math.pi * i / 24, 1 - 0.16 * (i % 2)) for i in range(25))]
    pleats = Shape([(0, 1.9, 0), *rim], [], [], [])
    file.node(mesh=file.mesh(file.primitive(pleats, file.material(BLUE, roughness=0.4), FAN)), translation=[2.5, 0, 0])


def vertex_colors(file):
    shape = knot()
    colors = [(*srgb("#%02x%02x%02x" % tuple(round(255 * c) for c in colorsys.hsv_to_rgb(u, 0.65, 0.9))), 1.0)
              for u, _ in shape.uvs]
    part = file.primitive(shape, file.material(roughness=0.35), COLOR_0=file.accessor(colors))
    file.node(mesh=file.mesh(part), translation=[0, 1.7, 0])


def sparse_accessors(file):
    """A ball of few faces, and the same accessor with some of its positions moved."""
    ball = sphere(1, 14, 9)
    plain = ball._replace(normals=[], uvs=[])
    part = file.primitive(plain, file.material(BLUE, roughness=0.4))
    file.node(mesh=file.mesh(part), translation=[-1.6, 0, 0])
    moved = [i for i in range(len(plain.positions)) if i // 15 in (2, 4, 6) and i % 15 % 14 % 2 == 0]
    places = [add((0, 1, 0), ball.normals[i], 1.75) for i in moved]
    sparse = dict(file.json["accessors"][part["attributes"]["POSITION"]])
    sparse["sparse"] = {"count": len(moved), "values": {"bufferView": file.view(file.values(places))},
                        "indices": {"componentType": UNSIGNED_INT, "bufferView": file.view(
                            b"".join(i.to_bytes(4, "little") for i in moved))}}
    other = {**part, "attributes": {"POSITION": file.put("accessors", sparse)}, "material": file.material(CORAL, roughness=0.4)}
    file.node(mesh=file.mesh(other), translation=[1.6, 0, 0])


def samplers(file):
    picture = png(arrow)
    shape = panel(2, 2, (-0.6, -0.6), (1.6, 1.6))
    wraps = ((REPEAT, REPEAT), (MIRRORED_REPEAT, MIRRORED_REPEAT), (CLAMP_TO_EDGE, CLAMP_TO_EDGE), (REPEAT, CLAMP_TO_EDGE))
    show_row(file, [file.material(texture=file.texture(picture, *both)) for both in wraps], shape)


def metallic_roughness(file):
    for metallic, color, back in ((1.0, GOLD, -3), (0.0, BLUE, 0)):
        for i, place in enumerate(row(5)):
            material = file.material(color, metallic, i / 4)
            file.show(sphere(), material, (place[0], 0, back))


def normal_texture(file):
    picture = file.texture(png(studs))
    show_row(file, [file.material(CORAL, roughness=0.3, normalTexture={"index": picture, "scale": scale})
                    for scale in (0.0, 0.5, 1.0)])


def alpha_modes(file):
    picture = file.texture(png(dots))
    shade = lathe(lambda v: (0.75 + 0.25 * v, 2 - 2 * v), 96, 24)
    show_row(file, [file.material(texture=picture, doubleSided=True, alphaMode=mode) for mode in ("OPAQUE", "MASK", "BLEND")],
             shade, 2.4)


def cameras(file):
    column = lathe(COLUMN, 48, 96)
    part = file.mesh(file.primitive(column, file.material(CREAM, roughness=0.6)))
    for i in range(6):
        for x in (-1.3, 1.3):
            file.node(mesh=part, translation=[x, 0, -2.2 * i])
    file.show(sphere(0.7), file.material(CORAL, roughness=0.25), (0, 0, -6.6))
    back = unit((0.55, 0.42, 1))
    right = unit(cross((0, 1, 0), back))
    up = cross(back, right)
    for name, of, distance in (("perspective", {"yfov": 0.95, "znear": 0.1}, 11.5),
                               ("orthographic", {"xmag": 5.0, "ymag": 5.0, "znear": 0.1, "zfar": 100.0}, 14)):
        number = file.put("cameras", {"name": name, "type": name, name: of})
        eye = add((0, 1.4, -5.2), back, distance)
        file.node(camera=number, matrix=[*right, 0, *up, 0, *back, 0, *eye, 1])


def animations(file):
    """A ball jumps over a block: a cubic spline is its parabola."""
    file.show(rounded_box((0.9, 1.5, 1.8), 0.2), file.material(BLUE, roughness=0.4), (0, 0.75, 0))
    striped = file.material(texture=file.texture(png(stripes)), roughness=0.3)
    ball = file.node(mesh=file.mesh(file.primitive(raised(sphere(0.75), -0.75), striped)), translation=[-2.6, 0.75, 0])
    turns = [after(turned(1, 0, 0, 90), turned(0, 0, 1, -120 * i)) for i in range(4)]
    file.put("animations", {
        "name": "jump",
        "channels": [{"sampler": 0, "target": {"node": ball, "path": "translation"}},
                     {"sampler": 1, "target": {"node": ball, "path": "rotation"}}],
        "samplers": [{"interpolation": "CUBICSPLINE", "input": file.accessor([0.0, 1.0], bounds=True), "output": file.accessor(
                         [(0, 0, 0), (-2.6, 0.75, 0), (5.2, 9.6, 0), (5.2, -9.6, 0), (2.6, 0.75, 0), (0, 0, 0)])},
                     {"interpolation": "LINEAR", "input": file.accessor([0.0, 1 / 3, 2 / 3, 1.0], bounds=True),
                      "output": file.accessor(turns)}]})


def skins(file):
    """A tube about four joints, each of which is turned by 0, 12 and 30 degrees."""
    def profile(v):
        dome = math.pi / 2 * min(v / 0.15, 1)
        return 0.42 * math.sin(dome), 4 - 4 * max(v - 0.15, 0) / 0.85 + 0.42 * math.cos(dome)

    shape = lathe(profile, 48, 96)
    joints, weights = [], []
    for _, y, _ in shape.positions:
        place = min(max(y - 0.5, 0), 3)
        lower = min(int(place), 2)
        joints.append((lower, lower + 1, 0, 0))
        weights.append((1 - place + lower, place - lower, 0, 0))
    tube = file.mesh(file.primitive(shape, file.material(CORAL, roughness=0.3), JOINTS_0=file.accessor(joints, UNSIGNED_BYTE),
                                    WEIGHTS_0=file.accessor(weights)))
    inverses = file.accessor([(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -float(i), 0, 1) for i in range(4)])
    for angle, x in ((0, -2.6), (12, 0), (30, 2.3)):
        child, chain = [], []
        for i in reversed(range(4)):
            place = {"translation": [0, 1, 0], "rotation": turned(0, 0, 1, -angle)} if i else {"translation": [x, 0, 0]}
            chain.insert(0, file.node(root=i == 0, **place, **({"children": child} if child else {})))
            child = [chain[0]]
        file.node(mesh=tube, skin=file.put("skins", {"joints": chain, "inverseBindMatrices": inverses}))


def morph_targets(file):
    """From a ball to a gourd, by half of the target and by all of it."""
    def gourd(u, v):
        around, rise = 2 * math.pi * (u - 0.5), math.pi * v
        radius = 1.15 * math.sin(rise) * (1 - 0.2 * (0.5 + 0.5 * math.cos(8 * around)) ** 3)
        height = 0.8 * math.cos(rise) * (1 - 0.45 * math.exp(-12 * math.sin(rise) ** 2))
        return radius * math.sin(around), 0.8 + height, radius * math.cos(around)

    ball, other = sphere(1, 120, 48), surface(gourd, 120, 48)
    target = {"POSITION": file.accessor([add(b, a, -1) for a, b in zip(ball.positions, other.positions)], bounds=True),
              "NORMAL": file.accessor([add(b, a, -1) for a, b in zip(ball.normals, other.normals)])}
    mesh = file.mesh({**file.primitive(ball, file.material(OCHRE, roughness=0.35)), "targets": [target]}, weights=[0])
    for weight, place in zip((0, 0.5, 1), row(3)):
        file.node(mesh=mesh, weights=[weight], translation=list(place))


# Extensions

def mesh_gpu_instancing(file):
    """Seeds of a sunflower."""
    file.use("EXT_mesh_gpu_instancing")
    mesh = file.mesh(file.primitive(rounded_box((0.62, 0.9, 0.32), 0.12), file.material(OCHRE, roughness=0.3)))
    places, turns, sizes = [], [], []
    for i in range(260):
        around, out = i * math.pi * (3 - math.sqrt(5)), math.sqrt(i + 0.5) / math.sqrt(260)
        places.append((6 * out * math.sin(around), 1.6 * (1 - out * out), 6 * out * math.cos(around)))
        turns.append(after(turned(1, 0, 0, 55 * out), turned(0, 1, 0, math.degrees(around))))
        sizes.append((0.55 + 0.45 * out,) * 3)
    attributes = {"TRANSLATION": places, "ROTATION": turns, "SCALE": sizes}
    file.node(mesh=mesh, extensions={"EXT_mesh_gpu_instancing": {"attributes": {
        name: file.accessor(values) for name, values in attributes.items()}}})


def mesh_quantization(file):
    """The left knot has floats, the right one integers."""
    file.use("KHR_mesh_quantization")
    file.json["extensionsRequired"] = ["KHR_mesh_quantization"]
    shape = knot(1, 0.3)
    material = file.material(CORAL, roughness=0.3)
    file.show(shape, material, (-2, 1.7, 0))
    part = file.primitive(shape._replace(normals=[], uvs=[]), material)
    part["attributes"] = {
        "POSITION": file.accessor([tuple(round(32767 * c / 2) for c in p) for p in shape.positions], SHORT, bounds=True,
                                  normalized=True),
        "NORMAL": file.accessor([tuple(round(127 * c) for c in n) for n in shape.normals], BYTE, normalized=True),
        "TEXCOORD_0": file.accessor([tuple(round(65535 * c) for c in uv) for uv in shape.uvs], UNSIGNED_SHORT, normalized=True)}
    file.node(mesh=file.mesh(part), translation=[2, 1.7, 0], scale=[2, 2, 2])


def lights_punctual(file):
    """A point, a spot and a sun, and a camera that has them in view."""
    file.use("KHR_lights_punctual")
    plaster = file.material((0.8, 0.8, 0.8), roughness=0.9)
    file.show(rounded_box((12, 0.2, 7), 0.05), plaster, (0, -0.1, 0))
    file.show(rounded_box((12, 6, 0.2), 0.05), plaster, (0, 3, -1.6))
    pawn = lathe(PAWN, 72, 96)
    show_row(file, [plaster] * 3, pawn, 2.6)
    lights = [({"type": "point", "color": [1, 0.45, 0.2], "intensity": 26}, {"translation": [-3.6, 1.6, 0.9]}),
              ({"type": "spot", "color": [0.3, 0.6, 1], "intensity": 130,
                "spot": {"innerConeAngle": 0.25, "outerConeAngle": 0.3}},
               {"translation": [0, 4.6, 2.4], "rotation": turned(1, 0, 0, -58)}),
              ({"type": "directional", "color": [1, 0.95, 0.85], "intensity": 3.2}, {"rotation": turned(1, 2.2, 0, -65)})]
    file.json["extensions"] = {"KHR_lights_punctual": {"lights": [light for light, _ in lights]}}
    for i, (_, place) in enumerate(lights):
        file.node(**place, extensions={"KHR_lights_punctual": {"light": i}})
    camera = file.put("cameras", {"type": "perspective", "perspective": {"yfov": 0.42, "znear": 0.1}})
    file.node(camera=camera, translation=[0, 2.6, 9.5], rotation=turned(1, 0, 0, -9.5))


def materials_variants(file):
    file.use("KHR_materials_variants")
    file.json["extensions"] = {"KHR_materials_variants": {"variants": [{"name": n} for n in ("glazed", "gilded", "striped")]}}
    glaze = file.material(BLUE, roughness=0.15)
    others = [glaze, file.material(GOLD, 1, 0.2), file.material(texture=file.texture(png(stripes)), roughness=0.5)]
    part = file.primitive(lathe(VASE, 96, 120), glaze)
    part["extensions"] = {"KHR_materials_variants": {"mappings": [
        {"material": material, "variants": [i]} for i, material in enumerate(others)]}}
    file.node(mesh=file.mesh(part))


def texture_transform(file):
    file.use("KHR_texture_transform")
    picture = file.texture(png(arrow))
    transforms = ({}, {"offset": [0.25, 0.25]}, {"rotation": math.radians(30)}, {"scale": [3, 3]})
    show_row(file, [file.material(texture={"index": picture, "extensions": {"KHR_texture_transform": t}}) for t in transforms],
             panel(2, 2))


def anisotropy(file):
    materials = [file.material((0.85, 0.8, 0.75), 1, 0.25, extensions={"anisotropy": {"anisotropyStrength": s}} if s else {})
                 for s in (0.0, 0.5, 0.9)]
    for material, place in zip(materials, row(3)):
        file.show(lathe(DOME, 96, 60), material, add(place, (0, 0.9, 0)), rotation=turned(1, 0, 0, 62))


def clearcoat(file):
    """Of three strengths; smooth over studs; with studs of its own, over a smooth base."""
    coat = {"clearcoatFactor": 1, "clearcoatRoughnessFactor": 0.02}
    bumps = {"index": file.texture(png(studs))}
    paints = [({"clearcoat": {**coat, "clearcoatFactor": f}}, {}) for f in (0.0, 0.5, 1.0)]
    paints += [({"clearcoat": coat}, {"normalTexture": bumps}),
               ({"clearcoat": {**coat, "clearcoatNormalTexture": {**bumps, "scale": 0.3}}}, {})]
    show_row(file, [file.material((0.45, 0.02, 0.03), 0.7, 0.6, extensions=extensions, **more) for extensions, more in paints])


def diffuse_transmission(file):
    bulb = file.material(INK, emissiveFactor=[1, 0.75, 0.5], extensions={"emissive_strength": {"emissiveStrength": 5}})
    for factor, place in zip((0.0, 0.5, 1.0), row(3)):
        paper = {"diffuseTransmissionFactor": factor, "diffuseTransmissionColorFactor": [0.95, 0.85, 0.7]}
        file.show(sphere(), file.material(CREAM, 0, 0.9, extensions={"diffuse_transmission": paper}), place)
        file.show(sphere(0.3), bulb, place)


def emissive_strength(file):
    show_row(file, [file.material(INK, emissiveFactor=[1, 0.6, 0.3], extensions={
        "emissive_strength": {"emissiveStrength": s}}) for s in (1.0, 4.0, 16.0)], sphere(0.6), 2.4)


def before_stripes(file, materials, shape=None, distance=1.5):
    """A row of clear things, and what is seen through them."""
    file.show(panel(2.3 * len(materials) + 0.6, 2.5), file.material(texture=file.texture(png(stripes))), (0, 0, -distance))
    show_row(file, materials, shape)


def clear(file, roughness=0.0, color=(1, 1, 1), **extensions):
    return file.material(color, 0, roughness, extensions={"transmission": {"transmissionFactor": 1}, **extensions})


def ior(file):
    solid = {"volume": {"thicknessFactor": 2}}
    before_stripes(file, [clear(file, **solid, ior={"ior": i}) for i in (1.1, 1.33, 1.5, 2.4)])


def iridescence(file):
    film = {"iridescenceFactor": 1, "iridescenceIor": 2.0}
    show_row(file, [file.material((0.01, 0.01, 0.01), 0, 0.05, extensions={
        "iridescence": {**film, "iridescenceThicknessMaximum": t}}) for t in (220, 320, 450)])


def sheen(file):
    show_row(file, [file.material((0.06, 0.004, 0.012), 0, 0.9, extensions={
        "sheen": {"sheenColorFactor": [s] * 3, "sheenRoughnessFactor": 0.45}}) for s in (0.0, 0.5, 1.0)])


def specular(file):
    colors = ((0, (1, 1, 1)), (0.5, (1, 1, 1)), (1, (1, 1, 1)), (1, CORAL), (1, BLUE))
    show_row(file, [file.material(INK, 0, 0.2, extensions={
        "specular": {"specularFactor": f, "specularColorFactor": list(c)}, "ior": {"ior": 1.8}}) for f, c in colors])


def specular_glossiness(file):
    dielectric = (0.04, 0.04, 0.04)
    surfaces = ((CORAL, dielectric, 0.3), (CORAL, dielectric, 0.8), ((0, 0, 0), (0.95, 0.64, 0.54), 0.7), ((0, 0, 0), GOLD, 0.9))
    materials = [file.material(extensions={"pbrSpecularGlossiness": {
        "diffuseFactor": [*diffuse, 1], "specularFactor": list(mirrored), "glossinessFactor": glossiness}})
        for diffuse, mirrored, glossiness in surfaces]
    picture = {"index": file.texture(png(stripes))}
    materials.append(file.material(extensions={"pbrSpecularGlossiness": {
        "diffuseTexture": picture, "specularGlossinessTexture": picture, "specularFactor": list(GOLD), "glossinessFactor": 0.8}}))
    show_row(file, materials)


def transmission(file):
    pane = raised(rounded_box((1.7, 1.7, 0.2), 0.1), 0.85)
    before_stripes(file, [clear(file, roughness) for roughness in (0.0, 0.2, 0.4)], pane, 0.6)


def unlit(file):
    picture = file.texture(png(stripes))
    show_row(file, [file.material(texture=picture), file.material(texture=picture, extensions={"unlit": {}})])


def volume(file):
    amber = {"thicknessFactor": 2, "attenuationColor": [0.95, 0.5, 0.12]}
    before_stripes(file, [clear(file, volume={**amber, "attenuationDistance": d}) for d in (4.0, 1.0, 0.3)])


FEATURES = [nodes, primitives, vertex_colors, sparse_accessors, samplers, metallic_roughness, normal_texture, alpha_modes,
            cameras, animations, skins, morph_targets, mesh_gpu_instancing, mesh_quantization, lights_punctual,
            materials_variants, texture_transform, anisotropy, clearcoat, diffuse_transmission, emissive_strength, ior, iridescence,
            sheen, specular, specular_glossiness, transmission, unlit, volume]


def main(folder=os.path.join(os.path.dirname(HERE), "build", "models", "features")):
    os.makedirs(folder, exist_ok=True)
    for feature in FEATURES:
        file = Gltf()
        feature(file)
        file.write(folder, feature.__name__.replace("_", "-"))


if __name__ == "__main__":
    main(*sys.argv[1:])
