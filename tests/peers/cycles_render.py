# cycles_render.py: renders scenes with Cycles, in Blender 3.4:
#     blender -b --factory-startup --python-exit-code 1 -P cycles_render.py -- JOBS.json
# JOBS.json: a list of objects:
#     scene, output     a diffuse JSON scene of Duolux, or a glTF file with a camera; an EXR
#     model             of a glTF file: "importer" (as Blender's importer has it) or "gltf" (gltf_model.py)
#     size, spp, seed   pixels of each side, samples per pixel, random numbers
#     bounces           scattering events on a path
#     free              bounces before Russian roulette may end a path, not counting the first scattering event
#                       (Cycles' min_light_bounces); 0 matches Duolux
import json
import os
import sys

import bpy
import numpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import duolux_json
import gltf_model


def load(file, model):
    """Replaces Blender's scene by that of the file."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    if file.endswith(".json"):
        duolux_json.load(file)
        return
    numpy.bool = bool  # Blender 3.4's importer uses a name that Debian 12's numpy no longer has
    bpy.ops.import_scene.gltf(filepath=file, loglevel=50)
    bpy.context.scene.camera = next(item for item in bpy.data.objects if item.type == "CAMERA")
    if model == "gltf":
        glass = [gltf_model.apply(material) for material in bpy.data.materials]
        # Light samples make rough glass with several scatterings too dark in Cycles 3.4.
        for material in bpy.data.materials:
            material.cycles.sample_as_light = not any(glass)


def render(job):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.render.resolution_x = scene.render.resolution_y = job["size"]
    scene.render.resolution_percentage = 100
    scene.render.use_compositing = scene.render.use_sequencer = False
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_mode = "RGB"
    scene.render.image_settings.color_depth = "32"
    scene.render.filepath = os.path.abspath(job["output"])
    scene.view_settings.view_transform = "Raw"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.samples, cycles.seed = job["spp"], job["seed"]
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    bounces = job["bounces"] - 1  # the first scattering event is not a bounce for Cycles
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = cycles.transmission_bounces = bounces
    cycles.transparent_max_bounces = 128
    cycles.min_light_bounces = job["free"]
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = 0.0
    cycles.pixel_filter_type = "BOX"  # one pixel wide
    if hasattr(cycles, "use_light_tree"):  # there is one emitter
        cycles.use_light_tree = False
    bpy.ops.render.render(write_still=True)


loaded = None
for job in json.load(open(sys.argv[sys.argv.index("--") + 1])):
    if loaded != (job["scene"], job.get("model")):
        loaded = job["scene"], job.get("model")
        load(os.path.abspath(job["scene"]), job.get("model"))
    render(job)
