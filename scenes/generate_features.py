#!/usr/bin/env python3
"""Writes the small scenes beside this file, one a feature: the pictures of docs/scene-format.md."""
import math
import os

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


def write(name, comment, room=ROOM, lights=LIGHTS, mattes=CLAY, phongs="", floor=FLOOR, objects=SPHERE):
    materials = f"    <mattes>\n{FLOOR_MATERIAL}{mattes}    </mattes>\n"
    if phongs:
        materials += f"    <phongs>\n{phongs}    </phongs>\n"
    text = (
        f"<!-- {comment} -->\n<raytracer>\n{room}{lights}  <materials>\n{materials}  </materials>\n"
        f"  <objects>\n{floor}{objects}  </objects>\n</raytracer>\n"
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
        f"{samples} sample{'s' if samples > 1 else ''} a pixel, on thin spokes.",
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

# Integrator
write(
    "normals",
    "Shading normals as colours: x is red, y green, z blue.",
    room=ROOM + "  <integrator> <normals/> </integrator>\n",
    objects="""\
    <spheres> <sphere> <center x="-1.4" y="1" z="0"/> <radius>1</radius> <material>clay</material> </sphere> </spheres>
    <toruses>
      <torus>
        <center x="1.2" y="1.1" z="0"/> <axis x="0.3" y="0.6" z="1"/>
        <sweptradius>0.8</sweptradius> <tuberadius>0.3</tuberadius> <material>clay</material>
      </torus>
    </toruses>
""",
)
