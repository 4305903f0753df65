"""clrt, Mitsuba 3 and Cycles behind one call: render(spp, seed, out) gives the seconds that it took.

Where seconds do not matter, timed=False spares what is done for them alone. Each render is a process of its own.
`render_s` are the seconds of rendering alone: those of clrt's stage `trace`, of Mitsuba's second call of mi.render (the
first compiles), of Cycles without its synchronization. `cpu_s` are those of all cores together, which other work on
the machine disturbs less: of the whole process for clrt, of the second render for Mitsuba, of Cycles with its
synchronization. `wall_s` is all of the process, for Mitsuba without the second render.
"""
import array
import json
import os
import re
import resource
import shutil
import subprocess
import time

import images

HERE = os.path.dirname(os.path.abspath(__file__))


class RenderError(Exception):
    pass


def run(command, what):
    """Standard output, standard error and the wall seconds."""
    start = time.perf_counter()
    child = subprocess.run(command, capture_output=True, text=True, errors="replace")
    seconds = time.perf_counter() - start
    if child.returncode != 0:
        raise RenderError(f"{what}: exit status {child.returncode}: {child.stderr.strip()[-600:]}")
    return child.stdout, child.stderr, seconds


def last_object(text, what):
    for line in reversed(text.splitlines()):
        at = line.find('{"version"')  # behind the colours of a warning
        if at >= 0:
            return json.loads(line[at:])
    raise RenderError(f"{what}: it has not said how long it took")


def write_json(path, value):
    with open(path, "w", encoding="utf-8") as file:
        json.dump(value, file)
    return path


class Clrt:
    def __init__(self, program, path, scene, folder, options=()):
        self.name, self.program, self.path = "clrt", program, path
        self.scene, self.folder, self.options = scene, folder, list(options)
        self.version = None

    def missing(self):
        if not shutil.which(self.program):
            return f"no program {self.program}"
        child = subprocess.run([self.program, "--check", self.path], capture_output=True, text=True)
        return None if child.returncode == 0 else child.stderr.strip() or "clrt --check fails"

    def render(self, spp, seed, out, timed=True, extra=()):
        stats = os.path.join(self.folder, "clrt.json")
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        _, _, wall = run([self.program, "-q", "--samples", str(spp), "--seed", str(seed), "--stats=" + stats,
                          *self.options, *extra, self.path, out], self.name)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        with open(stats, encoding="utf-8") as file:
            said = json.load(file)
        self.version = said["run"]["clrt_version"]
        return {"render_s": said["seconds"]["trace"], "wall_s": wall, "cpu_s": cpu}


class Mitsuba:
    """models: "own" is Mitsuba's principled, "clrt" a BSDF with clrt's formulas."""

    def __init__(self, python, variant, models, scene, folder, sampler="multijitter", exact_sky=False):
        self.name = f"Mitsuba 3 {variant.split('_')[0]}" + ("" if models == "own" else ", clrt's pbr")
        self.python, self.variant, self.models, self.sampler = python, variant, models, sampler
        self.scene, self.folder, self.exact_sky = scene, folder, exact_sky
        self.sky = None
        self.version = None

    def missing(self):
        try:
            child = subprocess.run([self.python, "-c", f"import mitsuba as mi; mi.set_variant('{self.variant}'); "
                                    "mi.load_dict({'type': 'sphere'})"], capture_output=True, text=True)
        except OSError as problem:
            return str(problem)
        return None if child.returncode == 0 else child.stderr.strip().splitlines()[-1]

    def prepared_sky(self):
        """Mitsuba's map has +z in its middle, and rows from pole to pole where clrt's have theirs at half-integers."""
        if not self.scene["environment"] or self.sky:
            return self.sky
        given = images.read_hdr(self.scene["environment"]["file"])
        half = 3 * (given.width // 2)
        rows = [row[half:] + row[:half] for row in given.rows()]
        if self.exact_sky:  # a row on each of clrt's and one between two: the same function of the direction
            between = [array.array("f", ((a + b) / 2 for a, b in zip(*pair))) for pair in zip(rows, rows[1:])]
            rows = [rows[0]] + [row for pair in zip(rows, between) for row in pair] + [rows[-1], rows[-1]]
        values = array.array("f", b"".join(row.tobytes() for row in rows))
        self.sky = os.path.join(self.folder, f"sky_{len(rows)}.pfm")
        images.write_pfm(self.sky, images.Image(given.width, len(rows), values))
        return self.sky

    def render(self, spp, seed, out, timed=True):
        # Nothing of the scalar variants is compiled: their first render is as good as a second.
        warm = 1 if timed and not self.variant.startswith("scalar") else 0
        job = {"scene": self.scene, "variant": self.variant, "models": self.models, "sampler": self.sampler, "spp": spp,
               "seed": seed, "environment": self.prepared_sky(), "out": out, "warm": warm}
        path = write_json(os.path.join(self.folder, "mitsuba_job.json"), job)
        said, _, wall = run([self.python, os.path.join(HERE, "mitsuba_render.py"), path], self.name)
        told = last_object(said, self.name)
        self.version = told["version"]
        return {"render_s": told["seconds"][-1], "wall_s": wall - sum(told["seconds"][1:]),
                "cpu_s": told["cpu_s"]}


class Cycles:
    def __init__(self, program, scene, folder):
        self.name, self.program, self.scene, self.folder = "Blender Cycles", program, scene, folder
        self.version = None

    def missing(self):
        if not shutil.which(self.program):
            return f"no program {self.program}"
        return None if os.name == "posix" else "not tried on this system"

    def render(self, spp, seed, out, timed=True):
        environment = self.scene["environment"]
        job = {"scene": self.scene, "spp": spp, "seed": seed, "environment": environment and environment["file"],
               "out": out, "exr": os.path.join(self.folder, "cycles.exr")}
        path = write_json(os.path.join(self.folder, "cycles_job.json"), job)
        said, log, wall = run([self.program, "-b", "--factory-startup", "--debug-cycles", "--python-exit-code", "3",
                               "--python", os.path.join(HERE, "cycles_render.py"), "--", path], self.name)
        told = last_object(said, self.name)
        self.version = told["version"]
        # A Blender that keeps no log tells only the time with synchronization.
        found = re.search(r"Render time \(without synchronization\): ([0-9.]+)", log + said)
        return {"render_s": float(found.group(1)) if found else told["operator_seconds"], "wall_s": wall,
                "cpu_s": told["cpu_s"]}
