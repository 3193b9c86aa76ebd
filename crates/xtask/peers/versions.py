"""Prints the names and versions of the peers."""

from importlib.metadata import version

print(", ".join(f"{name} {version(package)}" for name, package in
                [("Exudyn", "exudyn"), ("MuJoCo", "mujoco")]))
