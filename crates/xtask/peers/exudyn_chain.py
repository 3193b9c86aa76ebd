"""A chain of rods in space, absolute coordinates: exudyn_chain.py RODS."""

import sys

import exudyn_solver
import exudyn as exu
import exudyn.itemInterface as items
import exudyn.utilities as utilities
import numpy as np
from serving import serve

GRAVITY = 9.81 / np.sqrt(2) * np.array([0, -1, -1])
ABOUT_Z = np.eye(3)
# Columns are the axes of the hinge; its own axis is z.
ABOUT_Y = np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]])


def prepare(steps):
    rods = int(sys.argv[1])
    container, mbs = exudyn_solver.system()
    last = mbs.AddObject(items.ObjectGround())
    inertia = utilities.RigidBodyInertia(
        mass=1.0, inertiaTensor=np.diag([0.001, 1 / 12, 1 / 12]))
    bodies = []
    for k in range(rods):
        result = mbs.CreateRigidBody(
            referencePosition=[k + 0.5, 0, 0], inertia=inertia, gravity=list(GRAVITY),
            nodeType=exu.NodeType.RotationEulerParameters, returnDict=True)
        body = result["bodyNumber"]
        axes = ABOUT_Y if k % 2 else ABOUT_Z
        markers = [
            mbs.AddMarker(items.MarkerBodyRigid(
                bodyNumber=last, localPosition=[0.5 if k else 0, 0, 0])),
            mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=body, localPosition=[-0.5, 0, 0])),
        ]
        mbs.AddObject(items.RevoluteJointZ(
            markerNumbers=markers, rotationMarker0=axes, rotationMarker1=axes))
        bodies.append(body)
        last = body
    mbs.Assemble()
    chosen = exudyn_solver.settings(steps, 1.0, sparse=True)

    def read():
        output = exu.OutputVariableType
        rate = mbs.GetObjectOutputBody(bodies[0], output.AngularVelocity, [0, 0, 0])
        tip = mbs.GetObjectOutputBody(bodies[-1], output.Position, [0.5, 0, 0])
        return [rate[2], *tip]

    return lambda keep=container: exudyn_solver.solve(mbs, chosen), read


serve(prepare)
