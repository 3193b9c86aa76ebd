"""Draws the pictures of docs/examples.md from runs of the examples (standard library and matplotlib).

    cargo build --release -p stiction-cli
    pip install matplotlib
    python docs/pictures/examples.py target/release/stiction
"""

import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams["svg.hashsalt"] = "stiction"
import matplotlib.pyplot as plt

NAMESPACE = "{http://www.mscsoftware.com/:xrf10}"
REGIMES = [("stuck", "#f4a582"), ("transition", "#fee8c8"), ("sliding", "#d1e5f0")]
PICTURES = Path(__file__).resolve().parent
EXAMPLES = PICTURES.parent.parent / "examples"


class Results:
    """The dynamic steps of a .res: series by `ENTITY.COMPONENT`."""

    def __init__(self, path):
        root = ElementTree.parse(path).getroot()
        self.entities = list(root.iter(NAMESPACE + "Entity"))
        self.columns = {
            f"{entity.get('name')}.{component.get('name')}": int(component.get("id")) - 1
            for entity in self.entities
            for component in entity.iter(NAMESPACE + "Component")
        }
        self.rows = [
            [float(value) for value in step.text.split()]
            for data in root.iter(NAMESPACE + "Data")
            if data.get("name").startswith("dynamic")
            for step in data.iter(NAMESPACE + "Step")
        ]

    def __getitem__(self, name):
        column = self.columns[name]
        return [row[column] for row in self.rows]

    def magnitude(self, entity, components):
        series = [self[f"{entity}.{component}"] for component in components]
        return [sum(value**2 for value in values) ** 0.5 for values in zip(*series)]

    def frictions(self):
        return [entity.get("name") for entity in self.entities if entity.get("entType") == "Friction"]


def run(program, example, folder):
    """Results of an example."""
    command = EXAMPLES / f"{example}.acf"
    target = Path(folder) / command.stem
    subprocess.run([program, "run", command, "-o", target, "--progress", "none"], check=True)
    return Results(target / f"{command.stem}.res")


def shade(axis, results, friction):
    """Background in the colours of the regimes."""
    time, regimes = results["time.TIME"], results[f"{friction}_DETAIL.REGIME"]
    start = 0
    for k in range(1, len(time)):
        if k == len(time) - 1 or regimes[k] != regimes[k - 1]:
            axis.axvspan(time[start], time[k], color=REGIMES[int(regimes[k - 1])][1], lw=0)
            start = k


def finish(figure, axes, target):
    for axis in axes:
        axis.margins(x=0)
    axes[-1].set_xlabel("time (s)")
    patches = [plt.Rectangle((0, 0), 1, 1, color=colour) for _, colour in REGIMES]
    labels = [label for label, _ in REGIMES]
    figure.legend(patches, labels, loc="upper right", ncol=3, frameon=False, fontsize=9)
    figure.tight_layout()
    figure.savefig(PICTURES / target, metadata={"Date": None})


def delta_robot(results):
    """The two joints of the delta robot with the largest friction torque."""

    def peak(name):
        return max(results.magnitude(name, ("TX", "TY", "TZ")))

    shown = sorted(sorted(results.frictions()), key=peak, reverse=True)[:2]
    figure, axes = plt.subplots(len(shown), 1, figsize=(8, 4.2), sharex=True)
    for axis, name in zip(axes, shown):
        shade(axis, results, name)
        torque = [1e3 * value for value in results.magnitude(name, ("TX", "TY", "TZ"))]
        axis.plot(results["time.TIME"], torque, color="black", lw=1.2)
        axis.set_ylabel("torque (N mm)")
        axis.set_title(name, fontsize=9, loc="left")
    finish(figure, axes, "delta-robot-friction.svg")


def hooke(results):
    """Friction torque about the two pins of the hooke joint, and what they cost."""
    time = results["time.TIME"]
    figure, axes = plt.subplots(3, 1, figsize=(8, 5.6), sharex=True)
    for axis, name in zip(axes, ("I_PIN_FRICTION", "J_PIN_FRICTION")):
        shade(axis, results, name)
        axis.plot(time, results.magnitude(name, ("TX", "TY", "TZ")), color="black", lw=1.2)
        axis.set_ylabel("torque (N mm)")
        axis.set_title(name, fontsize=9, loc="left")
        axes[2].plot(time, results[f"{name}_DETAIL.DISSIPATED"], lw=1.2, label=name)
    axes[2].set_ylabel("dissipated (N mm)")
    axes[2].legend(frameon=False, fontsize=9)
    finish(figure, axes, "hooke-friction.svg")


def lugre_slider(results):
    """Stick-slip of the block: its place, the friction force, the bristles."""
    time = results["time.TIME"]
    figure, axes = plt.subplots(3, 1, figsize=(8, 5.6), sharex=True)
    for axis in axes[1:]:
        shade(axis, results, "BLOCK_FRICTION")
    axes[0].set_title("lugre-slider", fontsize=9, loc="left")
    axes[0].plot(time, [place - 0.3 for place in results["CARRIAGE_XFORM.Z"]], lw=1, label="carriage")
    axes[0].plot(time, results["BLOCK_XFORM.Z"], color="black", lw=1.2, label="block")
    axes[0].set_ylabel("place (m)")
    axes[0].legend(frameon=False, fontsize=9)
    axes[1].plot(time, [-force for force in results["BLOCK_FRICTION.FZ"]], color="black", lw=1.2)
    axes[1].set_ylabel("friction (N)")
    bristles = [1e3 * value for value in results["BLOCK_FRICTION_DETAIL.BRISTLE_Z"]]
    axes[2].plot(time, bristles, color="black", lw=1.2)
    axes[2].set_ylabel("bristles (mm)")
    finish(figure, axes, "lugre-slider-friction.svg")


def main(program):
    program = Path(program).resolve()
    with tempfile.TemporaryDirectory() as folder:
        delta_robot(run(program, "delta-robot/delta", folder))
        hooke(run(program, "hooke/hooke", folder))
        lugre_slider(run(program, "lugre-slider/lugre_slider", folder))


if __name__ == "__main__":
    main(*sys.argv[1:])
