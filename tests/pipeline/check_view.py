"""Unpacks the data of a 3-D view and compares them with the press, the grasp or the scene they were made of.

    check_view.py VIEW.js FOLDER"""
import base64
import json
import os
import sys
import zlib

import numpy as np


class Planes:
    """Integers as three planes of bytes: 0, -1, 1, -2 ... are stored as 0, 1, 2, 3 ..."""

    def __init__(self, data):
        self.data, self.at = np.frombuffer(data, np.uint8).astype(int), 0

    def next(self, count):
        low, middle, high = self.data[self.at:self.at + 3 * count].reshape(3, count)
        self.at += 3 * count
        code = low + 256 * middle + 65536 * high
        return np.where(code % 2 == 0, code // 2, -(code + 1) // 2)

    def triangles(self, count):
        first = np.cumsum(self.next(count))
        return np.stack([first, first + self.next(count), first + self.next(count)], axis=1)


def check_gel(planes, data, gel, press, world_from_gel):
    """Compares one gel of the view with its press folder, frame by frame."""
    front = np.load(f"{press}/front_vertices.npy")
    positions = np.load(f"{press}/positions.npy")[:, front]
    states, forces = np.load(f"{press}/contact_state.npy"), np.load(f"{press}/contact_force.npy")[:, :, 0]
    grid, count = gel["grid"], gel["vertices"]
    half = 0.501 * grid["step_m"]
    assert half < 0.3e-6, f"a step is {grid['step_m']} m"
    assert count == len(front) and len(data["frames"]) == len(positions)
    triangles = planes.triangles(gel["triangles"])
    assert triangles.min() == 0 and triangles.max() == count - 1
    steps, rows = np.zeros((count, 3), int), None
    for f, facts in enumerate(data["frames"]):
        for axis in range(3):
            difference = planes.next(count)
            steps[:, axis] += difference if f else np.cumsum(difference)
        shown = np.array(grid["low_m"]) + grid["step_m"] * steps
        if rows is None:  # which vertex is which: by the places at rest
            rows = np.argmin(np.linalg.norm(shown[:, None] - positions[0][None], axis=2), axis=1)
            assert sorted(rows) == list(range(count))
        assert np.abs(shown - positions[facts["frame"]][rows]).max() <= half
        # In the world: where the pose of this frame puts it.
        pose, given = world_from_gel[facts["frame"]], np.array(gel["poses"][f]).reshape(4, 4)
        there = positions[facts["frame"]][rows] @ pose[:3, :3].T + pose[:3, 3]
        assert np.abs(shown @ given[:3, :3].T + given[:3, 3] - there).max() <= 2 * half
        pressure = planes.next(count) / 255 * data["pressure_pa"]
        assert np.array_equal(planes.next(count), states[facts["frame"]][rows])
        # Pressure: the force into the face over a third of the area around, as far as the colours reach.
        corners = positions[facts["frame"]][rows][triangles]
        third = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 6
        normal, area = np.zeros((count, 3)), np.zeros(count)
        np.add.at(normal, triangles.ravel(), np.repeat(third, 3, axis=0))
        np.add.at(area, triangles.ravel(), np.repeat(np.linalg.norm(third, axis=1), 3))
        normal /= np.linalg.norm(normal, axis=1)[:, None]
        expected = np.maximum(0, -np.sum(forces[facts["frame"]][rows] * normal, axis=1)) / area
        expected = np.minimum(expected, data["pressure_pa"])
        assert np.abs(pressure - expected).max() <= 0.501 / 255 * data["pressure_pa"]
    for f, picture in enumerate(gel.get("pictures", [])):
        assert not picture or f"frame_{data['frames'][f]['frame']:04}/tactile.png" in picture


def check_object(planes, data, shown, poses, soft):
    """Compares a body with its poses, (frames, 4, 4), or a soft one with its vertices, (frames, vertices, 3)."""
    triangles, count, grid = planes.triangles(shown["triangles"]), shown["vertices"], shown["grid"]
    assert triangles.min() == 0 and triangles.max() == count - 1
    frames, steps, top = [facts["frame"] for facts in data["frames"]], np.zeros((count, 3), int), 0
    rows = None
    for f in frames if soft is not None else frames[:1]:
        for axis in range(3):
            difference = planes.next(count)
            steps[:, axis] += difference if rows is not None else np.cumsum(difference)
        top = max(top, steps.max())
        if soft is None:
            break
        there = np.array(grid["low_m"]) + grid["step_m"] * steps
        if rows is None:
            rows = np.argmin(np.linalg.norm(there[:, None] - soft[f][None], axis=2), axis=1)
            assert len(set(rows)) == count
        assert np.abs(there - soft[f][rows]).max() <= 0.501 * grid["step_m"]
    assert top == 65535
    assert np.array_equal(np.array(shown["poses"]), poses.reshape(-1, 16)[frames])


def robot_poses(folder, body):
    with open(f"{folder}/robot/robot.yaml", encoding="utf-8") as file:
        [line] = [line for line in file if line.startswith("  bodies: [")]
    return np.load(f"{folder}/robot/model_pose.npy")[:, line.strip()[len("bodies: ["):-1].split(", ").index(body)]


def main():
    script, folder = sys.argv[1:3]
    with open(script, encoding="utf-8") as file:
        data = json.loads(file.read().removeprefix("tacipc_view(").rstrip().removesuffix(");"))
    planes = Planes(zlib.decompress(base64.b64decode(data["packed"])))
    soft = {}
    if os.path.exists(f"{folder}/body_pose.npy"):  # bodies are gels, soft, rigid, fixed ones
        bodies = np.load(f"{folder}/body_pose.npy")
        for g, gel in enumerate(data["gels"]):
            check_gel(planes, data, gel, f"{folder}/gels/{gel['name']}/press", bodies[:, g])
        for shown in data["objects"]:
            if shown.get("kind") == "soft":
                soft[shown["name"]] = np.load(f"{folder}/soft/{shown['name']}/world_positions.npy")
        still, own = np.tile(np.eye(4), (len(bodies), 1, 1)), bodies.shape[1] - len(data["gels"])
        poses = list(np.moveaxis(bodies[:, len(data["gels"]) + len(soft):], 1, 0)) + [still] * len(soft)
        for shown in data["objects"][own:]:  # the robot's, and what stands around it
            poses.append(still if shown["name"] == "world" else robot_poses(folder, shown["name"]))
    elif os.path.exists(f"{folder}/finger_pose.npy"):
        poses, fingers = [np.load(f"{folder}/object_world_pose.npy")], np.load(f"{folder}/finger_pose.npy")
        assert [gel["name"] for gel in data["gels"]] == ["left", "right"]
        for g, gel in enumerate(data["gels"]):
            check_gel(planes, data, gel, f"{folder}/{gel['name']}/press", fingers[:, g])
    else:
        poses = [np.load(f"{folder}/object_pose.npy")]
        [gel] = data["gels"]
        check_gel(planes, data, gel, folder, np.tile(np.eye(4), (len(poses[0]), 1, 1)))
    assert len(data["objects"]) == len(poses)
    for shown, pose in zip(data["objects"], poses):
        check_object(planes, data, shown, pose, soft.get(shown["name"]))
    assert planes.at == len(planes.data)


main()
