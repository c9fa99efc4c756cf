"""Writes gallery/astrolabe.xml: an astrolabe of brass, silver and steel, lying on dark wood, through a macro lens."""
import math

from scene_xml import number, vector, write_gallery

TEXT = """<!-- An astrolabe of brass, silver and steel on dark wood. Made by scenes/generate_astrolabe.py. -->
<raytracer>
  <viewplane>
    <hres>1920</hres> <vres>1080</vres> <samples>512</samples> <background red="0" green="0" blue="0"/>
  </viewplane>
  <thinlenscamera>
    <eye x="-2.4" y="3.9" z="5.7"/> <lookat x="0.35" y="0.2" z="0.2"/> <fov>29</fov>
    <lensradius>0.09</lensradius> <focaldistance>6.35</focaldistance> <blades>9</blades>
  </thinlenscamera>
  <integrator> <path> <clampindirect>4</clampindirect> </path> </integrator>
  <lights>
    <environmentlights>
      <environmentlight> <scaleradiance>0.06</scaleradiance> <color red="0.7" green="0.8" blue="1"/> <visible>false</visible> </environmentlight>
    </environmentlights>
  </lights>
  <textures>
    <noises>
      <noise>
        <name>wear</name> <color1 red="0.55" green="0.55" blue="0.55"/> <color2 red="1" green="1" blue="1"/> <scale>0.35</scale>
        <octaves>6</octaves>
      </noise>
      <noise>
        <name>wood</name> <color1 red="0.02" green="0.011" blue="0.007"/> <color2 red="0.07" green="0.036" blue="0.02"/>
        <scale>0.8</scale> <octaves>7</octaves>
      </noise>
      <noise>
        <name>grain</name> <color1 red="0" green="0" blue="0"/> <color2 red="1" green="1" blue="1"/> <scale>0.1</scale> <octaves>5</octaves>
      </noise>
    </noises>
  </textures>
  <materials>
    <conductors>
      <conductor> <name>brass</name> <metal>brass</metal> <roughness texture="wear">0.42</roughness> </conductor>
      <conductor> <name>gold</name> <metal>gold</metal> <roughness texture="wear">0.3</roughness> </conductor>
      <conductor> <name>silver</name> <metal>silver</metal> <roughness texture="wear">0.5</roughness> </conductor>
      <conductor> <name>steel</name> <cr red="0.5" green="0.52" blue="0.55"/> <roughness>0.22</roughness> </conductor>
      <conductor> <name>niello</name> <cr red="0.05" green="0.05" blue="0.055"/> <roughness>0.35</roughness> </conductor>
    </conductors>
    <openpbrs>
      <openpbr>
        <name>wood</name> <base_color texture="wood"/> <specular_roughness>0.55</specular_roughness> <coat_weight>0.5</coat_weight>
        <coat_roughness>0.35</coat_roughness> <bump texture="grain" height="0.006"/>
      </openpbr>
    </openpbrs>
    <emissives>
      <emissive> <name>softbox</name> <ce red="1" green="0.93" blue="0.84"/> <scaleradiance>1.5</scaleradiance> </emissive>
      <emissive> <name>strip</name> <ce red="0.6" green="0.78" blue="1"/> <scaleradiance>1.6</scaleradiance> </emissive>
    </emissives>
  </materials>
  <objects>
    <planes>
      <plane> <point x="0" y="0" z="0"/> <normal x="0" y="1" z="0"/> <material>wood</material> </plane>
    </planes>
    <rectangles>
      <rectangle>
        <name>softbox</name> <corner x="-5" y="2.6" z="-7"/> <edge1 x="7" y="0" z="-1"/> <edge2 x="0" y="3.6" z="2.4"/> <material>softbox</material>
      </rectangle>
      <rectangle>
        <name>strip</name> <corner x="7" y="0.8" z="3.5"/> <edge1 x="0" y="0" z="-4.5"/> <edge2 x="0" y="2.6" z="0"/> <material>strip</material>
      </rectangle>
    </rectangles>
{objects}  </objects>
</raytracer>
"""

items = {}


def put(element, inside, material):
    group = {"torus": "toruses", "box": "boxes", "annulus": "annuli"}.get(element, element + "s")
    items.setdefault(group, []).append(f"<{element}> {inside} <material>{material}</material> </{element}>")


def ring(x, z, y, swept, tube, material):
    radii = f"<sweptradius>{number(swept)}</sweptradius> <tuberadius>{number(tube)}</tuberadius>"
    put("torus", f"{vector('center', (x, y, z))} {radii}", material)


def drum(x, z, y0, y1, radius, material, caps=True):
    ends = f"{vector('bottom', (x, y0, z))} {vector('top', (x, y1, z))} <radius>{number(radius)}</radius>"
    put("cylinder", f"{ends} <caps>{'true' if caps else 'false'}</caps>", material)


def flat_ring(x, z, y, inner, outer, material):
    radii = f"<innerradius>{number(inner)}</innerradius> <outerradius>{number(outer)}</outerradius>"
    put("annulus", f"{vector('center', (x, y, z))} {vector('normal', (0, 1, 0))} {radii}", material)


def bar(lower, upper, angle, material, at=(0, 0, 0)):
    """A box, turned by degrees about the vertical through (0, 0, 0), then moved."""
    turn = f'<rotate x="0" y="1" z="0" angle="{number(angle)}"/>'
    move = f'<translate x="{number(at[0])}" y="{number(at[1])}" z="{number(at[2])}"/>'
    put("box", f"{vector('min', lower)} {vector('max', upper)} <transform>{turn}{move}</transform>", material)


def spike(foot, tip, radius, material):
    ends = f"{vector('bottom', foot)} {vector('top', tip)} <radius>{number(radius)}</radius>"
    put("cone", ends, material)


# The body: a tray of brass with a rounded rim, and degrees on it.
drum(0, 0, 0.03, 0.26, 3.0, "brass")
ring(0, 0, 0.06, 2.97, 0.06, "brass")
drum(0, 0, 0.2, 0.4, 2.56, "brass", caps=False)
drum(0, 0, 0.2, 0.4, 3.0, "brass", caps=False)
flat_ring(0, 0, 0.4, 2.56, 3.0, "brass")
for edge in (2.56, 3.0):
    ring(0, 0, 0.4, edge, 0.022, "brass")
ring(0, 0, 0.4, 2.66, 0.008, "niello")
ring(0, 0, 0.4, 2.84, 0.008, "niello")
for i in range(180):
    inner = 2.66 if i % 15 == 0 else 2.74 if i % 5 == 0 else 2.79
    bar((inner, 0.39, -0.007), (2.84, 0.405, 0.007), 2 * i, "niello")
for i in range(24):
    angle = math.radians(15 * i + 7.5)
    put("sphere", f"{vector('center', (2.92 * math.cos(angle), 0.4, 2.92 * math.sin(angle)))} <radius>0.022</radius>", "niello")

# The plate: silver, with circles of altitude, as stereographic projection has them, where they are inside.
drum(0, 0, 0.2, 0.3, 2.53, "silver")
latitude = math.radians(48)
for altitude in range(0, 90, 10):
    a = math.radians(altitude)
    divisor = math.sin(latitude) + math.sin(a)
    swept, z = 1.12 * math.cos(a) / divisor, 1.12 * math.cos(latitude) / divisor
    if z + swept < 2.5:
        ring(0, -z, 0.3, swept, 0.009, "niello")
for swept in (0.73, 1.12, 1.72, 2.4):
    ring(0, 0, 0.3, swept, 0.009, "niello")
for i in range(12):
    bar((0.2, 0.298, -0.004), (2.4, 0.306, 0.004), 30 * i, "niello")

# The star map above it: rings of gold, spokes, and pointers.
ring(0, 0, 0.4, 2.3, 0.045, "gold")
ring(0.0, 0.62, 0.42, 1.5, 0.06, "gold")
flat_ring(0.0, 0.62, 0.43, 1.36, 1.64, "gold")
for i in range(36):
    bar((1.4, 0.425, -0.006), (1.6 if i % 3 == 0 else 1.5, 0.436, 0.006), 10 * i, "niello", (0.0, 0.0, 0.62))
for angle in (20, 97, 168, 250, 310):
    bar((0.16, 0.37, -0.035), (2.29, 0.42, 0.035), angle, "gold")
for i in range(13):
    angle, radius = 2 * math.pi * (i * 0.381966), 0.75 + 1.45 * math.sqrt(i / 13)
    foot = (radius * math.cos(angle), 0.43, radius * math.sin(angle))
    turn = angle + 1.9 + 0.7 * math.sin(3 * i)
    tip = (foot[0] + 0.34 * math.cos(turn), 0.45, foot[2] + 0.34 * math.sin(turn))
    spike(foot, tip, 0.045, "gold")
    put("sphere", f"{vector('center', foot)} <radius>0.065</radius>", "gold")

# The rule of steel, the pin and its nut.
bar((-2.86, 0.47, -0.11), (2.86, 0.51, 0.11), -38, "steel")
bar((-2.86, 0.51, -0.012), (2.86, 0.522, 0.012), -38, "niello")
for side in (-1, 1):
    bar((side * 2.45 - 0.03, 0.5, -0.11), (side * 2.45 + 0.03, 0.8, 0.11), -38, "steel")
drum(0, 0, 0.3, 0.62, 0.17, "brass")
ring(0, 0, 0.62, 0.15, 0.02, "brass")
drum(0, 0, 0.6, 0.7, 0.09, "steel")
put("sphere", f"{vector('center', (0, 0.72, 0))} <radius>0.085</radius>", "steel")

# The throne and the ring that it hangs by.
drum(0, -3.12, 0.06, 0.36, 0.3, "brass")
ring(0, -3.12, 0.36, 0.28, 0.03, "brass")
put("sphere", f"{vector('center', (0, 0.2, -3.5))} <radius>0.15</radius>", "brass")
radii = "<sweptradius>0.42</sweptradius> <tuberadius>0.055</tuberadius>"
put("torus", f"{vector('center', (0.1, 0.12, -3.98))} {vector('axis', (0.12, 1, 0.1))} {radii}", "steel")

objects = ""
for group, lines in items.items():
    objects += f"    <{group}>\n" + "".join(f"      {line}\n" for line in lines) + f"    </{group}>\n"

write_gallery("astrolabe", TEXT.replace("{objects}", objects))
