"""Rigid bodies in the plane for Exudyn, written down where they stand at the start."""

import exudyn.itemInterface as items
import numpy as np


class Plane:
    def __init__(self, mbs):
        self.mbs = mbs
        self.ground = mbs.AddObject(items.ObjectGround())
        self.centres = {self.ground: np.zeros(2)}
        self.nodes = {}

    def body(self, mass, inertia, centre, velocity=(0, 0), rate=0.0, gravity=0.0):
        """A body with its centre of mass at `centre`, all angles zero at the start."""
        node = self.mbs.AddNode(items.NodeRigidBody2D(
            referenceCoordinates=[*centre, 0.0], initialVelocities=[*velocity, rate]))
        body = self.mbs.AddObject(items.ObjectRigidBody2D(
            physicsMass=mass, physicsInertia=inertia, nodeNumber=node))
        self.centres[body] = np.array(centre, dtype=float)
        self.nodes[body] = node
        if gravity:
            self.mbs.AddLoad(items.Force(
                markerNumber=self.marker(body, centre), loadVector=[0, -mass * gravity, 0]))
        return body

    def rod(self, a, b, rate=0.0, velocity=None, gravity=0.0):
        """A thin rod of 1 kg; `rate` turns it about `a` unless a velocity is given."""
        a, b = np.array(a, dtype=float), np.array(b, dtype=float)
        half = 0.5 * (b - a)
        if velocity is None:
            velocity = rate * np.array([-half[1], half[0]])
        inertia = 4 * (half @ half) / 12
        return self.body(1.0, inertia, a + half, velocity, rate, gravity)

    def marker(self, body, at):
        local = np.array(at, dtype=float) - self.centres[body]
        return self.mbs.AddMarker(items.MarkerBodyPosition(
            bodyNumber=body, localPosition=[*local, 0.0]))

    def pin(self, i, j, at):
        return self.mbs.AddObject(items.RevoluteJoint2D(
            markerNumbers=[self.marker(i, at), self.marker(j, at)]))

    def coordinates(self, body):
        """Displacement of the centre, and angle."""
        return np.array(self.mbs.GetNodeOutput(self.nodes[body], _COORDINATES))


import exudyn as _exu  # noqa: E402

_COORDINATES = _exu.OutputVariableType.Coordinates
