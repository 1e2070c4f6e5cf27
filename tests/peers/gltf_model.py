# gltf_model.py: a material that Blender's importer made, closer to glTF's model than its Principled BSDF can be.
#
# Blender 3.4's Principled BSDF adds a dielectric's reflection to the diffuse light without taking it away there, its
# diffuse lobe is not Lambert's, a clear coat has a quarter of the strength, microfacets lose what they scatter several
# times, and the Fresnel reflectance has the exact shape where glTF has Schlick's. The importer blends where glTF masks,
# makes thin walls solid, and absorbs 1 - c where glTF absorbs -ln c. The nodes made here do what glTF says, except that
# the Fresnel reflectance of rough surfaces is that of smooth ones in the view's direction. Glass and sheen stay
# Blender's.
import math


class Tree:
    def __init__(self, tree):
        self.nodes, self.links = tree.nodes, tree.links

    def add(self, kind, **inputs):
        """A node; inputs are numbers, colours, or sockets of other nodes."""
        node = self.nodes.new("ShaderNode" + kind)
        for name, value in inputs.items():
            self.set(node.inputs[name], value)
        return node

    def set(self, socket, value):
        if hasattr(value, "is_linked"):
            self.links.new(value, socket)
        else:
            for link in socket.links:
                self.links.remove(link)
            socket.default_value = value

    def mix(self, fraction, first, second):
        """(1 - fraction) first + fraction second."""
        node = self.nodes.new("ShaderNodeMixShader")
        for socket, value in zip(node.inputs, (fraction, first, second)):
            self.set(socket, value)
        return node.outputs["Shader"]

    def math(self, operation, a, b):
        node = self.nodes.new("ShaderNodeMath")
        node.operation = operation
        self.set(node.inputs[0], a)
        self.set(node.inputs[1], b)
        return node.outputs["Value"]

    def mirror(self, roughness, normal, colour=(1.0, 1.0, 1.0, 1.0)):
        """Microfacets, with what they scatter several times."""
        node = self.add("BsdfGlossy", Color=colour, Roughness=roughness, **normal)
        node.distribution = "MULTI_GGX"
        return node.outputs["BSDF"]

    def schlick(self, f0, normal):
        """Fresnel reflectance f0 + (1 - f0) (1 - cosine)^5."""
        facing = self.add("LayerWeight", Blend=0.5, **normal).outputs["Facing"]  # 1 - cosine
        return self.math("ADD", f0, self.math("MULTIPLY", 1.0 - f0, self.math("POWER", facing, 5.0)))

    def metal(self, colour, roughness, normal):
        mix = self.nodes.new("ShaderNodeMix")
        mix.data_type = "RGBA"
        self.set(mix.inputs[0], self.schlick(0.0, normal))
        self.set(mix.inputs[6], colour)
        self.set(mix.inputs[7], (1.0, 1.0, 1.0, 1.0))
        return self.mirror(roughness, normal, mix.outputs[2])


def value_of(socket):
    """What an input is set to: the socket linked to it, or its value."""
    if socket.is_linked:
        return socket.links[0].from_socket
    value = socket.default_value
    return tuple(value) if hasattr(value, "__len__") else value


def apply(material):
    """Whether the material is glass of some volume."""
    tree = Tree(material.node_tree)
    principled = next((n for n in tree.nodes if n.type == "BSDF_PRINCIPLED"), None)
    if principled is None or max(value_of(principled.inputs["Emission"])[:3]) > 0.0:
        return False
    get = {name: value_of(socket) for name, socket in principled.inputs.items()}
    principled.distribution = "MULTI_GGX"
    output = next(n for n in tree.nodes if n.type == "OUTPUT_MATERIAL")
    normal = {"Normal": get["Normal"]} if principled.inputs["Normal"].is_linked else {}
    coat_normal = {"Normal": get["Clearcoat Normal"]} if principled.inputs["Clearcoat Normal"].is_linked else {}
    absorption = next((n for n in tree.nodes if n.type == "VOLUME_ABSORPTION"), None)
    tree.set(principled.inputs["Alpha"], 1.0)
    tree.set(principled.inputs["Clearcoat"], 0.0)

    f0 = ((get["IOR"] - 1.0) / (get["IOR"] + 1.0)) ** 2
    if get["Transmission"] == 0.0:
        diffuse = tree.add("BsdfDiffuse", Color=get["Base Color"], **normal).outputs["BSDF"]
        reflectance = 0.0 if get["Specular"] == 0.0 else tree.schlick(f0, normal)
        dielectric = tree.mix(reflectance, diffuse, tree.mirror(get["Roughness"], normal))
        surface = tree.mix(get["Metallic"], dielectric, tree.metal(get["Base Color"], get["Roughness"], normal))
    elif absorption is None:
        fresnel = tree.schlick(f0, normal)  # the Fresnel node would have the inside of solid glass behind the surface
        through = tree.add("BsdfTransparent", Color=get["Base Color"]).outputs["BSDF"]
        surface = tree.mix(fresnel, through, tree.mirror(get["Roughness"], normal))
    else:
        surface = principled.outputs["BSDF"]
        absorb_as_gltf(absorption)

    if get["Clearcoat"] != 0.0:
        varnish = tree.math("MULTIPLY", tree.schlick(0.04, coat_normal), get["Clearcoat"])
        surface = tree.mix(varnish, surface, tree.mirror(get["Clearcoat Roughness"], coat_normal))
    if get["Alpha"] != 1.0:
        alpha = get["Alpha"]
        if material.blend_method == "CLIP":
            alpha = tree.math("GREATER_THAN", alpha, material.alpha_threshold)
        surface = tree.mix(alpha, tree.add("BsdfTransparent").outputs["BSDF"], surface)
    target = output.inputs["Surface"]
    if target.links[0].from_node.type == "ADD_SHADER":  # a sheen, which stays as the importer has it
        target = target.links[0].from_node.inputs[1]
    tree.set(target, surface)
    return absorption is not None


def absorb_as_gltf(absorption):
    """From (1 - c) / d per length to -ln(c) / d. Cycles absorbs (1 - colour) density."""
    colour, density = value_of(absorption.inputs["Color"])[:3], value_of(absorption.inputs["Density"])
    wanted = [-math.log(max(c, 1e-6)) * density for c in colour]
    most = max(max(wanted), 1e-6)
    absorption.inputs["Density"].default_value = most
    absorption.inputs["Color"].default_value = [1.0 - w / most for w in wanted] + [1.0]
