#!/usr/bin/env python3
# materials.py: compares Duolux with Blender's Cycles for the materials of glTF; prints Markdown tables. Both programs
# read the same files, made here: a sphere of the material on a floor under a lamp of two triangles, and alone inside
# a large white sphere that emits. Needs Debian's blender and python3-numpy; takes about 20 minutes on two cores.
import argparse
import array
import json
import os
import platform
import shutil
import subprocess
import sys
import tempfile

from lit_model import light_model
from sphere_materials import MATERIALS, write_scene

HERE = os.path.dirname(os.path.abspath(__file__))
SIZE, BOUNCES = 128, 16
SEEDS = (1, 2)  # two renders each: their difference shows the noise
LIGHTS = {"lamp": "On a floor under a lamp of two triangles", "sphere": "Inside a white sphere that emits 1"}


def fail(message):
    sys.exit(f"materials.py: {message}")


def run(*command):
    # Blender takes its Python library from beside the first python3 of PATH; it needs Debian's.
    result = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "PATH": "/usr/bin:/bin"})
    if result.returncode != 0:
        fail(f"{command[0]} failed:\n{(result.stdout + result.stderr)[-2000:].strip()}")
    return result.stdout


class Pictures:
    """Renders into a folder and measures."""

    def __init__(self, duolux, folder, spp):
        self.duolux, self.folder, self.spp = duolux, folder, spp
        self.black = self.write_pfm("black.pfm", lambda x, y: 0.0)
        # Pixels that show nothing but the sphere, see sphere_materials.py.
        reach = 0.97 * 0.5 * SIZE * 0.2582 / 0.3640
        centre = (SIZE - 1) / 2.0
        inside = lambda x, y: (x - centre) ** 2 + (y - centre) ** 2 < reach * reach
        self.mask = self.write_pfm("mask.pfm", lambda x, y: 1.0 if inside(x, y) else 0.0)

    def path(self, *names):
        return os.path.join(self.folder, "-".join(names))

    def write_pfm(self, name, value):
        path = self.path(name)
        with open(path, "wb") as file:
            file.write(b"Pf\n%d %d\n-1.0\n" % (SIZE, SIZE))
            array.array("f", (value(x, y) for y in range(SIZE) for x in range(SIZE))).tofile(file)
        return path

    def render(self, scenes):
        """Renders glTF files, name -> path, by both programs."""
        jobs = []
        for name, scene in scenes.items():
            for seed in SEEDS:
                run(self.duolux, "render", scene, "--preset", "global", "--no-lamp", "--bounces", str(BOUNCES), "--size",
                    f"{SIZE}x{SIZE}", "--spp", str(self.spp), "--seed", str(seed), "--quiet", "-o",
                    self.path(name, "duolux", f"{seed}.exr"))
            jobs += [{"scene": scene, "output": self.path(name, model, f"{seed}.exr"), "model": model, "size": SIZE,
                      "spp": self.spp, "seed": seed, "bounces": BOUNCES, "free": 0}
                     for model in ("importer", "gltf") for seed in SEEDS]
        with open(self.path("jobs.json"), "w") as file:
            json.dump(jobs, file)
        run("blender", "-b", "--factory-startup", "--python-exit-code", "1", "-P", os.path.join(HERE, "cycles_render.py"),
            "--", self.path("jobs.json"))

    def compare(self, image, reference, mask):
        options = ["--mask", self.mask] if mask else []
        return json.loads(run(self.duolux, "compare", "--json", *options, image, reference))

    def mean(self, name, program, mask):
        """The mean radiance of pixels and channels, and its standard error."""
        images = [self.path(name, program, f"{seed}.exr") for seed in SEEDS]
        means = [self.compare(image, self.black, mask)["signed_mean"] for image in images]
        difference = self.compare(*images, mask)
        return sum(means) / 2.0, difference["rmse"] / 2.0 / difference["pixels"] ** 0.5


def cells(ours, theirs):
    """Duolux relative to Cycles, in percent."""
    (a, da), (b, db) = ours, theirs
    if b == 0.0:
        return "-"
    return f"{100.0 * (a / b - 1.0):+.2f} ± {100.0 * (da * da + db * db) ** 0.5 / b:.2f}"


def print_table(pictures, names, masked):
    parts = [(True, "sphere"), (False, "picture")] if masked else [(False, "picture")]
    columns = [f"{part}: {what}" for _, part in parts for what in ("Duolux", "importer, %", "glTF's model, %")]
    print("| material | " + " | ".join(columns) + " |")
    print("|---" * (1 + len(columns)) + "|")
    for name, label in names.items():
        row = []
        for mask, _ in parts:
            ours = pictures.mean(name, "duolux", mask)
            row += [f"{ours[0]:.4f}"] + [cells(ours, pictures.mean(name, model, mask)) for model in ("importer", "gltf")]
        print(f"| {label} | " + " | ".join(row) + " |")


def processor():
    with open("/proc/cpuinfo") as file:
        model = next((line.split(":")[1].strip() for line in file if line.startswith("model name")), platform.machine())
    return f"{os.cpu_count()} cores, {model}"


def main():
    parser = argparse.ArgumentParser(description="Compares Duolux with Blender's Cycles for the materials of glTF.")
    parser.add_argument("--duolux", default="build/duolux", help="the program (build/duolux)")
    parser.add_argument("--spp", type=int, default=256, help="samples per pixel of each of two renders (256)")
    parser.add_argument("--only", default="", help="only materials whose name contains this")
    parser.add_argument("--no-materials", action="store_true", help="only models")
    parser.add_argument("--model", action="append", default=[], metavar="FILE.gltf",
                        help="also a model, lit by lit_model.py; may be given several times")
    parser.add_argument("--keep", metavar="FOLDER", help="keep scenes and pictures here")
    arguments = parser.parse_args()
    if not shutil.which("blender"):
        fail("blender not found: apt-get install --no-install-recommends blender python3-numpy")
    duolux = os.path.abspath(arguments.duolux)
    if not os.access(duolux, os.X_OK):
        fail(f"{arguments.duolux} not found: ./quickstart builds it")

    with tempfile.TemporaryDirectory() as temporary:
        folder = arguments.keep or temporary
        os.makedirs(folder, exist_ok=True)
        pictures = Pictures(duolux, folder, arguments.spp)
        print(f"{processor()}; {run(duolux, '--version').strip()}; {run('blender', '--version').splitlines()[0]}; "
              f"{SIZE}x{SIZE} pixels, two renders of {arguments.spp} spp each")
        chosen = [name for name in MATERIALS if arguments.only in name and not arguments.no_materials]
        for light, title in LIGHTS.items():
            scenes = {f"{name} {light}".replace(" ", "_"): name for name in chosen}
            for file, name in scenes.items():
                write_scene(pictures.path(file + ".gltf"), name, light)
            if scenes:
                pictures.render({file: pictures.path(file + ".gltf") for file in scenes})
                print(f"\n### {title}\n")
                print_table(pictures, scenes, masked=True)
        if arguments.model:
            models = {os.path.splitext(os.path.basename(model))[0]: light_model(model, folder, duolux)
                      for model in arguments.model}
            pictures.render(models)
            print("\n### Models\n")
            print_table(pictures, {name: name for name in models}, masked=False)


if __name__ == "__main__":
    main()
