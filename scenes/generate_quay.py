#!/usr/bin/env python3
"""Writes gallery/quay.xml: street lamps along a canal, in the fog of a winter's evening."""
import math
import random

from scene_xml import color, number, srgb, vector, write_gallery

WATER, CELL = -0.9, 0.16  # the level of the canal, and the cells of its mesh
EDGE = 0.4  # of the quay, where the water begins on its right

TEXT = """<!-- Street lamps along a canal, in the fog of a winter's evening. Made by scenes/generate_quay.py. -->
<raytracer>
  <viewplane>
    <hres>1920</hres> <vres>1080</vres> <samples>512</samples> <filter>blackmanharris</filter>
    <viewtransform>agx</viewtransform> <exposure>0.6</exposure>
  </viewplane>
  <camera> <eye x="-0.35" y="1.62" z="6.4"/> <lookat x="1.75" y="1.25" z="-8"/> <fov>44</fov> </camera>
  <integrator> <path> <maxdepth>10</maxdepth> <clampindirect>4</clampindirect> </path> </integrator>
  <lights>
    <spotlights>
{lights}    </spotlights>
    <environmentlights>
      <environmentlight> <color red="0.16" green="0.26" blue="0.5"/> <scaleradiance>0.16</scaleradiance> </environmentlight>
    </environmentlights>
  </lights>
  <textures>
    <noises>
      <noise> <name>granite</name> {granite1} {granite2} <scale>0.12</scale> <octaves>6</octaves> </noise>
      <noise> <name>brick</name> {brick1} {brick2} <scale>1.4</scale> <octaves>7</octaves> </noise>
      <noise>
        <name>grit</name> <color1 red="0" green="0" blue="0"/> <color2 red="1" green="1" blue="1"/> <scale>0.16</scale> <octaves>5</octaves>
      </noise>
    </noises>
  </textures>
  <materials>
    <openpbrs>
      <openpbr> <name>cobbles</name> <base_color texture="granite"/> <specular_roughness>0.28</specular_roughness> <bump texture="grit" height="0.006"/> </openpbr>
      <openpbr> <name>kerb</name> <base_color texture="granite"/> <specular_roughness>0.45</specular_roughness> <bump texture="grit" height="0.01"/> </openpbr>
      <openpbr> <name>wall</name> <base_color texture="brick"/> <specular_roughness>0.7</specular_roughness> </openpbr>
      <openpbr> <name>iron</name> <base_color red="0.02" green="0.022" blue="0.024"/> <specular_roughness>0.35</specular_roughness> </openpbr>
      <openpbr> <name>wood</name> {wood} <specular_roughness>0.4</specular_roughness> </openpbr>
      <openpbr> <name>paint</name> {paint} <specular_roughness>0.3</specular_roughness> </openpbr>
      <openpbr> <name>water</name> <base_color red="0.008" green="0.011" blue="0.01"/> <specular_ior>1.33</specular_ior> <specular_roughness>0</specular_roughness> </openpbr>
    </openpbrs>
    <emissives>
      <emissive> <name>bulb</name> <ce red="1" green="0.72" blue="0.42"/> <scaleradiance>34</scaleradiance> </emissive>
{windows}    </emissives>
    <fogs>
      <fog> <name>fog</name> <meanfreepath>24</meanfreepath> <anisotropy>0.35</anisotropy> </fog>
    </fogs>
  </materials>
  <groups>
    <group>
      <name>lamp</name>
      <objects>
        <meshes>
{post}        </meshes>
        <cylinders>
          <cylinder> <bottom x="0" y="3.42" z="0"/> <top x="0.55" y="3.62" z="0"/> <radius>0.022</radius> <caps>true</caps> <material>iron</material> </cylinder>
        </cylinders>
        <cones>
          <cone> <bottom x="0.55" y="3.46" z="0"/> <top x="0.55" y="3.66" z="0"/> <radius>0.24</radius> <topradius>0.05</topradius> <material>iron</material> </cone>
        </cones>
      </objects>
    </group>
  </groups>
  <objects>
    <spheres>
{bulbs}    </spheres>
    <rectangles>
{panes}    </rectangles>
    <boxes>
{boxes}      <box> <name>air</name> <min x="-30" y="-1.5" z="-140"/> <max x="40" y="22" z="7"/> <material>fog</material> </box>
    </boxes>
    <meshes>
      <mesh> <name>canal</name> <normals>smooth</normals> <material>water</material>
        <positions>
{positions}        </positions>
        <faces>
{faces}        </faces>
      </mesh>
{boat}    </meshes>
    <instances>
{instances}    </instances>
  </objects>
</raytracer>
"""

LAMPS = [(-0.1, 0.5 - 7.5 * i) for i in range(9)]


def turned(profile, steps, indent):
    """A mesh: the profile turned about the y axis."""
    rows = len(profile)
    places, faces = [], []
    for i in range(steps):
        c, s = math.cos(2 * math.pi * i / steps), math.sin(2 * math.pi * i / steps)
        places.append("  ".join(f"{number(r * c)} {number(y)} {number(r * s)}" for r, y in profile))
        a, b = i * rows, (i + 1) % steps * rows
        for j in range(rows - 1):
            faces.append(f"{a + j} {a + j + 1} {b + j + 1}  {a + j} {b + j + 1} {b + j}")
    lines = "".join(f"{indent}    {p}\n" for p in places)
    numbers = "".join(f"{indent}    {'  '.join(faces[i:i + 6])}\n" for i in range(0, len(faces), 6))
    return (
        f"{indent}<mesh> <normals>smooth</normals> <material>iron</material>\n{indent}  <positions>\n{lines}{indent}  </positions>\n"
        f"{indent}  <faces>\n{numbers}{indent}  </faces>\n{indent}</mesh>\n"
    )


def canal():
    """Its water, with few waves; the farther away, the larger the cells."""
    r = random.Random(8)
    trains = []
    for i in range(16):
        length = 0.35 * (2.2 / 0.35) ** (i / 15)
        toward, k = r.gauss(1.2, 0.9), 2 * math.pi / length
        trains.append((k * math.cos(toward), k * math.sin(toward), r.uniform(0, 2 * math.pi), 0.0011 * length))
    rows, z = [], 7.0
    while z > -140:
        rows.append(z)
        z -= CELL * max(1.0, (7 - z) / 9)
    columns = [EDGE - 0.05 + 11.7 * (i / 60) ** 1.25 for i in range(61)]
    height = lambda x, z: WATER + sum(a * math.sin(kx * x + kz * z + phase) for kx, kz, phase, a in trains)
    positions = "".join(
        "          " + "  ".join(f"{number(x)} {number(height(x, z))} {number(z)}" for x in columns) + "\n" for z in rows
    )
    n = len(columns)
    faces = "".join(
        "          " + "  ".join(f"{j * n + i} {j * n + i + 1} {(j + 1) * n + i + 1}  {j * n + i} {(j + 1) * n + i + 1} {(j + 1) * n + i}" for i in range(n - 1)) + "\n"
        for j in range(len(rows) - 1)
    )
    return positions, faces


def boat(middle, length, beam):
    """A rowing boat along the quay: its outside and its inside, which meet at the gunwale. Inside, boards keep one's
    feet above the water."""
    sections, steps = 20, 7
    positions, faces = [], []
    for inset in (0.0, 0.05):
        for i in range(sections + 1):
            t = 2 * i / sections - 1
            half = max(beam / 2 * (1 - abs(t) ** 3.2) ** 0.75 - inset, 0.004)
            keel, gunwale = WATER - 0.22 + 0.3 * t**4 + inset * 2, WATER + 0.36 + 0.26 * t * t
            for j in range(-steps, steps + 1):
                a = j / steps * math.pi / 2
                y = keel + (gunwale - keel) * (1 - math.cos(a))
                positions.append((middle[0] + half * math.sin(a), max(y, WATER + 0.05) if inset else y, middle[1] + t * length / 2 * (1 - inset / 3)))
    row = 2 * steps + 1
    rows = sections + 1
    for side in range(2):
        for i in range(sections):
            for j in range(row - 1):
                a = (side * rows + i) * row + j
                faces.append((a, a + 1, a + row + 1, a + row))
    for j in (0, row - 1):
        for i in range(sections):
            a, b = i * row + j, (rows + i) * row + j
            faces.append((a, a + row, b + row, b))
    lines = "".join(f"          {'  '.join(' '.join(number(c) for c in v) for v in positions[i:i + row])}\n" for i in range(0, len(positions), row))
    numbers = "".join(f"          {a} {b} {c}  {a} {c} {d}\n" for a, b, c, d in faces)
    return f"      <mesh> <name>boat</name> <normals>flat</normals> <material>paint</material>\n        <positions>\n{lines}        </positions>\n        <faces>\n{numbers}        </faces>\n      </mesh>\n"


def box(low, high, material):
    return f"      <box> {vector('min', low)} {vector('max', high)} <material>{material}</material> </box>\n"


def cobbles(boxes):
    """In rows across the quay, as far as one can tell them apart."""
    r = random.Random(3)
    z = 6.2
    row = 0
    while z > -26:
        depth = 0.17 if z > -12 else 0.34
        x = -5.2 - (row % 2) * 0.12
        while x < EDGE - 0.5:
            width = r.uniform(0.2, 0.3) * (1 if z > -12 else 2)
            high = min(x + width, EDGE - 0.46)
            boxes.append(box((x + 0.009, -0.1, z - depth + 0.009), (high - 0.009, r.uniform(-0.012, 0.004), z - 0.009), "cobbles"))
            x += width
        z -= depth
        row += 1
    boxes.append(box((-5.4, -0.2, -140), (EDGE - 0.46, -0.02, 7), "kerb"))
    z = 6.5
    while z > -140:
        length = 1.1 if z > -30 else 4.4
        boxes.append(box((EDGE - 0.45, -1.4, z - length + 0.006), (EDGE, 0.035, z - 0.006), "kerb"))
        z -= length


def houses(boxes, panes):
    """On both sides, with some windows lit; far ones are plain."""
    r = random.Random(21)
    for side in (-1, 1):
        z = 8.0
        while z > -120:
            width, storeys = r.choice((4.6, 5.4, 6.2, 7.0)), r.choice((3, 3, 4, 4, 5))
            high = 1.2 + storeys * 2.9
            front = -5.4 if side < 0 else 12.0 + r.uniform(0, 0.25)
            low = -0.2 if side < 0 else -1.4
            x0, x1 = (front - 6, front) if side < 0 else (front, front + 6)
            boxes.append(box((x0, low, z - width + 0.02), (x1, high, z - 0.02), "wall"))
            across = 3 if width > 5 else 2
            for storey in range(storeys):
                for i in range(across):
                    middle, sill = z - width * (i + 0.5) / across, 0.9 + storey * 2.9
                    frame = (middle - 0.58, sill - 0.08, middle + 0.58, sill + 1.78)
                    out = front + (0.03 if side < 0 else -0.03)
                    boxes.append(box((min(front, out), frame[1], frame[0]), (max(front, out), frame[3], frame[2]), "wood"))
                    if r.random() < (0.34 if side > 0 else 0.22) and (side > 0 or z < -6):
                        glow, face = f"window{r.randrange(4)}", out + (0.004 if side < 0 else -0.004)
                        for low_z in (middle - 0.5, middle + 0.04):
                            corner = (face, sill, low_z)
                            edges = ((0, 1.7, 0), (0, 0, 0.46)) if side < 0 else ((0, 0, 0.46), (0, 1.7, 0))
                            panes.append(
                                f"      <rectangle> {vector('corner', corner)} {vector('edge1', edges[0])} {vector('edge2', edges[1])} <material>{glow}</material> </rectangle>\n"
                            )
            z -= width


def main():
    boxes, panes = [], []
    cobbles(boxes)
    houses(boxes, panes)
    for z in [2.4 - 2.5 * i for i in range(16)]:  # bollards between the lamps, and a chain's posts
        if all(abs(z - lamp[1]) > 0.6 for lamp in LAMPS):
            boxes.append(box((EDGE - 0.3, 0.03, z - 0.07), (EDGE - 0.16, 0.75, z + 0.07), "iron"))
            boxes.append(box((EDGE - 0.32, 0.75, z - 0.09), (EDGE - 0.14, 0.8, z + 0.09), "iron"))
    for z in (-0.9, 0.3):  # the boat's thwarts, and a bench on the quay
        boxes.append(box((1.0, WATER + 0.22, z - 0.13), (2.0, WATER + 0.26, z + 0.13), "wood"))
    for x in (-2.32, -2.16, -2.0):
        boxes.append(box((x, 0.43, -3.6), (x + 0.12, 0.47, -1.8), "wood"))
    for y in (0.58, 0.74):
        boxes.append(box((-2.42, y, -3.6), (-2.38, y + 0.12, -1.8), "wood"))
    for z in (-3.45, -1.99):
        boxes.append(box((-2.42, 0, z), (-2.36, 0.88, z + 0.04), "iron"))
        boxes.append(box((-1.94, 0, z), (-1.9, 0.43, z + 0.04), "iron"))
        boxes.append(box((-2.42, 0.38, z), (-1.88, 0.43, z + 0.04), "iron"))
    post = turned([(0.16, 0), (0.16, 0.1), (0.12, 0.14), (0.1, 0.5), (0.12, 0.54), (0.07, 0.6), (0.055, 2.0), (0.045, 3.4), (0.06, 3.42), (0.06, 3.5), (0.001, 3.6)], 24, "          ")
    lights, bulbs, instances = [], [], []
    for x, z in LAMPS:
        lights.append(
            f'      <spotlight> {vector("location", (x + 0.55, 3.4, z))} {vector("lookat", (x + 0.55, 0, z))} <coneangle>128</coneangle> <penumbraangle>24</penumbraangle> '
            '<scaleradiance>21</scaleradiance> <color red="1" green="0.72" blue="0.42"/> <falloff>inversesquare</falloff> </spotlight>\n'
        )
        bulbs.append(f'      <sphere> {vector("center", (x + 0.55, 3.5, z))} <radius>0.085</radius> <material>bulb</material> </sphere>\n')
        instances.append(f'      <instance> <group>lamp</group> <transform> <translate x="{number(x)}" y="0" z="{number(z)}"/> </transform> </instance>\n')
    glows = [(1, 0.62, 0.28), (1, 0.5, 0.18), (1, 0.75, 0.45), (0.95, 0.8, 0.6)]
    windows = "".join(
        f"      <emissive> <name>window{i}</name> {color('ce', c)} <scaleradiance>{(1.6, 1.1, 2.2, 0.8)[i]}</scaleradiance> </emissive>\n" for i, c in enumerate(glows)
    )
    positions, faces = canal()
    write_gallery(
        "quay",
        TEXT.format(
            lights="".join(lights), granite1=color("color1", srgb("#3a3836")), granite2=color("color2", srgb("#7c7772")),
            brick1=color("color1", srgb("#3f241c")), brick2=color("color2", srgb("#6d4434")), wood=color("base_color", srgb("#b9b2a2")),
            paint=color("base_color", srgb("#7d2a1e")), boat=boat((1.5, -0.4), 4.4, 1.35), windows=windows, post=post, bulbs="".join(bulbs), panes="".join(panes), boxes="".join(boxes), positions=positions,
            faces=faces, instances="".join(instances),
        ),
    )


if __name__ == "__main__":
    main()
