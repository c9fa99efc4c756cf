#!/usr/bin/env python3
"""Writes gallery/chain.xml: a chain of gold that lies on slate, in a spiral that runs out towards the camera."""
import math

from scene_xml import number, vector, write_gallery

LINKS = 76
SWEPT, TUBE = 0.33, 0.085
SPACING = 0.53

TEXT = """\
<!-- A chain of gold on slate, a softbox behind it. Made by scenes/generate_chain.py. -->
<raytracer>
  <viewplane>
    <hres>1920</hres> <vres>1080</vres> <samples>512</samples> <background red="0" green="0" blue="0"/>
  </viewplane>
  <thinlenscamera>
    <eye x="1.2" y="2.5" z="8.2"/> <lookat x="0.1" y="0.1" z="1.1"/> <fov>23</fov>
    <lensradius>0.1</lensradius> <focaldistance>6.1</focaldistance> <blades>7</blades>
  </thinlenscamera>
  <integrator> <path> <clampindirect>3</clampindirect> </path> </integrator>
  <lights>
    <environmentlights>
      <environmentlight>
        <scaleradiance>0.03</scaleradiance> <color red="0.7" green="0.82" blue="1"/> <visible>false</visible>
      </environmentlight>
    </environmentlights>
  </lights>
  <textures>
    <noises>
      <noise>
        <name>slate</name> <color1 red="0.018" green="0.02" blue="0.024"/> <color2 red="0.05" green="0.054" blue="0.062"/>
        <scale>1.2</scale> <octaves>8</octaves>
      </noise>
      <noise>
        <name>wear</name> <color1 red="0.75" green="0.75" blue="0.75"/> <color2 red="1" green="1" blue="1"/>
        <scale>0.15</scale> <octaves>5</octaves>
      </noise>
      <noise>
        <name>grit</name> <color1 red="0" green="0" blue="0"/> <color2 red="1" green="1" blue="1"/> <scale>0.35</scale>
        <octaves>4</octaves>
      </noise>
    </noises>
  </textures>
  <materials>
    <phongs>
      <phong>
        <name>slate</name> <ka>0</ka> <kd>1</kd> <ks>0.25</ks> <cd texture="slate"/> <cs red="1" green="1" blue="1"/>
        <exp>25</exp> <bump texture="grit" height="0.012"/>
      </phong>
    </phongs>
    <conductors>
      <conductor> <name>gold</name> <metal>gold</metal> <roughness texture="wear">0.34</roughness> </conductor>
    </conductors>
    <emissives>
      <emissive> <name>softbox</name> <ce red="1" green="0.9" blue="0.76"/> <scaleradiance>9</scaleradiance> </emissive>
      <emissive> <name>strip</name> <ce red="0.55" green="0.75" blue="1"/> <scaleradiance>3</scaleradiance> </emissive>
    </emissives>
  </materials>
  <objects>
    <planes>
      <plane> <point x="0" y="0" z="0"/> <normal x="0" y="1" z="0"/> <material>slate</material> </plane>
    </planes>
    <rectangles>
      <rectangle>
        <name>softbox</name> <corner x="-4.5" y="2.2" z="-6.5"/> <edge1 x="6" y="0" z="0"/> <edge2 x="0" y="2.8" z="1.6"/>
        <material>softbox</material>
      </rectangle>
      <rectangle>
        <name>strip</name> <corner x="8" y="0.8" z="4.5"/> <edge1 x="0" y="0" z="-5"/> <edge2 x="0" y="2.2" z="0"/>
        <material>strip</material>
      </rectangle>
    </rectangles>
    <toruses>
{links}    </toruses>
  </objects>
</raytracer>
"""


def spiral(angle):
    radius = 0.55 + 0.34 * angle
    return radius * math.cos(angle) * 1.25, radius * math.sin(angle)


def link(angle, i):
    """Every other link leans to the other side, none quite as the one before."""
    (x0, z0), (x1, z1) = spiral(angle - 0.01), spiral(angle + 0.01)
    length = math.hypot(x1 - x0, z1 - z0)
    across = -(z1 - z0) / length, (x1 - x0) / length
    lean = math.radians((38 if i % 2 else -40) + 6 * math.sin(7.3 * i))
    x, z = spiral(angle)
    center = x + 0.015 * math.sin(3.1 * i), SWEPT * abs(math.sin(lean)) + TUBE, z + 0.015 * math.cos(5.7 * i)
    axis = across[0] * math.sin(lean), math.cos(lean), across[1] * math.sin(lean)
    return (
        f"      <torus> {vector('center', center)} {vector('axis', axis)} <sweptradius>{number(SWEPT)}</sweptradius> "
        f"<tuberadius>{number(TUBE)}</tuberadius> <material>gold</material> </torus>\n"
    )


links, angle = "", 2.2
for i in range(LINKS):
    links += link(angle, i)
    before = spiral(angle)
    while math.dist(before, spiral(angle)) < SPACING:
        angle += 0.002

write_gallery("chain", TEXT.replace("{links}", links))
