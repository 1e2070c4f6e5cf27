# duolux_json.py: a JSON scene of Duolux with diffuse surfaces, in Blender.
#
# Emitters must be rectangles. They become area lights just in front of their surfaces, because emitting
# meshes are 1-5 % too dark at grazing angles in Cycles 3.4; its area lights agree with Lambert's formula.
import json
import math
import os
import sys

import bpy
from mathutils import Matrix, Vector


def read_mtl(file):
    """Name -> (Kd, Ke)."""
    materials = {}
    for words in map(str.split, open(file)):
        if words[:1] == ["newmtl"]:
            colours = materials[words[1]] = [[0.0] * 3, [0.0] * 3]
        elif words[:1] in (["Kd"], ["Ke"]):
            colours[words[0] == "Ke"] = [float(w) for w in words[1:4]]
    return materials


def make_diffuse(material, albedo):
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    bsdf = nodes.new("ShaderNodeBsdfDiffuse")
    bsdf.inputs["Color"].default_value = albedo + [1.0]
    bsdf.inputs["Roughness"].default_value = 0.0
    material.node_tree.links.new(bsdf.outputs["BSDF"], nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])


def add_object(name, data, position, x, y, z):
    """Adds an object with these axes."""
    item = bpy.data.objects.new(name, data)
    item.matrix_world = Matrix.Translation(position) @ Matrix((x, y, z)).transposed().to_4x4()
    bpy.context.scene.collection.objects.link(item)
    return item


def add_lamp(mesh, radiance, seen):
    """Adds an area light in place of a rectangle. `seen`: the camera sees it."""
    corner, *others = (v.co for v in mesh.vertices)
    edge1, edge2, diagonal = sorted((p - corner for p in others), key=lambda edge: edge.length)
    if (edge1 + edge2 - diagonal).length > 1e-4 * diagonal.length or len(others) != 3:
        sys.exit(f"duolux_json.py: {mesh.name} emits and is no rectangle")
    normal = mesh.polygons[0].normal
    lamp = bpy.data.lights.new(mesh.name, "AREA")
    lamp.shape = "RECTANGLE"
    lamp.size, lamp.size_y = edge1.length, edge2.length
    lamp.color = radiance
    lamp.energy = 4.0 * edge1.length * edge2.length  # radiance 1
    x, z = edge1.normalized(), -normal  # it shines along -z
    middle = corner + diagonal / 2.0 + normal * (diagonal.length * 1e-5)
    add_object(mesh.name, lamp, middle, x, z.cross(x), z).visible_camera = seen


def load(file):
    """Replaces Blender's scene by that of the file."""
    with open(file) as text:
        scene = json.load(text)
    materials = {}
    for item in scene["objects"]:
        obj = os.path.join(os.path.dirname(file), item["mesh"])
        bpy.ops.wm.obj_import(filepath=obj, forward_axis="Y", up_axis="Z")  # unchanged coordinates
        materials.update(read_mtl(os.path.splitext(obj)[0] + ".mtl"))
    for material in bpy.data.materials:
        make_diffuse(material, materials[material.name][0])
    for mesh in list(bpy.data.meshes):
        mesh.polygons.foreach_set("use_smooth", [False] * len(mesh.polygons))
        name = mesh.materials[0].name
        both = {"invisible": materials[name][1], "visible": materials[name][1]}
        emission = scene.get("materials", {}).get(name, {}).get("emission", both)
        if max(emission["invisible"]) > 0.0:
            add_lamp(mesh, emission["invisible"], max(emission["visible"]) > 0.0)

    camera = scene["camera"]
    lens = bpy.data.cameras.new("camera")
    lens.sensor_fit = "VERTICAL"
    lens.lens = lens.sensor_height / 2.0 / math.tan(math.radians(camera["vfov"]) / 2.0)
    lens.clip_start, lens.clip_end = 1e-3, 1e6
    position = Vector(camera["position"])
    back = (position - Vector(camera["target"])).normalized()
    right = Vector(camera["up"]).cross(back).normalized()
    bpy.context.scene.camera = add_object("camera", lens, position, right, back.cross(right), back)
