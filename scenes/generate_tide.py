#!/usr/bin/env python3
"""Writes gallery/tide.xml: columns in a honeycomb, as high as three waves that meet."""
import math

from scene_xml import Scene, palette, srgb

SHADES = 32
STOPS = [srgb(c) for c in ("#12204a", "#1f4e79", "#2a8c9b", "#7fc8a9", "#f4e3b2", "#f7b267", "#e8654f")]

scene = Scene("Columns in a honeycomb, as high as three waves that meet.")
scene.viewplane(960, 640, 16, srgb("#12203c"))
scene.camera((26, 30, 34), (0, 1.2, -1), 1230)
scene.ambient(1, srgb("#7d9bd1"))
scene.sun(12, (-0.9, 0.75, 0.25), 0.06, 3.7, srgb("#ffdcb0"))
scene.sky(40, 0.5, srgb("#a9c8ff"), srgb("#5b7fd6"))

for shade in range(SHADES):
    tint = palette(STOPS, shade / (SHADES - 1))
    scene.matte(f"side{shade}", 0.06, 0.8, tint)
    scene.matte(f"top{shade}", 0.06, 0.95, tint)
scene.matte("sea", 0.06, 0.8, srgb("#12204a"))


def wave(x, z, source_x, source_z, length):
    return math.cos(2 * math.pi * math.hypot(x - source_x, z - source_z) / length)


for row in range(-34, 35):
    for column in range(-34, 35):
        x = column + 0.5 * (row % 2)
        z = row * math.sqrt(3) / 2
        if math.hypot(x, z) > 24:
            continue
        height = wave(x, z, -13, 6, 13) + wave(x, z, 15, 10, 17) + wave(x, z, 3, -21, 15)
        level = (height + 3) / 6
        top = 0.2 + 7.5 * level**1.3
        shade = round(level * (SHADES - 1))
        scene.cylinder((x, -6, z), (x, top, z), 0.46, f"side{shade}")
        scene.disk((x, top, z), (0, 1, 0), 0.46, f"top{shade}")
scene.plane((0, -6, 0), (0, 1, 0), "sea")

scene.write(__file__, "tide")
