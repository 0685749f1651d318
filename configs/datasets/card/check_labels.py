#!/usr/bin/env python3
"""Recomputes the labels of grasps from the poses, forces and contact states that are packed beside them.

    python3 check_labels.py shards/*.h5

Needs h5py and numpy, and nothing of the simulator: definitions are those of docs/grasp.md. Says how many samples agree
and in what the others do not; exit 1 where one does not. A shard may be a stranger's: one that points to other files, or
claims more numbers than it can hold, is refused, and one on which libhdf5 crashes is reported as damaged.
"""
import multiprocessing
import os
import sys

import h5py
import numpy as np

LONGEST_S = 60  # between two samples
MOST_PACKED = 1032  # gzip packs no more bytes into one
SLIPPED_MM, TURNED_DEG, DROPPED_PART, TOUCHES_N = 1.0, 5.0, 0.2, 1e-6
FIRST_SLIP_SHARE, GROSS_SLIP_SHARE, UNEVEN = 0.05, 0.95, 0.1
GROSS_SLIP_MM, GROSS_TURN_DEG = 0.1, 0.5


def matrices(poses):
    """(..., 7) of x, y, z, qx, qy, qz, qw as rotations and origins."""
    x, y, z, w = np.moveaxis(poses[..., 3:], -1, 0)
    rows = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1)), poses[..., :3]


def angle_deg(rotation):
    """Of the turn that a rotation matrix makes; exact for small ones, too."""
    axial = rotation - rotation.T
    sine = 0.5 * np.linalg.norm([axial[2, 1], axial[0, 2], axial[1, 0]])
    return np.degrees(np.arctan2(sine, 0.5 * (np.trace(rotation) - 1)))


class Grasp:
    """One sample, a finger of a grasp, as recomputed."""

    def __init__(self, sample):
        attrs, series = sample.attrs, {name: field[...] for name, field in sample["series"].items()}
        self.attrs, self.series, self.time_s, phases = attrs, series, series["time_s"], series["phase"]
        names = dict(entry.split(" ", 1)[::-1] for entry in sample["series/phase"].attrs["codes"].split(", "))
        closes, releases = int(names["close"]), int(names["release"])
        self.hand, self.hand_at = matrices(series["hand_pose"])
        self.object, self.object_at = matrices(series["object_pose"])
        self.finger, self.finger_at = matrices(series["finger_pose"])
        self.force = series["finger_force_N"]
        self.grips = np.abs(np.einsum("fsi,fsi->fs", self.force, self.finger[..., 2]))
        self.touches = np.all(np.linalg.norm(self.force, axis=2) > TOUCHES_N, axis=1)
        # Freed: the object has not moved up to there, and the first close (or one of several in a row) ends there.
        self.freed = int(attrs["freed_frame"])
        if not 0 <= self.freed < len(phases):
            raise ValueError(f"freed_frame is {self.freed}, there are {len(phases)} frames")
        last_close = np.flatnonzero(phases == closes)[0]
        while last_close + 1 < len(phases) and phases[last_close + 1] == closes:
            last_close += 1
        self.freed_is_possible = phases[self.freed] == closes and self.freed <= last_close and \
            np.abs(series["object_pose"][:self.freed + 1] - series["object_pose"][0]).max() < 1e-9
        released = np.flatnonzero(phases == releases)
        self.judged = int(released[0]) - 1 if len(released) else len(phases) - 1
        self.center = np.asarray(attrs["center_of_mass_mm"])
        self.grip_point = self.center + np.asarray(attrs["grip_mm"])
        self.side = 1 if attrs["finger"] == "right" else 0
        self.mass_kg, self.mu = 1e-3 * attrs["object_mass_g"], attrs["mu"]
        self.gravity = np.asarray(attrs["gravity_m_s2"])
        self.measure_motion()
        self.measure_slip()

    def in_hand(self, frame):
        back = self.hand[frame].T
        return back @ self.object[frame], back @ (self.object_at[frame] - self.hand_at[frame])

    def moved(self, then, now):
        """Of the object in the hand from one frame to another: of its point at the grip, mm, and its turn, degrees."""
        (turn_then, at_then), (turn, at) = self.in_hand(then), self.in_hand(now)
        slip_mm = np.linalg.norm(turn @ self.grip_point + at - turn_then @ self.grip_point - at_then)
        return slip_mm, angle_deg(turn @ turn_then.T)

    def measure_motion(self):
        self.slip_mm, self.turn_deg = np.zeros(len(self.time_s)), np.zeros(len(self.time_s))
        for f in range(self.freed, len(self.time_s)):
            self.slip_mm[f], self.turn_deg[f] = self.moved(self.freed, f)
        self.measure_creep()
        place = lambda f: self.object[f] @ self.grip_point + self.object_at[f]
        self.rise_mm = (place(self.judged) - place(self.freed))[2]
        self.hand_rise_mm = (self.hand_at[self.judged] - self.hand_at[self.freed])[2]

    def measure_creep(self):
        """What of the way only crept, no faster than friction sticks, and what is slip without it."""
        speed = self.attrs.get("slip_speed_mm_s", 0.0)
        normal, slipping = self.series["normal_force_N"], self.series["slipping_force_N"]
        shares = np.divide(slipping, normal, out=np.zeros_like(normal), where=normal > TOUCHES_N).max(axis=1)
        radii = self.series["friction_radius_mm"].max(axis=1)
        turn_freed, at_freed = self.in_hand(self.freed)
        point = lambda turn, at: turn @ self.grip_point + at
        crept, crept_turn = np.zeros(3), np.eye(3)
        self.creep_mm, self.creep_deg = 0.0, 0.0
        self.slid_mm, self.slid_deg = np.zeros(len(self.time_s)), np.zeros(len(self.time_s))
        for f in range(self.freed + 1, self.judged + 1):
            (turn_before, at_before), (turn, at) = self.in_hand(f - 1), self.in_hand(f)
            step, step_turn = point(turn, at) - point(turn_before, at_before), turn @ turn_before.T
            fastest = max(np.linalg.norm(step), radii[f] * np.radians(angle_deg(step_turn)))
            if shares[f] < GROSS_SLIP_SHARE and fastest <= speed * (self.time_s[f] - self.time_s[f - 1]):
                crept, crept_turn = crept + step, step_turn @ crept_turn
            self.slid_mm[f] = np.linalg.norm(point(turn, at) - point(turn_freed, at_freed) - crept)
            self.slid_deg[f] = angle_deg(turn @ turn_freed.T @ crept_turn.T)
            self.creep_mm, self.creep_deg = np.linalg.norm(crept), angle_deg(crept_turn)

    def measure_slip(self):
        normal, slipping = self.series["normal_force_N"], self.series["slipping_force_N"]
        shares = np.divide(slipping, normal, out=np.zeros_like(normal), where=normal > TOUCHES_N)[:, self.side]
        self.slip_share = shares
        free = range(self.freed + 1, self.judged + 1)
        self.first_slip_s = next((self.time_s[f] for f in free if shares[f] >= FIRST_SLIP_SHARE), None)
        self.gross_slip_s, began = None, None
        for f in free:
            if shares[f] < GROSS_SLIP_SHARE:
                began = None
                continue
            began = began or f
            slip_mm, turn_deg = self.moved(began - 1, f)
            if slip_mm >= GROSS_SLIP_MM or turn_deg >= GROSS_TURN_DEG:
                self.gross_slip_s = self.time_s[began]
                break

    def outcome(self):
        f = self.judged
        if not np.any(np.linalg.norm(self.force, axis=2) > TOUCHES_N):
            return "untouched"
        if not self.touches[f] or (self.hand_rise_mm >= 1.0 and self.rise_mm < DROPPED_PART * self.hand_rise_mm):
            return "dropped"
        return "slipped" if self.slid_mm[f] >= SLIPPED_MM else "rotated" if self.slid_deg[f] >= TURNED_DEG else "lifted"

    def reason(self):
        if self.outcome() == "lifted":
            return None
        if not self.touches[self.freed]:
            return "no_contact"
        turn, at = self.in_hand(self.freed)
        carried = lambda f, point: 1e-3 * (self.hand[f] @ (turn @ point + at) + self.hand_at[f])  # m
        center = np.array([carried(f, self.center) for f in range(len(self.time_s))])
        for f in range(self.freed, self.judged + 1):
            if not (self.touches[f] and self.slid_mm[f] < SLIPPED_MM and self.slid_deg[f] < TURNED_DEG):
                break
            axis, pull, acceleration = self.hand[f][:, 0], self.gravity, 0.0
            if f + 1 < len(self.time_s):
                before, after = self.time_s[f] - self.time_s[f - 1], self.time_s[f + 1] - self.time_s[f]
                change = (center[f + 1] - center[f]) / after - (center[f] - center[f - 1]) / before
                acceleration = 2 / (before + after) * change
            across = lambda v: self.mass_kg * np.linalg.norm(v - (axis @ v) * axis)
            arm = center[f] - carried(f, self.grip_point)
            bears_n = self.mu * self.grips[f].sum()
            bears_n_m = 1e-3 * self.mu * (self.grips[f] * self.series["friction_radius_mm"][f]).sum()
            torque = self.mass_kg * abs(axis @ np.cross(arm, pull - acceleration))
            if across(pull) > bears_n:
                return "weight"
            if across(pull - acceleration) > bears_n:
                return "acceleration"
            if torque > 0 and np.hypot(across(pull - acceleration) / bears_n, torque / bears_n_m) > 1:
                return "torque"
        left, right = self.grips[self.freed]
        return "uneven_grip" if abs(left - right) > UNEVEN * (left + right) else "other"


def disagreements(sample):
    """What the sample says otherwise than its poses, forces and states: a list of words, empty where all agrees."""
    grasp, attrs, found = Grasp(sample), sample.attrs, []

    def compare(name, packed, computed, tolerance=1e-6):
        if computed is None or packed is None:
            same = packed is None and computed is None
        elif isinstance(computed, str):
            same = packed == computed
        else:
            same = np.shape(packed) == np.shape(computed) and \
                np.allclose(packed, computed, rtol=tolerance, atol=tolerance)
        if not same:
            found.append(f"{name} is {packed}, recomputed {computed}")

    if not grasp.freed_is_possible:
        found.append(f"freed_frame is {grasp.freed}, where the object was not freed")
    compare("judged_frame", int(attrs["judged_frame"]), grasp.judged, 0)
    compare("outcome", attrs["outcome"], grasp.outcome())
    compare("reason", attrs.get("reason"), grasp.reason())
    compare("first_slip_s", attrs.get("first_slip_s"), grasp.first_slip_s)
    compare("gross_slip_s", attrs.get("gross_slip_s"), grasp.gross_slip_s)
    compare("end_slip_mm", attrs["end_slip_mm"], grasp.slip_mm[grasp.judged])
    compare("end_turn_deg", attrs["end_turn_deg"], grasp.turn_deg[grasp.judged])
    if "slip_speed_mm_s" in attrs:
        compare("end_creep_mm", attrs["end_creep_mm"], grasp.creep_mm)
        compare("end_creep_deg", attrs["end_creep_deg"], grasp.creep_deg)
    compare("rise_mm", attrs["rise_mm"], grasp.rise_mm)
    compare("hand_rise_mm", attrs["hand_rise_mm"], grasp.hand_rise_mm)
    compare("grip_N", attrs["grip_N"], grasp.grips[grasp.freed].mean())
    weight_n = grasp.mass_kg * np.linalg.norm(grasp.gravity)
    margin = 2 * grasp.mu * grasp.grips[grasp.freed].mean() / weight_n if weight_n else None
    compare("friction_margin", attrs.get("friction_margin"), margin)
    compare("lever_mm", attrs["lever_mm"], np.linalg.norm((grasp.object[0] @ np.asarray(attrs["grip_mm"]))[1:]))
    # Frames that were rendered, in fields of 32 bits: seen by the finger, and vertex by vertex where that is packed.
    obs = sample["obs"]
    frames = obs["frame"][...] if "frame" in obs else []
    checked = {"slip_mm": grasp.slip_mm, "turn_deg": grasp.turn_deg, "slip_share": grasp.slip_share}
    for name, values in checked.items():
        if name in obs and len(frames):
            compare(f"obs/{name}", obs[name][...].tolist(), values[frames].tolist(), 1e-4)
    for i, f in enumerate(frames):
        back, place = grasp.finger[f, grasp.side].T, grasp.object_at[f] - grasp.finger_at[f, grasp.side]
        if "force_N" in obs:
            compare(f"obs/force_N[{i}]", obs["force_N"][i].tolist(), (back @ grasp.force[f, grasp.side]).tolist(), 1e-4)
        if "object_pose" in obs:
            turn, at = matrices(obs["object_pose"][i].astype(float))
            compare(f"obs/object_pose[{i}]", at.tolist(), (back @ place).tolist(), 1e-3)
            compare(f"obs/object_pose[{i}] turn", turn.tolist(), (back @ grasp.object[f]).tolist(), 1e-4)
        if "sim" in sample and {"nodal_force_normal_N", "nodal_contact_state"} <= set(sample["sim"]):
            normal = np.linalg.norm(sample["sim/nodal_force_normal_N"][i].astype(float), axis=1)
            slips = sample["sim/nodal_contact_state"][i] == 2
            compare(f"normal_force_N[{f}]", grasp.series["normal_force_N"][f, grasp.side], normal.sum(), 1e-4)
            slipping = grasp.series["slipping_force_N"][f, grasp.side]
            compare(f"slipping_force_N[{f}]", slipping, normal[slips].sum(), 1e-4)
    return found


def refuse_strange(shard, size):
    """Raises ValueError where a shard of `size` bytes points to other files or claims more numbers than it can hold."""
    def look(name, item):
        if isinstance(item, h5py.Dataset):
            if item.external or item.is_virtual:
                raise ValueError(f"{name}: has its numbers in other files, which are not read")
            if item.nbytes > MOST_PACKED * size:
                raise ValueError(f"{name}: claims {item.nbytes} bytes, which its file cannot hold")
            return
        for part in item:
            if not isinstance(item.get(part, getlink=True), h5py.HardLink):
                raise ValueError(f"{name}/{part}: is a link that shards do not have, which is not followed")

    look("", shard)
    shard.visititems(look)


def check_shard(path, answers):
    """Sends the name of each sample and what it says otherwise; last, or in its place, None and why it ended."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), 2)  # the last words of a library that crashes
    try:
        with h5py.File(path, "r") as shard, np.errstate(all="ignore"):
            refuse_strange(shard, os.path.getsize(path))
            for name, sample in shard["data"].items():
                answers.send((name, disagreements(sample) if "grasp" in sample.attrs else None))
        answers.send((None, None))
    except Exception as error:  # whatever a damaged file leads to
        answers.send((None, f"cannot be checked: {type(error).__name__}: {error}"))


def answers_of(path):
    """What check_shard sends, from a process of its own: on some damaged files libhdf5 crashes."""
    answers, to_send = multiprocessing.Pipe(duplex=False)
    process = multiprocessing.Process(target=check_shard, args=(path, to_send), daemon=True)
    process.start()
    to_send.close()
    try:
        while answers.poll(LONGEST_S):
            name, found = answers.recv()
            yield name, found
            if name is None:
                return
        yield None, f"nothing was read in {LONGEST_S} s: the file is damaged"
    except EOFError:
        yield None, "libhdf5 crashed while reading it: the file is damaged"
    finally:
        process.kill()
        process.join()


def main(paths):
    checked = agreed = unread = 0

    def say(words):
        words = words.replace("\n", " ")
        print(words if words.isprintable() else ascii(words))

    for path in paths:
        for name, found in answers_of(path):
            if name is None:
                unread += found is not None
                if found is not None:
                    say(f"{path}: {found}")
            elif found is not None:
                checked += 1
                agreed += not found
                for words in found:
                    say(f"{path}: {name}: {words}")
    if checked:
        print(f"labels recomputed from poses, forces and states: {agreed} of {checked} samples agree")
    elif not unread:
        print("there are no grasps in these shards")
    return 0 if agreed == checked and not unread else 1


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1:]))
