#!/usr/bin/env python3
"""Writes gallery/chain.xml: a chain of rings, gold and steel in turn, tied into a trefoil knot."""
import math

from scene_xml import Scene, add, cross, srgb, unit

LINKS = 76
STEPS = 20_000


def knot(t):
    """A trefoil knot in the xy plane, t in [0, 1)."""
    a = 2 * math.pi * t
    return (
        3.4 * (math.sin(a) + 2 * math.sin(2 * a)),
        3.4 * (math.cos(a) - 2 * math.cos(2 * a)),
        -4.0 * math.sin(3 * a),
    )


# The links' places, evenly spaced along the curve.
points = [knot(i / STEPS) for i in range(STEPS + 1)]
lengths = [0.0]
for a, b in zip(points, points[1:]):
    lengths.append(lengths[-1] + math.dist(a, b))
spacing = lengths[-1] / LINKS

scene = Scene("A chain of rings, tied into a trefoil knot.")
scene.viewplane(960, 720, 16, srgb("#0d2127"))
scene.camera((3, -7, 46), (0.3, -0.7, 0), 1440)
scene.ambient(1, srgb("#9fc3cc"))
scene.sun(20, (-0.6, 0.7, 0.75), 0.12, 3.4, srgb("#fff0d8"))
scene.sky(40, 0.4, srgb("#cfeaff"), srgb("#86b7d9"))
scene.point((30, -12, 22), 1.3, srgb("#ff8a5c"))
scene.point((-34, 6, -4), 1.5, srgb("#4fd0ff"))
scene.phong("gold", 0.1, 0.75, 0.3, srgb("#e0a83a"), srgb("#ffe6a8"), 35)
scene.phong("steel", 0.1, 0.6, 0.3, srgb("#8fb5c4"), srgb("#eaf7ff"), 50)
scene.matte("wall", 0.08, 0.9, srgb("#2f8a93"))

step = 0
for link in range(LINKS):
    while lengths[step] < link * spacing:
        step += 1
    center = points[step % STEPS]
    tangent = unit(add(points[(step + 1) % STEPS], points[(step - 1) % STEPS], -1))
    # Neighbours stand across each other.
    side = unit(cross(tangent, (0, 0, 1)))
    up = cross(tangent, side)
    axis = add(side, up, 0.9 if link % 2 else -1.1)
    scene.torus(center, axis, spacing / 1.42, spacing / 1.42 * 0.26, "steel" if link % 2 else "gold")
scene.plane((0, 0, -6), (0, 0, 1), "wall")

scene.write(__file__, "chain")
