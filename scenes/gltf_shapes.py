"""Triangles of round things: what generate_gltf_features.py shows. Python 3.8 or later, standard library only."""
import math
from collections import namedtuple

from scene_xml import add, cross, unit

# Lists of vectors, and of the numbers of the triangles' corners.
Shape = namedtuple("Shape", "positions normals uvs indices")


def surface(f, columns, rows):
    """f(u, v) is a point; v grows downwards where u grows to the right, as the surface is seen from outside."""
    positions, normals, uvs, indices = [], [], [], []
    for j in range(rows + 1):
        for i in range(columns + 1):
            u, v = i / columns, j / rows
            positions.append(f(u, v))
            uvs.append((u, v))
            step, inside = 1e-4, min(max(v, 1e-3), 1 - 1e-3)  # poles have no normals of their own
            along_u = add(f(u + step, inside), f(u - step, inside), -1)
            along_v = add(f(u, inside + step), f(u, inside - step), -1)
            normals.append(unit(cross(along_v, along_u)))
    for j in range(rows):
        for i in range(columns):
            a, b = j * (columns + 1) + i, (j + 1) * (columns + 1) + i
            for face in ((a, b, b + 1), (a, b + 1, a + 1)):
                if len({tuple(round(x, 9) for x in positions[k]) for k in face}) == 3:
                    indices += face
    return Shape(positions, normals, uvs, indices)


def lathe(profile, columns=72, rows=48):
    """profile(v) is a radius and a height, from the top to the bottom; u = 0.5 is in front."""
    def point(u, v):
        radius, height = profile(v)
        around = 2 * math.pi * (u - 0.5)
        return radius * math.sin(around), height, radius * math.cos(around)

    return surface(point, columns, rows)


def curve(*points):
    """A profile that is smooth through points, each a radius and a height (Catmull-Rom)."""
    def profile(v):
        place = min(max(v, 0), 1) * (len(points) - 1)
        i = min(int(place), len(points) - 2)
        t = place - i
        a, b, c, d = (points[min(max(k, 0), len(points) - 1)] for k in range(i - 1, i + 3))
        return tuple(q + t / 2 * (r - p + t * (2 * p - 5 * q + 4 * r - s + t * (3 * (q - r) + s - p)))
                     for p, q, r, s in zip(a, b, c, d))

    return profile


def sphere(radius=1.0, columns=72, rows=36):
    """It stands on the floor."""
    return lathe(lambda v: (radius * math.sin(math.pi * v), radius * (1 + math.cos(math.pi * v))), columns, rows)


def knot(radius=1.0, tube=0.3, columns=240, rows=20):
    """A trefoil, which winds three times around a torus of that radius while it goes around twice; upright."""
    def middle(u):
        around, across = 4 * math.pi * u, 6 * math.pi * u
        out = radius * (1 + 0.42 * math.cos(across))
        return out * math.sin(around), out * math.cos(around), radius * 0.42 * math.sin(across)

    def point(u, v):
        center = middle(u)
        along = unit(add(middle(u + 1e-4), middle(u - 1e-4), -1))
        around = 4 * math.pi * u
        out = add(center, (radius * math.sin(around), radius * math.cos(around), 0), -1)
        side = unit(cross(along, out))
        out = cross(side, along)
        turn = 2 * math.pi * v
        return add(add(center, out, tube * math.cos(turn)), side, tube * math.sin(turn))

    return surface(point, columns, rows)


def rounded_box(size, radius, steps=6):
    """About the origin; each side has all of a texture."""
    def places(half):
        edge = [-half + radius * (1 - math.tan(math.pi / 4 * (1 - i / steps))) for i in range(steps + 1)]
        return edge + [-x for x in reversed(edge)]

    half = [x / 2 for x in size]
    positions, normals, uvs, indices = [], [], [], []
    for axis in range(3):
        for side in (-1, 1):
            # Where the side faces the viewer, s goes to the right, and t upwards.
            s, t = ((2, 1), (0, 2), (0, 1))[axis]
            to_right = (-side, 1, side)[axis]
            upwards = (1, -side, 1)[axis]
            columns, rows, first = places(half[s]), places(half[t]), len(positions)
            for y in reversed(rows):
                for x in columns:
                    p = [0.0, 0.0, 0.0]
                    p[axis], p[s], p[t] = side * half[axis], x * to_right, y * upwards
                    inner = [min(max(c, radius - h), h - radius) for c, h in zip(p, half)]
                    normals.append(unit(add(p, inner, -1)))
                    positions.append(add(inner, normals[-1], radius))
                    uvs.append((x / (2 * half[s]) + 0.5, 0.5 - y / (2 * half[t])))
            width = len(columns)
            for j in range(len(rows) - 1):
                for i in range(width - 1):
                    a, b = first + j * width + i, first + (j + 1) * width + i
                    indices += [a, b, b + 1, a, b + 1, a + 1]
    return Shape(positions, normals, uvs, indices)


def panel(width, height, uv_from=(0, 0), uv_to=(1, 1)):
    """Upright, on the floor, and seen from the front; v goes downwards."""
    x, (u0, v0), (u1, v1) = width / 2, uv_from, uv_to
    return Shape([(-x, height, 0), (-x, 0, 0), (x, 0, 0), (x, height, 0)], [(0, 0, 1)] * 4,
                 [(u0, v0), (u0, v1), (u1, v1), (u1, v0)], [0, 1, 2, 0, 2, 3])


VASE = curve((0.36, 1.75), (0.33, 2.05), (0.4, 2.36), (0.46, 2.4), (0.44, 2.34), (0.36, 2.05), (0.42, 1.7), (0.75, 1.3),
             (0.86, 0.85), (0.66, 0.35), (0.5, 0.08), (0.48, 0), (0, 0))
PAWN = curve((0, 2.3), (0.3, 2.22), (0.46, 1.88), (0.32, 1.52), (0.2, 1.42), (0.44, 1.36), (0.42, 1.3), (0.2, 1.22), (0.2, 0.8),
             (0.34, 0.36), (0.66, 0.24), (0.72, 0.12), (0.7, 0), (0, 0))
COLUMN = curve((0, 3), (0.46, 3), (0.46, 2.8), (0.32, 2.66), (0.34, 1.5), (0.36, 0.4), (0.5, 0.24), (0.5, 0), (0, 0))
DOME = curve((0, 0.5), (0.42, 0.46), (0.78, 0.32), (0.97, 0.12), (1, 0), (0.98, -0.12), (0, -0.12))
