"""Roads made by `export opendrive`, and drawings by `export dxf`: each is read back, and judged by others' programs.

    python tests/opendrive.py PROGRAM FOLDER
"""

import json
import math
import os
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import ezdxf
import numpy as np
from scipy.integrate import quad

program, folder = sys.argv[1], Path(sys.argv[2])
tools = Path(sys.executable).parent

ENDS = ("--from 0,0 --to 200,0 --start-direction=-40deg --end-direction 80deg "
        "--start-curvature 0.004 --end-curvature 0.04")
FAR = ENDS.replace("0,0", "500000,5200000", 1).replace("200,0", "500200,5200000")


def run(*arguments, stdin=None, status=0):
    done = subprocess.run([program, *arguments], input=stdin, capture_output=True, text=True)
    assert done.returncode == status, (arguments, done.returncode, done.stderr)
    return done.stdout, done.stderr


def curve(kind, options):
    return run("curve", kind, *options.split(), "--json")[0]


LINE_ARC = json.dumps({"paths": [
    {"pieces": [
        {"kind": "line", "start": [10, -5], "end": [40, 35]},
        {"kind": "arc", "start": [40, 35], "direction": math.atan2(4, 3), "curvature": 0.02, "length": 40},
    ]},
    {"pieces": [{"kind": "arc", "start": [0, 0], "direction": 3, "curvature": -0.005, "length": 300}]},
]})
CASES = {
    "line-arc": LINE_ARC,
    "cubic": curve("cubic", ENDS),
    "cubic-far": curve("cubic", FAR),
    "ph-quintic": curve("ph-quintic", ENDS),
    "ph-quintic-far": curve("ph-quintic", FAR),
    "spline": run("path", "spline", "examples/lap.json")[0],
    "clothoid": run("join", *"--from 0,0,0 --to 180,150,100deg,0.01 --greatest-curvature 0.0166 --family clothoid "
                            "--objective greatest-rate --longest 400".split())[0],
}


class Geometry:
    """One `geometry` element, as the standard says."""

    def __init__(self, element):
        names = ("s", "x", "y", "hdg", "length")
        self.s, self.x, self.y, self.hdg, self.length = (float(element.get(name)) for name in names)
        (self.shape,) = element
        get = lambda names: np.array([float(self.shape.get(n)) for n in names])
        if self.shape.tag == "paramPoly3":
            assert self.shape.get("pRange") == "normalized"
            self.u, self.v = get(["aU", "bU", "cU", "dU"]), get(["aV", "bV", "cV", "dV"])
            assert self.u[0] == self.v[0] == self.v[1] == 0 < self.u[1]

    def at(self, p):
        """Point, heading and curvature at the share p of the parameter."""
        if self.shape.tag == "paramPoly3":
            powers, first = np.array([1, p, p * p, p**3]), np.array([0, 1, 2 * p, 3 * p * p])
            second = np.array([0, 0, 2, 6 * p])
            local, d = (self.u @ powers, self.v @ powers), (self.u @ first, self.v @ first)
            dd = (self.u @ second, self.v @ second)
            turn, kappa = math.atan2(d[1], d[0]), (d[0] * dd[1] - d[1] * dd[0]) / math.hypot(*d) ** 3
        elif self.shape.tag == "spiral":
            first, last = (float(self.shape.get(name)) for name in ("curvStart", "curvEnd"))
            kappa = first + p * (last - first)
            s = p * self.length
            turn = lambda x: x * (first + 0.5 * x * (last - first) / self.length)
            local = [quad(lambda x, f=f: f(turn(x)), 0, s, epsabs=1e-12, epsrel=1e-12)[0] for f in (math.cos, math.sin)]
            turn = turn(s)
        else:
            kappa = float(self.shape.get("curvature", 0))
            s = p * self.length
            turn = kappa * s
            local = (s, 0) if kappa == 0 else (math.sin(turn) / kappa, (1 - math.cos(turn)) / kappa)
        c, s = math.cos(self.hdg), math.sin(self.hdg)
        x, y = self.x + c * local[0] - s * local[1], self.y + s * local[0] + c * local[1]
        return np.array([x, y]), self.hdg + turn, kappa

    def measured(self):
        if self.shape.tag != "paramPoly3":
            return self.length
        speed = lambda p: math.hypot(self.u @ [0, 1, 2 * p, 3 * p * p], self.v @ [0, 1, 2 * p, 3 * p * p])
        return quad(speed, 0, 1, epsabs=1e-12, epsrel=1e-12)[0]


def bezier(points, t):
    points = np.array(points)
    while len(points) > 1:
        points = points[:-1] + t * (points[1:] - points[:-1])
    return points[0]


def check(name, text, path, tolerance):
    """Joints, lengths, and the distance from the curves that were asked for."""
    worst_joint = worst_heading = worst_curvature = worst_distance = 0.0
    roads = ElementTree.parse(path).getroot().findall("road")
    wanted = json.loads(text)["paths"]
    assert len(roads) == len(wanted)
    for road, asked in zip(roads, wanted):
        geometries = [Geometry(element) for element in road.find("planView")]
        station = 0.0
        for before, g in zip([None, *geometries], geometries):
            assert abs(g.s - station) <= 1e-9 * (1 + station), (name, g.s)
            assert abs(g.length - g.measured()) <= 1e-9 * g.length, (name, g.s)
            station += g.length
            if before:
                (p, h, k), (q, i, m) = before.at(1), g.at(0)
                worst_joint = max(worst_joint, np.hypot(*(p - q)))
                worst_heading = max(worst_heading, abs(math.remainder(h - i, math.tau)))
                worst_curvature = max(worst_curvature, abs(k - m))
        assert abs(station - float(road.get("length"))) <= 1e-9 * station
        rest = iter(geometries)
        for piece in asked["pieces"]:
            if piece["kind"] in ("line", "arc", "clothoid"):
                whole = math.dist(piece["start"], piece["end"]) if piece["kind"] == "line" else piece["length"]
                found = next(rest)
                assert abs(found.length - whole) < 1e-9
                assert (found.shape.tag == "spiral") == (piece["kind"] == "clothoid")
                worst_distance = max(worst_distance, *(
                    np.hypot(*(found.at(p)[0] - piece[end])) for p, end in ((0, "start"), (1, "end")) if end in piece))
                continue
            # A cubic is one geometry; the parts of a quintic are equally long in its parameter.
            parts = [next(rest)]
            end = np.array(piece["control_points"][-1])
            while piece["kind"] == "ph-quintic" and np.hypot(*(parts[-1].at(1)[0] - end)) > 2 * tolerance:
                parts.append(next(rest))
            for i, part in enumerate(parts):
                for p in np.linspace(0, 1, 21):
                    true = bezier(piece["control_points"], (i + p) / len(parts))
                    worst_distance = max(worst_distance, np.hypot(*(part.at(p)[0] - true)))
        assert next(rest, None) is None, name
    return worst_joint, worst_heading, worst_curvature, worst_distance


def judged(path):
    """By the ASAM quality checker and netconvert."""
    config, result = path.with_suffix(".config.xml"), path.with_suffix(".xqar")
    config.write_text(
        f'<?xml version="1.0" encoding="UTF-8"?><Config><Param name="InputFile" value="{path}"/>'
        f'<CheckerBundle application="xodrBundle"><Param name="resultFile" value="{result}"/></CheckerBundle></Config>'
    )
    subprocess.run([tools / "qc_opendrive", "-c", config], check=True, capture_output=True)
    root = ElementTree.parse(result).getroot()
    checkers = [c.get("status") for c in root.iter("Checker")]
    issues = [issue.attrib for issue in root.iter("Issue")]
    network = path.with_suffix(".net.xml")
    made = subprocess.run(
        [tools / "netconvert", "--opendrive-files", path, "-o", network], capture_output=True, text=True, check=True
    )
    assert "Success" in made.stdout + made.stderr and "Error" not in made.stderr, made.stderr
    assert checkers.count("completed") >= 20 and "error" not in checkers and not issues, (path, checkers, issues)
    return checkers.count("completed"), len(ElementTree.parse(network).getroot().findall("edge"))


def drawing(name, text):
    """The same paths in DXF, read by ezdxf: control points and ends of arcs are those of the JSON."""
    path = folder / f"{name}.dxf"
    run("export", "dxf", "-", "--out", str(path), stdin=text)
    document = ezdxf.readfile(path)
    assert not document.audit().errors, name
    entities = list(document.modelspace())
    pieces = [(i, piece) for i, asked in enumerate(json.loads(text)["paths"]) for piece in asked["pieces"]]
    assert len(entities) == len(pieces)
    worst = 0.0
    for entity, (i, piece) in zip(entities, pieces):
        assert entity.dxf.layer == f"PATH_{i + 1}"
        if entity.dxftype() == "SPLINE":
            n = len(piece["control_points"])
            assert entity.dxf.degree == n - 1 and list(entity.knots) == [0] * n + [1] * n
            found, true = np.array(entity.control_points)[:, :2], np.array(piece["control_points"])
        elif entity.dxftype() == "LINE":
            found, true = np.array([entity.dxf.start, entity.dxf.end])[:, :2], np.array([piece["start"], piece["end"]])
        else:
            found = np.array([entity.start_point, entity.end_point])[:, :2]
            k, turn = piece["curvature"], piece["curvature"] * piece["length"]
            if k < 0:
                found = found[::-1]
            heading = piece.get("start_direction", piece.get("direction"))
            normal = np.array([-math.sin(heading), math.cos(heading)])
            along = np.array([normal[1], -normal[0]])
            end = np.array(piece["start"]) + (math.sin(turn) * along + (1 - math.cos(turn)) * normal) / k
            true = np.array([piece["start"], end])
        worst = max(worst, np.abs(found - true).max() / max(1, np.abs(true).max()))
    assert worst < 2e-12, (name, worst)
    first = path.read_bytes()
    environment = dict(os.environ, TZ="Asia/Tokyo")
    subprocess.run([program, "export", "dxf", "-", "--out", path], input=text, text=True, check=True, env=environment)
    assert path.read_bytes() == first, f"{name}: other bytes in another time zone"
    print(f"{name:16} in DXF: {len(entities)} entities, {worst:.1e} of the size")


def main():
    for name, text in CASES.items():
        path = folder / f"{name}.xodr"
        _, note = run("export", "opendrive", "-", "--out", str(path), stdin=text)
        # Far from the origin a coordinate of 5,200,000 m has a rounding of 1e-9 m.
        place = 4e-9 if "far" in name else 1e-10
        joint, heading, curvature, distance = check(name, text, path, 0.001)
        fitted = "PH quintic" in note
        assert fitted == ("quintic" in name or name == "spline")
        assert joint <= place and heading <= 1e-9, (name, joint, heading)
        assert distance <= (0.001 if fitted else 0) + place, (name, distance)
        told = float(note.rsplit("at most ", 1)[1].split()[0]) if fitted else 0.02
        assert curvature <= 2.1 * told, (name, curvature, told)
        checks, edges = judged(path)
        assert edges >= 1
        print(f"{name:16} joints {joint:.1e} m, {heading:.1e} rad, {curvature:.1e} / m; "
              f"distance {distance:.1e} m; {checks} checks")
    for name, text in CASES.items():
        if name != "clothoid":
            drawing(name, text)
    refused = run("export", "dxf", "-", "--out", str(folder / "none.dxf"), stdin=CASES["clothoid"], status=2)[1]
    assert "clothoid" in refused, refused
    tight = run("export", "opendrive", "-", "--tolerance", "1e-9", stdin=CASES["ph-quintic"])[1]
    assert float(tight.rsplit("at most ", 1)[1].split()[0]) < 1e-6, tight
    broken = (folder / "cubic.xodr").read_text().replace('length="229', 'length="228')
    (folder / "broken.xodr").write_text(broken)
    try:
        check("broken", CASES["cubic"], folder / "broken.xodr", 0.001)
    except AssertionError:
        print("a wrong length is seen")
    else:
        sys.exit("the check cannot fail")
    far_arc = {"kind": "arc", "start": [0, 0], "direction": 0, "curvature": 1e-10, "length": 1}
    for piece, words in [(far_arc, "radius"), ({"kind": "line", "start": [0, 0], "end": [1e-6, 0]}, "length"),
                         ({"kind": "line", "start": [0, 0], "end": [1e10, 0]}, "beyond 1e9")]:
        text = json.dumps({"paths": [{"pieces": [piece]}]})
        _, wrong = run("export", "dxf", "-", "--out", str(folder / "none.dxf"), stdin=text, status=2)
        assert words in wrong and "paths[0].pieces[0]" in wrong and not (folder / "none.dxf").exists(), wrong
    involute = curve("involute", ENDS)
    assert "involute" in run("export", "dxf", "-", "--out", str(folder / "none.dxf"), stdin=involute, status=2)[1]


main()
