"""Writes gallery/pearls.xml: a million pearls as a sea with its swell, some by themselves, the others in patches."""
import math
import random

from scene_xml import color, palette, vector, write_gallery

ABOVE = 12.0  # of the eye, in a pearl's radius, as all lengths
NEAR, MIDDLE = 140.0, 380.0  # up to NEAR each pearl is a sphere of its own; then come small patches, then large ones
FAR = 2600.0
HALF = 0.36  # tangent of half the angle that is covered, a little more than the picture's
SMALL, LARGE = 7.4, 44.4  # edges of patches
PATCHES = 3  # of each size
SPACE = 1.86  # between neighbours in a row, in a pearl's radius

TEXT = """<!-- {count:,} pearls: a sea of them, and its swell, in the evening. Made by scenes/generate_pearls.py. -->
<raytracer>
  <viewplane>
    <hres>1920</hres> <vres>1080</vres> <samples>512</samples> <background red="0" green="0" blue="0"/>
    <viewtransform>agx</viewtransform> <exposure>{exposure}</exposure>
  </viewplane>
  <thinlenscamera>
    {eye} {lookat} <fov>22</fov>
    <lensradius>0.95</lensradius> <focaldistance>{focus}</focaldistance>
  </thinlenscamera>
  <integrator> <path> <clampindirect>1</clampindirect> </path> </integrator>
  <lights>
    <environmentlights>
      <environmentlight> <scaleradiance>0.3</scaleradiance> <color red="0.62" green="0.7" blue="1"/> <visible>false</visible> </environmentlight>
    </environmentlights>
    <directionallights>
      <directionallight> <direction x="-1" y="0.34" z="-0.12"/> <angle>8</angle> <scaleradiance>7</scaleradiance> <color red="1" green="0.58" blue="0.3"/> </directionallight>
    </directionallights>
  </lights>
  <materials>
    <openpbrs>
{pearls}    </openpbrs>
    <mattes>
      <matte> <name>depth</name> <ka>0</ka> <kd>1</kd> <cd red="0.2" green="0.17" blue="0.16"/> </matte>
    </mattes>
    <emissives>
      <emissive> <name>glow</name> <ce red="1" green="0.52" blue="0.3"/> <scaleradiance>8</scaleradiance> <twosided>true</twosided> </emissive>
{sky}    </emissives>
  </materials>
  <groups>
{groups}  </groups>
  <objects>
    <planes>
      <plane> <point x="0" y="-60" z="0"/> <normal x="0" y="1" z="0"/> <material>depth</material> </plane>
    </planes>
    <meshes>
      <mesh> <positions>{positions}</positions> <faces>{faces}</faces> <normals>smooth</normals> <material>depth</material> </mesh>
    </meshes>
    <rectangles>
      <rectangle> <corner x="-6000" y="0" z="-1200"/> <edge1 x="0" y="1700" z="0"/> <edge2 x="600" y="0" z="-2600"/> <material>glow</material> </rectangle>
{strips}    </rectangles>
    <spheres>
{spheres}    </spheres>
    <instances>
{instances}    </instances>
  </objects>
</raytracer>
"""

# Cream, rose and grey, and how thick the film on each is, in micrometres.
PEARLS = {"cream": ((0.8, 0.76, 0.7), 0.42), "rose": ((0.78, 0.67, 0.64), 0.5), "grey": ((0.66, 0.69, 0.71), 0.36)}
SKY = [(1.0, 0.45, 0.2), (0.66, 0.36, 0.32), (0.34, 0.26, 0.4), (0.17, 0.2, 0.4), (0.1, 0.14, 0.32)]  # from the horizon upwards
WAVES = ((460.0, 15.0, 0.3, -0.95), (290.0, 8.0, -0.5, -0.9), (170.0, 3.0, 0.9, 1.0))  # length, height, heading, phase
TURN = '<rotate x="0" y="1" z="0" angle="180"/>'
r = random.Random(5)
count = 0  # of pearls


def swell(x, z):
    """The sea's height: waves of several lengths and directions, with sharper crests than troughs, and one wave near by."""
    height = 0.0
    for length, high, heading, phase in WAVES:
        t = 2 * math.pi * (x * math.sin(heading) + z * math.cos(heading)) / length + phase
        height += high * ((0.5 + 0.5 * math.sin(t)) ** 1.7 - 0.4)
    far = -z - 118 - 0.22 * x + 0.0012 * x * x
    return height + 19 * math.exp(-((far / (34 if far < 0 else 26)) ** 2)) / (1 + math.exp((x - 4) / 13))



def slopes(x, z, step):
    along_x, along_z = swell(x + step, z) - swell(x - step, z), swell(x, z + step) - swell(x, z - step)
    return along_x / (2 * step), along_z / (2 * step)


def pearl(x, y, z):
    """Its centre, radius and material: of no two the same, and not quite in its place."""
    radius = min(1.12, max(0.72, r.gauss(0.94, 0.09)))
    return (x, y + r.gauss(0, 0.25), z), radius, r.choices(list(PEARLS), (6, 3, 2))[0]


def sphere(center, radius, material):
    place = vector("center", tuple(round(c, 2) for c in center))
    return f"<sphere> {place} <radius>{radius:.2f}</radius> <material>{material}</material> </sphere>\n"


def group(name, objects):
    return f"    <group> <name>{name}</name>\n      <objects>\n{objects}      </objects>\n    </group>\n"


def patch(name, edge):
    """A group: rows of pearls about the origin, and the dark below them; and how many there are."""
    items = []
    rows, columns = round(edge / (SPACE * 0.866)), round(edge / SPACE)
    for i in range(rows):
        for k in range(columns):
            x = (k + 0.5 + (0.25 if i % 2 else -0.25)) * edge / columns - edge / 2 + r.gauss(0, 0.17)
            items.append(pearl(x, 0, (i + 0.5) * edge / rows - edge / 2 + r.gauss(0, 0.17)))
    spheres = "".join("          " + sphere(*item) for item in items)
    corner = vector("corner", (-edge / 2, -0.6, edge / 2))
    edges = vector("edge1", (edge, 0, 0)) + vector("edge2", (0, 0, -edge))
    ground = f"        <rectangles> <rectangle> {corner} {edges} <material>depth</material> </rectangle> </rectangles>\n"
    return group(name, f"        <spheres>\n{spheres}        </spheres>\n{ground}"), len(items)


def four(name, kind, edge):
    """A group of four patches, two by two, two of them turned around; and how many pearls there are."""
    text, total = "", 0
    for i, (x, z) in enumerate(((-0.5, -0.5), (0.5, -0.5), (-0.5, 0.5), (0.5, 0.5))):
        part = f"{kind}{r.randrange(PATCHES)}"
        total += sizes[part]
        turn = TURN if i in (1, 2) else ""
        text += f"          <instance><group>{part}</group><transform>{turn}{vector('translate', (x * edge, 0, z * edge))}</transform></instance>\n"
    return group(name, f"        <instances>\n{text}        </instances>\n"), total


groups, sizes = "", {}
for kind, make in (
    ("small", lambda name: patch(name, SMALL)), ("large", lambda name: patch(name, LARGE)),
    ("fours", lambda name: four(name, "small", SMALL)), ("fourl", lambda name: four(name, "large", LARGE)),
):
    for i in range(PATCHES):
        text, sizes[f"{kind}{i}"] = make(f"{kind}{i}")
        groups += text

instances = []


def put(kind, edge, near, far):
    """Patches over the part of the sea that the picture shows, turned to the sea's slope there."""
    global count
    z = -near - edge / 2
    while z > -far:
        half = HALF * -z + 20 + edge
        n = math.ceil(2 * half / (edge * 0.96))
        for i in range(n):
            x = -half + (i + 0.5) * 2 * half / n + r.uniform(-0.3, 0.3)
            sx, sz = slopes(x, z, edge / 4)
            steep = math.hypot(sx, sz)
            name = f"{kind}{r.randrange(PATCHES)}"
            angle = math.degrees(math.atan(steep))
            first = TURN if r.random() < 0.5 else ""
            tilt = f'<rotate x="{sz / steep:.3f}" y="0" z="{-sx / steep:.3f}" angle="{-angle:.2f}"/>' if steep > 1e-3 else ""
            instances.append(
                f"<instance><group>{name}</group><transform>{first}{tilt}"
                f'<translate x="{x:.1f}" y="{swell(x, z):.2f}" z="{z:.1f}"/></transform></instance>\n'
            )
            count += sizes[name]
        # Patches lie the closer where the sea is steep.
        sz = max(abs(slopes(half * k / 8, z, 2)[1]) for k in range(-8, 9))
        z -= edge * 0.98 / math.sqrt(1 + sz * sz)


near = []
for i in range(18, int(NEAR / (SPACE * 0.866))):  # what is nearer is below the picture
    z = -i * SPACE * 0.866
    half = HALF * -z + 7
    for k in range(-int(half / SPACE), int(half / SPACE) + 1):
        x, away = (k + 0.5 * (i % 2)) * SPACE + r.gauss(0, 0.2), z + r.gauss(0, 0.2)
        near.append(pearl(x, swell(x, away), away))
    # A few lie on top of the others.
    for _ in range(int(0.035 * 2 * half / SPACE + r.random())):
        x = r.uniform(-half, half)
        near.append(((x, swell(x, z) + 1.35, z), r.uniform(0.8, 1.05), "cream"))
count += len(near)
# Below the single pearls it is dark, as below the patches.
CELL, COLUMNS = 5.0, 28
ROWS = int((NEAR + 10) / CELL)
corners = [((k - COLUMNS / 2) * CELL, 5 - i * CELL) for i in range(ROWS + 1) for k in range(COLUMNS + 1)]
positions = ", ".join(f"{x:.0f} {swell(x, z) - 0.6:.2f} {z:.0f}" for x, z in corners)
faces = " ".join(
    f"{i * (COLUMNS + 1) + k} {i * (COLUMNS + 1) + k + 1} {(i + 1) * (COLUMNS + 1) + k + 1} {(i + 1) * (COLUMNS + 1) + k},"
    for i in range(ROWS) for k in range(COLUMNS)
)
put("small", SMALL, NEAR, 210)
put("fours", 2 * SMALL, 210, MIDDLE)
put("large", LARGE, MIDDLE, 1000)
put("fourl", 2 * LARGE, 1000, FAR)

pearls = ""
for name, (base, film) in PEARLS.items():
    pearls += (
        f"      <openpbr> <name>{name}</name> {color('base_color', base)} <specular_roughness>0.28</specular_roughness>\n"
        f"        <coat_weight>1</coat_weight> <coat_roughness>0.13</coat_roughness> <coat_ior>1.9</coat_ior> <coat_darkening>0.3</coat_darkening>\n"
        f"        <thin_film_weight>0.35</thin_film_weight> <thin_film_thickness>{film}</thin_film_thickness> </openpbr>\n"
    )
# The sky is strips far away, from the horizon upwards.
STRIPS, AWAY, LOW, HIGH = 80, 6000.0, -200.0, 1500.0
sky = strips = ""
for i in range(STRIPS):
    y0, y1 = (LOW + (HIGH - LOW) * k / STRIPS for k in (i, i + 1))
    tint = palette(SKY, (max(y0, 0) / HIGH) ** 0.75)
    sky += f"      <emissive> <name>sky{i}</name> {color('ce', tint)} </emissive>\n"
    strips += (
        f"      <rectangle> {vector('corner', (-4000, y0, -AWAY))} {vector('edge1', (8000, 0, 0))} {vector('edge2', (0, y1 - y0, 0))}"
        f" <material>sky{i}</material> </rectangle>\n"
    )
eye = (0, swell(0, 0) + ABOVE, 0)
write_gallery(
    "pearls",
    TEXT.format(
        count=count, exposure=0.4, eye=vector("eye", eye), lookat=vector("lookat", (0, eye[1] - 5, -100)), focus=95, pearls=pearls, groups=groups,
        sky=sky, strips=strips, positions=positions, faces=faces,
        spheres="".join("      " + sphere(*item) for item in near),
        instances="".join("      " + i for i in instances),
    ),
)
