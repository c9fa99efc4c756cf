"""Writes gallery/chess.xml: an endgame at night, under one lamp. Pieces are turned: of cones, cylinders, toruses and spheres."""
import math

from scene_xml import number, vector, write_gallery

TEXT = """<!-- An endgame under one lamp: turned pieces of ebony and boxwood, the square being one unit. Made by scenes/generate_chess.py. -->
<raytracer>
  <viewplane>
    <hres>1920</hres> <vres>1080</vres> <samples>512</samples> <background red="0" green="0" blue="0"/>
  </viewplane>
  <thinlenscamera>
    <eye x="-3.3" y="2.35" z="7.6"/> <lookat x="0.1" y="0.75" z="0"/> <fov>25</fov>
    <lensradius>0.085</lensradius> <focaldistance>8.1</focaldistance> <blades>7</blades>
  </thinlenscamera>
  <integrator> <path> <clampindirect>4</clampindirect> </path> </integrator>
  <lights>
    <environmentlights>
      <environmentlight> <scaleradiance>0.12</scaleradiance> <color red="0.55" green="0.75" blue="1"/> <visible>false</visible> </environmentlight>
    </environmentlights>
  </lights>
  <textures>
    <noises>
      <noise>
        <name>maple</name> <color1 red="0.42" green="0.27" blue="0.13"/> <color2 red="0.58" green="0.4" blue="0.22"/>
        <scale>0.35</scale> <octaves>6</octaves>
      </noise>
      <noise>
        <name>walnut</name> <color1 red="0.035" green="0.018" blue="0.01"/> <color2 red="0.095" green="0.05" blue="0.025"/>
        <scale>0.3</scale> <octaves>6</octaves>
      </noise>
      <noise>
        <name>boxwood</name> <color1 red="0.6" green="0.41" blue="0.2"/> <color2 red="0.74" green="0.55" blue="0.31"/>
        <scale>0.22</scale> <octaves>5</octaves>
      </noise>
      <noise>
        <name>wear</name> <color1 red="0.7" green="0.7" blue="0.7"/> <color2 red="1" green="1" blue="1"/> <scale>0.2</scale>
        <octaves>5</octaves>
      </noise>
    </noises>
  </textures>
  <materials>
    <openpbrs>
      <openpbr>
        <name>boxwood</name> <base_color texture="boxwood"/> <specular_roughness>0.45</specular_roughness>
        <coat_weight>0.6</coat_weight> <coat_roughness texture="wear">0.22</coat_roughness>
      </openpbr>
      <openpbr>
        <name>ebony</name> <base_color red="0.022" green="0.017" blue="0.015"/> <specular_roughness>0.4</specular_roughness>
        <coat_weight>1</coat_weight> <coat_roughness texture="wear">0.2</coat_roughness>
      </openpbr>
      <openpbr>
        <name>maple</name> <base_color texture="maple"/> <specular_roughness>0.5</specular_roughness>
        <coat_weight>0.8</coat_weight> <coat_roughness texture="wear">0.26</coat_roughness>
      </openpbr>
      <openpbr>
        <name>walnut</name> <base_color texture="walnut"/> <specular_roughness>0.5</specular_roughness>
        <coat_weight>0.8</coat_weight> <coat_roughness texture="wear">0.26</coat_roughness>
      </openpbr>
    </openpbrs>
    <mattes>
      <matte> <name>table</name> <ka>0</ka> <kd>0.9</kd> <cd red="0.03" green="0.024" blue="0.02"/> </matte>
      <matte> <name>wall</name> <ka>0</ka> <kd>0.9</kd> <cd red="0.05" green="0.075" blue="0.08"/> </matte>
    </mattes>
    <emissives>
      <emissive> <name>lamp</name> <ce red="1" green="0.72" blue="0.42"/> <scaleradiance>240</scaleradiance> </emissive>
    </emissives>
  </materials>
  <groups>
{groups}  </groups>
  <objects>
    <planes>
      <plane> <point x="0" y="-0.35" z="0"/> <normal x="0" y="1" z="0"/> <material>table</material> </plane>
      <plane> <point x="0" y="0" z="-10"/> <normal x="0.1" y="0" z="1"/> <material>wall</material> </plane>
    </planes>
    <disks>
      <disk> <name>lamp</name> <center x="4.6" y="5.6" z="-1.6"/> <normal x="-0.8" y="-1" z="0.3"/> <radius>0.8</radius> <material>lamp</material> </disk>
    </disks>
    <boxes>
{board}    </boxes>
    <instances>
{instances}    </instances>
  </objects>
</raytracer>
"""


class Piece:
    """A profile from the board upwards, as a group's objects by element."""

    def __init__(self):
        self.items = {}

    def add(self, element, inside):
        group = {"torus": "toruses", "box": "boxes"}.get(element, element + "s")
        self.items.setdefault(group, []).append(f"<{element}>{inside}<material>boxwood</material></{element}>")

    def cone(self, y0, r0, y1, r1):
        ends = vector("bottom", (0, y0, 0)) + vector("top", (0, y1, 0))
        self.add("cone", f"{ends}<radius>{number(r0)}</radius><topradius>{number(r1)}</topradius><caps>true</caps>")

    def rim(self, y, r, tube):
        """A rounded edge."""
        self.add("torus", f"{vector('center', (0, y, 0))}<sweptradius>{number(r)}</sweptradius><tuberadius>{number(tube)}</tuberadius>")

    def ball(self, center, r, stretch=None, lean=0):
        turn = f'<rotate x="0" y="0" z="1" angle="{number(lean)}"/>' if lean else ""
        transform = ""
        if stretch:
            x, y, z = stretch
            transform = (
                f'<transform><scale x="{number(x)}" y="{number(y)}" z="{number(z)}"/>{turn}'
                f'<translate x="{number(center[0])}" y="{number(center[1])}" z="{number(center[2])}"/></transform>'
            )
            center = (0, 0, 0)
        self.add("sphere", f"{vector('center', center)}<radius>{number(r)}</radius>{transform}")

    def box(self, lower, upper, turn=None):
        transform = "" if turn is None else f'<transform><rotate x="0" y="1" z="0" angle="{number(turn)}"/></transform>'
        self.add("box", vector("min", lower) + vector("max", upper) + transform)

    def foot(self, r):
        """Of every piece: a disk with a round edge, a bell above it, and a ring where its neck begins."""
        self.rim(0.05, r - 0.05, 0.05)
        self.cone(0.0, r - 0.05, 0.1, r - 0.05)
        self.rim(0.125, r - 0.085, 0.032)
        self.cone(0.1, r - 0.06, 0.24, r * 0.56)
        self.rim(0.25, r * 0.53, 0.024)

    def neck(self, y0, r0, y1, r1, collar):
        """A slender cone with a flat collar at its top."""
        middle = y0 + 0.4 * (y1 - y0)
        waist = r1 + 0.22 * (r0 - r1)
        self.cone(y0, r0, middle, waist)
        self.cone(middle, waist, y1, r1)
        self.rim(y1, collar - 0.03, 0.03)
        self.cone(y1 - 0.03, collar - 0.03, y1 + 0.03, collar - 0.03)

    def text(self, name):
        lines = [f"    <group> <name>{name}</name>\n", "      <objects>\n"]
        for group, items in self.items.items():
            lines.append(f"        <{group}>\n")
            lines += [f"          {item}\n" for item in items]
            lines.append(f"        </{group}>\n")
        return "".join(lines + ["      </objects>\n", "    </group>\n"])


def pawn():
    piece = Piece()
    piece.foot(0.31)
    piece.neck(0.24, 0.17, 0.62, 0.085, 0.16)
    piece.ball((0, 0.8, 0), 0.165)
    return piece


def rook():
    piece = Piece()
    piece.foot(0.35)
    piece.neck(0.24, 0.21, 0.8, 0.15, 0.23)
    piece.cone(0.82, 0.19, 0.98, 0.235)
    piece.rim(0.98, 0.21, 0.025)
    for i in range(6):
        piece.box((0.13, 0.97, -0.075), (0.228, 1.1, 0.075), 60 * i + 15)
    return piece


def bishop():
    piece = Piece()
    piece.foot(0.34)
    piece.neck(0.24, 0.19, 0.98, 0.09, 0.19)
    piece.rim(1.06, 0.1, 0.03)
    piece.ball((0, 1.24, 0), 0.15, (1, 1.4, 1))
    piece.ball((0, 1.48, 0), 0.045)
    return piece


def queen():
    piece = Piece()
    piece.foot(0.37)
    piece.neck(0.24, 0.21, 1.2, 0.1, 0.22)
    piece.rim(1.28, 0.12, 0.03)
    piece.cone(1.26, 0.11, 1.56, 0.22)
    piece.rim(1.56, 0.19, 0.03)
    for i in range(10):
        angle = 2 * math.pi * i / 10
        piece.ball((0.195 * math.cos(angle), 1.6, 0.195 * math.sin(angle)), 0.042)
    piece.ball((0, 1.58, 0), 0.15, (1, 0.6, 1))
    piece.ball((0, 1.71, 0), 0.055)
    return piece


def king():
    piece = Piece()
    piece.foot(0.38)
    piece.neck(0.24, 0.22, 1.3, 0.11, 0.235)
    piece.rim(1.38, 0.13, 0.032)
    piece.cone(1.36, 0.12, 1.66, 0.205)
    piece.rim(1.66, 0.17, 0.034)
    piece.ball((0, 1.67, 0), 0.16, (1, 0.5, 1))
    piece.box((-0.032, 1.72, -0.028), (0.032, 1.98, 0.028))
    piece.box((-0.1, 1.83, -0.028), (0.1, 1.895, 0.028))
    return piece


def square(column, row):
    return column - 3.5, 3.5 - row


def instance(name, column, row, material, i, lying=None):
    x, z = square(column, row)
    x += 0.05 * math.sin(12.9 * i)
    z += 0.05 * math.cos(7.7 * i)
    steps = f'<rotate x="0" y="1" z="0" angle="{number(37.0 * i % 360)}"/>'
    y = 0.0
    if lying is not None:
        radius, lean, heading = lying
        steps += f'<rotate x="0" y="0" z="1" angle="{number(-lean)}"/><rotate x="0" y="1" z="0" angle="{number(heading)}"/>'
        y = radius
    steps += f'<translate x="{number(x)}" y="{number(y)}" z="{number(z)}"/>'
    return (
        f"      <instance> <group>{name}</group> <transform>{steps}</transform> <material>{material}</material> </instance>\n"
    )


PIECES = {"pawn": pawn, "rook": rook, "bishop": bishop, "queen": queen, "king": king}
# Columns a to h are 0 to 7, rows 1 to 8 are 0 to 7; row 0 is next to the camera.
POSITION = [
    ("king", 4, 3, "boxwood"), ("queen", 2, 4, "boxwood"), ("pawn", 5, 2, "boxwood"), ("pawn", 6, 3, "boxwood"),
    ("rook", 1, 1, "boxwood"), ("pawn", 0, 2, "boxwood"),
    ("king", 4, 6, "ebony"), ("rook", 7, 7, "ebony"), ("bishop", 3, 5, "ebony"), ("pawn", 5, 5, "ebony"),
    ("pawn", 7, 5, "ebony"), ("pawn", 1, 5, "ebony"), ("pawn", 6, 5, "ebony"), ("bishop", 0, 6, "ebony"),
]

board = ""
for column in range(8):
    for row in range(8):
        x, z = square(column, row)
        wood = "maple" if (column + row) % 2 else "walnut"
        lower, upper = (x - 0.498, -0.1, z - 0.498), (x + 0.498, 0.0, z + 0.498)
        board += f"      <box> {vector('min', lower)} {vector('max', upper)} <material>{wood}</material> </box>\n"
for lower, upper in (
    ((-4.5, -0.3, -4.5), (4.5, -0.012, 4.5)),
    ((-4.5, -0.1, -4.5), (4.5, 0.03, -4.04)), ((-4.5, -0.1, 4.04), (4.5, 0.03, 4.5)),
    ((-4.5, -0.1, -4.04), (-4.04, 0.03, 4.04)), ((4.04, -0.1, -4.04), (4.5, 0.03, 4.04)),
):
    board += f"      <box> {vector('min', lower)} {vector('max', upper)} <material>walnut</material> </box>\n"

instances = "".join(instance(*piece, i) for i, piece in enumerate(POSITION))
instances += instance("pawn", 3, 2, "ebony", 20, (0.16, 97, 35))
groups = "".join(make().text(name) for name, make in PIECES.items())

write_gallery("chess", TEXT.replace("{groups}", groups).replace("{board}", board).replace("{instances}", instances))
