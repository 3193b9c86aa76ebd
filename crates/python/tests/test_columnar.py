"""Tables on disk, read with pandas, polars and DuckDB."""

import json
from pathlib import Path

import duckdb
import numpy as np
import pandas
import polars
import pyarrow.parquet  # type: ignore[import-untyped]
import pytest
import stiction
from models import BLOCK


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> tuple[stiction.Result, Path]:
    folder = tmp_path_factory.mktemp("run")
    model = stiction.loads(BLOCK).replace({"guide.mu_static": 0.25})
    formats = ["parquet", "csv"]
    return model.run(end=1.0, dtout=1e-3, output=folder, formats=formats), folder


def test_files_are_whole_and_no_others(run: tuple[stiction.Result, Path]) -> None:
    names = sorted(path.name for path in run[1].iterdir())
    tables = ["friction.csv", "friction.parquet", "states.csv", "states.parquet"]
    assert names == sorted([*tables, "model.msg", "tables.json"])


def test_pandas_reads_the_states(run: tuple[stiction.Result, Path]) -> None:
    result, folder = run
    frame = pandas.read_parquet(folder / "states.parquet")
    np.testing.assert_array_equal(frame["time"], result.time)
    for channel in ("BLOCK_XFORM.VZ", "GUIDE.FY", "PULL.FZ"):
        np.testing.assert_array_equal(frame[channel], result[channel])
    assert list(frame["analysis"][:2]) == ["initialConditions", "dynamic"]
    assert not any("RUB" in name for name in frame.columns)
    text = pandas.read_csv(folder / "states.csv")
    pandas.testing.assert_frame_equal(text, frame, check_exact=True, check_dtype=False)


def test_polars_reads_the_frictions(run: tuple[stiction.Result, Path]) -> None:
    result, folder = run
    frame = polars.read_parquet(folder / "friction.parquet")
    assert frame.columns == ["time", "friction", "name", "channel", "value", "unit"]
    force = frame.filter(polars.col("channel") == "FZ")
    np.testing.assert_array_equal(force["value"].to_numpy(), result.friction["guide"].force)
    assert force["unit"].unique().to_list() == ["newton"] and force["friction"][0] == 7
    text = polars.read_csv(folder / "friction.csv", infer_schema_length=None)
    np.testing.assert_array_equal(text["value"].to_numpy(), frame["value"].to_numpy())


def test_duckdb_answers_how_long_it_stuck(run: tuple[stiction.Result, Path]) -> None:
    result, folder = run
    query = f"""
        select name, count(*) * 1e-3 from '{folder}/friction.parquet'
        where channel = 'REGIME' and value = 0 group by name
    """
    relation = duckdb.sql(query)
    assert relation is not None
    ((name, stuck),) = relation.fetchall()
    # As counted by the solver, but for one output at either end.
    assert name == "RUB"
    assert stuck == pytest.approx(result.friction["guide"].stuck_time[-1], abs=2e-3)


def test_metadata_say_what_the_tables_are_of(run: tuple[stiction.Result, Path]) -> None:
    result, folder = run
    for name in ("friction", "states"):
        said = pyarrow.parquet.read_metadata(folder / f"{name}.parquet").metadata
        facts = {key.decode().removeprefix("stiction."): said[key].decode() for key in said}
        assert facts["model"] == result.model_checksum
        assert facts["version"] == "0.1.0" and facts["outcome"] == "completed"
        assert json.loads(facts["options"]) == dict(result.options)
        units = json.loads(facts["units"])
        assert units["BLOCK_XFORM.VZ"] == "meter/sec" and units["time"] == "sec"
        assert json.loads((folder / "tables.json").read_text()) == facts


def test_many_rows_come_in_groups(tmp_path: Path) -> None:
    """1,048,576 values in a batch of six columns are 174,762 rows."""
    result = stiction.loads(BLOCK).run(end=1.0, steps=8000, output=tmp_path, formats=["parquet"])
    file = pyarrow.parquet.ParquetFile(tmp_path / "friction.parquet")
    channels = len(result.friction["rub"]._columns)
    assert file.metadata.num_rows == 8001 * channels
    assert file.metadata.row_group(0).num_rows == (1 << 20) // 6
    assert file.metadata.num_row_groups == -(-8001 * channels // ((1 << 20) // 6))


def test_unknown_formats_are_refused(tmp_path: Path) -> None:
    with pytest.raises(stiction.ParameterError, match="is parquet meant"):
        stiction.loads(BLOCK).run(end=0.1, output=tmp_path, formats=["parkuet"])


def test_tables_that_cannot_be_written(tmp_path: Path) -> None:
    (tmp_path / "friction.parquet.part").mkdir()
    with pytest.raises(stiction.OutputError, match="friction.parquet"):
        stiction.loads(BLOCK).run(end=0.1, output=tmp_path, formats=["parquet"], overwrite=True)
    assert not (tmp_path / "friction.parquet").exists()
