#!/usr/bin/env python3
"""Scenes and grasps with numbers, lines and characters changed at random, through press: strange_scenes.py BIN_DIR SOURCE_DIR GEL FOLDER COUNT FIRST
Mutation i is the same in every run. press must end by itself within 60 s of processor time with 0, 1 or 2; with a message of a few lines and no
record unless it is 0; and with no number in its record that is not finite."""
import os
import random
import re
import resource
import shutil
import subprocess
import sys

MOST_CPU_S = 60 * int(os.environ.get("TACIPC_SLOWER", "1"))  # of sanitizers
bin_dir, source, gel, folder = sys.argv[1:5]
count, first = int(sys.argv[5]), int(sys.argv[6])
scenes = os.path.join(source, "configs/scenes")
GRASP = """fingers: {}
object: {mass_g: 5}
motion:
  - {kind: close, force_n: 0.3, steps: 1}
  - {kind: lift, distance_mm: 0.1, steps: 1}
  - {kind: hold, steps: 1}
  - {kind: release, distance_mm: 0.5, steps: 1}
"""


def short(name):
    with open(os.path.join(scenes, name), encoding="utf-8") as file:
        text = file.read().replace("meshes/", os.path.join(scenes, "meshes/"))
    return re.sub(r"steps: \d+", "steps: 2", text)


BASES = [("scene", short("lift_block.yaml")), ("scene", short("peg_in_hole.yaml")), ("grasp", GRASP)]
NUMBER = re.compile(r"(?<![\w./#])-?\d+(?:\.\d+)?(?:e-?\d+)?(?![\w/])")


def mutated(text, draw):
    for _ in range(draw.choice([1, 1, 1, 2, 3])):
        kind = draw.random()
        if kind < 0.8:
            place = draw.choice(list(NUMBER.finditer(text)))
            value = float(place.group())
            value = draw.choice([10 * value, 100 * value, 1e3 * value, 1e6 * value, 0.1 * value, 1e-3 * value, -value, value + 1, value + 0.1, 0,
                                 1e9, 1e4, -1e4, 1e-9, 9999, 1e300, float("nan")])
            text = text[:place.start()] + f"{value:g}" + text[place.end():]
        elif kind < 0.9:
            lines = text.split("\n")
            del lines[draw.randrange(len(lines))]
            text = "\n".join(lines)
        else:
            at = draw.randrange(len(text))
            text = text[:at] + draw.choice("{}[]:,-x 9\t") + text[at + 1:]
    return text


def limit():
    resource.setrlimit(resource.RLIMIT_CPU, (MOST_CPU_S, MOST_CPU_S + 1))


def fault_of(result, out):
    if result.returncode not in (0, 1, 2):
        return f"ended with {result.returncode}"
    if (result.returncode == 0) != os.path.exists(os.path.join(out, "press.yaml")):
        return f"ended with {result.returncode}, and the record is {'not ' if result.returncode == 0 else ''}there"
    if result.returncode:
        return "" if result.stderr.strip() else "no message"
    with open(os.path.join(out, "press.yaml"), encoding="utf-8") as record:
        wrong = re.search(r": -?\.?(?:nan|inf)\b.*", record.read())
    return f"a record with {wrong.group()}" if wrong else ""


codes, faults = {0: 0, 1: 0, 2: 0}, 0
for i in range(first, first + count):
    draw = random.Random(i)
    kind, base = draw.choice(BASES)
    text = mutated(base, draw)
    file, out = os.path.join(folder, f"{i}.yaml"), os.path.join(folder, f"out_{i}")
    with open(file, "w", encoding="utf-8") as yaml:
        yaml.write(text)
    objects = [] if kind == "scene" else ["--object", os.path.join(folder, "object/object.ply")]
    result = subprocess.run([os.path.join(bin_dir, "press"), "--name", "strange", "--gel", gel, "--sensor", os.path.join(source, "configs/sensors/mctac.yaml"),
                             "--config", os.path.join(source, "configs/press/default.yaml"), "--threads", "1", "--log-level", "warning", "--sample", file,
                             "--out", out, *objects], capture_output=True, text=True, errors="replace", preexec_fn=limit, check=False)
    fault = fault_of(result, out)
    if fault:
        faults += 1
        print(f"mutation {i}: {fault}\n{text}\n{result.stderr[-600:]}", flush=True)
    else:
        codes[result.returncode] += 1
        os.remove(file)
    shutil.rmtree(out, ignore_errors=True)
print(f"{count} scenes and grasps from {first} on: " + ", ".join(f"{n} ended with {code}" for code, n in codes.items()) + f", {faults} faults")
sys.exit(faults > 0)
