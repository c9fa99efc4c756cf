#!/usr/bin/env python3
"""Writes gallery/ripples.xml: 10,000 spheres on the spiral of a sunflower's seeds, in rings of waves."""
import math

from scene_xml import Scene, palette, srgb

COUNT = 10_000
SHADES = 48
STOPS = [srgb(c) for c in ("#fff1c9", "#ffb35c", "#f2545b", "#a4268b", "#4a2bb0", "#1d6fd8", "#17b7b0")]

scene = Scene("10,000 spheres on a sunflower's spiral.")
scene.viewplane(960, 640, 16, srgb("#0b0a17"))
scene.camera((0, 84, 90), (0, -7, 10.5), 895)
scene.ambient(1, srgb("#8f88c9"))
scene.sun(12, (-0.75, 0.62, 0.1), 0.07, 4, srgb("#ffe2c2"))
scene.sky(24, 0.42, srgb("#ffffff"), srgb("#8fa4ff"))
scene.point((75, 30, -30), 1.5, srgb("#6f8cff"))
scene.point((0, 20, -95), 1.2, srgb("#ff6fb0"))

for shade in range(SHADES):
    scene.phong(f"shade{shade}", 0.1, 1, 0.1, palette(STOPS, shade / (SHADES - 1)), exp=30)

for i in range(COUNT):
    spread = math.sqrt((i + 0.5) / COUNT)  # even density: the radius grows with the root of the index
    around = i * math.pi * (3 - math.sqrt(5))
    r = 52 * spread
    height = 5.2 * math.cos(r * 0.46) * math.exp(-1.5 * spread) - 9 * spread * spread
    radius = 0.36 + 0.15 * math.cos(r * 0.46)
    shade = round(spread * (SHADES - 1))
    scene.sphere((r * math.cos(around), height, r * math.sin(around)), radius, f"shade{shade}")

scene.write(__file__, "ripples")
