#!/usr/bin/env python3
# lit_model.py MODEL.gltf FOLDER [DUOLUX]: writes FOLDER/NAME.gltf: the model on a grey floor under a white
# rectangular lamp, seen by a camera at its front (+z), as glTF that Duolux and Blender both read. The folder gets links
# to the model's other files.
import json
import os
import subprocess
import sys

from gltf_files import NO_REFLECTION, Gltf


def bounds(model, duolux):
    info = subprocess.run([duolux, "info", "--json", model], check=True, capture_output=True, text=True).stdout
    return json.loads(info)["bounds"]


def light_model(model, folder, duolux):
    """The path of the new file."""
    with open(model) as file:
        document = json.load(file)
    box = bounds(model, duolux)
    lower, upper = box["lower"], box["upper"]
    middle = [(a + b) / 2.0 for a, b in zip(lower, upper)]
    size = max(b - a for a, b in zip(lower, upper))

    document.pop("cameras", None)
    for node in document["nodes"]:
        node.pop("camera", None)
    gltf = Gltf(document)
    gltf.add_camera(30.0, [middle[0] + 0.7 * size, middle[1] + 0.3 * size, middle[2] + 2.2 * size], middle)
    floor = gltf.add_material({"name": "floor", "pbrMetallicRoughness": {
        "baseColorFactor": [0.4, 0.4, 0.4, 1.0], "metallicFactor": 0.0, "roughnessFactor": 1.0},
        "extensions": {"KHR_materials_specular": NO_REFLECTION}})
    gltf.add_node(mesh=gltf.add_rectangle(floor, 4.0 * size), translation=[middle[0], lower[1], middle[2]])
    lamp = gltf.add_rectangle(gltf.add_lamp(8.0), 0.7 * size)
    gltf.add_node(mesh=lamp, translation=[middle[0] + size, upper[1] + 0.8 * size, middle[2] + size],
                  rotation=[0.284, 0.0, -0.284, 0.9158])  # its back faces the model

    for name in os.listdir(os.path.dirname(os.path.abspath(model))):
        link = os.path.join(folder, name)
        if not os.path.lexists(link) and name != os.path.basename(model):
            os.symlink(os.path.join(os.path.dirname(os.path.abspath(model)), name), link)
    path = os.path.join(folder, os.path.basename(model))
    gltf.write(path)
    return path


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4) or not sys.argv[1].endswith(".gltf"):
        sys.exit("usage: lit_model.py MODEL.gltf FOLDER [DUOLUX]")
    print(light_model(sys.argv[1], sys.argv[2], sys.argv[3] if len(sys.argv) == 4 else "build/duolux"))
