"""Writes gallery/protein.xml: a bundle of helices as a sculpture of clay. Not a real protein: seven helices and their loops."""
import math
import random

from scene_xml import add, color, cross, number, srgb, unit, vector, write_gallery

HELICES = 7
RESIDUES = 26  # of a helix
RISE, RADIUS, TURN = 1.5, 2.3, math.radians(100)  # an alpha helix, in angstroms
SCALE = 0.072

TEXT = """<!-- Seven helices and their loops, each atom a ball of clay, under an even sky. Made by scenes/generate_protein.py. -->
<raytracer>
  <viewplane>
    <hres>1920</hres> <vres>1080</vres> <samples>256</samples> <background red="0" green="0" blue="0"/>
  </viewplane>
  <thinlenscamera>
    <eye x="4.2" y="2.6" z="11.5"/> <lookat x="-0.75" y="1.95" z="0"/> <fov>23</fov>
    <lensradius>0.09</lensradius> <focaldistance>10.6</focaldistance>
  </thinlenscamera>
  <integrator> <path/> </integrator>
  <lights>
    <environmentlights>
      <environmentlight> <scaleradiance>1.2</scaleradiance> <color red="1" green="0.97" blue="0.93"/> <visible>false</visible> </environmentlight>
    </environmentlights>
  </lights>
  <materials>
    <openpbrs>
{clays}    </openpbrs>
    <mattes>
      <matte> <name>paper</name> <ka>0</ka> <kd>1</kd> {paper} </matte>
    </mattes>
  </materials>
  <objects>
    <planes>
      <plane> <point x="0" y="0" z="0"/> <normal x="0" y="1" z="0"/> <material>paper</material> </plane>
      <plane> <point x="0" y="0" z="-9"/> <normal x="0.15" y="0.1" z="1"/> <material>paper</material> </plane>
    </planes>
    <spheres>
{spheres}    </spheres>
  </objects>
</raytracer>
"""

CLAYS = {
    "sand": "#d9c3a5", "rose": "#d7a695", "sage": "#a9b79c", "slate": "#8d9fb0", "coral": "#cf7f68",
}

r = random.Random(11)
atoms = []


def ball(center, radius, clay):
    atoms.append((center, radius, clay))


def side_chain(center, outwards, clay):
    """Two to four atoms, each on the one before."""
    place, direction, radius = center, outwards, 1.7
    for _ in range(r.randrange(2, 5)):
        wander = tuple(r.uniform(-0.7, 0.7) for _ in range(3))
        direction = unit(add(direction, wander))
        place = add(place, direction, 1.5)
        radius *= r.uniform(0.88, 1.0)
        ball(place, radius, clay)


# Up and down in turn, about a circle and one in its middle, each leaning a little.
ends = []
length = RESIDUES * RISE
for i in range(HELICES):
    around = 2 * math.pi * i / (HELICES - 1)
    foot = (0.0, 0.0, 0.0) if i == HELICES - 1 else (10.5 * math.cos(around), 0.0, 10.5 * math.sin(around))
    axis = unit((0.22 * math.sin(around + 0.9) + 0.1 * math.sin(5 * i), 1.0, 0.22 * math.cos(around + 0.9)))
    start, rise = add(foot, axis, 6.0 * math.sin(2.3 * i)), axis
    if i % 2:
        start, rise = add(start, axis, length), tuple(-x for x in axis)
    u = unit(cross(rise, (0.3, 0.1, 1.0)))
    v = cross(rise, u)
    clay = ("sand", "rose", "sage", "slate", "sand", "sage", "coral")[i]
    trace = []
    for k in range(RESIDUES):
        angle = TURN * k + i
        outwards = add(tuple(math.cos(angle) * x for x in u), v, math.sin(angle))
        center = add(add(start, rise, RISE * k), outwards, RADIUS)
        ball(center, 1.75, clay)
        ball(add(center, unit(add(rise, outwards, -0.6)), 1.35), 1.55, clay)
        side_chain(center, outwards, clay)
        trace.append(center)
    ends.append((trace[0], trace[-1], rise))

# A loop from each helix's end to the next one's beginning.
for (_, last, rise), (first, _, _) in zip(ends, ends[1:]):
    bow = add(add(last, tuple(b - a for a, b in zip(last, first)), 0.5), rise, 7.0)
    for k in range(1, 14):
        t = k / 14
        place = add(add(tuple((1 - t) ** 2 * x for x in last), bow, 2 * t * (1 - t)), first, t * t)
        wobble = tuple(r.uniform(-0.5, 0.5) for _ in range(3))
        ball(add(place, wobble), r.uniform(1.5, 1.8), "sand")

lowest = min(center[1] - radius for center, radius, _ in atoms)
spheres = ""
for center, radius, clay in atoms:
    x, y, z = (SCALE * c for c in add(center, (0, -lowest, 0)))
    spheres += (
        f"      <sphere> {vector('center', (x, y, z))} <radius>{number(SCALE * radius)}</radius> "
        f"<material>{clay}</material> </sphere>\n"
    )
clays = "".join(
    f"      <openpbr> <name>{name}</name> {color('base_color', srgb(hexadecimal))} <base_diffuse_roughness>0.6</base_diffuse_roughness> "
    f"<specular_roughness>0.6</specular_roughness> </openpbr>\n"
    for name, hexadecimal in CLAYS.items()
)

write_gallery("protein", TEXT.replace("{clays}", clays).replace("{paper}", color("cd", srgb("#cfc8bd"))).replace("{spheres}", spheres))
