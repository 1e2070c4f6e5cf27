# gltf_files.py: writes glTF files: spheres, rectangles, images, cameras. Needs only Python's standard library.
import base64
import json
import math
import struct
import zlib


def data_uri(kind, data):
    return f"data:{kind};base64,{base64.b64encode(data).decode()}"


def png(width, height, pixel):
    """A PNG of 8 bits; pixel(u, v): 3 or 4 numbers from 0 to 1, the image's coordinates being u right and v down."""
    rows = [[pixel((x + 0.5) / width, (y + 0.5) / height) for x in range(width)] for y in range(height)]
    numbers = [bytes([0]) + bytes(round(255.0 * n) for colour in row for n in colour) for row in rows]
    return png_of_rows(width, height, len(rows[0][0]), b"".join(numbers))


def png_of_rows(width, height, channels, rows, level=6):
    """`rows`: each begins with a byte 0 (no filter)."""
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    header = struct.pack(">IIBBBBB", width, height, 8, {3: 2, 4: 6}[channels], 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, level)) + chunk(b"IEND", b"")


# KHR_materials_specular of a dielectric that does not reflect. Blender 3.4's importer ignores the factor.
NO_REFLECTION = {"specularFactor": 0.0, "specularColorFactor": [0.0, 0.0, 0.0]}


class Gltf:
    """A glTF document to which meshes are added, in a buffer of its own."""

    def __init__(self, document=None):
        self.document = document or {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}]}
        self.data = bytearray()

    def add(self, kind, item):
        """The index of a new element of the list."""
        items = self.document.setdefault(kind, [])
        items.append(item)
        return len(items) - 1

    def add_node(self, **node):
        scene = self.document["scenes"][self.document.get("scene", 0)]
        scene.setdefault("nodes", []).append(self.add("nodes", node))

    def add_image(self, data):
        """A texture with a new image; returns what a material has in place of a number."""
        image = self.add("images", {"uri": data_uri("image/png", data)})
        return {"index": self.add("textures", {"source": image})}

    def add_material(self, material):
        extensions = self.document.setdefault("extensionsUsed", [])
        extensions += [name for name in material.get("extensions", {}) if name not in extensions]
        return self.add("materials", material)

    def add_lamp(self, strength):
        """A material that emits white radiance on both sides, as meshes do in Cycles, and reflects nothing."""
        return self.add_material({
            "name": "lamp", "doubleSided": True, "emissiveFactor": [1, 1, 1],
            "pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1], "metallicFactor": 0},
            "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": strength},
                           "KHR_materials_specular": NO_REFLECTION}})

    def accessor(self, rows, code, component, kind):
        """`code`: of struct, for each number. `component`: its glTF number."""
        data = b"".join(struct.pack(f"<{len(row)}{code}", *row) for row in rows)
        view = self.add("bufferViews", {"buffer": len(self.document.get("buffers", [])), "byteOffset": len(self.data),
                                        "byteLength": len(data)})
        self.data += data + bytes(-len(data) % 4)
        accessor = {"bufferView": view, "componentType": component, "count": len(rows), "type": kind}
        if kind == "VEC3":
            accessor["min"], accessor["max"] = ([f(column) for column in zip(*rows)] for f in (min, max))
        return self.add("accessors", accessor)

    def add_mesh(self, material, positions, normals, uvs, indices):
        attributes = {"POSITION": self.accessor(positions, "f", 5126, "VEC3"),
                      "NORMAL": self.accessor(normals, "f", 5126, "VEC3"),
                      "TEXCOORD_0": self.accessor(uvs, "f", 5126, "VEC2")}
        primitive = {"attributes": attributes, "material": material,
                     "indices": self.accessor([[i] for i in indices], "H", 5123, "SCALAR")}
        return self.add("meshes", {"primitives": [primitive]})

    def add_sphere(self, material, stacks=64):
        """A mesh of radius 1; its texture coordinates go around the y axis and from the top down."""
        slices = 2 * stacks
        positions, uvs, indices = [], [], []
        for i in range(stacks + 1):
            for j in range(slices + 1):
                theta, phi = math.pi * i / stacks, 2.0 * math.pi * j / slices
                positions.append((math.sin(theta) * math.cos(phi), math.cos(theta), -math.sin(theta) * math.sin(phi)))
                uvs.append((j / slices, i / stacks))
                a = i * (slices + 1) + j
                b = a + slices + 1
                if i < stacks and j < slices:  # at the poles, one of the two triangles has no area
                    indices += ([a, b, b + 1] if i < stacks - 1 else []) + ([a, b + 1, a + 1] if i > 0 else [])
        return self.add_mesh(material, positions, positions, uvs, indices)

    def add_rectangle(self, material, half):
        """A mesh in the plane y = 0 that faces up."""
        positions = [(x, 0.0, z) for x, z in ((-half, half), (half, half), (half, -half), (-half, -half))]
        uvs = [(0.0, 1.0), (1.0, 1.0), (1.0, 0.0), (0.0, 0.0)]
        return self.add_mesh(material, positions, [(0.0, 1.0, 0.0)] * 4, uvs, [0, 1, 2, 0, 2, 3])

    def add_camera(self, vfov, position, target):
        """`vfov`: the vertical angle of view in degrees. Up is y."""
        camera = self.add("cameras", {"type": "perspective", "perspective": {
            "yfov": math.radians(vfov), "aspectRatio": 1.0, "znear": 0.001, "zfar": 1000.0}})
        offset = [p - t for p, t in zip(position, target)]
        yaw = math.atan2(offset[0], offset[2]) / 2.0
        pitch = -math.atan2(offset[1], math.hypot(offset[0], offset[2])) / 2.0
        # Turns about x by the pitch, then about y by the yaw.
        rotation = [math.cos(yaw) * math.sin(pitch), math.sin(yaw) * math.cos(pitch),
                    -math.sin(yaw) * math.sin(pitch), math.cos(yaw) * math.cos(pitch)]
        self.add_node(camera=camera, translation=list(position), rotation=rotation)

    def write(self, path):
        buffer = {"byteLength": len(self.data), "uri": data_uri("application/octet-stream", bytes(self.data))}
        with open(path, "w") as file:
            json.dump({**self.document, "buffers": self.document.get("buffers", []) + [buffer]}, file)
