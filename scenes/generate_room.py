"""Writes gallery/room.xml: a bentwood chair in a plaster room, by the light of one window."""
import math
import random

from scene_xml import add, color, cross, number, srgb, unit, vector, write_gallery

LEFT, RIGHT, BACK, FRONT, HEIGHT = -1.9, 2.5, -2.1, 4.6, 2.85  # of the room, in metres
SILL, LINTEL, NEAR, FAR = 0.82, 2.3, -0.35, -1.45  # of the window in the left wall, at its frame
SPLAY, DEPTH = 0.16, 0.26  # how much wider the opening is inside, and how thick the wall is
PLANK, GAP = 0.165, 0.0025

TEXT = """<!-- A bentwood chair in a plaster room: the light of one window, and what the walls pass on. Made by scenes/generate_room.py. -->
<raytracer>
  <viewplane>
    <hres>1920</hres> <vres>1280</vres> <samples>1024</samples> <background red="0" green="0" blue="0"/>
    <viewtransform>khronos-neutral</viewtransform> <exposure>1.35</exposure>
  </viewplane>
  <thinlenscamera>
    <eye x="0.8" y="1.2" z="4.1"/> <lookat x="-0.36" y="0.94" z="-1.2"/> <fov>26.5</fov>
    <lensradius>0.012</lensradius> <focaldistance>4.9</focaldistance>
  </thinlenscamera>
  <integrator> <path> <clampindirect>0.6</clampindirect> </path> </integrator>
  <textures>
    <noises>
      <noise>
        <name>trowel</name> <color1 red="0" green="0" blue="0"/> <color2 red="1" green="1" blue="1"/> <scale>0.35</scale> <octaves>7</octaves>
      </noise>
      <noise>
        <name>lime</name> {lime1} {lime2} <scale>0.9</scale> <octaves>6</octaves>
      </noise>
      <noise>
        <name>use</name> <color1 red="0.75" green="0.75" blue="0.75"/> <color2 red="1" green="1" blue="1"/> <scale>0.12</scale> <octaves>6</octaves>
      </noise>
    </noises>
  </textures>
  <materials>
    <mattes>
      <matte> <name>plaster</name> <ka>0</ka> <kd>1</kd> <cd texture="lime"/> <bump texture="trowel" height="0.008"/> </matte>
      <matte> <name>shade</name> <ka>0</ka> <kd>1</kd> <cd red="0.22" green="0.2" blue="0.18"/> </matte>
    </mattes>
    <openpbrs>
      <openpbr> <name>paint</name> {paint} <specular_roughness>0.45</specular_roughness> </openpbr>
      <openpbr> <name>lacquer</name> {lacquer} <specular_roughness>0.34</specular_roughness> </openpbr>
{woods}    </openpbrs>
    <emissives>
      <emissive> <name>day</name> <ce red="0.9" green="0.95" blue="1"/> <scaleradiance>2.5</scaleradiance> </emissive>
      <emissive> <name>next window</name> <ce red="0.9" green="0.95" blue="1"/> <scaleradiance>5</scaleradiance> </emissive>
    </emissives>
  </materials>
  <groups>
    <group> <name>chair</name>
      <objects>
{chair}      </objects>
    </group>
  </groups>
  <objects>
    <rectangles>
{rectangles}    </rectangles>
    <boxes>
{boxes}    </boxes>
    <cylinders>
{cylinders}    </cylinders>
    <instances>
      <instance> <group>chair</group> <transform> <rotate x="0" y="1" z="0" angle="-38"/> <translate x="0.22" y="0" z="-0.98"/> </transform> </instance>
    </instances>
  </objects>
</raytracer>
"""

WOODS = ["#9c7a57", "#b79b78", "#ae9170", "#bfa483", "#b3957a"]
r = random.Random(4)


def curve(points, count):
    """So many places along a Catmull-Rom spline through the points."""
    ends = [add(points[0], add(points[0], points[1], -1))] + points + [add(points[-1], add(points[-1], points[-2], -1))]
    places = []
    for i in range(count):
        t = i / (count - 1) * (len(points) - 1)
        k = min(int(t), len(points) - 2)
        t -= k
        a, b, c, d = ends[k : k + 4]
        places.append(
            tuple(
                0.5 * (2 * q + (s - p) * t + (2 * p - 5 * q + 4 * s - u) * t * t + (3 * q - p - 3 * s + u) * t**3)
                for p, q, s, u in zip(a, b, c, d)
            )
        )
    return places


def sweep(places, radius, sides=14):
    """A round rod along the places as a <mesh>; radius: from 0 to 1 along it."""
    positions, faces = [], []
    side = None
    for i, place in enumerate(places):
        along = unit(add(places[min(i + 1, len(places) - 1)], places[max(i - 1, 0)], -1))
        if side is None:
            side = cross(along, (0.1, 0.2, 1))
        side = unit(add(side, along, -sum(a * b for a, b in zip(side, along))))
        other = cross(along, side)
        size = radius(i / (len(places) - 1))
        for k in range(sides):
            angle = 2 * math.pi * k / sides
            positions.append(add(add(place, side, size * math.cos(angle)), other, size * math.sin(angle)))
    for i in range(len(places) - 1):
        for k in range(sides):
            a, b = i * sides + k, i * sides + (k + 1) % sides
            faces.append(f"{a} {b} {b + sides} {a + sides},")
    numbers = ", ".join(" ".join(number(c) for c in p) for p in positions)
    return (
        f"          <mesh> <positions>{numbers}</positions>\n            <faces>{' '.join(faces)}</faces>\n"
        f"            <normals>smooth</normals> <material>lacquer</material> </mesh>\n"
    )


def mirrored(points):
    return [(-x, y, z) for x, y, z in points]


def chair():
    """It faces +z. The back, legs and arch in one, is one rod; the seat and the brace below are rings."""
    half = [(0.195, 0.0, -0.245), (0.182, 0.2, -0.212), (0.17, 0.4, -0.187), (0.168, 0.5, -0.187), (0.176, 0.62, -0.212),
            (0.186, 0.74, -0.25), (0.17, 0.845, -0.285), (0.1, 0.912, -0.31)]
    back = half + [(0.0, 0.93, -0.317)] + mirrored(half)[::-1]
    half = [(0.09, 0.44, -0.202), (0.092, 0.5, -0.206), (0.105, 0.6, -0.224), (0.108, 0.69, -0.245), (0.075, 0.755, -0.263)]
    inner = half + [(0.0, 0.778, -0.269)] + mirrored(half)[::-1]
    leg = [(0.187, 0.0, 0.195), (0.17, 0.15, 0.167), (0.153, 0.3, 0.14), (0.145, 0.44, 0.125)]
    meshes = sweep(curve(back, 110), lambda t: 0.0125 + 0.0035 * min(1, 6 * min(t, 1 - t)))
    meshes += sweep(curve(inner, 60), lambda t: 0.0105)
    for points in (leg, mirrored(leg)):
        meshes += sweep(curve(points, 24), lambda t: 0.0125 + 0.0055 * t)
    lines = "        <meshes>\n" + meshes + "        </meshes>\n"
    lines += "        <toruses>\n"
    for y, z, swept, tube, stretch in ((0.456, -0.02, 0.205, 0.017, 1.15), (0.432, -0.02, 0.206, 0.014, 1.0), (0.25, -0.0385, 0.222, 0.0095, 1.0)):
        lines += (
            f"          <torus> <sweptradius>{number(swept)}</sweptradius> <tuberadius>{number(tube)}</tuberadius> <material>lacquer</material>"
            f' <transform> <scale x="1" y="{number(stretch)}" z="1"/> {vector("translate", (0, y, z))} </transform> </torus>\n'
        )
    lines += "        </toruses>\n"
    # The seat: a shallow dish inside its ring.
    lines += (
        "        <spheres>\n"
        '          <sphere> <center x="0" y="0" z="0"/> <radius>0.202</radius> <material>lacquer</material>'
        ' <transform> <scale x="1" y="0.07" z="1"/> <translate x="0" y="0.453" z="-0.02"/> </transform> </sphere>\n'
        "        </spheres>\n"
    )
    return lines


rectangles, boxes, cylinders = [], [], []


def rectangle(corner, edge1, edge2, material="plaster"):
    place = f"{vector('corner', corner)} {vector('edge1', edge1)} {vector('edge2', edge2)}"
    rectangles.append(f"<rectangle> {place} <material>{material}</material> </rectangle>")


def box(lower, upper, material):
    boxes.append(f"<box> {vector('min', lower)} {vector('max', upper)} <material>{material}</material> </box>")


def rod(bottom, top, radius, material):
    place = f"{vector('bottom', bottom)} {vector('top', top)} <radius>{number(radius)}</radius>"
    cylinders.append(f"<cylinder> {place} <material>{material}</material> </cylinder>")


def room():
    width, depth = RIGHT - LEFT, FRONT - BACK
    rectangle((LEFT, 0, BACK), (width, 0, 0), (0, HEIGHT, 0))
    rectangle((LEFT, 0, FRONT), (width, 0, 0), (0, HEIGHT, 0), "shade")
    rectangle((RIGHT, 0, BACK), (0, 0, depth), (0, HEIGHT, 0), "shade")
    rectangle((LEFT, HEIGHT, BACK), (width, 0, 0), (0, 0, depth))
    # The left wall about the opening, which is wider inside, and the opening's slanted sides with rounded edges.
    bottom, top, near, far = SILL, LINTEL + 0.5 * SPLAY, NEAR + SPLAY, FAR - SPLAY
    rectangle((LEFT, 0, BACK), (0, HEIGHT, 0), (0, 0, far - BACK))
    rectangle((LEFT, 0, near), (0, HEIGHT, 0), (0, 0, FRONT - near))
    rectangle((LEFT, 0, far), (0, bottom, 0), (0, 0, near - far))
    rectangle((LEFT, top, far), (0, HEIGHT - top, 0), (0, 0, near - far))
    outside = LEFT - DEPTH
    rectangle((LEFT, bottom, far), (-DEPTH, 0, FAR - far), (0, top - bottom, 0))
    rectangle((LEFT, bottom, near), (-DEPTH, 0, NEAR - near), (0, top - bottom, 0))
    rectangle((LEFT, top, far), (-DEPTH, LINTEL - top, 0), (0, 0, near - far))
    for z in (far, near):
        rod((LEFT - 0.006, bottom, z), (LEFT - 0.006, top, z), 0.009, "plaster")
    rod((LEFT - 0.006, top, far), (LEFT - 0.006, top, near), 0.009, "plaster")
    # Its board, frame and bars, and six panes that shine: between the bars, so that these shade little of their light.
    box((outside, SILL - 0.035, far - 0.03), (LEFT + 0.05, SILL, near + 0.03), "paint")
    rod((LEFT + 0.05, SILL - 0.0175, far - 0.03), (LEFT + 0.05, SILL - 0.0175, near + 0.03), 0.0175, "paint")
    middle = (FAR + NEAR) / 2
    panes_z = ((FAR + 0.06, middle - 0.045), (middle + 0.045, NEAR - 0.06))
    pane = (LINTEL - SILL - 0.13 - 0.048) / 3
    panes_y = [(SILL + 0.07 + i * (pane + 0.024), SILL + 0.07 + i * (pane + 0.024) + pane) for i in range(3)]
    for z0, z1 in ((FAR, panes_z[0][0]), (panes_z[0][1], panes_z[1][0]), (panes_z[1][1], NEAR)):
        box((outside, SILL, z0), (outside + 0.06, LINTEL, z1), "paint")
    for y0, y1 in ((SILL, panes_y[0][0]), (panes_y[2][1], LINTEL)):
        box((outside, y0, FAR), (outside + 0.055, y1, NEAR), "paint")
    for lower, upper in zip(panes_y, panes_y[1:]):
        box((outside, lower[1], FAR), (outside + 0.05, upper[0], NEAR), "paint")
    for z0, z1 in panes_z:
        for y0, y1 in panes_y:
            rectangle((outside + 0.03, y0, z0), (0, y1 - y0, 0), (0, 0, z1 - z0), "day")
    # The next window, beside the camera, which nobody sees: most of the light comes from there. It has no depth, so that
    # no small bright surface is about it, which paths would rarely find.
    rectangle((LEFT + 0.004, SILL, -0.1), (0, LINTEL - SILL, 0), (0, 0, 1.2), "next window")
    # Skirting boards with a rounded top.
    for lower, upper in (
        ((LEFT, 0, BACK), (RIGHT, 0.15, BACK + 0.016)), ((LEFT, 0, BACK), (LEFT + 0.016, 0.15, FRONT)),
        ((RIGHT - 0.016, 0, BACK), (RIGHT, 0.15, FRONT)),
    ):
        box(lower, upper, "paint")
        edge, end = [(a + b) / 2 for a, b in zip(lower, upper)], [(a + b) / 2 for a, b in zip(lower, upper)]
        edge[1] = end[1] = 0.15
        along = 0 if upper[0] - lower[0] > upper[2] - lower[2] else 2
        edge[along], end[along] = lower[along], upper[along]
        rod(edge, end, 0.008, "paint")
    # The floor: boards of several lengths, on a dark ground that their gaps show.
    rectangle((LEFT, -0.012, BACK), (width, 0, 0), (0, 0, depth), "wood0")
    x = LEFT
    while x < RIGHT:
        z = BACK - r.uniform(0, 2)
        while z < FRONT:
            end = z + r.uniform(1.6, 3.2)
            box((x, -0.03, z), (min(x + PLANK - GAP, RIGHT), r.uniform(-0.0006, 0), min(end - GAP, FRONT)), f"wood{r.randrange(1, len(WOODS))}")
            z = end
        x += PLANK


def lines(items):
    return "".join(f"      {item}\n" for item in items)


room()
woods = ""
for i, wood in enumerate(WOODS):
    tint = tuple((0.25 if i == 0 else 0.8) * c for c in srgb(wood))
    woods += (
        f"      <openpbr> <name>wood{i}</name> {color('base_color', tint)[:-2]} texture=\"use\"/>"
        ' <specular_roughness texture="use">0.5</specular_roughness> </openpbr>\n'
    )

write_gallery(
    "room",
    TEXT.format(
        lime1=color("color1", srgb("#cdc7bf")), lime2=color("color2", srgb("#dcd6cd")), paint=color("base_color", srgb("#e2dfd8")),
        lacquer=color("base_color", srgb("#a5301d")), woods=woods, chair=chair(), rectangles=lines(rectangles), boxes=lines(boxes),
        cylinders=lines(cylinders),
    ),
)
