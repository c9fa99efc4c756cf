#!/usr/bin/env python3
"""Writes gallery/dusk.xml: a low-poly mountain lake of triangles under a setting sun of disks."""
import math

from scene_xml import Scene, add, cross, mix, srgb, unit

COLUMNS, ROWS = 72, 64


def hashed(i, j, salt):
    """A repeatable random number in [0, 1) for a grid point."""
    h = (i * 374761393 + j * 668265263 + salt * 2147483647) & 0xFFFFFFFF
    h = ((h ^ (h >> 13)) * 1274126177) & 0xFFFFFFFF
    h = ((h ^ (h >> 16)) * 2246822519) & 0xFFFFFFFF
    return ((h ^ (h >> 15)) & 0xFFFFFF) / 0x1000000


def noise(x, y, salt):
    """Smooth noise in [0, 1] with features of size 1."""
    i, j = math.floor(x), math.floor(y)
    u, v = x - i, y - j
    u, v = u * u * (3 - 2 * u), v * v * (3 - 2 * v)
    low = hashed(i, j, salt) * (1 - u) + hashed(i + 1, j, salt) * u
    high = hashed(i, j + 1, salt) * (1 - u) + hashed(i + 1, j + 1, salt) * u
    return low * (1 - v) + high * v


def height(x, z):
    """Ridges that grow into the distance and to the sides of a valley with a lake."""
    ridges = 0.0
    for octave in range(4):
        f = 2**octave
        ridges += (1 - abs(2 * noise(x * 0.055 * f + 3.1, z * 0.055 * f + 7.7, octave) - 1)) / f
    valley = x - 5 - 6 * math.sin(z * 0.05)
    rise = min(1.0, (valley / 26) ** 2) + 0.75 * min(1.0, max(0.0, (-z - 50) / 45))
    return 13.5 * (ridges - 0.75) * (0.12 + rise) - 1.9


scene = Scene("A mountain lake of triangles under a setting sun.")
scene.viewplane(960, 640, 16, srgb("#f6a889"))
scene.camera((2, 7.5, 30), (5, 7.8, -40), 1000)
scene.ambient(1)
scene.sun(6, (0.82, 0.5, 0.12), 0.04, 2.7, srgb("#ffb27a"))
scene.directional((-0.6, 0.7, 0.5), 1.0, srgb("#8c7cff"))

# The sun and its halo shine by their ambient coefficient alone, before a sky of the background's colour.
sky, glow = srgb("#f6a889"), srgb("#fff0c4")
for ring in range(6):
    scene.matte(f"halo{ring}", 1, 0, mix(glow, sky, (ring / 6) ** 0.6))
    scene.disk((22, 27, -240 - ring), (0, 0, 1), 12 + 8.5 * ring**1.15, f"halo{ring}")

HAZE = 12
kinds = {"snow": "#fbeef0", "rock": "#8a5a78", "wood": "#3f4f6b"}
for kind, tint in kinds.items():
    for band in range(HAZE):
        t = (band / (HAZE - 1)) ** 1.3 * 0.85
        # Distance turns a surface into the colour of the sky.
        scene.matte(f"{kind}{band}", 0.13 + 0.6 * t, 0.85 * (1 - t), mix(srgb(tint), srgb("#e58b8f"), t))
scene.phong("lake", 0.3, 0.5, 0.5, srgb("#7486bd"), srgb("#ffb690"), 18)
scene.plane((0, 0, 0), (0, 1, 0), "lake")


def corner(i, j):
    """The grid is finer near the viewer, and its points are shaken."""
    depth = (j + 0.6 * (hashed(i, j, 21) - 0.5)) / ROWS
    z = 24 - 30 * depth - 130 * depth * depth
    x = (i + 0.6 * (hashed(i, j, 20) - 0.5)) / COLUMNS - 0.5
    x *= 60 + 110 * depth
    return (x + 5, height(x + 5, z), z)


def add_triangle(a, b, c):
    middle = tuple((p + q + r) / 3 for p, q, r in zip(a, b, c))
    if max(a[1], b[1], c[1]) < -0.2 or middle[2] > 5:
        return  # below the lake, or a corner of the shore in the picture's own corner
    slope = abs(unit(cross(add(b, a, -1), add(c, a, -1)))[1])
    kind = "wood" if middle[1] < 2.6 else "snow" if middle[1] > 7.5 - 4 * (slope - 0.5) else "rock"
    band = min(HAZE - 1, max(0, int((24 - middle[2]) / 160 * HAZE)))
    scene.triangle(a, b, c, f"{kind}{band}")


for j in range(ROWS):
    for i in range(COLUMNS):
        a, b, c, d = corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)
        if (i + j) % 2:
            add_triangle(a, b, c)
            add_triangle(a, c, d)
        else:
            add_triangle(a, b, d)
            add_triangle(b, c, d)

# The sun's path on the water: flat glints on the line from the viewer to the sun, the nearer the wider.
scene.matte("glint", 0.8, 0, glow)
for i in range(26):
    z = 6 - 58 * (i / 26) ** 1.25
    x = 2 + (30 - z) * 20 / 270 + 1.6 * (hashed(i, 0, 30) - 0.5)
    wide = (0.5 + 1.5 * hashed(i, 1, 30)) * (1 + 0.012 * (30 - z))
    deep = 0.1 + 0.0035 * (30 - z) ** 1.2
    left, right = (x - wide, 0.03, z), (x + wide, 0.03, z)
    scene.triangle(left, right, (x + 0.2 * wide, 0.03, z - deep), "glint")
    scene.triangle(left, right, (x - 0.2 * wide, 0.03, z + deep), "glint")

scene.write(__file__, "dusk")
