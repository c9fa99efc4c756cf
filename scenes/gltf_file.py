"""Writes glTF files: what generate_gltf_features.py makes its models with. Python 3.8 or later, standard library only."""
import base64
import json
import os
import struct

FLOAT, BYTE, UNSIGNED_BYTE, SHORT, UNSIGNED_SHORT, UNSIGNED_INT = 5126, 5120, 5121, 5122, 5123, 5125
FORMATS = {FLOAT: "f", BYTE: "b", UNSIGNED_BYTE: "B", SHORT: "h", UNSIGNED_SHORT: "H", UNSIGNED_INT: "I"}
TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}
REPEAT, MIRRORED_REPEAT, CLAMP_TO_EDGE = 10497, 33648, 33071
TRIANGLES, STRIP, FAN = 4, 5, 6


class Gltf:
    """A file with one scene. What is added is known by its number."""

    def __init__(self):
        self.json = {"asset": {"version": "2.0", "generator": "scenes/generate_gltf_features.py"}, "scene": 0,
                     "scenes": [{"nodes": []}]}
        self.bytes = bytearray()

    def put(self, group, item):
        self.json.setdefault(group, []).append(item)
        return len(self.json[group]) - 1

    def use(self, extension):
        used = self.json.setdefault("extensionsUsed", [])
        if extension not in used:
            used.append(extension)

    def view(self, data):
        start = len(self.bytes)
        self.bytes += data + bytes(-len(data) % 4)
        return self.put("bufferViews", {"buffer": 0, "byteOffset": start, "byteLength": len(data)})

    def values(self, values, component=FLOAT):
        """The bytes of vectors, each of which begins at a multiple of four."""
        code = f"<{len(values[0])}{FORMATS[component]}"
        return b"".join(part + bytes(-len(part) % 4) for part in (struct.pack(code, *v) for v in values))

    def accessor(self, values, component=FLOAT, bounds=False, **more):
        """values: vectors, or numbers."""
        if not isinstance(values[0], (tuple, list)):
            code = f"<{len(values)}{FORMATS[component]}"
            item = {"bufferView": self.view(struct.pack(code, *values)), "type": "SCALAR"}
            values = [(v,) for v in values]
        else:
            item = {"bufferView": self.view(self.values(values, component)), "type": TYPES[len(values[0])]}
            size = struct.calcsize(FORMATS[component]) * len(values[0])
            if size % 4:
                self.json["bufferViews"][-1]["byteStride"] = size + -size % 4
        item.update(componentType=component, count=len(values), **more)
        if bounds:
            item.update(min=[min(c) for c in zip(*values)], max=[max(c) for c in zip(*values)])
        return self.put("accessors", item)

    def primitive(self, shape, material=None, mode=TRIANGLES, **attributes):
        """attributes: numbers of accessors."""
        known = {"POSITION": self.accessor(shape.positions, bounds=True)}
        if shape.normals:
            known["NORMAL"] = self.accessor(shape.normals)
        if shape.uvs:
            known["TEXCOORD_0"] = self.accessor(shape.uvs)
        known.update(attributes)
        item = {"attributes": known, "mode": mode}
        if shape.indices:
            item["indices"] = self.accessor(shape.indices, UNSIGNED_INT)
        if material is not None:
            item["material"] = material
        return item

    def mesh(self, *primitives, **more):
        return self.put("meshes", {"primitives": list(primitives), **more})

    def node(self, root=True, **properties):
        number = self.put("nodes", properties)
        if root:
            self.json["scenes"][0]["nodes"].append(number)
        return number

    def show(self, shape, material=None, at=(0, 0, 0), **properties):
        return self.node(mesh=self.mesh(self.primitive(shape, material)), translation=list(at), **properties)

    def texture(self, picture, wrap=REPEAT, wrap_t=None):
        """picture: the bytes of a PNG file. wrap_t: where it is not that of both directions."""
        image = self.put("images", {"bufferView": self.view(picture), "mimeType": "image/png"})
        sampler = self.put("samplers", {"wrapS": wrap, "wrapT": wrap_t or wrap})
        return self.put("textures", {"source": image, "sampler": sampler})

    def material(self, color=(1, 1, 1), metallic=0.0, roughness=0.5, texture=None, extensions=None, **more):
        """extensions: without the KHR_materials_ that their names begin with."""
        surface_of = {"baseColorFactor": [*color, 1][:4], "metallicFactor": metallic, "roughnessFactor": roughness}
        if texture is not None:
            surface_of["baseColorTexture"] = texture if isinstance(texture, dict) else {"index": texture}
        item = {"pbrMetallicRoughness": surface_of, **more}
        for name, value in (extensions or {}).items():
            self.use("KHR_materials_" + name)
            item.setdefault("extensions", {})["KHR_materials_" + name] = value
        return self.put("materials", item)

    def write(self, folder, name):
        data = base64.b64encode(bytes(self.bytes)).decode("ascii")
        uri = "data:application/octet-stream;base64," + data
        self.json["buffers"] = [{"byteLength": len(self.bytes), "uri": uri}]
        with open(os.path.join(folder, name + ".gltf"), "w", encoding="utf-8", newline="\n") as file:
            json.dump(self.json, file)
