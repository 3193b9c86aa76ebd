"""Results as tables of pandas, polars and xarray."""

import subprocess
import sys

import numpy as np
import pytest
import stiction
from models import BLOCK, EXAMPLES


@pytest.fixture(scope="module")
def result() -> stiction.Result:
    return stiction.loads(BLOCK).run(end=1.0, dtout=1e-2)


def test_pandas_without_copies(result: stiction.Result) -> None:
    frame = result.to_pandas()
    assert frame.index.name == "time" and list(frame.columns) == list(result.channels)
    assert np.shares_memory(frame.to_numpy(), result.values)
    assert frame.attrs["units"]["RUB.FZ"] == "newton" and frame.attrs["units"]["time"] == "sec"
    friction = result.friction["guide"].to_pandas()
    np.testing.assert_array_equal(friction["force"], result["RUB.FZ"])
    assert friction.attrs["units"]["force"] == "newton"


def test_polars(result: stiction.Result) -> None:
    frame = result.to_polars()
    assert frame.columns[0] == "time" and frame.height == len(result.time)
    np.testing.assert_array_equal(frame["RUB.FZ"].to_numpy(), result["RUB.FZ"])
    assert "share_reaction" in result.friction["guide"].to_polars().columns


def test_xarray_has_named_dimensions_and_units() -> None:
    result = stiction.load(EXAMPLES / "delta-robot" / "delta.acf").run()
    data = result.to_xarray()
    force = data["reaction_force"]
    assert force.dims == ("time", "joint", "component") and force.attrs["units"] == "newton"
    joint = str(data["joint"].values[0])
    np.testing.assert_array_equal(force.sel(joint=joint, component="x"), result[f"{joint}.FX"])
    friction = next(iter(result.friction.values()))
    load = data["load"].sel(friction=friction.name)
    np.testing.assert_array_equal(load, friction.load)
    assert str(load["friction_joint"].values) == friction.joint
    assert data["time"].attrs["units"] == "sec"
    assert all("units" in variable.attrs for variable in data.data_vars.values())


def test_ten_million_values_become_a_frame(result: stiction.Result) -> None:
    """A result of that size is made of a small one: 100 channels of 100,000 outputs."""
    import json

    names = [[f"C{k}", "", k] for k in range(100)]
    entity = {"name": "E", "element": "E", "kind": "Request", "id": 1, "components": names}
    count = 100_000
    times = np.arange(count, dtype=np.float64).tobytes()
    values = np.zeros(100 * count).tobytes()
    _, _, _, _, report, diagnostics, log, about = result._raw
    large = stiction.Result(
        json.dumps([entity]), times, bytes(count), values, report, diagnostics, log, about
    )
    frame = large.to_pandas()
    # It takes no time where nothing is copied.
    assert np.shares_memory(frame.to_numpy(), large.values) and frame.size == 10_000_000


def test_the_package_loads_alone() -> None:
    """What is heavy waits until it is asked for."""
    code = """
import sys
import stiction
heavy = {"numpy", "pandas", "polars", "xarray", "matplotlib"} & set(sys.modules)
assert not heavy, heavy
"""
    subprocess.run([sys.executable, "-c", code], check=True)
