"""Compares a folder of `robot` with MuJoCo's Python package, of another version, moved by the same controls.

    check_robot.py MODEL FOLDER PAD GEOM X,Y,Z TURN_DEG

The folder has a frame in every time step, of a motion without contacts. The pad's mount is a shift (m) and a turn about
z of the geom. The free body `ball` is one that the task gave another mass, a tetrahedron with edges along its axes: it
falls and turns as the closed form of its first instant says."""
import sys

import mujoco
import numpy as np

model_file, folder, pad, geom, at, turn = sys.argv[1:]
load = lambda name: np.load(f"{folder}/{name}.npy")
model = mujoco.MjModel.from_xml_path(model_file)
data = mujoco.MjData(model)
time, qpos, qvel, control, force = map(load, ("time", "qpos", "qvel", "control", "actuator_force"))
body_pose, body_twist, pad_pose = map(load, ("model_pose", "model_twist", "pad_pose"))
assert np.abs(np.diff(time) - model.opt.timestep).max() < 1e-9
assert len(time) == 1001, len(time)
ball = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, "ball")
first = model.jnt_qposadr[model.body_jntadr[ball]]
own = np.setdiff1d(np.arange(model.nq), np.arange(first, first + 7))
own_v = np.setdiff1d(np.arange(model.nv), np.arange(first, first + 6))
others = [b for b in range(1, model.nbody) if b != ball]
limited = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_ACTUATOR, "slide")
step = load("step")

c, s = np.cos(np.radians(float(turn))), np.sin(np.radians(float(turn)))
mount = np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1.0]])
mount[:3, 3] = [float(x) for x in at.split(",")]


def pose(position, rotation):
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = rotation.reshape(3, 3), position
    return matrix


worst = dict.fromkeys(("qpos", "qvel", "force", "body pose", "body twist", "pad pose"), 0.0)


def differ(what, a, b):
    worst[what] = max(worst[what], np.abs(a - b).max())


for n in range(len(time)):
    if n:
        # The controls of a frame are those that led to it; the limit holds from its step on.
        data.ctrl[:] = control[n]
        if step[n] >= 2:
            model.actuator_forcelimited[limited] = 1
            model.actuator_forcerange[limited] = [-3, 3]
        mujoco.mj_step(model, data)
        differ("force", data.actuator_force, force[n])
    assert data.ncon == 0 or n == 0
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    mujoco.mj_comVel(model, data)
    differ("qpos", data.qpos[own], qpos[n, own])
    differ("qvel", data.qvel[own_v], qvel[n, own_v])
    for b in others:
        differ("body pose", pose(data.xpos[b], data.xmat[b]), body_pose[n, b - 1])
        twist = np.zeros(6)
        mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_XBODY, b, twist, 0)
        differ("body twist", np.r_[twist[3:], twist[:3]], body_twist[n, b - 1])
    g = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_GEOM, geom)
    differ("pad pose", pose(data.geom_xpos[g], data.geom_xmat[g]) @ mount, pad_pose[n, 0])

print({what: float(f"{difference:.2g}") for what, difference in worst.items()})
assert np.ptp(qpos[:, own], axis=0).min() > 0.01, "a joint does not move"
assert (np.abs(force[:, limited]) > 2.999).any(), "the limit is never met"
for what, difference in worst.items():
    assert difference <= 1e-6, f"{what} differs by {difference:g}"
# The ball's own centre falls, whatever geom its body has; it does not begin to turn.
centre = body_pose[:, ball - 1, :3, :3] @ np.full(3, 0.25) + body_pose[:, ball - 1, :3, 3]
t, h = time[:, None], model.opt.timestep
fallen = np.array([0, 0, -9.81]) * t * (t + h) / 2
assert np.abs(centre - centre[0] - fallen).max() < 1e-9, "the ball does not fall about its centre"
assert np.abs(body_twist[:, ball - 1, 3:]).max() < 1e-9, "the ball turns"
