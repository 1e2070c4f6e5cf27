# sphere_materials.py: glTF files of a sphere, one for each kind of material, for materials.py.
import math

from gltf_files import NO_REFLECTION, Gltf, png

IMAGE = 256  # pixels of each side


def colours(u, v):
    light = 0.35 if (int(8 * u) + int(8 * v)) % 2 else 0.9
    return light, light * (0.5 + 0.5 * u), light * v


def holes(u, v):
    return *colours(u, v), 0.5 + 0.5 * math.sin(16.0 * math.pi * u) * math.sin(8.0 * math.pi * v)


def rough_metal_checks(u, v):
    """Roughness in green, metal in blue."""
    return 1.0, 0.2 + 0.6 * v, 1.0 if (int(16 * u) + int(8 * v)) % 2 else 0.0


def ridges(u, v):
    """Normals that lean up the image on average, so that a wrong sign shows in the mean."""
    x, y, z = 0.4 * math.sin(32.0 * math.pi * u), 0.35 + 0.3 * math.cos(24.0 * math.pi * v), 1.0
    length = math.sqrt(x * x + y * y + z * z)
    return tuple(0.5 + 0.5 * n / length for n in (x, y, z))


def surface(colour, metallic, roughness, extensions=None, base=None, **rest):
    """`base`: what pbrMetallicRoughness has besides. A function in place of a texture becomes an image."""
    pbr = {"baseColorFactor": [*colour, 1.0], "metallicFactor": metallic, "roughnessFactor": roughness, **(base or {})}
    return {"name": "surface", "pbrMetallicRoughness": pbr,
            "extensions": {f"KHR_materials_{name}": value for name, value in (extensions or {}).items()}, **rest}


GOLD, RED, GREY, WHITE = (0.9, 0.6, 0.3), (0.6, 0.1, 0.1), (0.8, 0.8, 0.8), (1.0, 1.0, 1.0)
GLASS = {"transmission": {"transmissionFactor": 1.0}, "volume": {"thicknessFactor": 1.0}}
TINTED = {**GLASS, "volume": {"thicknessFactor": 1.0, "attenuationColor": [0.3, 0.6, 0.9], "attenuationDistance": 1.0}}
THIN = {"transmission": {"transmissionFactor": 1.0}}
ROUGHNESSES = (0.0, 0.1, 0.3, 0.6, 1.0)


def coat(roughness):
    return {"clearcoat": {"clearcoatFactor": 1.0, "clearcoatRoughnessFactor": roughness}}


MATERIALS = {
    "diffuse": surface(GREY, 0.0, 1.0, {"specular": NO_REFLECTION}),
    **{f"metal, roughness {r}": surface(GOLD, 1.0, r) for r in ROUGHNESSES},
    **{f"dielectric, roughness {r}": surface(GREY, 0.0, r) for r in ROUGHNESSES},
    **{f"black dielectric, roughness {r}": surface((0.0, 0.0, 0.0), 0.0, r) for r in ROUGHNESSES},
    "textured metal": surface(WHITE, 1.0, 0.3, base={"baseColorTexture": colours}),
    "textured dielectric": surface(WHITE, 0.0, 0.5, base={"baseColorTexture": colours}),
    "textured roughness and metal": surface(GOLD, 1.0, 1.0, base={"metallicRoughnessTexture": rough_metal_checks}),
    "normal-mapped metal": surface(GOLD, 1.0, 0.3, normalTexture=ridges),
    "normal-mapped dielectric": surface(GREY, 0.0, 0.6, normalTexture=ridges),
    "alpha mask": surface(WHITE, 1.0, 0.3, base={"baseColorTexture": holes}, alphaMode="MASK", alphaCutoff=0.4,
                          doubleSided=True),
    "alpha blend": surface(WHITE, 1.0, 0.3, base={"baseColorTexture": holes}, alphaMode="BLEND", doubleSided=True),
    "glass": surface(WHITE, 0.0, 0.0, GLASS),
    "rough glass": surface(WHITE, 0.0, 0.3, GLASS),
    "absorbing glass": surface(WHITE, 0.0, 0.0, TINTED),
    "thin glass": surface(GOLD, 0.0, 0.0, THIN),
    "clearcoat, roughness 0": surface(RED, 1.0, 0.3, coat(0.0)),
    "clearcoat, roughness 0.3": surface(RED, 1.0, 0.3, coat(0.3)),
    "sheen": surface((0.2, 0.2, 0.2), 0.0, 1.0, {"sheen": {"sheenColorFactor": [0.8, 0.8, 0.8],
                                                           "sheenRoughnessFactor": 0.5}}),
}


def with_images(gltf, value):
    """The material, its functions replaced by images."""
    if callable(value):
        return gltf.add_image(png(IMAGE, IMAGE, value))
    if isinstance(value, dict):
        return {key: with_images(gltf, item) for key, item in value.items()}
    return value


def write_scene(path, name, light):
    """`light`: "lamp" or "sphere". The sphere has the radius 1, and the camera is at the distance 4 of its centre, so
    that it covers a disk of the tangent 0.2582 (of asin(1/4)) in the middle of an image of half height 0.3640."""
    gltf = Gltf()
    gltf.add_camera(40.0, (0.0, 0.8, 15.36**0.5), (0.0, 0.0, 0.0))
    gltf.add_node(mesh=gltf.add_sphere(gltf.add_material(with_images(gltf, MATERIALS[name]))))
    if light == "sphere":
        gltf.add_node(mesh=gltf.add_sphere(gltf.add_lamp(1.0), stacks=16), scale=[20.0, 20.0, 20.0])
    else:
        gltf.add_node(mesh=gltf.add_rectangle(gltf.add_lamp(5.0), 2.0), translation=[0.0, 4.0, 0.0])
        floor = surface((0.5, 0.5, 0.5), 0.0, 1.0, {"specular": NO_REFLECTION})
        gltf.add_node(mesh=gltf.add_rectangle(gltf.add_material({**floor, "name": "floor"}), 6.0), translation=[0.0, -1.0, 0.0])
    gltf.write(path)
