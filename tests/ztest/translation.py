"""Scenes of raytrace as scenes of Mitsuba: of the elements those that the scenes here have; others are exceptions."""

import math
import os
import xml.etree.ElementTree as ElementTree

import mitsuba
import numpy
from comparison.path_tracing.files import write_exr
from comparison.path_tracing.mitsuba import _float, _material, _point, _rgb, _vector
from comparison.path_tracing.scenes import Diffuse, Glass, Lamp, Metal

SUN_DISTANCE = 1e4


def numbers(element, names):
    return numpy.array([float(element.get(name, default)) for name, default in names])


def vector(element, name, default=None):
    found = element.find(name)
    return numpy.array(default, float) if found is None else numbers(found, (("x", 0), ("y", 0), ("z", 0)))


def color(element, name, default=(1, 1, 1)):
    found = element.find(name)
    return numpy.array(default, float) if found is None else numbers(found, (("red", 1), ("green", 1), ("blue", 1)))


def value(element, name, default=0.0):
    return float(element.findtext(name, str(default)))


def unit(v):
    return v / numpy.linalg.norm(v)


def matrix_of(x, y, z, place):
    result = numpy.eye(4)
    result[:3, 0], result[:3, 1], result[:3, 2], result[:3, 3] = x, y, z, place
    return result


def along(normal, scale, place):
    """Turns +z to the normal."""
    normal = unit(normal)
    x = unit(numpy.cross((0, 1, 0) if abs(normal[1]) < 0.9 else (1, 0, 0), normal))
    return matrix_of(x * scale, numpy.cross(normal, x) * scale, normal, place)


def rotation(axis, degrees):
    x, y, z = unit(axis)
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    result = numpy.eye(4)
    across = numpy.array([(0, -z, y), (z, 0, -x), (-y, x, 0)])
    result[:3, :3] = numpy.eye(3) * c + across * s + numpy.outer((x, y, z), (x, y, z)) * (1 - c)
    return result


def transform_of(element):
    result = numpy.eye(4)
    for step in element.findall("transform/*"):
        v = numbers(step, (("x", 0), ("y", 0), ("z", 0)))
        match step.tag:
            case "translate":
                one = matrix_of((1, 0, 0), (0, 1, 0), (0, 0, 1), v)
            case "rotate":
                one = rotation(v, float(step.get("angle")))
            case "scale":
                one = numpy.diag([*v, 1])
            case _:
                raise ValueError(f"<{step.tag}> is not translated")
        result = one @ result
    return result


def to_world(matrix):
    text = " ".join(f"{x:.9g}" for x in matrix.reshape(-1))
    return f'<transform name="to_world"><matrix value="{text}"/></transform>'


def integer(name, number):
    return f'<integer name="{name}" value="{number}"/>'


def text(name, words):
    return f'<string name="{name}" value="{words}"/>'


class Translation:
    """A scene, and the files that it needs, in a folder."""

    def __init__(self, file, folder):
        self.root = ElementTree.parse(file).getroot()
        self.source, self.folder = os.path.dirname(file), folder
        self.textures = {one.findtext("name"): one for one in self.root.findall("textures/*/*")}
        self.materials = {one.findtext("name"): one for one in self.root.findall("materials/*/*")}
        self.groups = {one.findtext("name"): one for one in self.root.findall("groups/*")}
        self.names = 0
        body = [self.light(one) for one in self.root.findall("lights/*/*")]
        body += [self.object(one) for one in self.root.findall("objects/*/*")]
        with open(os.path.join(folder, "scene.xml"), "w", encoding="utf-8") as out:
            out.write('<scene version="3.0.0">\n' + self.integrator() + self.sensor() + "\n".join(body) + "\n</scene>\n")

    def new_name(self, kind):
        self.names += 1
        return f"{kind}-{self.names}"

    def integrator(self):
        # A depth here is a scattering: one less than the segments of a path, which Mitsuba counts.
        depth = integer("max_depth", int(self.root.findtext("integrator/path/maxdepth")) + 1) + integer("rr_depth", 50)
        media = [self.root.find(f".//{name}") for name in ("attenuationdistance", "transmission_depth", "fog")]
        kind = "path" if media == [None, None, None] else "volpath"
        return f'<integrator type="moment"><integrator type="{kind}" name="of">{depth}</integrator></integrator>\n'

    def sensor(self):
        width, height = (self.root.findtext(f"viewplane/{name}") for name in ("hres", "vres"))
        camera = next(one for one in self.root if one.tag.endswith("camera"))
        view = f'<lookat origin="{_vector(vector(camera, "eye"))}" target="{_vector(vector(camera, "lookat"))}" up="0,1,0"/>'
        clip = _float("near_clip", 1e-2) + _float("far_clip", 1e5)
        match camera.tag:
            case "orthographiccamera":
                half = value(self.root, "viewplane/pixelsize") * int(width) / 2
                head, view = "orthographic", f'<scale x="{half:.9g}" y="{half:.9g}"/>{view}'
            case "camera" | "thinlenscamera":
                head, clip = "perspective", clip + _float("fov", value(camera, "fov")) + text("fov_axis", "y")
        if camera.tag == "thinlenscamera":
            head = "thinlens"
            clip += _float("aperture_radius", value(camera, "lensradius")) + _float(
                "focus_distance", value(camera, "focaldistance")
            )
        film = (
            integer("width", width) + integer("height", height) + text("component_format", "float32") + '<rfilter type="box"/>'
        )
        return (
            f'<sensor type="{head}">{clip}<transform name="to_world">{view}</transform>'
            f'<sampler type="independent"/><film type="hdrfilm">{film}</film></sensor>\n'
        )

    # Lights

    def radiance(self, light):
        return value(light, "scaleradiance", 1) * color(light, "color")

    def light(self, light):
        radiance = self.radiance(light)
        if light.tag in ("pointlight", "spotlight") and light.findtext("falloff") != "inversesquare":
            raise ValueError("Mitsuba's lights grow weaker with distance")
        match light.tag:
            case "pointlight":
                position = _point("position", vector(light, "location"))
                return f'<emitter type="point">{position}{_rgb("intensity", radiance)}</emitter>'
            case "spotlight":
                edge = value(light, "coneangle") / 2
                view = f'origin="{_vector(vector(light, "location"))}" target="{_vector(vector(light, "lookat"))}"'
                # Its edge may not be sharp.
                return (
                    f'<emitter type="spot"><transform name="to_world"><lookat {view} up="0,0.6,0.8"/></transform>'
                    f'{_rgb("intensity", radiance)}{_float("cutoff_angle", edge)}'
                    f'{_float("beam_width", 0.9999 * edge)}</emitter>'
                )
            case "directionallight":
                direction = unit(vector(light, "direction"))
                angle = math.radians(value(light, "angle")) / 2
                if angle == 0:
                    return (
                        f'<emitter type="directional"><vector name="direction" value="{_vector(-direction)}"/>'
                        f'{_rgb("irradiance", radiance)}</emitter>'
                    )
                # A disk that is far away. The camera must not see it.
                disk = along(-direction, SUN_DISTANCE * math.tan(angle), direction * SUN_DISTANCE)
                emitter = f'<emitter type="area">{_rgb("radiance", radiance / (math.pi * math.sin(angle) ** 2))}</emitter>'
                return f'<shape type="disk">{to_world(disk)}{_material(self.new_name("sun"), Lamp((0, 0, 0)))}{emitter}</shape>'
            case "environmentlight":
                if light.find("file") is None:
                    return f'<emitter type="constant">{_rgb("radiance", radiance)}</emitter>'
                return self.environment(light, radiance)
        raise ValueError(f"<{light.tag}> is not translated")

    def environment(self, light, radiance):
        """Its outermost rows lie at the poles, ours in the middles of the outermost texels: of twice as many rows and one, its
        every second lies where one of ours does. Beyond a pole, ours are those of the other side."""
        picture = self.picture(light.findtext("file")) * radiance
        rows = numpy.roll(picture, picture.shape[1] // 2, axis=1)
        beyond = numpy.concatenate([rows[:1], picture, rows[-1:]])
        fine = numpy.empty((2 * len(picture) + 1, *picture.shape[1:]), numpy.float32)
        fine[1::2], fine[::2] = picture, (beyond[:-1] + beyond[1:]) / 2
        return f'<emitter type="envmap">{text("filename", self.exr(fine))}{to_world(transform_of(light))}</emitter>'

    # Pictures

    def picture(self, name):
        """Its linear numbers."""
        bitmap = mitsuba.Bitmap(os.path.join(self.source, name))
        bitmap = bitmap.convert(mitsuba.Bitmap.PixelFormat.RGB, mitsuba.Struct.Type.Float32, srgb_gamma=False)
        return numpy.array(bitmap)

    def exr(self, picture):
        name = self.new_name("picture") + ".exr"
        write_exr(picture.astype(numpy.float32), os.path.join(self.folder, name))
        return name

    def color(self, name, element, child, scale=1.0):
        """As a property of the name: a colour, or a texture."""
        found = element.find(child)
        texture = self.textures.get(found.get("texture"))
        if texture is None:
            return _rgb(name, scale * color(element, child))
        picture = self.picture(texture.findtext("file")) * (scale * color(element, child))
        size, place = texture.find("uvscale"), texture.find("uvoffset")
        steps = "" if size is None else f'<scale x="{size.get("x")}" y="{size.get("y")}"/>'
        steps += f'<rotate z="1" angle="{value(texture, "uvrotation")}"/>'
        steps += "" if place is None else f'<translate x="{place.get("x")}" y="{place.get("y")}"/>'
        # Its upper row is at v = 0.
        steps += '<scale x="1" y="-1"/><translate x="0" y="1"/>'
        return (
            f'<texture type="bitmap" name="{name}">{text("filename", self.exr(picture))}<boolean name="raw" value="true"/>'
            f'{text("format", "variant")}<transform name="to_uv">{steps}</transform></texture>'
        )

    # Materials

    def emitter(self, name):
        material = self.materials[name]
        if material.tag != "emissive":
            return ""
        return f'<emitter type="area">{self.color("radiance", material, "ce", value(material, "scaleradiance", 1))}</emitter>'

    def bsdf(self, name):
        """And the medium inside."""
        material = self.materials[name]
        bsdf = getattr(self, material.tag)(material)
        if material.find("opacity") is not None:
            bsdf = f'<bsdf type="mask">{_float("opacity", value(material, "opacity"))}{bsdf}</bsdf>'
        return bsdf

    @staticmethod
    def two_sided(bsdf):
        return f'<bsdf type="twosided">{bsdf}</bsdf>'

    def matte(self, material):
        return self.two_sided(f'<bsdf type="diffuse">{self.color("reflectance", material, "cd", value(material, "kd"))}</bsdf>')

    def emissive(self, _):
        return _material(self.new_name("lamp"), Lamp((0, 0, 0)))

    def mirror(self, material):
        return _material(self.new_name("mirror"), Metal(color(material, "cr")))

    def conductor(self, material):
        roughness = value(material, "roughness")
        if material.find("edgecolor") is not None:
            if not numpy.array_equal(color(material, "edgecolor"), (1, 1, 1)):
                raise ValueError("Mitsuba has Schlick's approximation alone")
            base = _rgb("base_color", color(material, "cr"))
            return self.two_sided(
                f'<bsdf type="principled">{base}{_float("roughness", roughness)}{_float("metallic", 1)}</bsdf>'
            )
        if (anisotropy := value(material, "anisotropy")) > 0:
            rest = 1 - anisotropy
            x = roughness**2 * math.sqrt(2 / (1 + rest**2))
            inner = text("material", "none") + text("distribution", "ggx") + _rgb("specular_reflectance", color(material, "cr"))
            return self.two_sided(
                f'<bsdf type="roughconductor">{inner}{_float("alpha_u", x)}{_float("alpha_v", x * rest)}</bsdf>'
            )
        return _material(self.new_name("metal"), Metal(color(material, "cr"), roughness))

    def dielectric(self, material):
        index, roughness = value(material, "ior", 1.5), value(material, "roughness")
        inner = _float("int_ior", index) + _float("ext_ior", 1) + _rgb("specular_reflectance", color(material, "cr"))
        inner += _rgb("specular_transmittance", color(material, "ct"))
        if material.findtext("thinwalled") == "true":
            return f'<bsdf type="thindielectric">{inner}</bsdf>'
        if roughness > 0:
            return f'<bsdf type="roughdielectric">{inner}{text("distribution", "ggx")}{_float("alpha", roughness**2)}</bsdf>'
        bsdf = f'<bsdf type="dielectric">{inner}</bsdf>'
        if (distance := value(material, "attenuationdistance")) > 0:
            extinction = -numpy.log(color(material, "attenuationcolor")) / distance
            bsdf += self.medium(extinction, numpy.zeros(3))
        return bsdf

    @staticmethod
    def medium(extinction, scattering, anisotropy=0.0):
        return (
            f'<medium type="homogeneous" name="interior">{_rgb("sigma_t", extinction / extinction.max())}'
            f'{_float("scale", extinction.max())}{_rgb("albedo", scattering / extinction)}'
            f'<phase type="hg">{_float("g", anisotropy)}</phase></medium>'
        )

    def fog(self, material):
        extinction = numpy.full(3, 1 / value(material, "meanfreepath"))
        return '<bsdf type="null"/>' + self.medium(
            extinction, extinction * color(material, "color"), value(material, "anisotropy")
        )

    def openpbr(self, material):
        if (depth := value(material, "transmission_depth")) > 0:
            extinction = -numpy.log(color(material, "transmission_color")) / depth
            scattering = color(material, "transmission_scatter", (0, 0, 0)) / depth
            boundary = f'<bsdf type="dielectric">{_float("int_ior", value(material, "specular_ior", 1.5))}{_float("ext_ior", 1)}</bsdf>'
            return boundary + self.medium(extinction, scattering, value(material, "transmission_scatter_anisotropy"))
        if value(material, "transmission_weight") == 1 and value(material, "specular_roughness", 0.3) == 0:
            return _material(self.new_name("clear"), Glass(value(material, "specular_ior", 1.5)))
        if value(material, "specular_weight", 1) == 0:
            return _material(self.new_name("base"), Diffuse(color(material, "base_color", (0.8, 0.8, 0.8))))
        raise ValueError("Mitsuba has not this <openpbr>")

    # Objects

    def object(self, item, placed=numpy.eye(4), material=None):
        placed = placed @ transform_of(item)
        if item.tag == "instance":
            return self.instance(item, placed)
        name = material or item.findtext("material")
        head = getattr(self, item.tag)(item, placed)
        return f"<shape {head}{self.bsdf(name)}{self.emitter(name)}</shape>"

    def instance(self, item, placed):
        """Of lamps, which its instances may not have, copies."""
        group, material = self.groups[item.findtext("group")], item.findtext("material")
        inner = group.findall("objects/*/*")
        names = [material or one.findtext("material") for one in inner]
        if any(self.materials[name].tag == "emissive" for name in names):
            return "\n".join(self.object(one, placed, material) for one in inner)
        identity = f"group-{group.findtext('name')}-{material}"
        shapes = ""
        if not hasattr(self, identity):
            setattr(self, identity, True)
            inside = "\n".join(self.object(one, material=material) for one in inner)
            shapes = f'<shape type="shapegroup" id="{identity}">\n{inside}\n</shape>\n'
        return f'{shapes}<shape type="instance"><ref id="{identity}"/>{to_world(placed)}</shape>'

    def sphere(self, item, placed):
        center, radius = _point("center", vector(item, "center")), _float("radius", value(item, "radius"))
        columns = placed[:3, :3].T @ placed[:3, :3]
        if numpy.allclose(columns, columns[0, 0] * numpy.eye(3)):
            return f'type="sphere">{center}{radius}{to_world(placed)}'
        # Its spheres stay round, and its instances do not: a fine mesh with normals.
        return self.round_mesh(vector(item, "center"), value(item, "radius"), placed)

    def round_mesh(self, center, radius, placed, rings=256):
        around, up = numpy.meshgrid(numpy.arange(2 * rings) * math.pi / rings, numpy.arange(rings + 1) * math.pi / rings)
        normals = numpy.stack([numpy.sin(up) * numpy.sin(around), -numpy.cos(up), numpy.sin(up) * numpy.cos(around)], -1)
        normals = normals.reshape(-1, 3)
        i, j = (a.reshape(-1) for a in numpy.meshgrid(numpy.arange(rings), numpy.arange(2 * rings)))
        a, b = i * 2 * rings + j, i * 2 * rings + (j + 1) % (2 * rings)
        c, d = a + 2 * rings, b + 2 * rings
        faces = numpy.concatenate([numpy.stack([a, b, c], 1)[i > 0], numpy.stack([b, d, c], 1)[i < rings - 1]])
        return self.ply(center + radius * normals, faces, placed, normals)

    def rectangle(self, item, placed):
        a, b = vector(item, "edge1"), vector(item, "edge2")
        # The square from -1 to 1, which looks to +z.
        square = matrix_of(a / 2, b / 2, unit(numpy.cross(a, b)), vector(item, "corner") + (a + b) / 2)
        return f'type="rectangle">{to_world(placed @ square)}'

    def disk(self, item, placed):
        return f'type="disk">{to_world(placed @ along(vector(item, "normal"), value(item, "radius"), vector(item, "center")))}'

    def box(self, item, placed):
        low, high = vector(item, "min"), vector(item, "max")
        half = numpy.diag((high - low) / 2)
        return f'type="cube">{to_world(placed @ matrix_of(*half, (low + high) / 2))}'

    def cylinder(self, item, placed):
        ends = _point("p0", vector(item, "bottom")) + _point("p1", vector(item, "top"))
        return f'type="cylinder">{ends}{_float("radius", value(item, "radius"))}{to_world(placed)}'

    def triangle(self, item, placed):
        corners = numpy.array([vector(item, f"vertexposition{i}") for i in (1, 2, 3)])
        return self.ply(corners, numpy.array([(0, 1, 2)]), placed)

    def mesh(self, item, placed):
        lists = [item.findtext(name, "").replace(",", " ").split() for name in ("positions", "normals", "uvs", "faces")]
        positions, normals, uvs = (numpy.array(one, float).reshape(-1, n) for one, n in zip(lists, (3, 3, 2)))
        return self.ply(positions, numpy.array(lists[3], int).reshape(-1, 3), placed, normals, uvs)

    def ply(self, positions, faces, placed, normals=(), uvs=()):
        name = self.new_name("mesh") + ".ply"
        columns = [positions, *(one for one in (normals, uvs) if len(one) > 0)]
        names = ["x", "y", "z", *(["nx", "ny", "nz"] if len(normals) > 0 else []), *(["u", "v"] if len(uvs) > 0 else [])]
        with open(os.path.join(self.folder, name), "w", encoding="utf-8") as file:
            file.write(f"ply\nformat ascii 1.0\nelement vertex {len(positions)}\n")
            file.write("".join(f"property float {one}\n" for one in names))
            file.write(f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
            numpy.savetxt(file, numpy.concatenate(columns, axis=1), "%.9g")
            numpy.savetxt(file, numpy.concatenate([numpy.full((len(faces), 1), 3), faces], axis=1), "%d")
        flat = "true" if len(normals) == 0 else "false"
        return f'type="ply">{text("filename", name)}<boolean name="face_normals" value="{flat}"/>{to_world(placed)}'
