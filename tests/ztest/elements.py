"""Elements of scenes as text, and files of scenes and pictures: what scenes.py writes them with."""

import math
import os
import struct
import zlib

FOLDER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "scenes")
WIDTH = 48  # and height
SAMPLES = 16  # of one of the test's renders


def number(x):
    return f"{x:.6g}"


def vector(name, v):
    return f'<{name} x="{number(v[0])}" y="{number(v[1])}" z="{number(v[2])}"/>'


def color(name, c, more=""):
    return f'<{name} red="{number(c[0])}" green="{number(c[1])}" blue="{number(c[2])}"{more}/>'


def element(name, *inner):
    return f"<{name}>{' '.join(inner)}</{name}>"


def value(name, x):
    return element(name, x if isinstance(x, str) else number(x))


# Materials


def matte(name, cd, more=""):
    return element(
        "matte", value("name", name), value("ka", 0), value("kd", 1), cd if isinstance(cd, str) else color("cd", cd), more
    )


def lamp(name, ce, scale=1):
    return element(
        "emissive", value("name", name), ce if isinstance(ce, str) else color("ce", ce), value("scaleradiance", scale)
    )


def conductor(name, cr, roughness=0, *more):
    return element("conductor", value("name", name), color("cr", cr), value("roughness", roughness), *more)


def dielectric(name, *more):
    return element("dielectric", value("name", name), *more)


# Objects


def sphere(center, radius, material, more=""):
    return element("sphere", vector("center", center), value("radius", radius), value("material", material), more)


def rectangle(corner, edge1, edge2, material, more=""):
    return element(
        "rectangle", vector("corner", corner), vector("edge1", edge1), vector("edge2", edge2), value("material", material), more
    )


def box(low, high, material):
    return element("box", vector("min", low), vector("max", high), value("material", material))


def disk(center, normal, radius, material):
    return element(
        "disk", vector("center", center), vector("normal", normal), value("radius", radius), value("material", material)
    )


def numbers(vectors):
    return ", ".join(" ".join(f"{round(x, 5) + 0:.5g}" for x in v) for v in vectors)


def mesh(positions, faces, material, *more):
    triangles = "  ".join(" ".join(str(i) for i in f) for f in faces)
    return element(
        "mesh", value("positions", numbers(positions)), value("faces", triangles), *more, value("material", material)
    )


def steps(*inner):
    return element("transform", *inner)


def turn(axis, angle):
    return f'<rotate x="{axis[0]}" y="{axis[1]}" z="{axis[2]}" angle="{angle}"/>'


def icosahedron(center, radius):
    """Its corners, and its faces as seen from outside."""
    g = (1 + math.sqrt(5)) / 2
    corners = [(x, y * g, 0) for y in (-1, 1) for x in (-1, 1)]
    corners += [(0, x, y * g) for y in (-1, 1) for x in (-1, 1)] + [(y * g, 0, x) for y in (-1, 1) for x in (-1, 1)]
    faces = []
    for i in range(12):
        for j in range(i + 1, 12):
            for k in range(j + 1, 12):
                a, b, c = corners[i], corners[j], corners[k]
                if all(abs(math.dist(p, q) - 2) < 1e-9 for p, q in ((a, b), (b, c), (c, a))):
                    u, v = [[q[n] - a[n] for n in range(3)] for q in (b, c)]
                    volume = sum(a[n] * (u[n - 2] * v[n - 1] - u[n - 1] * v[n - 2]) for n in range(3))
                    faces.append((i, j, k) if volume > 0 else (i, k, j))
    scale = radius / math.hypot(1, g)
    return [tuple(center[n] + scale * p[n] for n in range(3)) for p in corners], faces


def ball_mesh(center, radius, rings):
    """A sphere's positions, normals, texture coordinates and faces."""
    normals, uvs, faces = [], [], []
    for i in range(rings + 1):
        for j in range(2 * rings + 1):
            polar, around = math.pi * i / rings, math.pi * j / rings
            normals.append((math.sin(polar) * math.sin(around), -math.cos(polar), math.sin(polar) * math.cos(around)))
            uvs.append((j / (2 * rings), i / rings))

    def at(i, j):
        return i * (2 * rings + 1) + j

    for i in range(rings):
        for j in range(2 * rings):
            if i > 0:
                faces.append((at(i, j), at(i, j + 1), at(i + 1, j)))
            if i < rings - 1:
                faces.append((at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)))
    # At the poles triangles have two corners in one place, which are left out above.
    return [tuple(center[n] + radius * v[n] for n in range(3)) for v in normals], normals, uvs, faces


# What several scenes have

PINHOLE = ((0, 2.4, 7), (0, 0.9, 0), 36)


def camera(eye=PINHOLE[0], lookat=PINHOLE[1], fov=PINHOLE[2]):
    return element("camera", vector("eye", eye), vector("lookat", lookat), value("fov", fov))


def room():
    """The box from -1 to 1, open towards the viewer, who sees its side walls in red and green."""
    return [
        rectangle((-1, -1, 1), (2, 0, 0), (0, 0, -2), "white"),
        rectangle((-1, 1, -1), (2, 0, 0), (0, 0, 2), "white"),
        rectangle((-1, -1, -1), (2, 0, 0), (0, 2, 0), "white"),
        rectangle((-1, -1, 1), (0, 0, -2), (0, 2, 0), "red"),
        rectangle((1, -1, -1), (0, 0, 2), (0, 2, 0), "green"),
    ]


# The groups that elements stand in.
PLURALS = {
    "matte": "mattes",
    "emissive": "emissives",
    "mirror": "mirrors",
    "conductor": "conductors",
    "dielectric": "dielectrics",
    "fog": "fogs",
    "openpbr": "openpbrs",
    "image": "images",
    "sphere": "spheres",
    "rectangle": "rectangles",
    "disk": "disks",
    "mesh": "meshes",
    "triangle": "triangles",
    "box": "boxes",
    "cylinder": "cylinders",
    "instance": "instances",
    "environmentlight": "environmentlights",
    "directionallight": "directionallights",
    "pointlight": "pointlights",
    "spotlight": "spotlights",
    "group": "groups",
}


def section(name, items, indent="  "):
    """The items by their kinds, each in its group."""
    kinds = {}
    for item in items:
        kinds.setdefault(item[1 : item.index(">")].split()[0], []).append(item)
    lines = [f"{indent}<{name}>"]
    for kind, found in kinds.items():
        lines += [f"{indent}  <{PLURALS[kind]}>", *(f"{indent}    {item}" for item in found), f"{indent}  </{PLURALS[kind]}>"]
    return "\n".join([*lines, f"{indent}</{name}>\n"])


def write(name, title, depth, objects, materials, lights=(), textures=(), groups=(), view=camera(), viewplane=""):
    text = f"<!-- {title} Written by ../scenes.py. -->\n<raytracer>\n"
    text += f"  <viewplane><hres>{WIDTH}</hres><vres>{WIDTH}</vres><samples>{SAMPLES}</samples>{viewplane}</viewplane>\n"
    text += f"  {view}\n  <integrator><path><maxdepth>{depth}</maxdepth></path></integrator>\n"
    text += section("lights", lights) if lights else ""
    text += section("textures", textures) if textures else ""
    text += section("materials", materials)
    for group, inner in groups:
        text += f"  <groups><group>\n    <name>{group}</name>\n{section('objects', inner, '    ')}  </group></groups>\n"
    text += section("objects", objects) + "</raytracer>\n"
    with open(os.path.join(FOLDER, name + ".xml"), "w", encoding="utf-8", newline="\n") as file:
        file.write(text)


def write_png(name, width, height, pixel):
    """pixel(x, y): three bytes; row 0 is the uppermost."""
    rows = b"".join(b"\0" + b"".join(bytes(pixel(x, y)) for x in range(width)) for y in range(height))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    with open(os.path.join(FOLDER, name), "wb") as file:
        file.write(
            b"\x89PNG\r\n\x1a\n"
            + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows))
            + chunk(b"IEND", b"")
        )


def write_hdr(name, width, height, pixel):
    """Radiance's format, whose numbers are linear. pixel(x, y): three numbers."""
    data = bytearray()
    for y in range(height):
        for x in range(width):
            c = pixel(x, y)
            fraction, exponent = math.frexp(max(c))
            data += bytes(int(v * fraction * 256 / max(c)) for v in c) + bytes([exponent + 128])
    with open(os.path.join(FOLDER, name), "wb") as file:
        file.write(f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n".encode() + data)


def write_pictures():
    write_png("tiles.png", 8, 8, lambda x, y: (40 + 25 * x, 230 - 24 * y, 60 + 150 * ((x + y) % 2)))
    write_hdr("panel.hdr", 8, 8, lambda x, y: (0.2 + x, 0.2 + 0.5 * y, 4.0 if x == y else 0.3))
    # A lamp at the right, above; bright low rows.
    write_hdr("sky.hdr", 16, 8, lambda x, y: (30.0, 24.0, 15.0) if (x, y) == (11, 2) else (0.3 + 0.02 * x, 0.4, 0.2 + 0.1 * y))
