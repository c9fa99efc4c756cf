#!/usr/bin/env python3
"""Writes gallery/pool.xml: a ball and two rings in a swimming pool, in the afternoon sun."""
import math
import random

from scene_xml import color, number, srgb, vector, write_gallery

LEFT, RIGHT, BACK, FRONT, DEPTH = -2.5, 4.6, -2.0, 3.2, 1.15  # of the pool, in metres
LEVEL = -0.13  # of the water
CELL = 0.05  # of its mesh
STONE, JOINT = 0.62, 0.006

TEXT = """<!-- A ball and two rings in a swimming pool, in the afternoon sun. Made by scenes/generate_pool.py. -->
<raytracer>
  <viewplane>
    <hres>1920</hres> <vres>1080</vres> <samples>512</samples> <filter>blackmanharris</filter>
    <viewtransform>agx</viewtransform> <exposure>0.35</exposure>
  </viewplane>
  <thinlenscamera>
    <eye x="-0.55" y="2.0" z="3.5"/> <lookat x="0.12" y="-0.52" z="-0.1"/> <fov>38</fov>
    <lensradius>0.01</lensradius> <focaldistance>4.3</focaldistance>
  </thinlenscamera>
  <integrator> <path> <caustics>photons</caustics> <clampindirect>6</clampindirect> </path> </integrator>
  <lights>
    <directionallights>
      <directionallight>
        <direction x="-0.62" y="0.72" z="-0.3"/> <color red="1" green="0.86" blue="0.66"/> <scaleradiance>4.5</scaleradiance> <angle>0.53</angle>
      </directionallight>
    </directionallights>
    <environmentlights>
      <environmentlight> <color red="0.34" green="0.5" blue="0.8"/> <scaleradiance>0.5</scaleradiance> </environmentlight>
    </environmentlights>
  </lights>
  <textures>
    <noises>
      <noise> <name>veins</name> {stone1} {stone2} <scale>0.25</scale> <octaves>7</octaves> </noise>
      <noise>
        <name>grit</name> <color1 red="0" green="0" blue="0"/> <color2 red="1" green="1" blue="1"/> <scale>0.05</scale> <octaves>5</octaves>
      </noise>
    </noises>
    <checkers>
      <checker> <name>mosaic</name> {tile1} {tile2} <scale>0.05</scale> </checker>
    </checkers>
  </textures>
  <materials>
    <mattes>
      <matte> <name>tiles</name> <ka>0</ka> <kd>0.85</kd> <cd texture="mosaic"/> </matte>
      <matte> <name>joint</name> <ka>0</ka> <kd>1</kd> <cd red="0.16" green="0.15" blue="0.13"/> </matte>
    </mattes>
    <openpbrs>
{stones}      <openpbr> <name>coral</name> {coral} <specular_roughness>0.35</specular_roughness> </openpbr>
      <openpbr> <name>cream</name> {cream} <specular_roughness>0.35</specular_roughness> </openpbr>
    </openpbrs>
    <dielectrics>
      <dielectric>
        <name>water</name> <ior>1.33</ior> <attenuationcolor red="0.6" green="0.92" blue="0.96"/> <attenuationdistance>2.2</attenuationdistance>
      </dielectric>
    </dielectrics>
  </materials>
  <objects>
    <rectangles>
{walls}    </rectangles>
    <boxes>
{boxes}    </boxes>
    <spheres>
      <sphere> <center x="1.02" y="-0.03" z="-0.5"/> <radius>0.25</radius> <material>coral</material> </sphere>
    </spheres>
    <toruses>
      <torus> <center x="-0.6" y="{flat}" z="0.62"/> <axis x="0" y="1" z="0"/> <sweptradius>0.24</sweptradius> <tuberadius>0.045</tuberadius> <material>cream</material> </torus>
      <torus> <center x="-0.36" y="{leaning}" z="0.36"/> <axis x="0.3" y="0.92" z="-0.26"/> <sweptradius>0.24</sweptradius> <tuberadius>0.045</tuberadius> <material>coral</material> </torus>
    </toruses>
    <meshes>
      <mesh> <name>surface</name> <normals>smooth</normals> <material>water</material>
        <positions>
{positions}        </positions>
        <faces>
{faces}        </faces>
      </mesh>
    </meshes>
  </objects>
</raytracer>
"""


def waves():
    """Height of the water: trains of waves from all sides, more from one, the short ones low."""
    r = random.Random(5)
    trains = []
    for i in range(26):
        length = 0.28 * (1.75 / 0.28) ** (i / 25)
        toward = r.gauss(0.4, 1.1)
        k = 2 * math.pi / length
        trains.append((k * math.cos(toward), k * math.sin(toward), r.uniform(0, 2 * math.pi), 0.0062 * length**1.15))
    return lambda x, z: sum(a * math.sin(kx * x + kz * z + phase) for kx, kz, phase, a in trains)


def surface():
    height = waves()
    # A little into the walls, so that no light comes past its edge.
    left, back = LEFT - 0.01, BACK - 0.01
    columns, rows = math.ceil((RIGHT - left) / CELL) + 1, math.ceil((FRONT - back) / CELL) + 1
    positions = []
    for j in range(rows):
        places = []
        for i in range(columns):
            x, z = left + i * CELL, back + j * CELL
            places.append(f"{number(x)} {number(LEVEL + height(x, z))} {number(z)}")
        positions.append("          " + "  ".join(places) + "\n")
    faces = []
    for j in range(rows - 1):
        a = j * columns
        for i in range(columns - 1):
            p, q = a + i, a + columns + i  # those behind and in front
            faces.append(f"          {p} {q} {q + 1}  {p} {q + 1} {p + 1}\n")
    return "".join(positions), "".join(faces)


def wall(corner, edge1, edge2):
    return f"      <rectangle> {vector('corner', corner)} {vector('edge1', edge1)} {vector('edge2', edge2)} <material>tiles</material> </rectangle>\n"


def stones():
    """The deck around it, in rows whose joints alternate; the first row reaches over the edge."""
    r = random.Random(11)
    boxes = []

    def stone(x0, x1, z0, z1):
        low, high = (x0 + JOINT / 2, -0.05, z0 + JOINT / 2), (x1 - JOINT / 2, r.uniform(-0.0015, 0), z1 - JOINT / 2)
        boxes.append(f"      <box> {vector('min', low)} {vector('max', high)} <material>stone{r.randrange(len(TINTS))}</material> </box>\n")

    for row in range(9):
        z1 = BACK + 0.02 - row * STONE * 0.7
        x = LEFT + 0.02 - 4 * STONE - (row % 2) * STONE / 2
        while x < RIGHT + 4:
            stone(x, x + STONE, z1 - STONE * 0.7, z1)
            x += STONE
    for column in range(5):
        x1 = LEFT + 0.02 - column * STONE * 0.7
        z = BACK + 0.02 + (column % 2) * STONE / 2
        while z < FRONT:
            stone(x1 - STONE * 0.7, x1, z, z + STONE)
            z += STONE
    boxes.append("      <box> <min x=\"-9\" y=\"-0.06\" z=\"-12\"/> <max x=\"12\" y=\"-0.012\" z=\"-2.01\"/> <material>joint</material> </box>\n")
    boxes.append("      <box> <min x=\"-9\" y=\"-0.06\" z=\"-2.01\"/> <max x=\"-2.61\" y=\"-0.012\" z=\"6\"/> <material>joint</material> </box>\n")
    return "".join(boxes)


TINTS = (0.92, 0.97, 1.0, 1.04)
width, length, tall = RIGHT - LEFT, FRONT - BACK, DEPTH - 0.05
walls = (
    wall((LEFT, -DEPTH, FRONT), (width, 0, 0), (0, 0, -length))
    + wall((LEFT, -DEPTH, BACK), (width, 0, 0), (0, tall, 0))
    + wall((LEFT, -DEPTH, FRONT), (0, 0, -length), (0, tall, 0))
    + wall((RIGHT, -DEPTH, BACK), (0, 0, length), (0, tall, 0))
    + wall((RIGHT, -DEPTH, FRONT), (-width, 0, 0), (0, tall, 0))
)
slabs = "".join(
    f"      <openpbr> <name>stone{i}</name> {color('base_color', (tint,) * 3)[:-2]} texture=\"veins\"/> <specular_roughness>0.55</specular_roughness>"
    ' <bump texture="grit" height="0.004"/> </openpbr>\n'
    for i, tint in enumerate(TINTS)
)
positions, faces = surface()
write_gallery(
    "pool",
    TEXT.format(
        stone1=color("color1", srgb("#b9aa94")), stone2=color("color2", srgb("#d9ccb8")), tile1=color("color1", srgb("#b5d6d9")),
        tile2=color("color2", srgb("#9fc6cc")), stones=slabs, coral=color("base_color", srgb("#dd5836")), cream=color("base_color", srgb("#e6dfd2")),
        walls=walls, boxes=stones(), flat=number(-DEPTH + 0.045), leaning=number(-DEPTH + 0.14), positions=positions, faces=faces,
    ),
)
