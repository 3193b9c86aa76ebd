"""A rod on a pin with LuGre friction from its reaction; the law is in user functions.

The deflection of the bristles is a differential equation of first order, the torque the law of a
torsional spring; both read the force of the pin's joint.
"""

import exudyn_solver
import exudyn as exu
import exudyn.itemInterface as items
import numpy as np
from plane import Plane
from serving import serve

LENGTH, GRAVITY, RADIUS = 0.5, 9.81, 0.05
STATIC, DYNAMIC, STRIBECK = 0.3, 0.2, 5e-3
STIFFNESS, DAMPING = 1e5, 100.0


def deflection_rate(load, velocity, deflection):
    level = load * (DYNAMIC + (STATIC - DYNAMIC) * np.exp(-(velocity / STRIBECK) ** 2))
    return velocity - STIFFNESS * abs(velocity) * deflection / level


def prepare(steps):
    container, mbs = exudyn_solver.system()
    plane = Plane(mbs)
    rod = plane.body(1.0, 1 / 12, (LENGTH, 0), gravity=GRAVITY)
    plane.pin(rod, plane.ground, (0, 0))
    node = plane.nodes[rod]
    bristles = mbs.AddNode(items.NodeGenericODE1(
        referenceCoordinates=[0], initialCoordinates=[0], numberOfODE1Coordinates=1))

    def load(mbs):
        # Never below 2 N here; the bound is for the first iterations, which know no reaction yet.
        force = mbs.systemData.GetAECoordinates()
        return max(np.hypot(force[0], force[1]), 1.0)

    def rate(mbs, t, item, q):
        velocity = RADIUS * mbs.GetNodeOutput(node, exu.OutputVariableType.Coordinates_t)[2]
        return [deflection_rate(load(mbs), velocity, q[0])]

    def torque(mbs, t, item, rotation, angular_velocity, stiffness, damping, offset):
        velocity = RADIUS * angular_velocity
        z = mbs.systemData.GetODE1Coordinates()[0]
        return RADIUS * (STIFFNESS * z + DAMPING * deflection_rate(load(mbs), velocity, z))

    mbs.AddObject(items.ObjectGenericODE1(nodeNumbers=[bristles], rhsUserFunction=rate))
    markers = [
        mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=body, localPosition=[0, 0, 0]))
        for body in (plane.ground, rod)
    ]
    mbs.AddObject(items.TorsionalSpringDamper(
        markerNumbers=markers, stiffness=0, damping=0, springTorqueUserFunction=torque))
    mbs.Assemble()
    chosen = exudyn_solver.settings(steps, 5.0, "trapezoidal", full_newton=True)

    def read():
        return [plane.coordinates(rod)[2]]

    return lambda keep=container: exudyn_solver.solve(mbs, chosen), read


serve(prepare)
