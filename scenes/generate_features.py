#!/usr/bin/env python3
"""Writes the small scenes beside this file, one a feature: the pictures of docs/scene-format.md."""
import base64
import json
import math
import os
import random
import struct
import zlib

HERE = os.path.dirname(os.path.abspath(__file__))

ROOM = """\
  <viewplane>
    <hres>320</hres> <vres>240</vres> <samples>16</samples> <background red="0.04" green="0.06" blue="0.09"/>
  </viewplane>
  <camera> <eye x="0" y="2.2" z="8"/> <lookat x="0" y="0.9" z="0"/> <viewdistance>520</viewdistance> </camera>
"""
LIGHTS = """\
  <lights>
    <ambientlight> <scaleradiance>1</scaleradiance> </ambientlight>
    <directionallights>
      <directionallight> <direction x="-1" y="1.4" z="1"/> <scaleradiance>3</scaleradiance> </directionallight>
    </directionallights>
  </lights>
"""
FLOOR_MATERIAL = """\
      <matte> <name>floor</name> <ka>0.12</ka> <kd>0.75</kd> <cd red="0.55" green="0.62" blue="0.68"/> </matte>
"""
CLAY = """\
      <matte> <name>clay</name> <ka>0.12</ka> <kd>0.9</kd> <cd red="0.85" green="0.28" blue="0.12"/> </matte>
"""
GLOSSY = """\
      <phong>
        <name>glossy</name> <ka>0.12</ka> <kd>0.8</kd> <ks>0.25</ks> <cd red="0.85" green="0.28" blue="0.12"/>
        <cs red="1" green="1" blue="1"/> <exp>60</exp>
      </phong>
"""
FLOOR = """\
    <planes>
      <plane> <point x="0" y="0" z="0"/> <normal x="0" y="1" z="0"/> <material>floor</material> </plane>
    </planes>
"""
SPHERE = """\
    <spheres> <sphere> <center x="0" y="1" z="0"/> <radius>1</radius> <material>clay</material> </sphere> </spheres>
"""


def write(name, comment, room=ROOM, lights=LIGHTS, mattes=CLAY, phongs="", floor=FLOOR, objects=SPHERE, textures="",
          groups="", materials_more=""):
    materials = f"    <mattes>\n{FLOOR_MATERIAL}{mattes}    </mattes>\n"
    if phongs:
        materials += f"    <phongs>\n{phongs}    </phongs>\n"
    materials += materials_more
    if textures:
        textures = f"  <textures>\n{textures}  </textures>\n"
    text = (
        f"<!-- {comment} -->\n<raytracer>\n{room}{lights}{textures}  <materials>\n{materials}  </materials>\n"
        f"  <objects>\n{floor}{objects}  </objects>\n{groups}</raytracer>\n"
    )
    with open(os.path.join(HERE, name + ".xml"), "w", encoding="utf-8", newline="\n") as file:
        file.write(text)


def shape(name, comment, objects):
    write(name, comment, mattes="", phongs=GLOSSY, objects=objects)


def light(name, comment, lights):
    write(name, comment, lights=f"  <lights>\n{lights}  </lights>\n")


# Shapes
write(
    "plane",
    "Two infinite planes, and the horizon.",
    objects="""\
    <planes>
      <plane> <point x="0" y="0" z="0"/> <normal x="-0.12" y="1" z="-0.02"/> <material>clay</material> </plane>
    </planes>
""",
)
shape(
    "sphere",
    "Spheres.",
    """\
    <spheres>
      <sphere> <center x="0" y="1" z="0"/> <radius>1</radius> <material>glossy</material> </sphere>
      <sphere> <center x="1.5" y="0.4" z="0.7"/> <radius>0.4</radius> <material>glossy</material> </sphere>
    </spheres>
""",
)
shape(
    "triangle",
    "Triangles: one alone, and three that make a tent.",
    """\
    <triangles>
      <triangle>
        <vertexposition1 x="-2.2" y="0.1" z="0.6"/> <vertexposition2 x="-0.6" y="0.1" z="0"/>
        <vertexposition3 x="-1.6" y="2" z="-0.2"/>
        <material>glossy</material>
      </triangle>
      <triangle>
        <vertexposition1 x="1.2" y="1.8" z="0"/> <vertexposition2 x="0.1" y="0" z="0.5"/>
        <vertexposition3 x="1.4" y="0" z="1.2"/>
        <material>glossy</material>
      </triangle>
      <triangle>
        <vertexposition1 x="1.2" y="1.8" z="0"/> <vertexposition2 x="1.4" y="0" z="1.2"/>
        <vertexposition3 x="2.2" y="0" z="-0.6"/>
        <material>glossy</material>
      </triangle>
      <triangle>
        <vertexposition1 x="1.2" y="1.8" z="0"/> <vertexposition2 x="2.2" y="0" z="-0.6"/>
        <vertexposition3 x="0.1" y="0" z="0.5"/>
        <material>glossy</material>
      </triangle>
    </triangles>
""",
)
shape(
    "cylinder",
    "Open cylinders: one stands, one lies and can be looked into.",
    """\
    <cylinders>
      <cylinder>
        <bottom x="-1" y="0" z="0"/> <top x="-1" y="2" z="0"/> <radius>0.6</radius> <material>glossy</material>
      </cylinder>
      <cylinder>
        <bottom x="0.7" y="0.5" z="1.2"/> <top x="1.7" y="0.5" z="-0.8"/>
        <radius>0.5</radius> <material>glossy</material>
      </cylinder>
    </cylinders>
""",
)
shape(
    "caps",
    "Cylinders and a truncated cone with caps.",
    """\
    <cylinders>
      <cylinder>
        <bottom x="-1.2" y="0" z="0"/> <top x="-1.2" y="1.6" z="0"/> <radius>0.6</radius> <caps>true</caps>
        <material>glossy</material>
      </cylinder>
      <cylinder>
        <bottom x="-0.3" y="0.5" z="1.2"/> <top x="0.7" y="0.5" z="0.4"/> <radius>0.5</radius> <caps>true</caps>
        <material>glossy</material>
      </cylinder>
    </cylinders>
    <cones>
      <cone>
        <bottom x="1.6" y="0" z="-0.3"/> <top x="1.6" y="1.4" z="-0.3"/> <radius>0.8</radius>
        <topradius>0.4</topradius> <caps>true</caps> <material>glossy</material>
      </cone>
    </cones>
""",
)
shape(
    "torus",
    "Toruses: a thick one that lies, a thin one about a slanted axis, a spindle.",
    """\
    <toruses>
      <torus>
        <center x="-0.9" y="0.4" z="0.4"/>
        <sweptradius>0.9</sweptradius> <tuberadius>0.4</tuberadius> <material>glossy</material>
      </torus>
      <torus>
        <center x="-0.9" y="1.5" z="-0.4"/> <axis x="0.5" y="0.3" z="1"/> <sweptradius>0.9</sweptradius>
        <tuberadius>0.12</tuberadius>
        <material>glossy</material>
      </torus>
      <torus>
        <center x="1.35" y="0.7" z="0"/>
        <sweptradius>0.35</sweptradius> <tuberadius>0.7</tuberadius> <material>glossy</material>
      </torus>
    </toruses>
""",
)
shape(
    "disk",
    "Disks: one floats, one stands.",
    """\
    <disks>
      <disk>
        <center x="-1" y="0.8" z="0.3"/> <normal x="0.2" y="1" z="0.3"/>
        <radius>0.9</radius> <material>glossy</material>
      </disk>
      <disk>
        <center x="1.2" y="1" z="-0.3"/> <normal x="-0.5" y="0.1" z="1"/>
        <radius>1</radius> <material>glossy</material>
      </disk>
    </disks>
""",
)
shape(
    "rectangle",
    "Rectangles: a wall, and a leaning parallelogram in front of it.",
    """\
    <rectangles>
      <rectangle>
        <corner x="-2.2" y="0" z="-1"/> <edge1 x="3" y="0" z="0"/> <edge2 x="0" y="1.8" z="0"/>
        <material>glossy</material>
      </rectangle>
      <rectangle>
        <corner x="0.2" y="0" z="0.8"/> <edge1 x="1.4" y="0" z="-0.4"/> <edge2 x="0.5" y="1.5" z="-0.5"/>
        <material>glossy</material>
      </rectangle>
    </rectangles>
""",
)
shape(
    "box",
    "Boxes: a tower, a slab and a cube that lies on it.",
    """\
    <boxes>
      <box> <min x="-1.9" y="0" z="-0.8"/> <max x="-0.9" y="2.2" z="0.2"/> <material>glossy</material> </box>
      <box> <min x="-0.5" y="0" z="-0.6"/> <max x="2" y="0.4" z="1.2"/> <material>glossy</material> </box>
      <box> <min x="0.6" y="0.4" z="-0.2"/> <max x="1.4" y="1.2" z="0.6"/> <material>glossy</material> </box>
    </boxes>
""",
)
shape(
    "cone",
    "Cones: one with a tip, a truncated one, an open one that lies and can be looked into.",
    """\
    <cones>
      <cone>
        <bottom x="-1.4" y="0" z="0"/> <top x="-1.4" y="2" z="0"/> <radius>0.8</radius> <material>glossy</material>
      </cone>
      <cone>
        <bottom x="0.2" y="0" z="-0.6"/> <top x="0.2" y="1.2" z="-0.6"/> <radius>0.7</radius>
        <topradius>0.35</topradius> <material>glossy</material>
      </cone>
      <cone>
        <bottom x="1.2" y="0.65" z="1"/> <top x="2" y="0.15" z="-0.8"/> <radius>0.65</radius> <topradius>0.1</topradius>
        <material>glossy</material>
      </cone>
    </cones>
""",
)
shape(
    "annulus",
    "Annuli: one floats, one stands.",
    """\
    <annuli>
      <annulus>
        <center x="-1" y="0.8" z="0.3"/> <normal x="0.2" y="1" z="0.3"/>
        <innerradius>0.5</innerradius> <outerradius>0.9</outerradius> <material>glossy</material>
      </annulus>
      <annulus>
        <center x="1.2" y="1" z="-0.3"/> <normal x="-0.5" y="0.1" z="1"/>
        <innerradius>0.7</innerradius> <outerradius>1</outerradius> <material>glossy</material>
      </annulus>
    </annuli>
""",
)



def knot(normals):
    """A trefoil knot: a tube of quads."""
    rings, sides, tube = 60, 8, 0.28
    center = lambda t: (
        0.42 * (math.sin(t) + 2 * math.sin(2 * t)), 0.42 * (math.cos(t) - 2 * math.cos(2 * t)), -0.5 * math.sin(3 * t))
    cross = lambda a, b: (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])

    def unit(a):
        size = math.sqrt(sum(c * c for c in a))
        return tuple(c / size for c in a)

    positions, faces = [], []
    for ring in range(rings):
        t = 2 * math.pi * ring / rings
        at, ahead = center(t), center(t + 1e-4)
        along = unit([b - a for a, b in zip(at, ahead)])
        side = unit(cross(along, (0, 0, 1)))
        up = cross(side, along)
        for i in range(sides):
            angle = 2 * math.pi * i / sides
            x = [c + tube * (math.cos(angle) * s + math.sin(angle) * u) for c, s, u in zip(at, side, up)]
            positions.append(f"{x[0]:.4f} {x[1] + 1.45:.4f} {x[2]:.4f}")
            j, next_ring = (i + 1) % sides, (ring + 1) % rings
            faces.append(f"{ring * sides + i} {ring * sides + j} {next_ring * sides + j} {next_ring * sides + i}")
    lines = lambda items: ",\n".join("          " + ", ".join(items[i : i + 5]) for i in range(0, len(items), 5))
    return f"""\
    <meshes>
      <mesh>
        <positions>
{lines(positions)}
        </positions>
        <faces>
{lines(faces)}
        </faces>
        <normals>{normals}</normals> <material>glossy</material>
      </mesh>
    </meshes>
"""


shape("mesh-flat", "A knot of 480 quads with the normals of its faces.", knot("flat"))
shape("mesh-smooth", "The same knot with smooth normals.", knot("smooth"))


def jack(elements, x):
    """A cube with an arm from each of its faces, of 30 quads."""
    sides = [(axis, sign) for axis in range(3) for sign in (-1, 1)]

    def square(axis, sign, size, away):
        """Its corners, counter-clockwise from outside."""
        ring = [(-size, -size), (size, -size), (size, size), (-size, size)]
        corners = []
        for u, v in ring if sign > 0 else ring[::-1]:
            corner = [0.0, 0.0, 0.0]
            corner[axis], corner[(axis + 1) % 3], corner[(axis + 2) % 3] = sign * away, u, v
            corners.append(tuple(corner))
        return corners

    quads = []
    for axis, sign in sides:
        inner, outer = square(axis, sign, 0.25, 0.25), square(axis, sign, 0.32, 0.85)
        quads.append(outer)
        for i in range(4):
            quads.append([inner[i], inner[(i + 1) % 4], outer[(i + 1) % 4], outer[i]])
    places = sorted({corner for quad in quads for corner in quad})
    positions = [" ".join(f"{c:g}" for c in place) for place in places]
    faces = [" ".join(str(places.index(corner)) for corner in quad) for quad in quads]
    lines = lambda items: ",\n".join("          " + ", ".join(items[i : i + 6]) for i in range(0, len(items), 6))
    return f"""\
      <mesh>
        <positions>
{lines(positions)}
        </positions>
        <faces>
{lines(faces)}
        </faces>
        {elements} <material>glossy</material>
        <transform>
          <rotate x="1" y="0.3" z="0.6" angle="40"/> <scale x="0.8" y="0.8" z="0.8"/> <translate x="{x}" y="0.75" z="0"/>
        </transform>
      </mesh>
"""


shape(
    "subdivision",
    "A jack of 30 quads, the same subdivided once, and four times.",
    "    <meshes>\n"
    + jack("<normals>flat</normals>", -1.55)
    + jack("<subdivision>1</subdivision> <normals>flat</normals>", 0)
    + jack("<subdivision>4</subdivision>", 1.55)
    + "    </meshes>\n",
)
write(
    "displacement",
    "A cube that becomes a ball with craters, a box of stone, and the ground, which is one square: all by noise.",
    textures="""\
    <noises>
      <noise> <name>craters</name> <scale>0.55</scale> <octaves>3</octaves> </noise>
      <noise> <name>stone</name> <scale>0.3</scale> <octaves>8</octaves> </noise>
      <noise> <name>ground</name> <scale>1.2</scale> <octaves>10</octaves> </noise>
    </noises>
""",
    mattes="""\
      <matte> <name>clay</name> <ka>0.12</ka> <kd>0.9</kd> <cd red="0.85" green="0.28" blue="0.12"/> </matte>
      <matte> <name>grey</name> <ka>0.12</ka> <kd>0.9</kd> <cd red="0.6" green="0.58" blue="0.52"/> </matte>
""",
    floor="",
    objects="""\
    <meshes>
      <mesh>
        <positions>-9 0 -9, -9 0 9, 9 0 9, 9 0 -9</positions> <faces>0 1 2 3,</faces>
        <subdivision>8</subdivision> <subdivisionscheme>flat</subdivisionscheme>
        <displacement texture="ground" height="0.7"/> <midlevel>0.5</midlevel> <material>floor</material>
      </mesh>
      <mesh>
        <positions>
          -1.2 -1.2 -1.2, 1.2 -1.2 -1.2, 1.2 1.2 -1.2, -1.2 1.2 -1.2, -1.2 -1.2 1.2, 1.2 -1.2 1.2, 1.2 1.2 1.2,
          -1.2 1.2 1.2
        </positions>
        <faces>0 3 2 1, 4 5 6 7, 0 1 5 4, 1 2 6 5, 2 3 7 6, 3 0 4 7</faces>
        <subdivision>7</subdivision> <displacement texture="craters" height="0.45"/> <midlevel>0.5</midlevel>
        <material>clay</material> <transform> <translate x="-1" y="1" z="0"/> </transform>
      </mesh>
      <mesh>
        <positions>
          -0.6 -0.6 -0.6, 0.6 -0.6 -0.6, 0.6 0.6 -0.6, -0.6 0.6 -0.6, -0.6 -0.6 0.6, 0.6 -0.6 0.6, 0.6 0.6 0.6,
          -0.6 0.6 0.6
        </positions>
        <faces>0 3 2 1, 4 5 6 7, 0 1 5 4, 1 2 6 5, 2 3 7 6, 3 0 4 7</faces>
        <subdivision>7</subdivision> <subdivisionscheme>flat</subdivisionscheme>
        <displacement texture="stone" height="0.16"/> <midlevel>0.5</midlevel> <material>grey</material>
        <transform> <rotate x="0" y="1" z="0" angle="25"/> <translate x="1.15" y="0.6" z="0.3"/> </transform>
      </mesh>
    </meshes>
""",
)


def double_helix(file):
    """Two strands and what joins them, as points with a radius and a colour."""
    points = []
    for step in range(120):
        t = step / 119
        angle, height = 4.5 * math.pi * t, 2.3 * t - 1.15
        strands = [(0.7 * math.cos(angle + a), height, 0.7 * math.sin(angle + a)) for a in (0, math.pi)]
        colors = ((int(235 - 160 * t), 90, 60), (50, 110, int(90 + 150 * t)))
        points += [(*at, 0.1, *color) for at, color in zip(strands, colors)]
        if step % 8 == 4:
            mix = lambda k: (a + (b - a) * k for a, b in zip(*strands))
            points += [(*mix(k / 10), 0.05, 225, 200, 150) for k in range(1, 10)]
    head = "ply\nformat ascii 1.0\n" + f"element vertex {len(points)}\n"
    head += "".join(f"property float {name}\n" for name in ("x", "y", "z", "radius"))
    head += "".join(f"property uchar {name}\n" for name in ("red", "green", "blue")) + "end_header\n"
    rows = "".join("%.4f %.4f %.4f %g %d %d %d\n" % point for point in points)
    os.makedirs(os.path.join(HERE, "models"), exist_ok=True)
    with open(os.path.join(HERE, file), "w", encoding="ascii", newline="\n") as out:
        out.write(head + rows)


double_helix("models/helix.ply")
write(
    "sphere-cloud",
    "A cloud of spheres from a file of points, with their radii and colours.",
    objects="""\
    <sphereclouds>
      <spherecloud>
        <file>models/helix.ply</file>
        <transform> <rotate x="0" y="0" z="1" angle="-65"/> <translate x="0" y="1.2" z="0"/> </transform>
      </spherecloud>
    </sphereclouds>
""",
)


def grass(blades):
    """Blades that stand in a disk and bend outwards and in the wind, of four points each."""
    numbers = random.Random(3)
    strands = []
    for _ in range(blades):
        angle, distance = numbers.uniform(0, 2 * math.pi), 0.9 * math.sqrt(numbers.random())
        x, z = distance * math.cos(angle), distance * math.sin(angle)
        height, bend = numbers.uniform(1.1, 2), numbers.uniform(0.1, 0.55)
        away = angle + numbers.uniform(-0.8, 0.8)
        points = [(x + (bend * math.cos(away) + 0.25) * t * t, height * t * (1 - 0.25 * bend * t), z + bend * math.sin(away) * t * t)
                  for t in (0, 0.4, 0.75, 1)]
        strands.append("  ".join(" ".join(f"{value:.3f}" for value in point) for point in points))
    return ",\n          ".join(strands)


write(
    "curves",
    "A tuft of grass, of strands that end in points, and a spring of wire.",
    mattes="""\
      <matte> <name>grass</name> <ka>0.12</ka> <kd>0.9</kd> <cd red="0.32" green="0.62" blue="0.12"/> </matte>
""",
    phongs=GLOSSY,
    objects=f"""\
    <curves>
      <curve>
        <points>
          {grass(260)}
        </points>
        <radius>0.02</radius> <tipscale>0</tipscale> <material>grass</material>
        <transform> <translate x="-0.9" y="0" z="0"/> </transform>
      </curve>
      <curve>
        <points>
          {"  ".join(f"{1.5 + 0.45 * math.cos(i * math.pi / 4):.3f} {0.06 + i * 0.03:.3f} {0.45 * math.sin(i * math.pi / 4):.3f}" for i in range(57))}
        </points>
        <radius>0.06</radius> <material>glossy</material>
      </curve>
    </curves>
""",
)


def lantern(file):
    """A lantern as glTF, with the light in it: four posts between a base and a roof, of two materials."""

    def box(x0, x1, y0, y1, z0, z1):
        corners = [(x, y, z) for x in (x0, x1) for y in (y0, y1) for z in (z0, z1)]
        sides = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
        return corners, [corner for a, b, c, d in sides for corner in (a, b, c, a, c, d)]

    roof = [(-0.42, 1, -0.42), (-0.42, 1, 0.42), (0.42, 1, 0.42), (0.42, 1, -0.42), (0, 1.4, 0)]
    roof_faces = [corner for i in range(4) for corner in (i, (i + 1) % 4, 4)] + [0, 3, 2, 0, 2, 1]
    posts = [box(x - 0.03, x + 0.03, 0.1, 1, z - 0.03, z + 0.03) for x in (-0.3, 0.3) for z in (-0.3, 0.3)]
    data, views, accessors, primitives = b"", [], [], []

    def add(kind, count, layout, values, **more):
        nonlocal data
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": struct.calcsize(layout)})
        accessors.append({"bufferView": len(views) - 1, "componentType": 5126 if kind == "VEC3" else 5123,
                          "count": count, "type": kind, **more})
        data += struct.pack(layout, *values)
        data += bytes(-len(data) % 4)
        return len(accessors) - 1

    for material, parts in enumerate(([box(-0.4, 0.4, 0, 0.1, -0.4, 0.4), (roof, roof_faces)], posts)):
        corners, faces = [], []
        for part_corners, part_faces in parts:
            faces += [len(corners) + corner for corner in part_faces]
            corners += part_corners
        values = [value for corner in corners for value in corner]
        position = add("VEC3", len(corners), f"<{len(values)}f", values,
                       min=[min(axis) for axis in zip(*corners)], max=[max(axis) for axis in zip(*corners)])
        primitives.append({"attributes": {"POSITION": position}, "material": material,
                           "indices": add("SCALAR", len(faces), f"<{len(faces)}H", faces)})
    model = {
        "asset": {"version": "2.0"},
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": [
            {"name": "flame", "type": "point", "color": [1, 0.72, 0.42], "intensity": 7}]}},
        "scene": 0,
        "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"mesh": 0}, {"translation": [0, 0.6, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}}],
        "meshes": [{"primitives": primitives}],
        "materials": [
            {"name": "copper", "pbrMetallicRoughness": {"baseColorFactor": [0.93, 0.52, 0.36, 1], "roughnessFactor": 0.5}},
            {"name": "iron", "pbrMetallicRoughness": {"baseColorFactor": [0.2, 0.2, 0.2, 1], "roughnessFactor": 0.6}}],
        "buffers": [{"byteLength": len(data),
                     "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
        "bufferViews": views,
        "accessors": accessors,
    }
    with open(os.path.join(HERE, file), "w", encoding="ascii", newline="\n") as out:
        json.dump(model, out, indent=1)
        out.write("\n")


lantern("models/lantern.gltf")
write(
    "model",
    "Two lanterns, one a third smaller: models that bring their lights and materials.",
    room=ROOM.replace("<samples>16", "<samples>64")
    + "  <integrator> <path> <clampindirect>0.3</clampindirect> </path> </integrator>\n",
    lights="""\
  <lights> <ambientlight> <scaleradiance>0.1</scaleradiance> </ambientlight> </lights>
""",
    objects="""\
    <models>
      <model>
        <file>models/lantern.gltf</file>
        <transform>
          <scale x="1.5" y="1.5" z="1.5"/> <rotate x="0" y="1" z="0" angle="20"/> <translate x="-1.1" y="0" z="-0.3"/>
        </transform>
      </model>
      <model>
        <file>models/lantern.gltf</file>
        <transform> <rotate x="0" y="1" z="0" angle="-35"/> <translate x="1.6" y="0" z="0.8"/> </transform>
      </model>
    </models>
    <spheres>
      <sphere> <center x="0.5" y="0.5" z="-0.8"/> <radius>0.5</radius> <material>clay</material> </sphere>
    </spheres>
""",
)
pawns = "".join(
    f"""\
      <instance>
        <group>pawn</group> <transform> <scale x="{size}" y="{height}" z="{size}"/> <translate x="{x}" y="0" z="{z}"/> </transform>
      </instance>
"""
    for x, z, size, height in (
        (-1.6, 1.6, 0.8, 0.8), (-0.6, 1.2, 0.8, 1.1), (0.5, 1.6, 0.8, 0.8), (1.5, 1.2, 0.8, 1), (-2, -0.8, 1, 1.2),
        (-0.8, -1.2, 1, 1), (0.7, -0.8, 1, 1.2), (2, -1.2, 1, 1))
)
write(
    "instances",
    "Eight instances of a pawn, stretched: its sphere becomes an ellipsoid.",
    mattes="",
    phongs=GLOSSY,
    objects=f"    <instances>\n{pawns}    </instances>\n",
    groups="""\
  <groups>
    <group>
      <name>pawn</name>
      <objects>
        <spheres>
          <sphere> <center x="0" y="1.3" z="0"/> <radius>0.3</radius> <material>glossy</material> </sphere>
        </spheres>
        <cylinders>
          <cylinder>
            <bottom x="0" y="0" z="0"/> <top x="0" y="1.1" z="0"/> <radius>0.2</radius> <material>glossy</material>
          </cylinder>
        </cylinders>
        <toruses>
          <torus>
            <center x="0" y="0.15" z="0"/> <sweptradius>0.3</sweptradius> <tuberadius>0.15</tuberadius>
            <material>glossy</material>
          </torus>
          <torus>
            <center x="0" y="1" z="0"/> <sweptradius>0.2</sweptradius> <tuberadius>0.08</tuberadius>
            <material>glossy</material>
          </torus>
        </toruses>
      </objects>
    </group>
  </groups>
""",
)

# Textures
def png(name, width, height, color):
    """color(x, y): red, green and blue of a pixel, 0 to 255; y counts from the top."""
    rows = b"".join(b"\0" + bytes(c for x in range(width) for c in color(x, y)) for y in range(height))
    chunks = ((b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)), (b"IDAT", zlib.compress(rows, 9)),
              (b"IEND", b""))
    os.makedirs(os.path.join(HERE, "images"), exist_ok=True)
    with open(os.path.join(HERE, "images", name), "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        for kind, data in chunks:
            file.write(struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)))


def bricks(x, y):
    """128 x 128 pixels, which fit to themselves on all sides: four courses of two bricks, every other one shifted."""
    course = y // 32
    along = (x + 32 * (course % 2)) % 128
    edge = min(along % 64, 63 - along % 64, y % 32, 31 - y % 32)
    if edge < 2:
        return 176, 170, 160
    shade = (course * 5 + along // 64 * 3) % 7 / 6
    worn = 0.8 if edge < 4 else 1
    return tuple(int(worn * (a + shade * (b - a))) for a, b in ((150, 190), (60, 92), (44, 66)))


png("bricks.png", 128, 128, bricks)
BRICKS = """\
    <images>
      <image> <name>bricks</name> <file>images/bricks.png</file> <uvscale x="3" y="2"/> </image>
    </images>
"""
write(
    "texture-image",
    "A picture of bricks on a wall and about a cylinder, and for how brightly a sphere shines.",
    textures=BRICKS,
    mattes="""\
      <matte> <name>wall</name> <ka>0.12</ka> <kd>0.9</kd> <cd texture="bricks"/> </matte>
""",
    phongs="""\
      <phong>
        <name>stamped</name> <ka>0.12</ka> <kd>0.7</kd> <ks texture="bricks" channel="green">0.9</ks>
        <cd red="0.3" green="0.4" blue="0.6"/> <cs red="1" green="1" blue="1"/> <exp>20</exp>
      </phong>
""",
    objects="""\
    <rectangles>
      <rectangle>
        <corner x="-2.6" y="0" z="-1.2"/> <edge1 x="5.2" y="0" z="0"/> <edge2 x="0" y="2" z="0"/> <material>wall</material>
      </rectangle>
    </rectangles>
    <cylinders>
      <cylinder>
        <bottom x="-1.3" y="0" z="0.6"/> <top x="-1.3" y="1.5" z="0.6"/> <radius>0.5</radius> <material>wall</material>
      </cylinder>
    </cylinders>
    <spheres> <sphere> <center x="1" y="0.8" z="0.4"/> <radius>0.8</radius> <material>stamped</material> </sphere> </spheres>
""",
)
write(
    "texture-checker",
    "Squares to the horizon and about a sphere, and cubes that a torus is cut from.",
    textures="""\
    <checkers>
      <checker>
        <name>tiles</name> <color1 red="0.8" green="0.8" blue="0.75"/> <color2 red="0.15" green="0.2" blue="0.3"/>
      </checker>
      <checker>
        <name>squares</name> <color1 red="0.9" green="0.9" blue="0.9"/> <color2 red="0.8" green="0.1" blue="0.1"/>
        <uvscale x="16" y="8"/>
      </checker>
      <checker>
        <name>cubes</name> <color1 red="0.9" green="0.7" blue="0.2"/> <color2 red="0.3" green="0.15" blue="0.05"/>
        <scale>0.25</scale>
      </checker>
    </checkers>
""",
    mattes="""\
      <matte> <name>tiled</name> <ka>0.12</ka> <kd>0.8</kd> <cd texture="tiles"/> </matte>
      <matte> <name>ball</name> <ka>0.12</ka> <kd>0.9</kd> <cd texture="squares"/> </matte>
      <matte> <name>inlaid</name> <ka>0.12</ka> <kd>0.9</kd> <cd texture="cubes"/> </matte>
""",
    floor="",
    objects="""\
    <planes>
      <plane> <point x="0" y="0" z="0"/> <normal x="0" y="1" z="0"/> <material>tiled</material> </plane>
    </planes>
    <spheres> <sphere> <center x="-1.1" y="0.9" z="0"/> <radius>0.9</radius> <material>ball</material> </sphere> </spheres>
    <toruses>
      <torus>
        <center x="1.2" y="0.75" z="0"/> <axis x="0.3" y="0.9" z="0.6"/> <sweptradius>0.75</sweptradius>
        <tuberadius>0.35</tuberadius> <material>inlaid</material>
      </torus>
    </toruses>
""",
)
write(
    "texture-noise",
    "Noise: as a colour, and as what dims a colour.",
    textures="""\
    <noises>
      <noise>
        <name>clouds</name> <color1 red="0.1" green="0.25" blue="0.6"/> <color2 red="1" green="1" blue="1"/>
        <scale>0.6</scale> <octaves>6</octaves>
      </noise>
      <noise> <name>stains</name> <color1 red="0.3" green="0.3" blue="0.3"/> <scale>0.25</scale> </noise>
    </noises>
""",
    mattes="""\
      <matte> <name>sky</name> <ka>0.12</ka> <kd>0.9</kd> <cd texture="clouds"/> </matte>
      <matte>
        <name>stained</name> <ka>0.12</ka> <kd texture="stains">0.95</kd> <cd red="0.85" green="0.28" blue="0.12"/>
      </matte>
""",
    objects="""\
    <spheres>
      <sphere> <center x="-1.1" y="1" z="0"/> <radius>1</radius> <material>sky</material> </sphere>
      <sphere> <center x="1.1" y="1" z="0"/> <radius>1</radius> <material>stained</material> </sphere>
    </spheres>
""",
)
write(
    "opacity",
    "A veil that passes two of three rays, a sphere with square holes, and a lattice; their shadows have the same holes.",
    room=ROOM.replace("<samples>16</samples>", "<samples>64</samples>"),
    textures="""\
    <checkers>
      <checker> <name>holes</name> <uvscale x="16" y="8"/> </checker>
      <checker> <name>lattice</name> <uvscale x="6" y="6"/> </checker>
    </checkers>
""",
    mattes="""\
      <matte>
        <name>veil</name> <ka>0.12</ka> <kd>0.9</kd> <cd red="0.9" green="0.9" blue="0.9"/> <opacity>0.33</opacity>
      </matte>
      <matte>
        <name>shell</name> <ka>0.12</ka> <kd>0.9</kd> <cd red="0.85" green="0.28" blue="0.12"/> <opacity texture="holes"/>
      </matte>
      <matte>
        <name>slats</name> <ka>0.12</ka> <kd>0.9</kd> <cd red="0.3" green="0.5" blue="0.2"/> <opacity texture="lattice"/>
      </matte>
""",
    objects="""\
    <spheres>
      <sphere> <center x="-0.1" y="0.85" z="0.2"/> <radius>0.85</radius> <material>shell</material> </sphere>
      <sphere> <center x="-1.6" y="0.65" z="0.2"/> <radius>0.65</radius> <material>veil</material> </sphere>
    </spheres>
    <rectangles>
      <rectangle>
        <corner x="0.9" y="0" z="0.4"/> <edge1 x="1.2" y="0" z="-0.6"/> <edge2 x="0" y="1.5" z="0"/>
        <material>slats</material>
      </rectangle>
    </rectangles>
""",
)
write(
    "relief",
    "Heights that shading follows: of noise on a sphere, on a cylinder and on the floor.",
    textures="""\
    <noises>
      <noise> <name>orange</name> <scale>0.12</scale> <octaves>2</octaves> </noise>
      <noise> <name>waves</name> <scale>0.5</scale> <octaves>3</octaves> </noise>
      <noise> <name>blows</name> <scale>0.3</scale> <octaves>1</octaves> </noise>
    </noises>
""",
    mattes="""\
      <matte>
        <name>sand</name> <ka>0.12</ka> <kd>0.75</kd> <cd red="0.55" green="0.62" blue="0.68"/>
        <bump texture="waves" height="0.25"/>
      </matte>
      <matte>
        <name>hammered</name> <ka>0.12</ka> <kd>0.9</kd> <cd red="0.9" green="0.85" blue="0.7"/>
        <bump texture="blows" height="0.2"/>
      </matte>
""",
    phongs="""\
      <phong>
        <name>peel</name> <ka>0.12</ka> <kd>0.8</kd> <ks>0.2</ks> <cd red="0.95" green="0.45" blue="0.05"/>
        <cs red="1" green="1" blue="1"/> <exp>40</exp> <bump texture="orange" height="0.06"/>
      </phong>
""",
    floor="",
    objects="""\
    <planes>
      <plane> <point x="0" y="0" z="0"/> <normal x="0" y="1" z="0"/> <material>sand</material> </plane>
    </planes>
    <spheres> <sphere> <center x="-0.9" y="0.95" z="0"/> <radius>0.95</radius> <material>peel</material> </sphere> </spheres>
    <cylinders>
      <cylinder>
        <bottom x="1.2" y="0" z="0"/> <top x="1.2" y="1.6" z="0"/> <radius>0.6</radius> <material>hammered</material>
      </cylinder>
    </cylinders>
""",
)

# Lights
light(
    "ambient-light",
    "Ambient light alone: everything is evenly bright.",
    """\
    <ambientlight> <scaleradiance>3</scaleradiance> <color red="1" green="0.9" blue="0.8"/> </ambientlight>
""",
)
light(
    "point-light",
    "A point light beside the sphere: its shadow widens, and the floor darkens where light grazes it.",
    """\
    <pointlights>
      <pointlight>
        <location x="-2" y="2" z="1.5"/> <scaleradiance>3</scaleradiance> <color red="1" green="0.85" blue="0.6"/>
      </pointlight>
    </pointlights>
""",
)
light(
    "spot-light",
    "A spotlight with a penumbra, which falls off with the square of the distance.",
    """\
    <ambientlight> <scaleradiance>0.5</scaleradiance> </ambientlight>
    <spotlights>
      <spotlight>
        <location x="-2" y="4" z="2"/> <lookat x="-0.2" y="0.6" z="0"/> <coneangle>42</coneangle>
        <penumbraangle>7</penumbraangle> <scaleradiance>90</scaleradiance> <color red="1" green="0.85" blue="0.6"/>
        <falloff>inversesquare</falloff>
      </spotlight>
    </spotlights>
""",
)
light(
    "directional-light",
    "A directional light: parallel rays, the floor evenly bright.",
    """\
    <directionallights>
      <directionallight>
        <direction x="-1" y="1" z="0.5"/> <scaleradiance>3</scaleradiance> <color red="0.7" green="0.85" blue="1"/>
      </directionallight>
    </directionallights>
""",
)
light(
    "shadows-off",
    "The scene of point-light.xml with its shadows off.",
    """\
    <pointlights>
      <pointlight>
        <location x="-2" y="2" z="1.5"/> <scaleradiance>3</scaleradiance> <color red="1" green="0.85" blue="0.6"/>
        <shadows>false</shadows>
      </pointlight>
    </pointlights>
""",
)
light(
    "colored-lights",
    "Three lights, red, green and blue: white where all arrive, coloured where one is shadowed.",
    """\
    <pointlights>
      <pointlight>
        <location x="-3" y="5" z="3"/> <scaleradiance>2.5</scaleradiance> <color red="1" green="0.05" blue="0.05"/>
      </pointlight>
      <pointlight>
        <location x="0" y="5" z="4"/> <scaleradiance>2.5</scaleradiance> <color red="0.05" green="1" blue="0.05"/>
      </pointlight>
      <pointlight>
        <location x="3" y="5" z="3"/> <scaleradiance>2.5</scaleradiance> <color red="0.05" green="0.05" blue="1"/>
      </pointlight>
    </pointlights>
""",
)



def studio(x, y):
    """256 x 128 pixels of longitude and latitude: three lamps in a grey room with a wooden floor."""
    lamps = ((40, 80, 30, 56, (255, 214, 150)), (150, 206, 22, 50, (190, 220, 255)), (110, 122, 16, 60, (255, 120, 80)))
    for left, right, top, bottom, color in lamps:
        if left <= x < right and top <= y < bottom:
            return color
    if y >= 70:
        return (58, 42, 30) if (x // 16 + (y - 70) // 8) % 2 else (50, 36, 26)
    return tuple(24 + (70 - y) // shade for shade in (5, 4, 3))


png("studio.png", 256, 128, studio)
SOLO = ROOM.replace("<samples>16", "<samples>256")
write(
    "environment-light",
    "A picture of a room with three lamps, all around.",
    room=SOLO,
    lights="""\
  <lights>
    <environmentlights>
      <environmentlight>
        <file>images/studio.png</file> <scaleradiance>3</scaleradiance>
        <transform> <rotate x="0" y="1" z="0" angle="160"/> </transform>
      </environmentlight>
    </environmentlights>
  </lights>
""",
    mattes="""\
      <matte> <name>white</name> <ka>0</ka> <kd>0.8</kd> <cd red="1" green="1" blue="1"/> </matte>
""",
    phongs="""\
      <phong>
        <name>glossy</name> <ka>0</ka> <kd>0.5</kd> <ks>6</ks> <cd red="0.3" green="0.3" blue="0.35"/>
        <cs red="1" green="1" blue="1"/> <exp>120</exp>
      </phong>
""",
    floor="",
    objects="""\
    <disks>
      <disk> <center x="0" y="0" z="0"/> <normal x="0" y="1" z="0"/> <radius>2.6</radius> <material>white</material> </disk>
    </disks>
    <spheres>
      <sphere> <center x="-1" y="0.9" z="0"/> <radius>0.9</radius> <material>white</material> </sphere>
      <sphere> <center x="1" y="0.9" z="0.2"/> <radius>0.9</radius> <material>glossy</material> </sphere>
    </spheres>
""",
)
write(
    "environment-even",
    "The same radiance from everywhere, as of an overcast sky: dark is what sees little of it.",
    room=SOLO,
    lights="""\
  <lights>
    <environmentlights> <environmentlight> <color red="0.8" green="0.9" blue="1"/> </environmentlight> </environmentlights>
  </lights>
""",
)
POST_AND_BALL = """\
    <cylinders>
      <cylinder>
        <bottom x="-0.6" y="0" z="0"/> <top x="-0.6" y="2.2" z="0"/> <radius>0.12</radius> <material>clay</material>
      </cylinder>
    </cylinders>
    <spheres> <sphere> <center x="0.9" y="0.5" z="0.6"/> <radius>0.5</radius> <material>clay</material> </sphere> </spheres>
"""
write(
    "sun",
    "A directional light of 6 degrees, and a blue sky: shadows are the softer the farther they fall.",
    room=SOLO,
    lights="""\
  <lights>
    <directionallights>
      <directionallight>
        <direction x="-1" y="0.7" z="0.5"/> <angle>6</angle>
        <scaleradiance>2.6</scaleradiance> <color red="1" green="0.9" blue="0.7"/>
      </directionallight>
    </directionallights>
    <environmentlights>
      <environmentlight> <scaleradiance>0.5</scaleradiance> <color red="0.4" green="0.65" blue="1"/> </environmentlight>
    </environmentlights>
  </lights>
""",
    objects=POST_AND_BALL,
)
write(
    "caustics",
    "What a glass ball and a ring of gold make of a spotlight, on paths that start there.",
    room="""\
  <integrator> <path> <caustics>light</caustics> </path> </integrator>
  <viewplane> <hres>320</hres> <vres>240</vres> <samples>256</samples> </viewplane>
  <camera> <eye x="0" y="4.6" z="5.2"/> <lookat x="-0.25" y="0.2" z="0.1"/> <viewdistance>420</viewdistance> </camera>
""",
    lights="""\
  <lights>
    <spotlights>
      <spotlight>
        <location x="5" y="2.6" z="-2.4"/> <lookat x="0" y="0.2" z="0.2"/> <coneangle>44</coneangle> <penumbraangle>8</penumbraangle>
        <scaleradiance>160</scaleradiance> <color red="1" green="0.93" blue="0.82"/> <falloff>inversesquare</falloff>
      </spotlight>
    </spotlights>
    <environmentlights>
      <environmentlight> <scaleradiance>0.12</scaleradiance> <color red="0.6" green="0.75" blue="1"/> </environmentlight>
    </environmentlights>
  </lights>
""",
    materials_more="""\
    <dielectrics> <dielectric> <name>glass</name> </dielectric> </dielectrics>
    <conductors> <conductor> <name>gold</name> <metal>gold</metal> <roughness>0.1</roughness> </conductor> </conductors>
""",
    objects="""\
    <spheres>
      <sphere> <center x="-0.9" y="0.6" z="-0.4"/> <radius>0.6</radius> <material>glass</material> </sphere>
    </spheres>
    <cylinders>
      <cylinder>
        <bottom x="0.75" y="0" z="0.6"/> <top x="0.75" y="0.45" z="0.6"/> <radius>0.75</radius> <material>gold</material>
      </cylinder>
    </cylinders>
""",
)
write(
    "photons",
    "A ball in a block of glass, and a mirror that shows the light behind it: no path from the camera meets the lamp, which has no size.",
    room="""\
  <integrator> <path> <caustics>photons</caustics> </path> </integrator>
  <viewplane> <hres>320</hres> <vres>240</vres> <samples>256</samples> </viewplane>
  <camera> <eye x="0.2" y="3.4" z="5.6"/> <lookat x="0" y="0.35" z="-0.1"/> <viewdistance>430</viewdistance> </camera>
""",
    lights="""\
  <lights>
    <spotlights>
      <spotlight>
        <location x="3.4" y="3.6" z="-0.6"/> <lookat x="0.2" y="0.4" z="0"/> <coneangle>44</coneangle> <penumbraangle>8</penumbraangle>
        <scaleradiance>130</scaleradiance> <color red="1" green="0.93" blue="0.82"/> <falloff>inversesquare</falloff>
      </spotlight>
    </spotlights>
    <environmentlights>
      <environmentlight> <scaleradiance>0.12</scaleradiance> <color red="0.6" green="0.75" blue="1"/> </environmentlight>
    </environmentlights>
  </lights>
""",
    mattes="""\
      <matte> <name>red</name> <ka>0</ka> <kd>0.8</kd> <cd red="0.9" green="0.12" blue="0.06"/> </matte>
""",
    materials_more="""\
    <dielectrics> <dielectric> <name>glass</name> </dielectric> </dielectrics>
    <mirrors> <mirror> <name>mirror</name> <cr red="0.9" green="0.92" blue="0.9"/> </mirror> </mirrors>
""",
    objects="""\
    <boxes>
      <box>
        <name>block</name> <min x="-0.55" y="0.002" z="-0.55"/> <max x="0.55" y="1" z="0.55"/> <material>glass</material>
        <transform> <rotate x="0" y="1" z="0" angle="24"/> <translate x="0.55" y="0" z="0.2"/> </transform>
      </box>
    </boxes>
    <spheres>
      <sphere> <name>ball</name> <center x="0.55" y="0.36" z="0.2"/> <radius>0.35</radius> <material>red</material> </sphere>
      <sphere> <name>lens</name> <center x="-1" y="0.45" z="0.1"/> <radius>0.45</radius> <material>glass</material> </sphere>
    </spheres>
    <rectangles>
      <rectangle> <corner x="-2.6" y="0" z="-0.5"/> <edge1 x="2.4" y="0" z="-1.1"/> <edge2 x="0" y="1.3" z="0"/> <material>mirror</material> </rectangle>
    </rectangles>
""",
)
write(
    "fog",
    "A spotlight through boards, and a lamp, in a box of mist; and a ball of smoke.",
    room="""\
  <integrator> <path> <clampindirect>1</clampindirect> </path> </integrator>
  <viewplane> <hres>320</hres> <vres>240</vres> <samples>256</samples> </viewplane>
  <camera> <eye x="0" y="1.5" z="7"/> <lookat x="0" y="1.35" z="0"/> <viewdistance>440</viewdistance> </camera>
""",
    lights="""\
  <lights>
    <spotlights>
      <spotlight>
        <location x="-2.3" y="4.2" z="-1.5"/> <lookat x="-0.3" y="0.3" z="0.2"/> <coneangle>38</coneangle> <penumbraangle>4</penumbraangle>
        <scaleradiance>190</scaleradiance> <color red="1" green="0.93" blue="0.82"/> <falloff>inversesquare</falloff>
      </spotlight>
    </spotlights>
    <pointlights>
      <pointlight>
        <location x="1.9" y="1.9" z="-0.6"/> <scaleradiance>5</scaleradiance> <color red="1" green="0.5" blue="0.2"/>
        <falloff>inversesquare</falloff>
      </pointlight>
    </pointlights>
    <environmentlights>
      <environmentlight> <scaleradiance>0.03</scaleradiance> <color red="0.5" green="0.7" blue="1"/> </environmentlight>
    </environmentlights>
  </lights>
""",
    mattes=CLAY + """\
      <matte> <name>board</name> <ka>0</ka> <kd>1</kd> <cd red="0.06" green="0.05" blue="0.04"/> </matte>
""",
    materials_more="""\
    <fogs>
      <fog> <name>mist</name> <meanfreepath>11</meanfreepath> <anisotropy>0.3</anisotropy> </fog>
      <fog> <name>smoke</name> <meanfreepath>0.22</meanfreepath> <color red="0.85" green="0.85" blue="0.85"/> </fog>
    </fogs>
""",
    objects="""\
    <spheres>
      <sphere> <center x="-0.35" y="0.5" z="0.2"/> <radius>0.5</radius> <material>clay</material> </sphere>
      <sphere> <center x="1.35" y="0.72" z="0.3"/> <radius>0.5</radius> <material>smoke</material> </sphere>
    </spheres>
    <boxes>
      <box> <min x="-1.93" y="2.3" z="-1.6"/> <max x="-1.7" y="2.36" z="0.3"/> <material>board</material> </box>
      <box> <min x="-1.5" y="2.3" z="-1.6"/> <max x="-1.27" y="2.36" z="0.3"/> <material>board</material> </box>
      <box> <min x="-1.07" y="2.3" z="-1.6"/> <max x="-0.84" y="2.36" z="0.3"/> <material>board</material> </box>
      <box> <min x="-5" y="0" z="-4"/> <max x="5" y="5" z="4"/> <material>mist</material> </box>
    </boxes>
""",
)
write(
    "cloud",
    "Clouds in a low sun over swaths of mist: fogs whose density is that of noise.",
    room="""\
  <integrator> <path> <maxdepth>48</maxdepth> </path> </integrator>
  <viewplane> <hres>320</hres> <vres>240</vres> <samples>160</samples> </viewplane>
  <camera> <eye x="0" y="1.1" z="12"/> <lookat x="0" y="2.35" z="0"/> <fov>32</fov> </camera>
""",
    lights="""\
  <lights>
    <skylights>
      <skylight>
        <sundirection x="-0.9" y="0.22" z="0.25"/> <turbidity>3</turbidity> <scaleradiance>4</scaleradiance>
      </skylight>
    </skylights>
  </lights>
""",
    mattes="""\
      <matte> <name>meadow</name> <ka>0</ka> <kd>1</kd> <cd red="0.1" green="0.14" blue="0.06"/> </matte>
""",
    textures="""\
    <noises>
      <noise>
        <name>billows</name> <color1 red="-2" green="0" blue="0"/> <color2 red="6.5" green="0" blue="0"/>
        <scale>1.3</scale> <octaves>6</octaves>
      </noise>
      <noise>
        <name>swaths</name> <color1 red="-1.2" green="0" blue="0"/> <color2 red="2.2" green="0" blue="0"/>
        <scale>2.2</scale> <octaves>4</octaves>
      </noise>
    </noises>
""",
    materials_more="""\
    <fogs>
      <fog>
        <name>cloud</name> <meanfreepath>0.12</meanfreepath> <anisotropy>0.5</anisotropy>
        <density texture="billows"/> <densityfade x="2.6" y="1.3" z="2"/>
      </fog>
      <fog>
        <name>mist</name> <meanfreepath>2</meanfreepath> <anisotropy>0.3</anisotropy>
        <density texture="swaths"/> <densityfade x="0" y="0.9" z="0"/>
      </fog>
    </fogs>
""",
    floor="""\
    <planes>
      <plane> <point x="0" y="-0.5" z="0"/> <normal x="0" y="1" z="0"/> <material>meadow</material> </plane>
    </planes>
""",
    objects="""\
    <boxes>
      <box> <min x="-4.6" y="1.7" z="-4"/> <max x="4.8" y="5.2" z="0.5"/> <material>cloud</material> </box>
      <box> <min x="-30" y="-1.4" z="-40"/> <max x="30" y="0.6" z="8"/> <material>mist</material> </box>
    </boxes>
""",
)
write(
    "skylight",
    "A clear sky in the late afternoon; the sun is behind, on the left.",
    room="""\
  <viewplane> <hres>320</hres> <vres>240</vres> <samples>256</samples> </viewplane>
  <camera> <eye x="0" y="1" z="6"/> <lookat x="0" y="1.5" z="0"/> <viewdistance>300</viewdistance> </camera>
""",
    lights="""\
  <lights>
    <skylights>
      <skylight>
        <sundirection x="-1" y="0.4" z="-0.8"/> <turbidity>2.5</turbidity>
        <scaleradiance>3.5</scaleradiance>
      </skylight>
    </skylights>
  </lights>
""",
    objects=POST_AND_BALL,
)



def stained_glass():
    """A room whose only light is daylight through a window of panes in two colours and clear ones."""
    colors = ["0.9 0.12 0.08", "0.08 0.25 0.8", "0.95 0.7 0.1", "0.1 0.55 0.2"]
    panes, glass = "", ""
    for number, color in enumerate(colors):
        red, green, blue = color.split()
        glass += f"""\
      <dielectric>
        <name>glass {number}</name> <ct red="{red}" green="{green}" blue="{blue}"/> <thinwalled>true</thinwalled>
      </dielectric>
"""
    size = 0.4
    for row in range(5):
        for column in range(6):
            number = int("013203 4214 1 302031 1240 4 301302".replace(" ", "4")[6 * row + column])
            material = "clear" if number == 4 else f"glass {number}"
            panes += f"""\
      <rectangle>
        <corner x="-2.5" y="{0.9 + size * row:.4g}" z="{-1.4 + size * column:.4g}"/> <edge1 x="0" y="0" z="{size - 0.04:.4g}"/>
        <edge2 x="0" y="{size - 0.04:.4g}" z="0"/> <material>{material}</material>
      </rectangle>
"""
    bars = ""
    for row in range(6):
        y = 0.9 + size * row
        bars += f"""\
      <box> <min x="-2.52" y="{y - 0.04:.4g}" z="-1.44"/> <max x="-2.48" y="{y:.4g}" z="1"/> <material>wall</material> </box>
"""
    for column in range(7):
        z = -1.4 + size * column
        bars += f"""\
      <box> <min x="-2.52" y="0.86" z="{z - 0.04:.4g}"/> <max x="-2.48" y="2.9" z="{z:.4g}"/> <material>wall</material> </box>
"""
    walls = """\
      <box> <min x="-2.6" y="0" z="-2.5"/> <max x="-2.4" y="3.2" z="-1.4"/> <material>wall</material> </box>
      <box> <min x="-2.6" y="0" z="1"/> <max x="-2.4" y="3.2" z="5"/> <material>wall</material> </box>
      <box> <min x="-2.6" y="0" z="-1.4"/> <max x="-2.4" y="0.88" z="1"/> <material>wall</material> </box>
      <box> <min x="-2.6" y="2.88" z="-1.4"/> <max x="-2.4" y="3.2" z="1"/> <material>wall</material> </box>
      <box> <min x="-2.6" y="0" z="-2.7"/> <max x="2.6" y="3.2" z="-2.5"/> <material>wall</material> </box>
      <box> <min x="2.4" y="0" z="-2.5"/> <max x="2.6" y="3.2" z="5"/> <material>wall</material> </box>
      <box> <min x="-2.6" y="0" z="5"/> <max x="2.6" y="3.2" z="5.2"/> <material>wall</material> </box>
      <box> <min x="-2.6" y="3.2" z="-2.7"/> <max x="2.6" y="3.4" z="5.2"/> <material>wall</material> </box>
"""
    write(
        "panes",
        "A room lit by the sun and the sky through a window of thin, coloured glass.",
        room="""\
  <viewplane>
    <hres>320</hres> <vres>240</vres> <samples>512</samples> <viewtransform>agx</viewtransform> <exposure>2.8</exposure>
  </viewplane>
  <camera> <eye x="0.9" y="1.5" z="4.6"/> <lookat x="-0.35" y="1.15" z="0"/> <viewdistance>250</viewdistance> </camera>
""",
        lights="""\
  <lights>
    <skylights> <skylight> <sundirection x="-1" y="0.75" z="0.12"/> </skylight> </skylights>
  </lights>
""",
        mattes=CLAY
        + """\
      <matte> <name>wall</name> <ka>0.12</ka> <kd>0.8</kd> <cd red="0.92" green="0.9" blue="0.86"/> </matte>
""",
        materials_more=f"""\
    <dielectrics>
      <dielectric> <name>clear</name> <thinwalled>true</thinwalled> </dielectric>
{glass}    </dielectrics>
""",
        objects=f"""\
    <boxes>
{walls}{bars}    </boxes>
    <rectangles>
{panes}    </rectangles>
    <spheres>
      <sphere> <center x="0.35" y="0.5" z="0.1"/> <radius>0.5</radius> <material>wall</material> </sphere>
    </spheres>
""",
    )


stained_glass()


def ies_file(name, intensity):
    """A lamp that is alike all around; intensity(degrees from straight down)."""
    angles = [2.5 * i for i in range(37)]
    with open(os.path.join(HERE, name), "w", encoding="utf-8", newline="\n") as file:
        file.write("IESNA:LM-63-2002\n[TEST] none: computed by scenes/generate_features.py\nTILT=NONE\n")
        file.write(f"1 -1 1 {len(angles)} 1 1 2 0.1 0.1 0\n1 1 20\n")
        for numbers in (angles, [0], [max(round(intensity(angle), 1), 0) for angle in angles]):
            file.write("\n".join(" ".join(f"{x:g}" for x in numbers[i : i + 10]) for i in range(0, len(numbers), 10)) + "\n")


ies_file("models/narrow.ies", lambda a: 900 * math.exp(-((a / 12) ** 2)) + 60 * math.exp(-((a / 45) ** 4)))
ies_file("models/ring.ies", lambda a: 500 * math.exp(-(((a - 32) / 9) ** 2)) + 150 * math.exp(-((a / 20) ** 2)))
ies_file("models/wide.ies", lambda a: 300 * math.cos(math.radians(a)) * (1 + 0.8 * math.sin(math.radians(2 * a))))
write(
    "ies-lights",
    "Point lights in front of a wall, with three IES files.",
    lights="""\
  <lights>
    <ambientlight> <scaleradiance>0.3</scaleradiance> </ambientlight>
    <pointlights>
"""
    + "".join(
        f"""\
      <pointlight>
        <location x="{x}" y="2.35" z="-0.5"/> <scaleradiance>{scale}</scaleradiance> <color red="1" green="0.85" blue="0.65"/>
        <falloff>inversesquare</falloff> <iesfile>models/{name}.ies</iesfile>
      </pointlight>
"""
        for x, scale, name in ((-1.6, 40, "narrow"), (0, 7, "ring"), (1.6, 4, "wide"))
    )
    + """\
    </pointlights>
  </lights>
""",
    objects="""\
    <planes> <plane> <point x="0" y="0" z="-0.9"/> <normal x="0" y="0" z="1"/> <material>clay</material> </plane> </planes>
""",
)

# A wall in the light of lamps of four temperatures, without and with a white balance.
TEMPERATURES = (2000, 2700, 4000, 6500)
for name, balance, comment in (("kelvin", "", "without a white balance"), ("white-balance", " <whitebalance>2700</whitebalance>", "with 2,700 K as white")):
    write(
        name,
        "Lamps of " + ", ".join(f"{kelvin:,}" for kelvin in TEMPERATURES) + f" kelvin before a white wall, {comment}.",
        room=ROOM.replace("<samples>16</samples>", f"<samples>16</samples>{balance}")
        .replace("<hres>320</hres> <vres>240</vres>", "<hres>320</hres> <vres>120</vres>")
        .replace("520", "340"),
        lights="  <lights>\n    <ambientlight> <scaleradiance>0.15</scaleradiance> <color kelvin=\"2700\"/> </ambientlight>\n    <pointlights>\n"
        + "".join(
            f"""\
      <pointlight>
        <location x="{2.4 * i - 3.6:g}" y="1.7" z="0"/> <scaleradiance>1.1</scaleradiance> <color kelvin="{kelvin}"/>
        <falloff>inversesquare</falloff>
      </pointlight>
"""
            for i, kelvin in enumerate(TEMPERATURES)
        )
        + "    </pointlights>\n  </lights>\n",
        mattes='      <matte> <name>plaster</name> <ka>0.9</ka> <kd>0.9</kd> <cd red="0.9" green="0.9" blue="0.9"/> </matte>\n',
        objects="""\
    <planes> <plane> <point x="0" y="0" z="-0.9"/> <normal x="0" y="0" z="1"/> <material>plaster</material> </plane> </planes>
""",
    )

# Materials
row = "".join(
    f'      <sphere> <center x="{x}" y="0.75" z="0"/> <radius>0.75</radius> <material>{name}</material> </sphere>\n'
    for x, name in (("-1.7", "left"), ("0", "middle"), ("1.7", "right"))
)
ROW = f"    <spheres>\n{row}    </spheres>\n"
write(
    "matte",
    "Matte with kd of 0.25, 0.6 and 1.",
    mattes="".join(
        f"      <matte> <name>{name}</name> <ka>0.1</ka> <kd>{kd}</kd> "
        '<cd red="0.3" green="0.75" blue="0.35"/> </matte>\n'
        for name, kd in (("left", 0.25), ("middle", 0.6), ("right", 1))
    ),
    objects=ROW,
)


def phongs(values):
    return "".join(
        f'      <phong>\n        <name>{name}</name> <ka>0.1</ka> <kd>0.7</kd> <ks>{ks}</ks> '
        f'<cd red="0.25" green="0.35" blue="0.85"/>\n'
        f'        <cs red="1" green="1" blue="1"/> <exp>{exp}</exp>\n      </phong>\n'
        for name, ks, exp in values
    )


write(
    "phong",
    "Phong with ks of 0, 0.1 and 0.3.",
    mattes="",
    phongs=phongs((("left", 0, 40), ("middle", 0.1, 40), ("right", 0.3, 40))),
    objects=ROW,
)
write(
    "phong-exponents",
    "Phong with exponents of 5, 30 and 300.",
    mattes="",
    phongs=phongs((("left", 0.2, 5), ("middle", 0.2, 30), ("right", 0.2, 300))),
    objects=ROW,
)

# View plane and camera
write(
    "background",
    "A background colour: what rays see that hit nothing.",
    room=ROOM.replace('red="0.04" green="0.06" blue="0.09"', 'red="0.95" green="0.55" blue="0.3"'),
    floor="",
)
FAN = "".join(
    '      <cylinder> <bottom x="0" y="-1" z="0"/> '
    f'<top x="{6 * math.sin(a):.4f}" y="{6 * math.cos(a) - 1:.4f}" z="0"/> '
    "<radius>0.03</radius> <material>clay</material> </cylinder>\n"
    for a in (math.radians(4 * spoke - 62) for spoke in range(32))
)
SMALL = "<hres>160</hres> <vres>120</vres> <pixelsize>2</pixelsize>"
for samples in (1, 4, 16, 64):
    write(
        f"samples-{samples}",
        f"{samples} sample{'s' if samples > 1 else ''} per pixel, on thin spokes.",
        room=ROOM.replace("<samples>16", f"<samples>{samples}").replace("<hres>320</hres> <vres>240</vres>", SMALL),
        floor="",
        objects=f"    <cylinders>\n{FAN}    </cylinders>\n",
    )
write(
    "camera-up",
    "The camera's up vector, slanted: the picture turns the other way.",
    room=ROOM.replace("<viewdistance>", '<up x="0.5" y="1" z="0"/> <viewdistance>'),
)
write(
    "camera-wide",
    "A short view distance: a wide angle from nearby.",
    room=ROOM.replace('<eye x="0" y="2.2" z="8"/>', '<eye x="0" y="1.3" z="3.2"/>').replace("520", "170"),
)
write(
    "camera-straight-down",
    "The camera looks along its up vector: another is picked.",
    room=ROOM.replace('<eye x="0" y="2.2" z="8"/>', '<eye x="0" y="8" z="0"/>').replace('y="0.9"', 'y="0"'),
    mattes="",
    phongs=GLOSSY,
    objects="""\
    <toruses>
      <torus>
        <center x="0" y="0.3" z="0"/>
        <sweptradius>1</sweptradius> <tuberadius>0.3</tuberadius> <material>glossy</material>
      </torus>
    </toruses>
""",
)
TOWERS = "".join(
    f'      <box> <min x="{x - 0.6:g}" y="0" z="{z - 0.6:g}"/> <max x="{x + 0.6:g}" y="{height}" z="{z + 0.6:g}"/> '
    "<material>clay</material> </box>\n"
    for x, z, height in ((-3.2, -3, 4.5), (-1.6, -1, 6), (0, -3, 7.5), (1.6, -1, 5.5), (3.2, -3, 6.5))
)
for name, comment, lookat, shift in (
    ("camera-tilted", "A camera that looks up: verticals lean towards each other.", 3.6, ""),
    ("camera-shift", "A level camera whose picture is shifted upwards: verticals stay parallel.", 1.6, ' <shift x="0" y="0.25"/>'),
):
    write(
        name,
        comment,
        room=ROOM.replace('<eye x="0" y="2.2" z="8"/> <lookat x="0" y="0.9" z="0"/>',
                          f'<eye x="0" y="1.6" z="8"/> <lookat x="0" y="{lookat}" z="0"/>')
        .replace("<viewdistance>520</viewdistance>", f"<viewdistance>280</viewdistance>{shift}"),
        objects=f"    <boxes>\n{TOWERS}    </boxes>\n",
    )

# A room with a gap in its roof.
for name, comment, clip in (
    ("camera-uncut", "A house, seen from outside.", ""),
    ("camera-near-clip", "The same, cut open for the camera alone: the wall before it still keeps the sun out.",
     " <nearclip>6.7</nearclip>"),
):
    write(
        name,
        comment,
        room=ROOM.replace("<samples>16</samples>", "<samples>64</samples>")
        .replace("<viewdistance>520</viewdistance>", f"<viewdistance>400</viewdistance>{clip}"),
        lights="""\
  <lights>
    <ambientlight> <scaleradiance>0.3</scaleradiance> </ambientlight>
    <directionallights>
      <directionallight> <direction x="-0.4" y="1.6" z="0.5"/> <scaleradiance>3</scaleradiance> </directionallight>
    </directionallights>
  </lights>
  <integrator> <path/> </integrator>
""",
        mattes=CLAY + """\
      <matte> <name>wall</name> <ka>0.5</ka> <kd>0.8</kd> <cd red="0.9" green="0.85" blue="0.75"/> </matte>
""",
        objects="""\
    <boxes>
      <box> <min x="-2" y="0" z="-1.9"/> <max x="2" y="2.4" z="-1.8"/> <material>wall</material> </box>
      <box> <min x="-2" y="0" z="1.7"/> <max x="2" y="2.4" z="1.8"/> <material>wall</material> </box>
      <box> <min x="-2.1" y="0" z="-1.9"/> <max x="-2" y="2.4" z="1.8"/> <material>wall</material> </box>
      <box> <min x="2" y="0" z="-1.9"/> <max x="2.1" y="2.4" z="1.8"/> <material>wall</material> </box>
      <box> <min x="-2.1" y="2.4" z="-1.9"/> <max x="-0.8" y="2.5" z="1.8"/> <material>wall</material> </box>
      <box> <min x="0.8" y="2.4" z="-1.9"/> <max x="2.1" y="2.5" z="1.8"/> <material>wall</material> </box>
      <box> <min x="0.9" y="0" z="-1.2"/> <max x="1.7" y="0.8" z="-0.4"/> <material>clay</material> </box>
    </boxes>
    <spheres> <sphere> <center x="-0.3" y="0.6" z="-0.2"/> <radius>0.6</radius> <material>clay</material> </sphere> </spheres>
""",
    )

STAIRS = "".join(
    f"      <rectangle> <corner x=\"{x}\" y=\"{y}\" z=\"{z}\"/> <edge1 {edge1}/> <edge2 {edge2}/> "
    "<material>glossy</material> </rectangle>\n"
    for step in range(4)
    for x, y, z, edge1, edge2 in (
        (-1.6 + 0.8 * step, 0, -0.8, f'x="0" y="{0.4 * (step + 1):g}" z="0"', 'x="0" y="0" z="1.6"'),
        (-1.6 + 0.8 * step, 0, 0.8, 'x="0.8" y="0" z="0"', f'x="0" y="{0.4 * (step + 1):g}" z="0"'),
        (-1.6 + 0.8 * step, round(0.4 * (step + 1), 2), -0.8, 'x="0.8" y="0" z="0"', 'x="0" y="0" z="1.6"'),
    )
)
CORNER = """\
  <viewplane>
    <hres>320</hres> <vres>240</vres> <pixelsize>0.018</pixelsize> <samples>16</samples>
    <background red="0.04" green="0.06" blue="0.09"/>
  </viewplane>
  <orthographiccamera> <eye x="-6" y="6" z="8"/> <lookat x="0" y="0.6" z="0"/> </orthographiccamera>
"""
write(
    "camera-orthographic",
    "An orthographic camera: what is parallel in the scene is parallel in the picture.",
    room=CORNER,
    mattes="",
    phongs=GLOSSY,
    objects=f"    <rectangles>\n{STAIRS}    </rectangles>\n",
)

# What the other cameras see: a row of spheres that goes away, and some around the camera.
AVENUE = "    <spheres>\n" + "".join(
    f'      <sphere> <center x="{x}" y="{y}" z="{z}"/> <radius>{y}</radius> <material>{material}</material> </sphere>\n'
    for x, y, z, material in (
        (-2.6, 0.6, -6, "glossy"),
        (-1.5, 0.6, -3, "clay"),
        (0, 0.6, 0, "glossy"),
        (0.9, 0.5, 2, "clay"),
        (1.2, 0.4, 4, "glossy"),
        (-2.4, 0.8, 8.5, "clay"),
        (2.8, 0.9, 9.5, "glossy"),
        (0.5, 0.7, 12, "clay"),
    )
)
AVENUE += "    </spheres>\n"
VIEW = '<eye x="0" y="2.2" z="8"/> <lookat x="0" y="0.9" z="0"/>'
PINHOLE = f"<camera> {VIEW} <viewdistance>520</viewdistance> </camera>"


def camera(name, comment, element, replaced=None):
    room = ROOM.replace(PINHOLE, element)
    for old, new in replaced or ():
        room = room.replace(old, new)
    write(name, comment, room=room, phongs=GLOSSY, objects=AVENUE)


camera(
    "camera-thin-lens",
    "A thin lens: what lies nearer or farther than the focal distance is blurred. Pixels have soft edges, too.",
    f"<thinlenscamera> {VIEW} <fov>26</fov> <lensradius>0.35</lensradius> <focaldistance>8.1</focaldistance>\n"
    "  </thinlenscamera>",
    (("<samples>16</samples>", "<samples>64</samples> <filter>gaussian</filter>"),),
)
LAMPS = "    <spheres>\n" + "".join(
    f'      <sphere> <center x="{-3 + 1.2 * i % 6:.4g}" y="{0.5 + 0.7 * i % 3.1:.4g}" z="{-2 - 0.9 * i:.4g}"/> '
    "<radius>0.1</radius> <material>lamp</material> </sphere>\n"
    for i in range(12)
)
LAMPS += """\
      <sphere> <center x="0.4" y="0.5" z="4"/> <radius>0.5</radius> <material>clay</material> </sphere>
    </spheres>
"""
write(
    "camera-blades",
    "A lens of five blades: small bright things that are out of focus have its shape.",
    room=ROOM.replace(
        PINHOLE,
        f"<thinlenscamera> {VIEW} <fov>26</fov> <lensradius>0.3</lensradius> <focaldistance>4.1</focaldistance>\n"
        "    <blades>5</blades> <bladerotation>90</bladerotation>\n  </thinlenscamera>",
    ).replace("<samples>16</samples>", "<samples>256</samples>"),
    mattes=CLAY + """\
      <matte> <name>lamp</name> <ka>9</ka> <kd>0</kd> <cd red="1" green="0.8" blue="0.45"/> </matte>
""",
    objects=LAMPS,
)
SPOKES = "".join(
    f'          <cylinder> <bottom x="0" y="0" z="0"/> '
    f'<top x="{math.cos(math.pi / 4 * i):.6g}" y="{math.sin(math.pi / 4 * i):.6g}" z="0"/> <radius>0.05</radius> '
    "<material>clay</material> </cylinder>\n"
    for i in range(8)
)
write(
    "motion-blur",
    "A wheel that rolls, and a ball that falls behind it, while the shutter is open. The wheel's lowest point rests.",
    room=ROOM.replace(
        PINHOLE,
        f"<camera>\n    {VIEW} <viewdistance>520</viewdistance> <shutteropen>0</shutteropen> <shutterclose>0.5</shutterclose>\n"
        "  </camera>",
    ).replace("<samples>16</samples>", "<samples>256</samples>"),
    mattes=CLAY,
    phongs=GLOSSY,
    objects="""\
    <instances>
      <instance>
        <group>wheel</group>
        <transform>
          <rotate> <key frame="1" x="0" y="0" z="-1" angle="0"/> <key frame="2" x="0" y="0" z="-1" angle="50"/> </rotate>
          <translate> <key frame="1" x="-0.6" y="1.1" z="0"/> <key frame="2" x="0.36" y="1.1" z="0"/> </translate>
        </transform>
      </instance>
    </instances>
    <spheres>
      <sphere>
        <center> <key frame="1" x="1.7" y="2.1" z="-1"/> <key frame="2" x="1.9" y="0.9" z="-1"/> </center>
        <radius>0.4</radius> <material>glossy</material>
      </sphere>
    </spheres>
""",
    groups=f"""\
  <groups>
    <group>
      <name>wheel</name>
      <objects>
        <toruses>
          <torus>
            <center x="0" y="0" z="0"/> <axis x="0" y="0" z="1"/> <sweptradius>1</sweptradius> <tuberadius>0.1</tuberadius>
            <material>clay</material>
          </torus>
        </toruses>
        <cylinders>
{SPOKES}        </cylinders>
      </objects>
    </group>
  </groups>
""",
)
camera(
    "camera-fisheye",
    "A fisheye camera: half of all directions in a circle.",
    f"<fisheyecamera> {VIEW} <angle>180</angle> </fisheyecamera>",
)
camera(
    "camera-spherical",
    "A spherical camera: all directions, by longitude and latitude.",
    f"<sphericalcamera> {VIEW} </sphericalcamera>",
    (("<vres>240</vres>", "<vres>160</vres>"),),
)
write(
    "filter-gaussian",
    "The scene of samples-64.xml with a Gaussian pixel filter.",
    room=ROOM.replace("<samples>16", "<filter>gaussian</filter> <samples>64").replace(
        "<hres>320</hres> <vres>240</vres>", SMALL
    ),
    floor="",
    objects=f"    <cylinders>\n{FAN}    </cylinders>\n",
)

PAINTS = {"red": (-2.7, 0.9, 0.03, 0.02), "yellow": (-0.9, 0.95, 0.6, 0.02), "blue": (0.9, 0.02, 0.08, 0.9),
          "grey": (2.7, 0.5, 0.5, 0.5)}
for transform in ("srgb", "agx", "khronos-neutral"):
    write(
        f"view-{transform}",
        f"Strong light on saturated paints, through the view transform {transform}.",
        room=ROOM.replace("<samples>16</samples>", f"<samples>16</samples> <viewtransform>{transform}</viewtransform>")
        .replace("<hres>320</hres> <vres>240</vres>", "<hres>320</hres> <vres>120</vres>")
        .replace("520", "340"),
        lights=LIGHTS.replace("<scaleradiance>3<", "<scaleradiance>8<"),
        mattes="",
        phongs="".join(
            f"""\
      <phong>
        <name>{name}</name> <ka>0.12</ka> <kd>0.9</kd> <ks>0.3</ks> <cd red="{red}" green="{green}" blue="{blue}"/>
        <cs red="1" green="1" blue="1"/> <exp>60</exp>
      </phong>
"""
            for name, (_, red, green, blue) in PAINTS.items()
        ),
        objects="    <spheres>\n"
        + "".join(
            f"""\
      <sphere> <center x="{x}" y="0.85" z="0"/> <radius>0.85</radius> <material>{name}</material> </sphere>
"""
            for name, (x, *_) in PAINTS.items()
        )
        + "    </spheres>\n",
    )

# Shadow catchers
write(
    "shadow-catcher",
    "A floor of which a transparent picture shows the shadow alone, to put the sphere onto a photograph.",
    room=ROOM.replace("<samples>16</samples> ", "<samples>256</samples> ").replace("0.04", "0").replace("0.06", "0")
    .replace("0.09", "0"),
    lights="""\
  <lights>
    <environmentlights> <environmentlight> <scaleradiance>0.35</scaleradiance> </environmentlight> </environmentlights>
    <directionallights>
      <directionallight>
        <direction x="-1" y="1.4" z="1"/> <scaleradiance>2.5</scaleradiance> <angle>5</angle>
      </directionallight>
    </directionallights>
  </lights>
""",
    floor=FLOOR.replace("</material> </plane>", "</material> <shadowcatcher>true</shadowcatcher> </plane>"),
)

# What the camera does not see
for name, comment, more in (
    ("visible", "A lamp before the eye and a dark screen, which throws its shadow, in a room with a mirror.", ""),
    ("invisible", "The same lamp and screen, which the camera does not see: the mirror does.",
     " <visible>false</visible>"),
):
    write(
        name,
        comment,
        room=ROOM.replace("<samples>16</samples>", "<samples>256</samples>"),
        lights="  <integrator> <path> <caustics>light</caustics> </path> </integrator>\n",
        mattes=CLAY + """\
      <matte> <name>screen</name> <ka>0</ka> <kd>0.1</kd> <cd red="1" green="1" blue="1"/> </matte>
""",
        materials_more="""\
    <mirrors> <mirror> <name>mirror</name> <cr red="0.9" green="0.9" blue="0.9"/> </mirror> </mirrors>
    <emissives>
      <emissive> <name>lamp</name> <ce red="1" green="0.9" blue="0.75"/> <scaleradiance>20</scaleradiance> </emissive>
    </emissives>
""",
        objects=f"""\
    <spheres>
      <sphere> <center x="-0.7" y="0.7" z="0.4"/> <radius>0.7</radius> <material>clay</material> </sphere>
      <sphere> <center x="-1.1" y="1.9" z="2.6"/> <radius>0.35</radius> <material>lamp</material>{more} </sphere>
    </spheres>
    <rectangles>
      <rectangle>
        <corner x="-2.4" y="0.1" z="-1.2"/> <edge1 x="4.4" y="0" z="-0.9"/> <edge2 x="0" y="2.4" z="0"/>
        <material>mirror</material>
      </rectangle>
      <rectangle>
        <corner x="0.4" y="0.1" z="1.6"/> <edge1 x="0.9" y="0" z="0.4"/> <edge2 x="0" y="1.3" z="0"/>
        <material>screen</material>{more}
      </rectangle>
    </rectangles>
""",
    )

# Integrator
BOUNCES = dict(
    mattes="""\
      <matte> <name>white</name> <ka>0</ka> <kd>0.85</kd> <cd red="1" green="0.98" blue="0.95"/> </matte>
      <matte> <name>red</name> <ka>0</ka> <kd>0.8</kd> <cd red="0.9" green="0.12" blue="0.08"/> </matte>
""",
    phongs="""\
      <phong>
        <name>blue</name> <ka>0</ka> <kd>0.4</kd> <ks>0.15</ks> <cd red="0.15" green="0.3" blue="0.8"/>
        <cs red="1" green="1" blue="1"/> <exp>40</exp>
      </phong>
""",
    lights="""\
  <lights>
    <directionallights>
      <directionallight>
        <direction x="1" y="1.3" z="0.7"/> <scaleradiance>2.2</scaleradiance> <color red="1" green="0.86" blue="0.66"/>
      </directionallight>
    </directionallights>
  </lights>
""",
    objects="""\
    <boxes> <box> <min x="-2.3" y="0" z="-1.6"/> <max x="-2" y="2.4" z="1.4"/> <material>red</material> </box> </boxes>
    <spheres>
      <sphere> <center x="-0.9" y="0.9" z="0"/> <radius>0.9</radius> <material>white</material> </sphere>
      <sphere> <center x="1.1" y="0.6" z="0.6"/> <radius>0.6</radius> <material>blue</material> </sphere>
    </spheres>
""",
)
SKY = ROOM.replace('red="0.04" green="0.06" blue="0.09"', 'red="0.3" green="0.4" blue="0.55"')
write(
    "path",
    "Light of the sky, and of the red wall on what stands beside it.",
    room=SKY.replace("<samples>16", "<samples>256") + "  <integrator> <path> <maxdepth>8</maxdepth> </path> </integrator>\n",
    **BOUNCES,
)
write("raycast", "The same by direct light alone.", room=SKY + "  <integrator> <raycast/> </integrator>\n", **BOUNCES)
MODELS = """\
    <spheres> <sphere> <center x="-1.4" y="1" z="0"/> <radius>1</radius> <material>clay</material> </sphere> </spheres>
    <toruses>
      <torus>
        <center x="1.2" y="1.1" z="0"/> <axis x="0.3" y="0.6" z="1"/>
        <sweptradius>0.8</sweptradius> <tuberadius>0.3</tuberadius> <material>clay</material>
      </torus>
    </toruses>
"""
for name, comment, element in (
    ("normals", "Shading normals as colours: x is red, y green, z blue.", "<normals/>"),
    ("ambient-occlusion", "How much of a white sky surfaces see.", "<ambientocclusion/>"),
    ("albedo", "Colours without light.", "<albedo/>"),
    ("uv", "Texture coordinates as colours: u is red, v green.", "<uv/>"),
):
    room = ROOM.replace("<samples>16", "<samples>256") if name == "ambient-occlusion" else ROOM
    write(name, comment, room=f"{room}  <integrator> {element} </integrator>\n", objects=MODELS)

# Materials that paths alone show: under a bright sky and a large lamp, on a checkered floor.
STUDIO = dict(
    room=SKY.replace("<samples>16", "<samples>256"),
    lights="",
    textures="""\
    <checkers>
      <checker>
        <name>tiles</name> <color1 red="0.75" green="0.73" blue="0.7"/> <color2 red="0.3" green="0.33" blue="0.38"/>
        <uvscale x="1.6" y="1.6"/>
      </checker>
    </checkers>
""",
    mattes="""\
      <matte> <name>tiles</name> <ka>0</ka> <kd>1</kd> <cd texture="tiles"/> </matte>
      <matte> <name>red</name> <ka>0</ka> <kd>0.8</kd> <cd red="0.9" green="0.12" blue="0.08"/> </matte>
      <matte> <name>yellow</name> <ka>0</ka> <kd>0.8</kd> <cd red="0.95" green="0.7" blue="0.1"/> </matte>
""",
    floor=FLOOR.replace("<material>floor", "<material>tiles"),
)
LAMP_MATERIAL = """\
    <emissives> <emissive> <name>lamp</name> <ce red="1" green="0.93" blue="0.8"/> <scaleradiance>5</scaleradiance> </emissive> </emissives>
"""
LAMP = """\
    <rectangles>
      <rectangle>
        <corner x="-5" y="6" z="-1"/> <edge1 x="5" y="0" z="0"/> <edge2 x="0" y="0" z="5"/> <material>lamp</material>
      </rectangle>
    </rectangles>
"""


def studio(name, comment, materials, objects, samples=256, groups=""):
    style = {**STUDIO, "room": STUDIO["room"].replace("<samples>256", f"<samples>{samples}")}
    write(name, comment, materials_more=materials + LAMP_MATERIAL, objects=objects + LAMP, groups=groups, **style)


def row(materials):
    """A sphere of each."""
    size = 2.2 / len(materials)
    spheres = "".join(
        f'      <sphere> <center x="{(i - (len(materials) - 1) / 2) * 2 * size:.2f}" y="{size * 0.95:.2f}" z="0.5"/> '
        f"<radius>{size * 0.95:.2f}</radius> <material>{material}</material> </sphere>\n"
        for i, material in enumerate(materials)
    )
    return f"    <spheres>\n{spheres}    </spheres>\n"


studio(
    "mirror",
    "A mirror and a bluish mirrored ball.",
    """\
    <mirrors>
      <mirror> <name>silvered</name> <cr red="0.93" green="0.94" blue="0.93"/> </mirror>
      <mirror> <name>bluish</name> <cr red="0.6" green="0.75" blue="0.95"/> </mirror>
    </mirrors>
""",
    """\
    <spheres>
      <sphere> <center x="-1.2" y="0.8" z="0"/> <radius>0.8</radius> <material>bluish</material> </sphere>
      <sphere> <center x="0.7" y="0.5" z="0.9"/> <radius>0.5</radius> <material>red</material> </sphere>
      <sphere> <center x="-0.2" y="0.3" z="1.7"/> <radius>0.3</radius> <material>yellow</material> </sphere>
    </spheres>
    <boxes>
      <box>
        <min x="-1.6" y="0" z="-0.06"/> <max x="1.6" y="2.3" z="0"/> <material>silvered</material>
        <transform> <rotate x="0" y="1" z="0" angle="-28"/> <translate x="1.4" y="0" z="-1.2"/> </transform>
      </box>
    </boxes>
""",
)
METALS = ["gold", "silver", "copper", "iron", "brass"]
studio(
    "metals",
    "Metals by their names: gold, silver, copper, iron and brass.",
    "    <conductors>\n"
    + "".join(
        f"      <conductor> <name>{metal}</name> <metal>{metal}</metal> <roughness>0.25</roughness> </conductor>\n"
        for metal in METALS
    )
    + "    </conductors>\n",
    row(METALS),
)
ROUGHNESSES = ["0", "0.2", "0.4", "0.7", "1"]
studio(
    "conductor",
    "Gold of roughness 0, 0.2, 0.4, 0.7 and 1.",
    "    <conductors>\n"
    + "".join(
        f"      <conductor> <name>gold {r}</name> <metal>gold</metal> <roughness>{r}</roughness> </conductor>\n"
        for r in ROUGHNESSES
    )
    + "    </conductors>\n",
    row([f"gold {r}" for r in ROUGHNESSES]),
)
studio(
    "dielectric",
    "A glass ball, one that is green inside, and a thin-walled one.",
    """\
    <dielectrics>
      <dielectric> <name>clear</name> </dielectric>
      <dielectric>
        <name>green</name> <attenuationcolor red="0.25" green="0.8" blue="0.45"/>
        <attenuationdistance>0.9</attenuationdistance>
      </dielectric>
      <dielectric> <name>bubble</name> <thinwalled>true</thinwalled> </dielectric>
    </dielectrics>
""",
    row(["clear", "green", "bubble"])
    + """\
    <boxes>
      <box> <min x="-2.6" y="0" z="-1.6"/> <max x="-1.2" y="1.2" z="-1.3"/> <material>red</material> </box>
      <box> <min x="0.8" y="0" z="-1.6"/> <max x="2.6" y="1.2" z="-1.3"/> <material>yellow</material> </box>
    </boxes>
""",
)


def tumbler(x, ice=False, straw=False, water=True):
    """Of glass, hollowed by air that counts more, where water counts more still and reaches into the glass."""

    def upright(bottom, top, radius, material):
        return (
            f'      <cylinder> <bottom x="{x}" y="{bottom}" z="0.5"/> <top x="{x}" y="{top}" z="0.5"/> <radius>{radius}</radius> '
            f"<caps>true</caps> <material>{material}</material> </cylinder>\n"
        )

    cylinders = upright(0, 1.6, 0.6, "glass") + upright(0.15, 1.8, 0.53, "air")
    boxes = ""
    if water:
        cylinders += upright(0.14, 1.2, 0.54, "water")
    if straw:
        cylinders += (
            f'      <cylinder> <bottom x="{x - 0.3}" y="0.2" z="0.6"/> <top x="{x + 0.6}" y="2.2" z="0.4"/> <radius>0.05</radius> '
            "<caps>true</caps> <material>red</material> </cylinder>\n"
        )
    if ice:
        for dx, y, z, angle in ((-0.16, 1.1, 0.68, 20), (0.18, 1.15, 0.35, 65)):
            boxes += (
                '      <box> <min x="-0.18" y="-0.18" z="-0.18"/> <max x="0.18" y="0.18" z="0.18"/> <material>ice</material> '
                f'<transform> <rotate x="0.4" y="1" z="0.3" angle="{angle}"/> '
                f'<translate x="{x + dx:.4g}" y="{y}" z="{z}"/> </transform> </box>\n'
            )
    return cylinders, boxes


TUMBLERS = [tumbler(-1.5, water=False), tumbler(0, straw=True), tumbler(1.5, ice=True)]
studio(
    "dielectric-priority",
    "Tumblers: empty, with water and a straw, with water and ice.",
    """\
    <dielectrics>
      <dielectric> <name>glass</name> <ior>1.5</ior> <priority>1</priority> </dielectric>
      <dielectric> <name>air</name> <ior>1</ior> <priority>2</priority> </dielectric>
      <dielectric>
        <name>water</name> <ior>1.33</ior> <priority>3</priority> <attenuationcolor red="0.55" green="0.85" blue="0.9"/>
        <attenuationdistance>2</attenuationdistance>
      </dielectric>
      <dielectric> <name>ice</name> <ior>1.31</ior> <priority>4</priority> </dielectric>
    </dielectrics>
""",
    "    <cylinders>\n"
    + "".join(cylinders for cylinders, _ in TUMBLERS)
    + "    </cylinders>\n    <boxes>\n"
    + "".join(boxes for _, boxes in TUMBLERS)
    + "    </boxes>\n",
)
studio(
    "dielectric-roughness",
    "Glass of roughness 0, 0.15, 0.3, 0.5 and 0.8 before a wall.",
    "    <dielectrics>\n"
    + "".join(
        f"      <dielectric> <name>glass {r}</name> <roughness>{r}</roughness> </dielectric>\n"
        for r in ["0", "0.15", "0.3", "0.5", "0.8"]
    )
    + "    </dielectrics>\n",
    row([f"glass {r}" for r in ["0", "0.15", "0.3", "0.5", "0.8"]])
    + """\
    <boxes>
      <box> <min x="-2.6" y="0" z="-1.3"/> <max x="-0.2" y="0.7" z="-1"/> <material>red</material> </box>
      <box> <min x="0.2" y="0" z="-1.3"/> <max x="2.6" y="0.7" z="-1"/> <material>yellow</material> </box>
    </boxes>
""",
)


def prism_scene():
    """A spotlight through a slit, onto a prism at the angle of the least deviation."""
    size, height, turn, x0, z0 = 0.62, 1.1, math.radians(-14), -0.7, -0.5
    way_in = math.asin(1.7 / 2) - math.pi / 6 + turn  # in plan, from the right counter-clockwise; the base looks front

    def plan(x, y):
        return x0 + size * (x * math.cos(turn) - y * math.sin(turn)), z0 - size * (x * math.sin(turn) + y * math.cos(turn))

    corners = [plan(-1, 0), plan(1, 0), plan(0, math.sqrt(3))]
    positions = ", ".join(f"{x:.4f} {y} {z:.4f}" for y in (-0.01, height) for x, z in corners)
    mx, mz = plan(-0.5, math.sqrt(3) / 2)
    right, front = math.cos(way_in), -math.sin(way_in)

    def before(distance, aside=0.0):
        return mx - right * distance - front * aside, mz - front * distance + right * aside

    lamp_x, lamp_z = before(8)
    hole_x, hole_z = before(1.8)
    cards = ""
    for side in (1, -1):
        cx, cz = before(1.8, side * 0.045)
        cards += (
            f'      <rectangle> <corner x="{cx:.4f}" y="0" z="{cz:.4f}"/> <edge1 x="0" y="1.5" z="0"/> '
            f'<edge2 x="{-side * front * 0.8:.4f}" y="0" z="{side * right * 0.8:.4f}"/> <material>card</material> </rectangle>\n'
        )
    write(
        "dispersion",
        "A prism of flint glass splits light that comes through a slit.",
        room="""\
  <integrator> <path> <caustics>light</caustics> </path> </integrator>
  <viewplane> <hres>320</hres> <vres>240</vres> <samples>128</samples> </viewplane>
  <camera> <eye x="0.1" y="3.6" z="5.2"/> <lookat x="-0.05" y="0.25" z="-0.1"/> <viewdistance>390</viewdistance> </camera>
""",
        lights=f"""\
  <lights>
    <spotlights>
      <spotlight>
        <location x="{lamp_x:.4f}" y="2.3" z="{lamp_z:.4f}"/> <lookat x="{hole_x:.4f}" y="0.75" z="{hole_z:.4f}"/>
        <coneangle>11</coneangle> <penumbraangle>1</penumbraangle> <scaleradiance>2200</scaleradiance>
        <falloff>inversesquare</falloff>
      </spotlight>
    </spotlights>
    <environmentlights>
      <environmentlight> <scaleradiance>0.14</scaleradiance> <color red="0.6" green="0.75" blue="1"/> </environmentlight>
    </environmentlights>
  </lights>
""",
        mattes="""\
      <matte> <name>card</name> <ka>0</ka> <kd>0.5</kd> <cd red="0.1" green="0.1" blue="0.11"/> </matte>
""",
        materials_more="""\
    <dielectrics> <dielectric> <name>flint</name> <ior>1.7</ior> <abbe>15</abbe> </dielectric> </dielectrics>
    <emissives> <emissive> <name>window</name> <ce red="0.75" green="0.85" blue="1"/> </emissive> </emissives>
""",
        objects=f"""\
    <meshes>
      <mesh>
        <positions>{positions}</positions>
        <faces>2 1 0, 3 4 5, 0 1 4 3, 1 2 5 4, 2 0 3 5</faces> <material>flint</material>
      </mesh>
    </meshes>
    <rectangles>
{cards}      <rectangle>
        <corner x="-5" y="2" z="-7"/> <edge1 x="7" y="0" z="0"/> <edge2 x="0" y="3.5" z="0"/> <material>window</material>
      </rectangle>
    </rectangles>
""",
    )


prism_scene()


def parameter(element, value):
    """Of a material: a number, or a colour of three."""
    if isinstance(value, tuple):
        return "<{} red=\"{}\" green=\"{}\" blue=\"{}\"/>".format(element, *value)
    return f"<{element}>{value}</{element}>"


def openpbr_row(name, comment, materials, more="", samples=256):
    """A sphere of each, from its parameters."""
    studio(
        name,
        comment,
        "    <openpbrs>\n"
        + "".join(
            f"      <openpbr> <name>{i + 1}</name> {' '.join(parameter(*item) for item in material.items())} </openpbr>\n"
            for i, material in enumerate(materials)
        )
        + "    </openpbrs>\n",
        row([str(i + 1) for i in range(len(materials))]) + more,
        samples,
    )


ORANGE, CLARET = (0.9, 0.4, 0.08), (0.5, 0.02, 0.06)
WALLS = """\
    <boxes>
      <box> <min x="-2.6" y="0" z="-1.3"/> <max x="-0.2" y="0.7" z="-1"/> <material>red</material> </box>
      <box> <min x="0.2" y="0" z="-1.3"/> <max x="2.6" y="0.7" z="-1"/> <material>yellow</material> </box>
    </boxes>
"""
openpbr_row(
    "openpbr",
    "OpenPBR's base: without a gloss, glossy, rough, half a metal, and a metal.",
    [
        {"base_color": ORANGE, "specular_weight": 0, "base_diffuse_roughness": 1},
        {"base_color": ORANGE, "specular_roughness": 0.1},
        {"base_color": ORANGE, "specular_roughness": 0.5},
        {"base_color": ORANGE, "base_metalness": 0.5},
        {"base_color": ORANGE, "base_metalness": 1},
    ],
)
openpbr_row(
    "openpbr-transmission",
    "OpenPBR's transmission_weight 0.5, and 1: smooth, rough, with a depth, and thin-walled.",
    [
        {"base_color": ORANGE, "transmission_weight": 0.5, "specular_roughness": 0.1},
        {"transmission_weight": 1, "specular_roughness": 0},
        {"transmission_weight": 1, "specular_roughness": 0.3},
        {"transmission_weight": 1, "specular_roughness": 0, "transmission_color": (0.3, 0.8, 0.5), "transmission_depth": 0.4},
        {"transmission_weight": 1, "specular_roughness": 0, "transmission_color": (0.95, 0.7, 0.5), "geometry_thin_walled": "true"},
    ],
    WALLS,
)
openpbr_row(
    "openpbr-scatter",
    "OpenPBR's transmission_scatter 0, 0.1, 0.4 and 1 in a depth of 0.4, and in amber by steps of 0.8 forwards.",
    [
        {
            "transmission_weight": 1, "specular_roughness": 0, "transmission_depth": 0.4, "transmission_color": color,
            "transmission_scatter": (scatter, scatter, scatter), "transmission_scatter_anisotropy": g,
        }
        for color, scatter, g in (
            ((0.75, 0.88, 0.95), 0, 0),
            ((0.75, 0.88, 0.95), 0.1, 0),
            ((0.75, 0.88, 0.95), 0.4, 0),
            ((0.75, 0.88, 0.95), 1, 0),
            ((0.9, 0.5, 0.08), 1, 0.8),
        )
    ],
    WALLS,
    1024,
)


def subsurface_scene():
    """Pawns with a lamp behind them, and a lantern."""
    wax = "<subsurface_color red=\"0.85\" green=\"0.5\" blue=\"0.3\"/>"
    radii = (None, 0.02, 0.06, 0.2)
    materials = "".join(
        f"      <openpbr> <name>{i + 1}</name> <base_color red=\"0.85\" green=\"0.5\" blue=\"0.3\"/> <specular_roughness>0.3</specular_roughness> "
        + (f"<subsurface_weight>1</subsurface_weight> {wax} <subsurface_radius>{radius}</subsurface_radius> " if radius else "")
        + "</openpbr>\n"
        for i, radius in enumerate(radii)
    )
    x = [(i - 2) * 0.92 for i in range(5)]

    def each(shape, text):
        return "".join(f"      <{shape}> {text.format(x=x[i])} <material>{i + 1}</material> </{shape}>\n" for i in range(4))

    write(
        "openpbr-subsurface",
        "OpenPBR's subsurface_weight 0, and 1 with a subsurface_radius of 0.02, 0.06 and 0.2; a lamp in a thin wall.",
        room="""\
  <viewplane>
    <hres>320</hres> <vres>240</vres> <samples>1600</samples> <background red="0.012" green="0.014" blue="0.02"/>
  </viewplane>
  <camera> <eye x="0" y="1.7" z="6"/> <lookat x="0" y="0.62" z="0"/> <viewdistance>400</viewdistance> </camera>
  <integrator> <path> <clampindirect>4</clampindirect> </path> </integrator>
""",
        lights="",
        mattes="""\
      <matte> <name>table</name> <ka>0</ka> <kd>1</kd> <cd red="0.12" green="0.11" blue="0.1"/> </matte>
""",
        phongs="",
        materials_more=f"""\
    <openpbrs>
{materials}      <openpbr>
        <name>paper</name> <specular_weight>0</specular_weight> <geometry_thin_walled>true</geometry_thin_walled> <subsurface_weight>1</subsurface_weight>
        <subsurface_color red="0.95" green="0.86" blue="0.7"/> <subsurface_scatter_anisotropy>0.2</subsurface_scatter_anisotropy>
      </openpbr>
    </openpbrs>
    <emissives>
      <emissive> <name>lamp</name> <ce red="1" green="0.9" blue="0.75"/> <scaleradiance>26</scaleradiance> </emissive>
      <emissive> <name>bulb</name> <ce red="1" green="0.7" blue="0.4"/> <scaleradiance>12</scaleradiance> </emissive>
    </emissives>
""",
        floor="",
        objects=f"""\
    <planes>
      <plane> <point x="0" y="0" z="0"/> <normal x="0" y="1" z="0"/> <material>table</material> </plane>
    </planes>
    <cones>
{each("cone", '<bottom x="{x:.2f}" y="0" z="0"/> <top x="{x:.2f}" y="0.8" z="0"/> <radius>0.3</radius> <topradius>0.1</topradius> <caps>true</caps>')}    </cones>
    <spheres>
{each("sphere", '<center x="{x:.2f}" y="0.86" z="0"/> <radius>0.24</radius>')}      <sphere> <center x="{x[4]:.2f}" y="0.45" z="0"/> <radius>0.45</radius> <material>paper</material> </sphere>
      <sphere> <center x="{x[4]:.2f}" y="0.4" z="0"/> <radius>0.08</radius> <material>bulb</material> </sphere>
    </spheres>
    <rectangles>
      <rectangle>
        <corner x="-3" y="2.75" z="-2.2"/> <edge1 x="4.4" y="0" z="0"/> <edge2 x="0" y="0.9" z="0.9"/> <material>lamp</material>
      </rectangle>
    </rectangles>
""",
    )


subsurface_scene()
openpbr_row(
    "openpbr-coat",
    "OpenPBR's coat on a rough base: none, clear, clear and without darkening, red, and red and rough.",
    [
        {"base_color": (0.3, 0.5, 0.4), "specular_roughness": 0.6},
        {"base_color": (0.3, 0.5, 0.4), "specular_roughness": 0.6, "coat_weight": 1},
        {"base_color": (0.3, 0.5, 0.4), "specular_roughness": 0.6, "coat_weight": 1, "coat_darkening": 0},
        {"base_metalness": 1, "coat_weight": 1, "coat_color": (0.9, 0.2, 0.15)},
        {"base_metalness": 1, "coat_weight": 1, "coat_color": (0.9, 0.2, 0.15), "coat_roughness": 0.5},
    ],
)
openpbr_row(
    "openpbr-fuzz",
    "OpenPBR's fuzz: none, fuzz_roughness 0.25, 0.5 and 1, and dust on a metal.",
    [
        {"base_color": CLARET, "specular_weight": 0},
        {"base_color": CLARET, "specular_weight": 0, "fuzz_weight": 1, "fuzz_roughness": 0.25},
        {"base_color": CLARET, "specular_weight": 0, "fuzz_weight": 1},
        {"base_color": CLARET, "specular_weight": 0, "fuzz_weight": 1, "fuzz_roughness": 1},
        {"base_color": ORANGE, "base_metalness": 1, "fuzz_weight": 0.5, "fuzz_color": (0.8, 0.75, 0.7), "fuzz_roughness": 0.8},
    ],
)
openpbr_row(
    "openpbr-thin-film",
    "Films of 0.25, 0.4 and 0.6 micrometres on black, a film on titanium, and a bubble.",
    [
        {"base_color": (0.01, 0.01, 0.01), "specular_roughness": 0.1, "thin_film_weight": 1, "thin_film_ior": 2, "thin_film_thickness": 0.25},
        {"base_color": (0.01, 0.01, 0.01), "specular_roughness": 0.1, "thin_film_weight": 1, "thin_film_ior": 2, "thin_film_thickness": 0.4},
        {"base_color": (0.01, 0.01, 0.01), "specular_roughness": 0.1, "thin_film_weight": 1, "thin_film_ior": 2, "thin_film_thickness": 0.6},
        {
            "base_color": (0.618, 0.58, 0.543), "base_metalness": 1, "specular_color": (0.769, 0.79, 0.821), "specular_roughness": 0.2,
            "thin_film_weight": 1, "thin_film_ior": 2.4, "thin_film_thickness": 0.06,
        },
        {
            "transmission_weight": 1, "specular_roughness": 0, "specular_ior": 1, "geometry_thin_walled": "true",
            "thin_film_weight": 1, "thin_film_ior": 1.33, "thin_film_thickness": 0.45,
        },
    ],
)
openpbr_row(
    "openpbr-anisotropy",
    "Metal of specular_roughness_anisotropy 0, 0.5, 0.8 and 1, and a coat of 0.8 on red.",
    [
        {"base_metalness": 1, "specular_roughness_anisotropy": 0},
        {"base_metalness": 1, "specular_roughness_anisotropy": 0.5},
        {"base_metalness": 1, "specular_roughness_anisotropy": 0.8},
        {"base_metalness": 1, "specular_roughness_anisotropy": 1},
        {
            "base_color": CLARET, "coat_weight": 1, "coat_roughness": 0.3, "coat_roughness_anisotropy": 0.8,
        },
    ],
)


def lock(strands, seed):
    """Points of strands that hang from a line side by side, in one wave, as a hairdresser shows colours."""
    numbers = random.Random(seed)
    lines = []
    for _ in range(strands):
        across, depth, length = numbers.uniform(-0.34, 0.34), numbers.gauss(0, 0.05), numbers.gauss(1.95, 0.06)
        own, phase = numbers.gauss(0, 0.03), numbers.gauss(0, 0.35)
        points = []
        for i in range(9):
            t = i / 8
            x = across * (1 - 0.35 * t * t) + own * t + 0.05 * t * math.sin(7 * t + phase)
            z = depth * (1 + t) + 0.34 * math.sin(math.pi * (1.5 * t + 0.15)) + 0.02 * math.sin(9 * t + 3 * phase)
            points.append(f"{x:.3f} {2.15 - length * t:.3f} {z:.3f}")
        lines.append("              " + "  ".join(points))
    return ",\n".join(lines)


def hair_row(name, comment, hairs):
    """The same lock of each of those materials: their fields by name."""
    materials = "".join(
        f"      <hair> <name>lock {i}</name> " + " ".join(parameter(*item) for item in fields.items()) + " </hair>\n"
        for i, fields in enumerate(hairs)
    )
    instances = "".join(
        f'      <instance> <group>lock</group> <transform> '
        f'<translate x="{(i - (len(hairs) - 1) / 2) * 0.92:.2f}" y="0" z="0.6"/> </transform> <material>lock {i}</material> </instance>\n'
        for i in range(len(hairs))
    )
    groups = f"""\
  <groups>
    <group>
      <name>lock</name>
      <objects>
        <curves>
          <curve>
            <points>
{lock(360, 3)}
            </points>
            <radius>0.011</radius> <tipscale>0.3</tipscale> <material>lock 0</material>
          </curve>
        </curves>
      </objects>
    </group>
  </groups>
"""
    studio(
        name,
        comment,
        f"    <hairs>\n{materials}    </hairs>\n",
        f"    <instances>\n{instances}    </instances>\n",
        groups=groups,
    )


hair_row(
    "hair",
    "Locks of hair of melanin 0.2, 0.5, 0.9, of 0.5 with a melaninredness of 0.9, and of a color.",
    [
        {"melanin": 0.2},
        {"melanin": 0.5},
        {"melanin": 0.9},
        {"melanin": 0.5, "melaninredness": 0.9},
        {"color": (0.1, 0.35, 0.7)},
    ],
)
hair_row(
    "hair-roughness",
    "The same hair of roughness and radialroughness 0.1, 0.2, 0.3, 0.5 and 0.9.",
    [{"melanin": 0.45, "roughness": r, "radialroughness": r} for r in (0.1, 0.2, 0.3, 0.5, 0.9)],
)


write(
    "emissive",
    "Lamps of any shape: a ring, a ball and a panel.",
    room=ROOM.replace("<samples>16", "<samples>256").replace("0.04", "0").replace("0.06", "0").replace("0.09", "0"),
    lights="",
    materials_more="""\
    <emissives>
      <emissive> <name>warm</name> <ce red="1" green="0.62" blue="0.25"/> <scaleradiance>7</scaleradiance> </emissive>
      <emissive> <name>cool</name> <ce red="0.35" green="0.6" blue="1"/> <scaleradiance>9</scaleradiance> </emissive>
      <emissive> <name>panel</name> <ce red="1" green="0.95" blue="0.9"/> <scaleradiance>9</scaleradiance> </emissive>
    </emissives>
""",
    objects="""\
    <spheres>
      <sphere> <center x="0.2" y="0.75" z="0.2"/> <radius>0.75</radius> <material>clay</material> </sphere>
      <sphere> <center x="1.75" y="0.22" z="1.3"/> <radius>0.22</radius> <material>cool</material> </sphere>
    </spheres>
    <toruses>
      <torus>
        <center x="-1.5" y="0.95" z="-0.4"/> <axis x="0.7" y="0" z="1"/> <sweptradius>0.85</sweptradius>
        <tuberadius>0.07</tuberadius> <material>warm</material>
      </torus>
    </toruses>
    <rectangles>
      <rectangle>
        <corner x="-3" y="4" z="-3"/> <edge1 x="4" y="0" z="0"/> <edge2 x="0" y="0.6" z="2"/> <material>panel</material>
      </rectangle>
    </rectangles>
""",
)
