#!/usr/bin/env python3
# loading.py [--duolux DUOLUX] [MODEL...]: seconds from the start of `duolux render` to the first sample, for models and
# for a glTF file with 100 images of 2048x2048, made here in a temporary folder (700 MB). Prints a Markdown table:
# medians of three runs, with the files and the driver's kernels in caches.
import argparse
import json
import os
import random
import statistics
import subprocess
import sys
import tempfile

from gltf_files import Gltf, png_of_rows

RUNS = 3
STAGES = ("load", "build", "upload", "pipeline", "first_dispatch")
IMAGES, SIDE = 100, 2048
DIFFERENT = 4  # images that differ; the files are copies under other names


def write_many_images(folder):
    """The path of a glTF file of spheres, each with its own image."""
    numbers = random.Random(1)
    few = bytes(160 + (i & 7) * (i >> 6) for i in range(256))  # noise that PNG compresses to about a third
    images = [png_of_rows(SIDE, SIDE, 3, b"".join(b"\0" + numbers.randbytes(3 * SIDE).translate(few) for _ in range(SIDE)),
                          level=1) for _ in range(DIFFERENT)]
    gltf = Gltf()
    gltf.add_camera(40.0, (0.0, 0.0, 16.0), (0.0, 0.0, 0.0))
    gltf.add_node(mesh=gltf.add_rectangle(gltf.add_lamp(5.0), 5.0), translation=[0.0, 8.0, 0.0])
    for i in range(IMAGES):
        name = f"image{i}.png"
        with open(os.path.join(folder, name), "wb") as file:
            file.write(images[i % DIFFERENT])
        texture = gltf.add("textures", {"source": gltf.add("images", {"uri": name})})
        material = gltf.add_material({"pbrMetallicRoughness": {"baseColorTexture": {"index": texture}}})
        gltf.add_node(mesh=gltf.add_sphere(material, stacks=8), translation=[i % 10 - 4.5, i // 10 - 4.5, 0.0],
                      scale=[0.45] * 3)
    path = os.path.join(folder, "images.gltf")
    gltf.write(path)
    return path


def size_of(scene):
    """Bytes of the file, or of the folder of a .gltf, whose other files it may use."""
    if not scene.endswith(".gltf"):
        return os.path.getsize(scene)
    folder = os.path.dirname(os.path.abspath(scene))
    return sum(os.path.getsize(os.path.join(folder, name)) for name in os.listdir(folder))


def measure(duolux, scene, folder):
    """Medians of each stage and of their sum."""
    report, runs = os.path.join(folder, "report.json"), []
    for _ in range(RUNS + 1):
        result = subprocess.run([duolux, "render", scene, "--spp", "1", "--size", "64x64", "--quiet", "--report", report,
                                 "-o", os.path.join(folder, "out.exr")], capture_output=True, text=True)
        if result.returncode != 0:
            sys.exit(f"loading.py: {result.stderr.strip()}")
        with open(report) as file:
            seconds = json.load(file)["seconds"]
        runs.append([seconds[stage] for stage in STAGES])
    runs = runs[1:]  # the first fills the caches
    return [statistics.median(column) for column in zip(*runs)] + [statistics.median(map(sum, runs))]


def main():
    parser = argparse.ArgumentParser(description="Measures the time from the start to the first sample.")
    parser.add_argument("--duolux", default="build/duolux", help="the program (build/duolux)")
    parser.add_argument("models", nargs="*", metavar="MODEL")
    arguments = parser.parse_args()
    print("| scene | MB | " + " | ".join(f"{stage}, s".replace("_", " ") for stage in STAGES) + " | sum, s |")
    print("|---" * (len(STAGES) + 3) + "|")
    with tempfile.TemporaryDirectory() as folder:
        for scene in [*arguments.models, write_many_images(folder)]:
            seconds = measure(os.path.abspath(arguments.duolux), scene, folder)
            print(f"| {os.path.basename(scene)} | {size_of(scene) / 1e6:.1f} | " +
                  " | ".join(f"{s:.2f}" for s in seconds) + " |", flush=True)


if __name__ == "__main__":
    main()
