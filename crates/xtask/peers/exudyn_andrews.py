"""Andrews' squeezing mechanism in the plane: exudyn_andrews.py alpha|trapezoidal."""

import sys

import exudyn_solver
import exudyn.itemInterface as items
import numpy as np
from plane import Plane
from serving import serve

START = [-0.06171389001427645, 0.0, 0.4552798191630704, 0.2226683901658859,
         0.48736497954384255, -0.2226683901658859, 1.2305474445498212]


def along(angle):
    return np.array([np.cos(angle), np.sin(angle)])


def across(angle):
    return np.array([-np.sin(angle), np.cos(angle)])


def prepare(steps):
    q = START
    angles = [q[0], q[0] + q[1], q[2], q[3] + q[4], q[4], q[5] + q[6], q[6]]
    beta, second, gamma, fourth, delta, sixth, epsilon = angles
    a, b = np.array([-0.06934, -0.00227]), np.array([-0.03635, 0.03273])
    k = 7e-3 * along(beta)
    h = a + 40e-3 * along(delta)
    g = a - 40e-3 * across(epsilon)
    f = b - 35e-3 * across(gamma)
    end = b + 20e-3 * along(gamma) - 18e-3 * across(gamma)
    centres = [
        0.92e-3 * along(beta),
        k - 11.5e-3 * along(second),
        b - 18.74e-3 * across(gamma) + 10.43e-3 * along(gamma),
        h - (20e-3 - 14.21e-3) * across(fourth),
        a + 23.08e-3 * along(delta) + 9.16e-3 * across(delta),
        g + (20e-3 - 14.21e-3) * along(sixth),
        a - 12.28e-3 * across(epsilon) - 4.49e-3 * along(epsilon),
    ]
    masses = [0.04325, 0.00365, 0.02373, 0.00706, 0.07050, 0.00706, 0.05498]
    inertias = [2.194e-6, 4.410e-7, 5.255e-6, 5.667e-7, 1.169e-5, 5.667e-7, 1.912e-5]
    container, mbs = exudyn_solver.system()
    plane = Plane(mbs)
    k1, k2, k3, k4, k5, k6, k7 = map(plane.body, masses, inertias, centres)
    ground = plane.ground
    for i, j, at in [(k1, ground, (0, 0)), (k2, k1, k), (k3, ground, b), (k5, ground, a),
                     (k4, k5, h), (k7, ground, a), (k6, k7, g),
                     (k3, k2, f), (k4, k2, f), (k6, k2, f)]:
        plane.pin(i, j, at)
    mbs.AddObject(items.SpringDamper(
        markerNumbers=[plane.marker(ground, (0.014, 0.072)), plane.marker(k3, end)],
        stiffness=4530.0, damping=0.0, referenceLength=0.07785))
    mbs.AddLoad(items.Torque(
        markerNumber=mbs.AddMarker(items.MarkerNodeRigid(nodeNumber=plane.nodes[k1])),
        loadVector=[0, 0, 0.033]))
    mbs.Assemble()
    chosen = exudyn_solver.settings(steps, 0.05, sys.argv[1])

    def read():
        bodies = [k1, k2, k3, k4, k5, k6, k7]
        return [angle + plane.coordinates(body)[2] for angle, body in zip(angles, bodies)]

    return lambda keep=container: exudyn_solver.solve(mbs, chosen), read


serve(prepare)
