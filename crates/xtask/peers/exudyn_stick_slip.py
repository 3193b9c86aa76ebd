"""A block drawn by a spring with LuGre friction: exudyn_stick_slip.py trapezoidal|dopri5.

Place, velocity and deflection of the bristles are one system of first order, whose right-hand side
is a user function.
"""

import math
import sys

import exudyn_solver
import exudyn as exu
import exudyn.itemInterface as items
from serving import serve

MASS, SPRING, SPEED = 1.0, 2.0, 0.1
COULOMB, STATIC, STRIBECK = 1.0, 1.5, 1e-3
STIFFNESS, DAMPING, VISCOUS = 1e5, math.sqrt(1e5), 0.4


def prepare(steps):
    container, mbs = exudyn_solver.system()
    node = mbs.AddNode(items.NodeGenericODE1(
        referenceCoordinates=[0, 0, 0], initialCoordinates=[0, 0, 0], numberOfODE1Coordinates=3))

    def rate(mbs, t, item, q):
        x, v, z = q
        level = COULOMB + (STATIC - COULOMB) * math.exp(-(v / STRIBECK) ** 2)
        z_rate = v - STIFFNESS * abs(v) * z / level
        friction = STIFFNESS * z + DAMPING * z_rate + VISCOUS * v
        return [v, (SPRING * (SPEED * t - x) - friction) / MASS, z_rate]

    mbs.AddObject(items.ObjectGenericODE1(nodeNumbers=[node], rhsUserFunction=rate))
    mbs.Assemble()
    s, solver = exudyn_solver.settings(steps, 25.0, sys.argv[1])
    if sys.argv[1] == "dopri5":
        s.timeIntegration.automaticStepSize = True
        s.timeIntegration.adaptiveStep = True
        s.timeIntegration.relativeTolerance = s.timeIntegration.absoluteTolerance = 1e-6

    def read():
        return [mbs.GetNodeOutput(node, exu.OutputVariableType.Coordinates)[0]]

    return lambda keep=container: exudyn_solver.solve(mbs, (s, solver)), read


serve(prepare)
