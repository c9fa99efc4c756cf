#!/usr/bin/env python3
"""Writes gallery/helix.xml: a double helix of spheres, its strands joined by rods of two colours."""
import math

from scene_xml import Scene, add, srgb

PAIRS = 110
scene = Scene("A double helix of spheres and rods.")
scene.viewplane(720, 960, 16, srgb("#070b14"))
scene.camera((0, 4, 60), (0, 0, 0), 1560)
scene.ambient(1, srgb("#7a8cc0"))
scene.sun(8, (-0.5, 0.6, 0.9), 0.05, 2.9, srgb("#fff4e6"))
scene.point((40, -20, 10), 1.6, srgb("#ff4f8b"))
scene.point((-40, 10, -12), 1.8, srgb("#35b6ff"))

strand_colors = ("#ff7a59", "#34c3c9")
rod_colors = ("#ffd166", "#ef476f", "#06d6a0", "#7b61ff")
for i, c in enumerate(strand_colors):
    scene.phong(f"strand{i}", 0.08, 0.85, 0.25, srgb(c), exp=60)
for i, c in enumerate(rod_colors):
    scene.phong(f"rod{i}", 0.08, 0.85, 0.12, srgb(c), exp=30)

for i in range(PAIRS):
    along = (i - (PAIRS - 1) / 2) * 0.62
    angle = i * 2 * math.pi / 21
    # The axis leans to the right and away from the viewer.
    axis = (0.46, 0.84, -0.29)
    side, depth = (0.9, -0.42, 0.06), (-0.07, -0.29, -0.95)
    center = tuple(along * a for a in axis)
    ends = []
    for strand in (0, 1):
        turn = angle + strand * 0.72 * math.pi
        out = tuple(5.2 * (math.cos(turn) * s + math.sin(turn) * d) for s, d in zip(side, depth))
        ends.append(add(center, out))
    for strand, end in enumerate(ends):
        scene.sphere(end, 0.85, f"strand{strand}")
    kind = (i * 7 + i // 3 * 5) % 4
    middle = tuple((a + b) / 2 for a, b in zip(*ends))
    scene.cylinder(ends[0], middle, 0.26, f"rod{kind}")
    scene.cylinder(middle, ends[1], 0.26, f"rod{(kind + 2) % 4}")

scene.write(__file__, "helix")
