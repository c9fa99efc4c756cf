"""The scenes that are rendered, in no renderer's language. The same on every machine.

All that the renderers share is in them: a pinhole camera, diffuse, metal, glass and shining surfaces, a sky.
"""

import math
import random
from dataclasses import dataclass, field

import numpy

WIDTH = 256  # and height, in pixels
SKY_SIZE = (1024, 512)
TEXTURE_EDGE = 1024  # texels


@dataclass
class Diffuse:
    color: tuple


@dataclass
class Textured:
    """Diffuse, in the colours of texture()."""


@dataclass
class Metal:
    """roughness 0 is smooth; its square is GGX's alpha."""

    color: tuple
    roughness: float = 0.0


@dataclass
class Glass:
    ior: float = 1.5


@dataclass
class Lamp:
    """Shines from its front, and reflects nothing."""

    radiance: tuple


@dataclass
class Sphere:
    center: tuple
    radius: float
    material: str


@dataclass
class Rectangle:
    """Its front is where edge1 turns to edge2 counter-clockwise."""

    corner: tuple
    edge1: tuple
    edge2: tuple
    material: str


@dataclass
class Mesh:
    """vertices: n x 3; faces: m x 3, counter-clockwise from the front; uvs: n x 2, v upwards."""

    vertices: numpy.ndarray
    faces: numpy.ndarray
    material: str
    uvs: numpy.ndarray | None = None


@dataclass
class Scene:
    name: str
    title: str
    eye: tuple
    lookat: tuple
    fov: float  # in degrees, along both axes
    materials: dict = field(default_factory=dict)
    objects: list = field(default_factory=list)
    sky: bool = False
    caustics: bool = False  # on paths from the lights, where a renderer has them
    # What its noise is mostly of, for renderers with a setting for that.
    focused: bool = False  # light by way of metal or glass
    bounced: bool = False  # light from one diffuse surface to the next

    def of(self, shape):
        return [item for item in self.objects if isinstance(item, shape)]

    def is_textured(self):
        return any(isinstance(material, Textured) for material in self.materials.values())


def sky(rows):
    """The radiance of a sky with a sun, as a picture of longitude and latitude, its upper row first, its middle +z, -x on
    the right of that. rows: the latitudes of its rows, from 0 (+y) to 1."""
    width, height = SKY_SIZE
    longitude = ((numpy.arange(width) + 0.5) / width - 0.5) * 2 * math.pi
    polar = rows(numpy.arange(height), height)[:, None] * math.pi
    y = numpy.cos(polar) + 0 * longitude
    x, z = -numpy.sin(polar) * numpy.sin(longitude), numpy.sin(polar) * numpy.cos(longitude)
    up = numpy.clip(y, 0, 1)[..., None] ** 0.5
    colors = (1 - up) * numpy.array([0.7, 0.75, 0.8]) + up * numpy.array([0.2, 0.36, 0.75])
    colors = numpy.where(y[..., None] < 0, numpy.array([0.18, 0.16, 0.14]), colors)
    sun = numpy.array([0.48, 0.64, 0.6])
    apart = numpy.arccos(numpy.clip((x * sun[0] + y * sun[1] + z * sun[2]) / numpy.linalg.norm(sun), -1, 1))
    disk = 1500 * numpy.exp(-0.5 * (apart / math.radians(1)) ** 2)
    return (colors + disk[..., None] * numpy.array([1, 0.9, 0.75])).astype(numpy.float32)


def texture():
    """Linear colours, the upper row first."""
    side = (numpy.arange(TEXTURE_EDGE) + 0.5) / TEXTURE_EDGE * 2 * math.pi
    u, v = numpy.meshgrid(side, side)
    waves = [numpy.sin(f * u + 2 * numpy.sin(g * v)) * numpy.cos(g * v + f) for f, g in ((3, 8), (7, 5), (19, 23))]
    mixed = numpy.clip(0.5 + 0.25 * sum(waves), 0, 1)[..., None]
    return ((1 - mixed) * numpy.array([0.05, 0.12, 0.3]) + mixed * numpy.array([0.8, 0.55, 0.25])).astype(numpy.float32)


def box(center, half, angle, material):
    """Upright, turned about the vertical."""
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    corners = half * numpy.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    vertices = center + corners @ numpy.array([(c, 0, -s), (0, 1, 0), (s, 0, c)])
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    faces = [face for p, q, r, t in quads for face in ((p, q, r), (p, r, t))]
    return Mesh(vertices.astype(numpy.float32), numpy.array(faces, numpy.int32), material)


def walls(left="red", right="green", other="white"):
    """Of the box from -1 to 1, but for the side towards the viewer."""
    return [
        Rectangle((-1, -1, 1), (2, 0, 0), (0, 0, -2), other),
        Rectangle((-1, 1, -1), (2, 0, 0), (0, 0, 2), other),
        Rectangle((-1, -1, -1), (2, 0, 0), (0, 2, 0), other),
        Rectangle((-1, -1, 1), (0, 0, -2), (0, 2, 0), left),
        Rectangle((1, -1, -1), (0, 0, 2), (0, 2, 0), right),
    ]


WHITE = Diffuse((0.73, 0.73, 0.73))


def cornell(name, title, short, tall):
    scene = Scene(name, title, (0, 0, 3.9), (0, 0, 0), 39.3)
    scene.materials = {
        "white": WHITE, "red": Diffuse((0.63, 0.065, 0.05)), "green": Diffuse((0.14, 0.45, 0.091)),
        "lamp": Lamp((17, 12, 4)), "short": short, "tall": tall,
    }
    scene.bounced = isinstance(short, Diffuse)
    scene.focused = not scene.bounced
    scene.objects = walls() + [Rectangle((-0.25, 0.998, -0.2), (0.5, 0, 0), (0, 0, 0.4), "lamp")]
    if isinstance(short, Glass):
        scene.objects += [Sphere((0.4, -0.6, 0.4), 0.4, "short"), Sphere((-0.4, -0.45, -0.35), 0.5, "tall")]
    else:
        scene.objects += [box((0.35, -0.7, 0.3), (0.3, 0.3, 0.3), -17, "short")]
        scene.objects += [box((-0.35, -0.4, -0.3), (0.3, 0.6, 0.3), 20, "tall")]
    return scene


def spheres(name, title):
    r = random.Random(60)
    scene = Scene(name, title, (0, 4, 12), (0, 0.6, 0), 34, sky=True)
    scene.materials = {f"m{i}": Diffuse(tuple(0.2 + 0.6 * r.random() for _ in range(3))) for i in range(6)}
    scene.materials |= {"floor": Diffuse((0.5, 0.5, 0.5)), "metal": Metal((0.9, 0.75, 0.5), 0.3)}
    scene.objects = [Rectangle((-30, 0, 30), (60, 0, 0), (0, 0, -60), "floor")]
    while len(scene.objects) < 61:
        radius = 0.25 + 0.35 * r.random()
        center = (8 * r.random() - 4, radius, 8 * r.random() - 4)
        if all(math.dist(center, s.center) > radius + s.radius for s in scene.of(Sphere)):
            material = "metal" if len(scene.objects) % 4 == 0 else f"m{r.randrange(6)}"
            scene.objects.append(Sphere(center, radius, material))
    return scene


def terrain(name, title, cells=707):
    scene = Scene(name, title, (0, 5, 11), (0, 0, 0), 40, {"ground": Diffuse((0.6, 0.5, 0.4))}, sky=True)
    side = numpy.linspace(-8, 8, cells + 1)
    x, z = numpy.meshgrid(side, side)
    y = sum(0.9 / f * numpy.sin(1.1 * f * x + 3 * f) * numpy.cos(0.9 * f * z + f * f) for f in (1, 2.3, 5.1, 11.7, 26))
    vertices = numpy.stack([x, y, z], axis=-1).reshape(-1, 3).astype(numpy.float32)
    a = (numpy.arange(cells)[:, None] * (cells + 1) + numpy.arange(cells)).reshape(-1)
    b, c, d = a + 1, a + cells + 1, a + cells + 2
    faces = numpy.concatenate([numpy.stack([a, c, b], 1), numpy.stack([b, c, d], 1)]).astype(numpy.int32)
    scene.objects = [Mesh(vertices, faces, "ground")]
    return scene


def furnished(name, title):
    """The Cornell box without its lamp."""
    scene = cornell(name, title, Diffuse((0.6, 0.6, 0.7)), Diffuse((0.7, 0.6, 0.5)))
    scene.objects = [item for item in scene.objects if item.material != "lamp"]
    scene.bounced = False
    return scene


def lamps(name, title):
    r = random.Random(400)
    scene = furnished(name, title)
    for i in range(8):
        scene.materials[f"lamp{i}"] = Lamp(tuple(4 + 16 * r.random() for _ in range(3)))
    while len(scene.objects) < 7 + 400:
        center = tuple(1.9 * r.random() - 0.95 for _ in range(3))
        scene.objects.append(Sphere(center, 0.005 + 0.01 * r.random(), f"lamp{r.randrange(8)}"))
    return scene


def window(name, title):
    """A closed room; the sun shines through a window in its right wall on the floor."""
    scene = furnished(name, title)
    scene.sky = scene.bounced = True
    scene.eye, scene.fov = (0, 0, 0.98), 85
    right = [item for item in scene.objects if item.material == "green"]
    scene.objects = [item for item in scene.objects if item not in right]
    scene.objects.append(Rectangle((-1, -1, 1), (0, 2, 0), (2, 0, 0), "white"))  # behind the viewer
    # The window is from -0.4 to 0.6 in z and from -0.1 to 0.7 in y.
    for z0, z1, y0, y1 in ((-1, 1, -1, -0.1), (-1, 1, 0.7, 1), (-1, -0.4, -0.1, 0.7), (0.6, 1, -0.1, 0.7)):
        scene.objects.append(Rectangle((1, y0, z0), (0, 0, z1 - z0), (0, y1 - y0, 0), "green"))
    return scene


def sparks(name, title, count=25_000):
    """Tetrahedra that shine, in a mesh."""
    r = numpy.random.default_rng(100)
    scene = furnished(name, title)
    scene.materials["sparks"] = Lamp((60, 45, 30))
    centers = r.uniform(-0.97, 0.97, (count, 1, 3))
    size = r.uniform(0.0003, 0.0015, (count, 1, 1))
    corners = numpy.array([(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)])
    faces = numpy.array([(0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)])
    vertices = (centers + size * corners).reshape(-1, 3).astype(numpy.float32)
    all_faces = (4 * numpy.arange(count)[:, None, None] + faces).reshape(-1, 3).astype(numpy.int32)
    scene.objects.append(Mesh(vertices, all_faces, "sparks"))
    return scene


def grid_faces(columns, rows):
    """Of (columns + 1) x (rows + 1) vertices, row by row."""
    a = (numpy.arange(rows)[:, None] * (columns + 1) + numpy.arange(columns)).reshape(-1)
    b, c, d = a + 1, a + columns + 1, a + columns + 2
    return numpy.concatenate([numpy.stack([a, b, d], 1), numpy.stack([a, d, c], 1)]).astype(numpy.int32)


def knot(name, title, columns=1024, rows=96):
    """A textured tube, knotted, in a white room."""
    scene = furnished(name, title)
    scene.bounced = True
    scene.objects = scene.objects[:5] + [Rectangle((-0.25, 0.998, -0.2), (0.5, 0, 0), (0, 0, 0.4), "lamp")]
    scene.materials["knot"] = Textured()
    t, s = numpy.meshgrid(numpy.linspace(0, 2 * math.pi, columns + 1), numpy.linspace(0, 2 * math.pi, rows + 1))

    def center(t):
        r = 0.42 + 0.17 * numpy.cos(3 * t)
        return numpy.stack([r * numpy.cos(2 * t), r * numpy.sin(2 * t) - 0.15, 0.3 * numpy.sin(3 * t)], axis=-1)

    along = center(t + 1e-4) - center(t - 1e-4)
    along /= numpy.linalg.norm(along, axis=-1, keepdims=True)
    across = numpy.cross(along, numpy.array([0, 0, 1.0]))
    across /= numpy.linalg.norm(across, axis=-1, keepdims=True)
    up = numpy.cross(across, along)
    vertices = center(t) + 0.13 * (numpy.cos(s)[..., None] * across + numpy.sin(s)[..., None] * up)
    uvs = numpy.stack([t / (2 * math.pi), s / (2 * math.pi)], axis=-1)
    scene.objects.append(Mesh(vertices.reshape(-1, 3).astype(numpy.float32), grid_faces(columns, rows), "knot",
                              uvs.reshape(-1, 2).astype(numpy.float32)))
    return scene


def ball(center, radius, columns, rows, material):
    """Of flat faces."""
    t, s = numpy.meshgrid(numpy.linspace(0, 2 * math.pi, columns + 1), numpy.linspace(-math.pi / 2, math.pi / 2, rows + 1))
    unit = numpy.stack([numpy.cos(s) * numpy.cos(t), numpy.sin(s), -numpy.cos(s) * numpy.sin(t)], axis=-1)
    vertices = (center + radius * unit).reshape(-1, 3).astype(numpy.float32)
    faces = grid_faces(columns, rows)
    corners = vertices[faces]
    area = numpy.linalg.norm(numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    return Mesh(vertices, faces[area > 1e-9], material)


def crystal(name, title):
    """A ball of cut glass and a ring of mirrors on a floor, under a lamp."""
    scene = Scene(name, title, (0.1, 5, 2.2), (0.1, 0.2, 0.25), 36, caustics=True, focused=True)
    scene.materials = {"floor": Diffuse((0.7, 0.68, 0.65)), "lamp": Lamp((375, 340, 275)), "glass": Glass(),
                       "mirror": Metal((0.95, 0.85, 0.6))}
    t, y = numpy.meshgrid(numpy.linspace(0, 2 * math.pi, 65), numpy.array([0.001, 0.25]))
    band = numpy.stack([0.8 + 0.6 * numpy.cos(t), y, 0.35 - 0.6 * numpy.sin(t)], axis=-1)
    scene.objects = [
        Rectangle((-6, 0, 6), (12, 0, 0), (0, 0, -12), "floor"),
        Rectangle((-1.5, 3.2, -0.8), (0.2, 0, 0), (0, 0, 0.2), "lamp"),
        ball((-0.75, 0.9, -0.1), 0.5, 24, 12, "glass"),
        Mesh(band.reshape(-1, 3).astype(numpy.float32), grid_faces(64, 1), "mirror"),
    ]
    return scene


# name: what the table calls it, and what makes it.
SCENES = {
    "cornell": ("Cornell box, diffuse", lambda *names: cornell(*names, WHITE, WHITE)),
    "metals": (
        "the same with a rough metal and a mirror",
        lambda *names: cornell(*names, Metal((0.9, 0.7, 0.4), 0.3), Metal((0.9, 0.9, 0.9))),
    ),
    "glass": ("with glass spheres", lambda *names: cornell(*names, Glass(), Glass())),
    "spheres": ("60 spheres under a sky with a sun", spheres),
    "terrain": ("a million triangles under the same sky", terrain),
    "lamps": ("400 small lamps in a room", lamps),
    "window": ("a room lit through a window", window),
    "sparks": ("100,000 lamps: a mesh that shines", sparks),
    "knot": ("a textured mesh of 200,000 triangles", knot),
    "crystal": ("caustics of cut glass and a mirror", crystal),
}


def make(name):
    title, maker = SCENES[name]
    return maker(name, title)
