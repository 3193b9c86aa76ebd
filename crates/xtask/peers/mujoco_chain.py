"""A chain of rods in space, joint coordinates, Runge and Kutta: mujoco_chain.py RODS."""

import sys

import mujoco
import numpy as np
from serving import serve

GRAVITY = 9.81 / np.sqrt(2) * np.array([0, -1, -1])


def model(rods):
    spec = mujoco.MjSpec()
    spec.option.gravity = GRAVITY
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_RK4
    spec.option.disableflags = mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
    body = spec.worldbody
    for k in range(rods):
        body = body.add_body(
            pos=[1.0 if k else 0.0, 0, 0], mass=1.0, ipos=[0.5, 0, 0],
            inertia=[0.001, 1 / 12, 1 / 12], explicitinertial=True)
        body.add_joint(type=mujoco.mjtJoint.mjJNT_HINGE, axis=[0, 1, 0] if k % 2 else [0, 0, 1])
    body.add_site(name="tip", pos=[1, 0, 0])
    return spec.compile()


MODEL = model(int(sys.argv[1]))


def prepare(steps):
    MODEL.opt.timestep = 1.0 / steps
    data = mujoco.MjData(MODEL)

    def run():
        mujoco.mj_step(MODEL, data, nstep=steps)
        unstable = sum(warning.number for warning in data.warning)
        return not unstable and bool(np.isfinite(data.qpos).all())

    def read():
        rate = data.qvel[0]
        mujoco.mj_kinematics(MODEL, data)
        return [rate, *data.site("tip").xpos]

    return run, read


serve(prepare)
