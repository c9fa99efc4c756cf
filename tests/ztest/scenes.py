"""The scenes of the Z-test, each of which has one thing that Mitsuba has, too: writes scenes/NAME.xml and their pictures.

Left out is what differs by design. Metals and rough glass lose no light between their facets here, so they are smooth
enough for that not to matter; textures are larger than pixels, so none is filtered; a mesh with normals is lit from where
its shadow does not begin.
"""

import os
import random

from elements import (
    FOLDER,
    PINHOLE,
    WIDTH,
    ball_mesh,
    box,
    camera,
    color,
    conductor,
    dielectric,
    disk,
    element,
    icosahedron,
    lamp,
    matte,
    mesh,
    numbers,
    rectangle,
    room,
    sphere,
    steps,
    turn,
    value,
    vector,
    write,
    write_pictures,
)

WHITE, GREY, RED, GREEN, BLUE = (0.75, 0.75, 0.75), (0.5, 0.5, 0.5), (0.6, 0.1, 0.06), (0.15, 0.5, 0.1), (0.1, 0.2, 0.6)

FLOOR = rectangle((-5, 0, 5), (10, 0, 0), (0, 0, -10), "floor")
WALL = rectangle((-5, 0, -3), (10, 0, 0), (0, 6, 0), "wall")
MATTES = [matte("floor", GREY), matte("wall", (0.6, 0.5, 0.4)), matte("clay", RED), matte("moss", GREEN)]
EVEN = element("environmentlight", color("color", (0.5, 0.6, 0.7)))
LAMP = lamp("lamp", (1, 0.9, 0.7), 8)
PANEL = rectangle((-1.5, 4.5, -1), (3, 0, 0), (0, 0.5, 2), "lamp")  # above, and shines down


ROOM_MATTES = [matte("white", WHITE), matte("red", RED), matte("green", GREEN)]
ROOM_CAMERA = camera((0, 0, 3.9), (0, 0, 0), 39.3)
ROOM_LAMP = rectangle((-0.4, 0.99, -0.4), (0.8, 0, 0), (0, 0, 0.8), "lamp")


def lights():
    ball = sphere((0, 0.8, 0), 0.8, "clay")
    table = [FLOOR, WALL, ball]
    materials = [*MATTES, lamp("lamp", (1, 0.9, 0.7), 12)]
    write("light-sphere", "A ball that shines.", 3, [*table, sphere((1.8, 2.2, 1), 0.5, "lamp")], materials)
    write(
        "light-rectangle",
        "A room under a rectangle that shines.",
        6,
        [*room(), ROOM_LAMP, sphere((-0.3, -0.6, -0.2), 0.4, "white")],
        [*ROOM_MATTES, LAMP],
        view=ROOM_CAMERA,
    )
    write("light-disk", "A disk that shines.", 3, [*table, disk((-1.6, 2.6, 1.2), (0.6, -1, -0.4), 0.8, "lamp")], materials)
    triangle = element(
        "triangle",
        vector("vertexposition1", (1, 1.6, -1)),
        vector("vertexposition2", (2.4, 0.3, 0.5)),
        vector("vertexposition3", (1.8, 2.8, 1)),
        value("material", "lamp"),
    )
    write(
        "light-triangle",
        "A triangle that shines, large and near.",
        3,
        [*table, triangle],
        [*MATTES, lamp("lamp", (1, 0.9, 0.7), 5)],
    )
    corners, faces = icosahedron((-1.7, 2.2, 0.8), 0.6)
    write("light-mesh", "A mesh that shines.", 3, [*table, mesh(corners, faces, "lamp")], materials)
    write(
        "light-textured",
        "A rectangle that shines as a picture.",
        3,
        [*table, rectangle((-1, 0.4, -1.8), (0, 2, 0), (-1.2, 0, 1.8), "picture")],
        [*MATTES, lamp("picture", '<ce texture="panel"/>', 2)],
        textures=[element("image", value("name", "panel"), value("file", "panel.hdr"))],
    )
    r = random.Random(64)
    colors = [tuple(0.2 + 0.8 * r.random() for _ in range(3)) for _ in range(4)]
    many = [lamp(f"lamp{i}", c, 40) for i, c in enumerate(colors)]
    lamps = []
    for i in range(64):
        place = (6 * r.random() - 3, 0.1 + 2.5 * r.random(), 5 * r.random() - 2.6)
        if i % 2 == 0:
            lamps.append(sphere(place, 0.03 + 0.04 * r.random(), f"lamp{i % 4}"))
        else:
            edges = [tuple(0.2 * r.random() - 0.1 for _ in range(3)) for _ in range(2)]
            lamps.append(rectangle(place, *edges, f"lamp{i % 4}"))
    write("light-many", "64 lamps.", 2, [*table, *lamps], [*MATTES, *many])
    write(
        "environment-image",
        "A picture all around, turned, with matte things and a mirror.",
        4,
        [FLOOR, sphere((-1, 0.9, 0), 0.9, "clay"), sphere((1, 0.9, 0), 0.9, "silver")],
        [*MATTES, conductor("silver", WHITE)],
        [element("environmentlight", value("file", "sky.hdr"), steps(turn((0, 1, 0), 40), turn((1, 0, 0), 10)))],
    )
    write(
        "environment-even",
        "The same light from everywhere.",
        6,
        [FLOOR, WALL, sphere((-1, 0.9, 0), 0.9, "clay"), sphere((1, 0.9, 0), 0.9, "moss")],
        MATTES,
        [EVEN],
    )
    write(
        "sun",
        "A sun of 10 degrees.",
        3,
        table,
        MATTES,
        [element("directionallight", vector("direction", (-1, 1, 0.8)), value("scaleradiance", 3), value("angle", 10))],
    )
    write(
        "directional",
        "A directional light, and an orthographic camera.",
        4,
        [*table, sphere((1.6, 0.5, 0.6), 0.5, "moss")],
        MATTES,
        [
            element(
                "directionallight", vector("direction", (1, 1.2, 0.7)), value("scaleradiance", 3), color("color", (1, 0.9, 0.8))
            )
        ],
        view=element("orthographiccamera", vector("eye", PINHOLE[0]), vector("lookat", PINHOLE[1])),
        viewplane=value("pixelsize", 5 / WIDTH),
    )
    write(
        "point",
        "A point light in a room.",
        6,
        [*room(), sphere((0.3, -0.6, 0.1), 0.4, "white")],
        ROOM_MATTES,
        [
            element(
                "pointlight",
                vector("location", (-0.3, 0.5, 0.4)),
                value("scaleradiance", 1.5),
                value("falloff", "inversesquare"),
            )
        ],
        view=ROOM_CAMERA,
    )
    write(
        "spot",
        "A spotlight in a room.",
        6,
        [*room(), sphere((0.3, -0.6, 0.1), 0.4, "white")],
        ROOM_MATTES,
        [
            element(
                "spotlight",
                vector("location", (-0.5, 0.8, 0.6)),
                vector("lookat", (0.2, -0.8, -0.1)),
                value("scaleradiance", 6),
                value("coneangle", 70),
                value("falloff", "inversesquare"),
            )
        ],
        view=ROOM_CAMERA,
    )


def materials():
    pair = [FLOOR, WALL, PANEL, sphere((-1, 0.9, 0), 0.9, "left"), sphere((1, 0.9, 0), 0.9, "right")]

    def balls(name, title, depth, *more, lights=(EVEN,)):
        write(name, title, depth, pair, [*MATTES, LAMP, *more], lights)

    balls(
        "mirror",
        "A mirror, and a smooth metal.",
        6,
        element("mirror", value("name", "left"), color("cr", (0.9, 0.8, 0.7))),
        conductor("right", (0.6, 0.8, 0.9)),
    )
    balls(
        "metal-rough",
        "Metals of two roughnesses.",
        4,
        conductor("left", (0.9, 0.7, 0.4), 0.12),
        conductor("right", (0.1, 0.15, 0.2), 0.3),
    )
    balls(
        "metal-edges",
        "Rough metals that grow white towards their edges.",
        4,
        conductor("left", (0.6, 0.4, 0.2), 0.2, color("edgecolor", (1, 1, 1))),
        conductor("right", (0.2, 0.3, 0.4), 0.12, color("edgecolor", (1, 1, 1))),
    )
    brushed = rectangle((-2, 0.01, 2), (4, 0, 0), (0, 0, -3.5), "brushed")
    write(
        "metal-brushed",
        "A brushed metal below a ball that shines.",
        3,
        [FLOOR, WALL, brushed, sphere((0.5, 1.6, -0.5), 0.4, "lamp")],
        [*MATTES, LAMP, conductor("brushed", (0.1, 0.12, 0.15), 0.25, value("anisotropy", 0.7))],
        [EVEN],
    )
    balls(
        "glass",
        "Clear balls.",
        8,
        dielectric("left", value("ior", 1.5)),
        dielectric("right", value("ior", 1.33), color("cr", (0.9, 0.9, 0.9)), color("ct", (0.9, 1, 0.8))),
    )
    balls(
        "glass-rough",
        "Rough clear balls.",
        8,
        dielectric("left", value("ior", 1.5), value("roughness", 0.1)),
        dielectric("right", value("ior", 1.5), value("roughness", 0.17)),
    )
    balls(
        "glass-thin",
        "Bubbles.",
        8,
        dielectric("left", value("ior", 1.5), value("thinwalled", "true")),
        dielectric("right", value("ior", 2.2), value("thinwalled", "true")),
    )
    balls(
        "glass-coloured",
        "Glass that takes light away inside.",
        8,
        dielectric("left", value("ior", 1.5), color("attenuationcolor", (0.9, 0.4, 0.1)), value("attenuationdistance", 1)),
        dielectric("right", value("ior", 1.1), color("attenuationcolor", (0.3, 0.6, 0.9)), value("attenuationdistance", 2)),
    )
    balls(
        "openpbr",
        "OpenPBR's base without gloss, and clear.",
        8,
        element("openpbr", value("name", "left"), color("base_color", (0.3, 0.5, 0.8)), value("specular_weight", 0)),
        element(
            "openpbr",
            value("name", "right"),
            value("transmission_weight", 1),
            value("specular_roughness", 0),
            value("specular_ior", 1.4),
        ),
    )

    def milky(name, ior, left, scatter, *more):
        return element(
            "openpbr",
            value("name", name),
            value("transmission_weight", 1),
            value("specular_roughness", 0),
            value("transmission_depth", 1),
            value("specular_ior", ior),
            color("transmission_color", left),
            color("transmission_scatter", scatter),
            *more,
        )

    balls(
        "glass-milky",
        "Glass that scatters light inside, and fog without a surface, forwards.",
        60,
        milky("left", 1.4, (0.3, 0.3, 0.3), (0.9, 0.6, 0.3)),
        milky("right", 1, (0.2, 0.2, 0.2), (0.8, 1.1, 1.4), value("transmission_scatter_anisotropy", 0.6)),
    )
    def fog(name, path, scattered, anisotropy):
        return element(
            "fog", value("name", name), value("meanfreepath", path), color("color", scattered), value("anisotropy", anisotropy)
        )

    balls(
        "fog-balls",
        "Balls of fog, dense and thin, backwards and forwards.",
        8,
        fog("left", 0.5, (0.9, 0.7, 0.5), -0.3),
        fog("right", 1.5, (1, 0.9, 0.8), 0.7),
    )
    write(
        "fog-lights",
        "A room with fog, a point light and a spotlight.",
        6,
        [*room(), sphere((0.3, -0.5, 0.1), 0.3, "white"), box((-0.9, -0.9, -0.9), (0.9, 0.5, 0.9), "fog")],
        [*ROOM_MATTES, fog("fog", 1, (0.95, 0.9, 0.8), 0.3)],
        [
            element(
                "pointlight",
                vector("location", (-0.4, 0.8, 0.3)),
                value("scaleradiance", 1),
                value("falloff", "inversesquare"),
            ),
            element(
                "spotlight",
                vector("location", (0.7, 0.9, 0.2)),
                vector("lookat", (-0.2, -0.8, -0.1)),
                value("scaleradiance", 12),
                value("coneangle", 40),
                value("falloff", "inversesquare"),
            ),
        ],
        view=ROOM_CAMERA,
    )
    veil = rectangle((-2.2, 0.2, 1.2), (4.4, 0, 0), (0, 1.2, 0), "veil")
    write(
        "opacity",
        "A veil before balls, and its shadow.",
        24,
        [*pair, veil],
        [*MATTES, LAMP, matte("left", GREEN), matte("right", RED), matte("veil", BLUE, value("opacity", 0.4))],
        [EVEN],
    )


def shapes():
    positions, normals, uvs, faces = ball_mesh((0.9, 0.9, 0), 0.9, 20)
    write(
        "mesh-smooth",
        "A mesh with normals, lit from beside the camera.",
        3,
        [FLOOR, WALL, mesh(positions, faces, "clay", value("normals", numbers(normals)))],
        MATTES,
        [
            element(
                "pointlight",
                vector("location", (0.6, 2.9, 7.5)),
                value("scaleradiance", 150),
                value("falloff", "inversesquare"),
            )
        ],
    )
    tiles = element("image", value("name", "tiles"), value("file", "tiles.png"), '<uvscale x="1" y="1"/>')
    turned = element(
        "image",
        value("name", "turned"),
        value("file", "tiles.png"),
        '<uvscale x="0.6" y="0.9"/>',
        value("uvrotation", 30),
        '<uvoffset x="0.2" y="0.1"/>',
    )
    corners = [(0, 0, 1.5), (2.2, 0, 0.8), (2.2, 2, 0.2), (0, 2, 0)]
    write(
        "texture",
        "Pictures on a wall and on a mesh.",
        3,
        [
            rectangle((-5, 0, 5), (10, 0, 0), (0, 0, -10), "floor"),
            rectangle((-2.6, 0, -1), (2.4, 0, 0), (0, 2.4, 0), "tiles"),
            mesh(corners, [(0, 1, 2), (0, 2, 3)], "turned", value("uvs", "0 0, 1 0, 1 1, 0 1")),
            PANEL,
        ],
        [*MATTES, LAMP, matte("tiles", '<cd texture="tiles"/>'), matte("turned", '<cd texture="turned"/>')],
        [EVEN],
        [tiles, turned],
    )
    corners, faces = icosahedron((0, 0, 0), 0.7)
    group = [mesh(corners, faces, "clay"), sphere((0, 0.9, 0), 0.35, "moss")]
    put = [
        steps(f'<scale x="{s}" y="{s * q}" z="{s}"/>', turn((0, 0, 1), a), f'<translate x="{x}" y="0.7" z="{z}"/>')
        for s, q, a, x, z in (
            (1, 1, 0, -1.7, -0.6),
            (0.9, 1.4, 25, 0.2, -0.5),
            (0.7, 0.8, -60, 1.4, 0.6),
            (-0.5, 1, 10, -0.5, 1.5),
        )
    ]
    instances = [
        element("instance", value("group", "figure"), one, value("material", "wall") if i == 1 else "")
        for i, one in enumerate(put)
    ]
    write(
        "instances",
        "Instances of a group of a mesh and a ball, mirrored, stretched, and of another material.",
        4,
        [FLOOR, WALL, PANEL, *instances],
        [*MATTES, LAMP],
        [EVEN],
        groups=[("figure", group)],
    )
    lamp_group = [rectangle((-0.4, 0, -0.4), (0.8, 0, 0), (0, 0, 0.8), "lamp"), sphere((0, 0.5, 0), 0.2, "lamp")]
    put = [steps(turn((0, 0, 1), a), f'<translate x="{x}" y="2.4" z="0.4"/>') for a, x in ((20, -1.6), (-30, 1.4))]
    write(
        "light-instances",
        "Instances of lamps.",
        3,
        [FLOOR, WALL, sphere((0, 0.8, 0), 0.8, "clay"), *(element("instance", value("group", "lamps"), one) for one in put)],
        [*MATTES, LAMP],
        groups=[("lamps", lamp_group)],
    )
    write(
        "shapes",
        "A box, a cylinder, a disk, and a ball that is stretched.",
        4,
        [
            FLOOR,
            WALL,
            PANEL,
            box((-2, 0, -0.5), (-1, 1.4, 0.5), "clay"),
            element(
                "cylinder",
                vector("bottom", (0, 0, 0)),
                vector("top", (0.3, 1.4, 0.2)),
                value("radius", 0.5),
                value("material", "moss"),
            ),
            disk((1.8, 0.8, -0.4), (-0.3, 0.4, 1), 0.7, "clay"),
            sphere(
                (0, 0, 0),
                1,
                "moss",
                steps('<scale x="0.8" y="0.4" z="0.5"/>', turn((0, 1, 0), 30), '<translate x="1" y="0.4" z="1.4"/>'),
            ),
        ],
        [*MATTES, LAMP],
        [EVEN],
    )
    thin = element(
        "thinlenscamera",
        vector("eye", PINHOLE[0]),
        vector("lookat", PINHOLE[1]),
        value("fov", PINHOLE[2]),
        value("lensradius", 0.25),
        value("focaldistance", 6.5),
    )
    row = [sphere((x, 0.6, z), 0.6, m) for x, z, m in ((-1.6, -2, "clay"), (0, 0.5, "moss"), (1.3, 2.5, "wall"))]
    write(
        "lens",
        "A lens, and balls before and behind what is sharp.",
        3,
        [FLOOR, WALL, PANEL, *row],
        [*MATTES, LAMP],
        [EVEN],
        view=thin,
    )


def main():
    os.makedirs(FOLDER, exist_ok=True)
    write_pictures()
    lights()
    materials()
    shapes()


if __name__ == "__main__":
    main()
