"""Rows of four-bars in the plane: exudyn_four_bar.py alpha|trapezoidal LOOPS."""

import sys

import exudyn_solver
from plane import Plane
from serving import serve

GRAVITY = 9.81


def prepare(steps):
    method, loops = sys.argv[1], int(sys.argv[2])
    container, mbs = exudyn_solver.system()
    plane = Plane(mbs)
    first = last = None
    for k in range(loops + 1):
        upright = plane.rod((k, 0), (k, 1), rate=-1.0, gravity=GRAVITY)
        first = upright if first is None else first
        plane.pin(upright, plane.ground, (k, 0))
        if last is not None:
            plane.pin(upright, last, (k, 1))
        if k < loops:
            last = plane.rod((k, 1), (k + 1, 1), velocity=(1.0, 0.0), gravity=GRAVITY)
            plane.pin(last, upright, (k, 1))
    mbs.Assemble()
    chosen = exudyn_solver.settings(steps, 10.0, method, sparse=loops > 4, full_newton=True)

    def read():
        x, y, _ = plane.coordinates(first)
        # The centre is half way to the head; it starts at (0, 1/2).
        return [2 * x, 2 * (y + 0.5)]

    return lambda keep=container: exudyn_solver.solve(mbs, chosen), read


serve(prepare)
