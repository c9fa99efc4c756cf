#!/usr/bin/env python3
"""Writes gallery/turntable.xml: a display that the camera goes around in 48 frames, while its parts move."""
import math

from scene_xml import Keys, Scene, add, palette, srgb

FRAMES = 48  # frame 49 would be frame 1 again
PALETTE = [srgb(c) for c in ("#e4572e", "#f3a712", "#a8c686", "#2a9d8f", "#3d5a80", "#7b4b94", "#d1495b", "#e4572e")]


def turning(count, vector_at):
    """Keys at `count` even steps of the turn: vector_at(t), t in [0, 1]."""
    return Keys({1 + FRAMES * i // count: vector_at(i / count) for i in range(count + 1)})


def around(t, radius, height):
    return (radius * math.sin(2 * math.pi * t), height, radius * math.cos(2 * math.pi * t))


scene = Scene(f"A turntable of {FRAMES} frames.")
scene.viewplane(960, 720, 16, srgb("#e9e2d6"))
scene.camera(turning(24, lambda t: around(t, 17.5, 7.4 + 0.9 * math.sin(2 * math.pi * t))), (0, 1.05, 0), 1440)
scene.ambient(1, srgb("#c9c6d6"))
scene.sun(16, (-0.7, 1.1, 0.45), 0.09, 2.4, srgb("#fff1dc"))
scene.sky(32, 0.3, srgb("#dce9ff"), srgb("#b9cbe6"))
scene.point((9, 5, -8), 0.7, srgb("#ff9a6b"))
scene.matte("floor", 0.2, 0.85, srgb("#e9e2d6"))
scene.matte("stone", 0.16, 0.85, srgb("#8c8792"))
scene.phong("gold", 0.12, 0.75, 0.3, srgb("#e0a83a"), srgb("#ffe6a8"), 40)
scene.phong("pearl", 0.14, 0.8, 0.25, srgb("#f2ece4"), srgb("#ffffff"), 80)
scene.matte("gem 0", 0.16, 0.9, srgb("#2a9d8f"))
scene.matte("gem 1", 0.16, 0.9, srgb("#52c7b8"))

# The table, in two steps.
scene.plane((0, -0.9, 0), (0, 1, 0), "floor")
for bottom, top, radius in ((-0.9, -0.45, 4.9), (-0.45, 0, 4.2)):
    scene.cylinder((0, bottom, 0), (0, top, 0), radius, "stone")
    scene.disk((0, top, 0), (0, 1, 0), radius, "stone")
scene.torus((0, 0, 0), (0, 1, 0), 4.2, 0.09, "gold")
scene.torus((0, -0.45, 0), (0, 1, 0), 4.9, 0.09, "gold")

# A ring of columns, each with a ball that rises and sinks; one wave runs around the table.
COLUMNS = 16
for i in range(COLUMNS):
    place = i / COLUMNS
    name = f"hue {i}"
    scene.phong(name, 0.15, 0.8, 0.15, palette(PALETTE, place), srgb("#ffffff"), 30)
    x, _, z = around(place, 3.35, 0)
    height = 0.55 + 0.25 * math.sin(4 * math.pi * place)
    scene.cylinder((x, 0, z), (x, height, z), 0.3, name)
    scene.disk((x, height, z), (0, 1, 0), 0.3, name)
    bob = turning(8, lambda t: (x, height + 0.75 + 0.4 * math.cos(2 * math.pi * (2 * t - place)), z))
    scene.sphere(bob, 0.36, name)

# In the middle a gem, within rings that tumble against each other.
GEM = (0, 2.35, 0)
ring = [around((i + 0.5) / 6, 0.95, GEM[1]) for i in range(6)]
for i in range(6):
    for tip in (1.35, -1.35):
        scene.triangle(ring[i], ring[(i + 1) % 6], add(GEM, (0, tip, 0)), f"gem {i % 2}")
for sign, radius, material in ((2, 1.7, "gold"), (-1, 2.05, "pearl")):
    scene.torus(GEM, turning(16, lambda t: around(sign * t, 1.0, 0.6)), radius, 0.11, material)

scene.write(__file__, "turntable")
