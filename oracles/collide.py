"""Distances of two triangle meshes by FCL -> crates/trueaxis/tests/data/fcl_distances.csv

usage: python3 oracles/collide.py          (pip install python-fcl numpy)
The meshes are made by the same formula as in crates/trueaxis/tests/collide.rs (`bumpy_ball`); FCL's BVH with
OBBRSS and exact triangle distance. 0 where they overlap (FCL's collide says so)."""
import os
import sys
from importlib.metadata import version

import fcl
import numpy as np

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
OUT = os.path.join(ROOT, "crates", "trueaxis", "tests", "data", "fcl_distances.csv")


def bumpy_ball(radius, rings, sectors, bumps, waves):
    def point(i, k):
        polar, around = np.pi * i / rings, 2 * np.pi * (k % sectors) / sectors
        size = radius * (1 + bumps * np.sin(waves * polar) * np.cos(3 * around))
        return size * np.array([np.sin(polar) * np.cos(around), np.sin(polar) * np.sin(around), np.cos(polar)])

    vertices, faces = [], []
    for i in range(rings):
        for k in range(sectors):
            a, b, c, d = point(i, k), point(i + 1, k), point(i + 1, k + 1), point(i, k + 1)
            for triangle in ([a, b, c], [a, c, d]):
                area = np.linalg.norm(np.cross(triangle[1] - triangle[0], triangle[2] - triangle[0]))
                if area > 1e-9:  # at the poles one of the two has none
                    faces.append([len(vertices) + j for j in range(3)])
                    vertices += triangle
    model = fcl.BVHModel()
    model.beginModel(len(vertices), len(faces))
    model.addSubModel(np.array(vertices), np.array(faces))
    model.endModel()
    return model


def rotation(axis, angle):
    axis = axis / np.linalg.norm(axis)
    k = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


def main():
    random = np.random.default_rng(6)
    rows = []
    for _ in range(60):
        radii = random.uniform(5, 60, 2).round(3)
        sizes = [int(v) for v in random.integers(6, 24, 4)]
        bumps = random.uniform(0, 0.3, 2).round(3)
        waves = random.uniform(1, 6, 2).round(3)
        axis, angle = random.normal(size=3).round(3), round(random.uniform(-3, 3), 3)
        way = random.normal(size=3)
        shift = (way / np.linalg.norm(way) * radii.sum() * random.uniform(0.8, 2.0)).round(3)
        first = fcl.CollisionObject(bumpy_ball(radii[0], sizes[0], sizes[1], bumps[0], waves[0]))
        second = fcl.CollisionObject(
            bumpy_ball(radii[1], sizes[2], sizes[3], bumps[1], waves[1]), fcl.Transform(rotation(axis, angle), shift)
        )
        result = fcl.DistanceResult()
        fcl.distance(first, second, fcl.DistanceRequest(), result)
        hit = fcl.collide(first, second, fcl.CollisionRequest(), fcl.CollisionResult())
        distance = 0.0 if hit else result.min_distance
        rows.append([*radii, *sizes, *bumps, *waves, *axis, angle, *shift, repr(float(distance))])
    head = (
        "radius_1,radius_2,rings_1,sectors_1,rings_2,sectors_2,bumps_1,bumps_2,waves_1,waves_2,"
        "axis_x,axis_y,axis_z,angle,shift_x,shift_y,shift_z,distance"
    )
    with open(OUT, "w") as f:
        f.write(f"# python-fcl {version('python-fcl')}, Python {sys.version.split()[0]}: python3 oracles/collide.py\n")
        f.write(head + "\n")
        f.writelines(",".join(map(str, row)) + "\n" for row in rows)


if __name__ == "__main__":
    main()
