"""Draws docs/pictures/delta-robot-friction.svg from a run of the delta-robot example (standard library and matplotlib).

    cargo run --release -p stiction-cli -- run examples/delta-robot/delta.acf -o delta-run --force
    pip install matplotlib
    python docs/pictures/delta_robot_friction.py delta-run/delta.res docs/pictures/delta-robot-friction.svg
"""

import sys
import xml.etree.ElementTree as ElementTree

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams["svg.hashsalt"] = "stiction"
import matplotlib.pyplot as plt

NAMESPACE = "{http://www.mscsoftware.com/:xrf10}"
REGIMES = [("stuck", "#f4a582"), ("transition", "#fee8c8"), ("sliding", "#d1e5f0")]


def read(path):
    """Entities by name with their component columns, and the rows of the dynamic steps."""
    root = ElementTree.parse(path).getroot()
    entities = {
        entity.get("name"): (
            entity,
            {c.get("name"): int(c.get("id")) - 1 for c in entity.iter(NAMESPACE + "Component")},
        )
        for entity in root.iter(NAMESPACE + "Entity")
    }
    rows = [
        [float(value) for value in step.text.split()]
        for data in root.iter(NAMESPACE + "Data")
        if data.get("name").startswith("dynamic")
        for step in data.iter(NAMESPACE + "Step")
    ]
    return entities, rows


def regime(row, columns, stiction_velocity=0.002, coefficient=1.5):
    """0 stuck, 1 transition, 2 sliding, from the surface velocity and the example's arguments."""
    speed = sum(row[columns[c]] ** 2 for c in ("WX", "WY", "WZ")) ** 0.5
    return 0 if speed < stiction_velocity else 1 if speed < coefficient * stiction_velocity else 2


def main(source, target):
    entities, rows = read(source)
    frictions = [
        (name, columns)
        for name, (entity, columns) in sorted(entities.items())
        if entity.get("entType") == "Friction"
    ]

    def peak(item):
        columns = item[1]
        return max(sum(row[columns[c]] ** 2 for c in ("TX", "TY", "TZ")) for row in rows)

    shown = sorted(frictions, key=peak, reverse=True)[:2]
    time = [row[0] for row in rows]
    figure, axes = plt.subplots(len(shown), 1, figsize=(8, 4.2), sharex=True)
    for axis, (name, columns) in zip(axes, shown):
        torque = [
            1e3 * sum(row[columns[c]] ** 2 for c in ("TX", "TY", "TZ")) ** 0.5 for row in rows
        ]
        states = [regime(row, columns) for row in rows]
        start = 0
        for k in range(1, len(time)):
            if k == len(time) - 1 or states[k] != states[k - 1]:
                axis.axvspan(time[start], time[k], color=REGIMES[states[k - 1]][1], lw=0)
                start = k
        axis.plot(time, torque, color="black", lw=1.2)
        axis.set_ylabel("torque (N mm)")
        axis.set_title(name, fontsize=9, loc="left")
        axis.margins(x=0)
    axes[-1].set_xlabel("time (s)")
    patches = [plt.Rectangle((0, 0), 1, 1, color=colour) for _, colour in REGIMES]
    figure.legend(
        patches, [label for label, _ in REGIMES], loc="upper right", ncol=3, frameon=False, fontsize=9
    )
    figure.tight_layout()
    figure.savefig(target, metadata={"Date": None})


if __name__ == "__main__":
    main(*sys.argv[1:])
