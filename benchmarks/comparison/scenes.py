"""The scenes that are compared, in no renderer's language. Standard library only; the same scene on every machine.

All that the renderers share is in them: a pinhole camera, point lights with shadows and no fall-off with distance,
matte materials, a background where nothing is hit, no ambient light. A hit shows

    color / pi * sum over the unshadowed lights of radiance * cos(angle of incidence)
"""

import math
import random
from dataclasses import dataclass, field

EYE = (0.0, 8.0, 30.0)
LOOKAT = (0.0, 0.0, 0.0)
VIEW_HEIGHT = 1024 / 1500  # of what is seen, over its distance
BACKGROUND = (0.0, 0.0, 1.0)  # no material is without red, so this colour in a picture means that nothing was hit
FLOOR = ((0.0, -4.0, 0.0), (0.0, 1.0, 0.0))  # a point of the plane, and its normal
MATERIALS = 8
LIGHT = 0.9  # what all lights together make of a white floor under them


@dataclass
class Light:
    location: tuple
    radiance: float


@dataclass
class Sphere:
    center: tuple
    radius: float
    material: int


@dataclass
class Cylinder:
    """Open: without caps."""

    bottom: tuple
    top: tuple
    radius: float
    material: int


@dataclass
class Torus:
    center: tuple
    axis: tuple
    swept_radius: float
    tube_radius: float
    material: int


@dataclass
class Triangle:
    corners: tuple
    material: int


@dataclass
class Scene:
    """The last material is that of the floor, which every scene has."""

    name: str
    title: str
    width: int = 1024
    height: int = 1024
    samples: int = 16
    lights: list = field(default_factory=list)
    materials: list = field(default_factory=list)
    objects: list = field(default_factory=list)

    def of(self, shape):
        return [item for item in self.objects if isinstance(item, shape)]

    def shapes(self):
        return {type(item) for item in self.objects}


class Generator:
    """Objects at random places in a box; n of them fill the same share of it, however many there are."""

    def __init__(self, count):
        self.random = random.Random(count)
        self.size = 4 / count ** (1 / 3)

    def point(self):
        r = self.random.random
        return (16 * r() - 8, 10 * r() - 3, 16 * r() - 8)

    def direction(self):
        while True:
            v = tuple(2 * self.random.random() - 1 for _ in range(3))
            length = math.sqrt(sum(x * x for x in v))
            if 0.1 < length < 1:
                return tuple(x / length for x in v)

    def extent(self):
        return self.size * (0.3 + 0.7 * self.random.random())

    def material(self):
        return self.random.randrange(MATERIALS)

    def sphere(self):
        return Sphere(self.point(), self.extent(), self.material())

    def cylinder(self):
        bottom, axis, length = self.point(), self.direction(), 2 * self.extent()
        top = tuple(a + length * b for a, b in zip(bottom, axis))
        return Cylinder(bottom, top, 0.4 * self.extent(), self.material())

    def torus(self):
        swept = self.extent()
        tube = swept * (0.15 + 0.35 * self.random.random())
        return Torus(self.point(), self.direction(), swept, tube, self.material())

    def triangle(self):
        center, size = self.point(), 1.5 * self.extent()
        corners = tuple(tuple(a + size * b for a, b in zip(center, self.direction())) for _ in range(3))
        return Triangle(corners, self.material())


def lights(count):
    """In a ring above; one alone stands at the front right."""
    result = []
    for i in range(count):
        angle = 0.98 + 2 * math.pi * i / count
        result.append(Light((36 * math.cos(angle), 40.0, 36 * math.sin(angle)), math.pi * LIGHT / count))
    return result


def cloud(name, title, count, kinds, light_count=1, **settings):
    """`count` objects, whose shapes take turns."""
    generator = Generator(count)
    colors = random.Random(7)
    scene = Scene(name, title, lights=lights(light_count), **settings)
    scene.materials = [tuple(0.2 + 0.8 * colors.random() for _ in range(3)) for _ in range(MATERIALS)]
    scene.materials.append((0.6, 0.6, 0.6))
    makers = [getattr(generator, kind) for kind in kinds]
    scene.objects = [makers[i % len(makers)]() for i in range(count)]
    return scene


# name: what the table calls it, and what it is made of.
SCENES = {
    "spheres-10": ("10 spheres", 10, ["sphere"], {}),
    "spheres-1k": ("1,000 spheres", 1000, ["sphere"], {}),
    "spheres-100k": ("100,000 spheres", 100_000, ["sphere"], {}),
    "spheres-1m": ("1,000,000 spheres", 1_000_000, ["sphere"], {}),
    "cylinders-10k": ("10,000 cylinders", 10_000, ["cylinder"], {}),
    "tori-1k": ("1,000 tori", 1000, ["torus"], {}),
    "tori-10k": ("10,000 tori", 10_000, ["torus"], {}),
    "triangles-100k": ("100,000 triangles", 100_000, ["triangle"], {}),
    "mix-5k": ("5,000 of all five shapes", 5000, ["sphere", "cylinder", "torus", "triangle"], {}),
    "mix-without-tori-5k": ("5,000, all but tori", 5000, ["sphere", "cylinder", "triangle"], {}),
    "lights-16": ("1,000 spheres, 16 lights", 1000, ["sphere"], {"light_count": 16}),
    "4k": ("1,000 spheres, 3840 x 2160, 1 sample", 1000, ["sphere"], {"width": 3840, "height": 2160, "samples": 1}),
    "samples-256": (
        "1,000 spheres, 512 x 512, 256 samples",
        1000,
        ["sphere"],
        {"width": 512, "height": 512, "samples": 256},
    ),
}


def make(name):
    title, count, kinds, settings = SCENES[name]
    return cloud(name, title, count, kinds, **settings)
