"""Writes scene files: what the generate_*.py scripts share. Python 3.8 or later, standard library only.

Numbers are rounded to a fixed number of digits, so that every machine writes the same bytes.
"""
import math
import os


def number(value):
    text = f"{value:.4f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


class Keys:
    """A vector that changes from frame to frame: values maps frames to vectors, joined without corners."""

    def __init__(self, values):
        self.values = values


def vector(name, v):
    if isinstance(v, Keys):
        keys = "".join(f'<key frame="{f}" {coordinates(c)} interpolation="smooth"/>' for f, c in v.values.items())
        return f"<{name}>{keys}</{name}>"
    return f"<{name} {coordinates(v)}/>"


def coordinates(v):
    return f'x="{number(v[0])}" y="{number(v[1])}" z="{number(v[2])}"'


def color(name, c):
    return f'<{name} red="{number(c[0])}" green="{number(c[1])}" blue="{number(c[2])}"/>'


def srgb(hexadecimal):
    """The linear colour of "#rrggbb", which screens and palettes mean as sRGB."""

    def linear(s):
        return s / 12.92 if s <= 0.04045 else ((s + 0.055) / 1.055) ** 2.4

    return tuple(linear(int(hexadecimal[i : i + 2], 16) / 255) for i in (1, 3, 5))


def mix(a, b, t):
    return tuple(x + (y - x) * t for x, y in zip(a, b))


def palette(stops, t):
    """The colour at t in [0, 1] of evenly spaced stops."""
    place = min(max(t, 0.0), 1.0) * (len(stops) - 1)
    i = min(int(place), len(stops) - 2)
    return mix(stops[i], stops[i + 1], place - i)


def add(a, b, scale=1.0):
    return tuple(x + scale * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    length = math.sqrt(sum(x * x for x in a))
    return tuple(x / length for x in a)


def write_gallery(name, text):
    """Writes gallery/<name>.xml beside this file."""
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "gallery", name + ".xml")
    with open(path, "w", encoding="utf-8", newline="\n") as file:
        file.write(text)


class Scene:
    """Collects a scene's elements, one line each; write() puts them into their groups."""

    def __init__(self, comment):
        self.comment = comment
        self.head = []
        self.lights = {}
        self.materials = {}
        self.objects = {}

    def viewplane(self, hres, vres, samples, background):
        self.head.append(
            f"<viewplane><hres>{hres}</hres><vres>{vres}</vres><samples>{samples}</samples>"
            f"{color('background', background)}</viewplane>"
        )

    def camera(self, eye, lookat, viewdistance):
        self.head.append(
            f"<camera>{vector('eye', eye)}{vector('lookat', lookat)}"
            f"<viewdistance>{number(viewdistance)}</viewdistance></camera>"
        )

    def ambient(self, radiance, tint=(1, 1, 1)):
        self.lights[""] = [
            f"<ambientlight><scaleradiance>{number(radiance)}</scaleradiance>{color('color', tint)}</ambientlight>"
        ]

    def directional(self, direction, radiance, tint=(1, 1, 1)):
        self.lights.setdefault("directionallights", []).append(
            f"<directionallight>{vector('direction', direction)}"
            f"<scaleradiance>{number(radiance)}</scaleradiance>{color('color', tint)}</directionallight>"
        )

    def point(self, location, radiance, tint=(1, 1, 1)):
        self.lights.setdefault("pointlights", []).append(
            f"<pointlight>{vector('location', location)}"
            f"<scaleradiance>{number(radiance)}</scaleradiance>{color('color', tint)}</pointlight>"
        )

    def sky(self, count, brightness, zenith, horizon):
        """A sky of `count` directional lights, evenly spread; a white floor under it is `brightness` bright."""
        for i in range(count):
            height = (i + 0.5) / count
            around = i * math.pi * (3 - math.sqrt(5))
            side = math.sqrt(1 - height * height)
            self.directional(
                (side * math.cos(around), height, side * math.sin(around)),
                2 * math.pi * brightness / count,
                mix(horizon, zenith, height),
            )

    def sun(self, count, direction, spread, radiance, tint):
        """A sun with soft shadows: `count` directional lights within `spread` radians of `direction`."""
        w = unit(direction)
        u = unit(cross(w, (0.3, 1.0, 0.2)))
        v = cross(w, u)
        for i in range(count):
            r = spread * math.sqrt((i + 0.5) / count)
            around = i * math.pi * (3 - math.sqrt(5))
            d = add(add(w, u, r * math.cos(around)), v, r * math.sin(around))
            self.directional(d, radiance / count, tint)

    def matte(self, name, ka, kd, cd):
        self.materials.setdefault("mattes", []).append(
            f"<matte><name>{name}</name><ka>{number(ka)}</ka><kd>{number(kd)}</kd>{color('cd', cd)}</matte>"
        )

    def phong(self, name, ka, kd, ks, cd, cs=(1, 1, 1), exp=40):
        self.materials.setdefault("phongs", []).append(
            f"<phong><name>{name}</name><ka>{number(ka)}</ka><kd>{number(kd)}</kd><ks>{number(ks)}</ks>"
            f"{color('cd', cd)}{color('cs', cs)}<exp>{number(exp)}</exp></phong>"
        )

    def plane(self, point, normal, material):
        self._add("plane", vector("point", point) + vector("normal", normal), material)

    def sphere(self, center, radius, material):
        self._add("sphere", f"{vector('center', center)}<radius>{number(radius)}</radius>", material)

    def triangle(self, a, b, c, material):
        corners = "".join(vector(f"vertexposition{i}", v) for i, v in enumerate((a, b, c), 1))
        self._add("triangle", corners, material)

    def cylinder(self, bottom, top, radius, material):
        ends = vector("bottom", bottom) + vector("top", top)
        self._add("cylinder", f"{ends}<radius>{number(radius)}</radius>", material)

    def torus(self, center, axis, sweptradius, tuberadius, material):
        radii = f"<sweptradius>{number(sweptradius)}</sweptradius><tuberadius>{number(tuberadius)}</tuberadius>"
        self._add("torus", vector("center", center) + vector("axis", axis) + radii, material)

    def disk(self, center, normal, radius, material):
        place = vector("center", center) + vector("normal", normal)
        self._add("disk", f"{place}<radius>{number(radius)}</radius>", material)

    def _add(self, element, parameters, material):
        group = "toruses" if element == "torus" else element + "s"
        line = f"<{element}>{parameters}<material>{material}</material></{element}>"
        self.objects.setdefault(group, []).append(line)

    def write(self, script, name):
        """Writes gallery/<name>.xml beside this file."""
        lines = [f"<!-- {self.comment} Made by scenes/{os.path.basename(script)}. -->", "<raytracer>"]
        lines += ["  " + line for line in self.head]
        for section, groups in (("lights", self.lights), ("materials", self.materials), ("objects", self.objects)):
            lines.append(f"  <{section}>")
            for group, items in groups.items():
                if group:
                    lines.append(f"    <{group}>")
                lines += ["      " + item for item in items]
                if group:
                    lines.append(f"    </{group}>")
            lines.append(f"  </{section}>")
        lines.append("</raytracer>")
        write_gallery(name, "\n".join(lines) + "\n")
