"""Models and results that are written to disk."""

import os
import pickle
from pathlib import Path

import numpy as np
import pyarrow.parquet  # type: ignore[import-untyped]
import pytest
import stiction
from models import BLOCK, EXAMPLES


def test_a_changed_model_is_written_with_its_comments_and_layout(tmp_path: Path) -> None:
    path = EXAMPLES / "lugre-slider" / "lugre_slider.adm"
    model = stiction.load(path).replace({"guide.mu_static": 0.35, "INTEGRATOR.error": 1e-7})
    model.write(tmp_path / "stickier.adm")
    before = path.read_text().splitlines()
    after = (tmp_path / "stickier.adm").read_text().splitlines()
    assert len(after) == len(before)
    changed = [new for old, new in zip(before, after) if old != new]
    assert len(changed) == 2
    assert any("0.35" in line for line in changed) and any("1e-07" in line for line in changed)
    # It is the same model: a run of it is the same to the last bit.
    again = stiction.load(tmp_path / "stickier.adm")
    np.testing.assert_array_equal(
        again.run(end=15.0, dtout=0.5).values, model.run(end=15.0, dtout=0.5).values
    )


def test_a_file_that_is_there_is_not_overwritten(tmp_path: Path) -> None:
    model = stiction.loads(BLOCK)
    path = tmp_path / "m.adm"
    model.write(path)
    assert path.read_text() == BLOCK
    with pytest.raises(stiction.OutputError, match="overwrite=True"):
        model.replace({"rub.mu_static": 0.5}).write(path)
    model.replace({"rub.mu_static": 0.5}).write(path, overwrite=True)
    assert path.read_text() == BLOCK.replace("MU_STATIC=0.3", "MU_STATIC=0.5")
    with pytest.raises(stiction.OutputError, match="cannot write"):
        model.write(tmp_path / "nowhere" / "m.adm")
    assert [file.name for file in tmp_path.iterdir()] == ["m.adm"]


def test_a_saved_result_has_the_files_of_a_run(tmp_path: Path) -> None:
    formats = ["parquet", "csv"]
    run, saved = tmp_path / "run", tmp_path / "deep" / "saved"
    model = stiction.loads(BLOCK).replace({"guide.mu_static": 0.25})
    result = model.run(end=1.0, dtout=1e-3, output=run, formats=formats)
    # A result can travel before it is saved.
    pickle.loads(pickle.dumps(result)).save(saved, formats)
    names = sorted(file.name for file in run.iterdir())
    assert sorted(file.name for file in saved.iterdir()) == names
    for name in names:
        if name.endswith((".csv", ".msg")):
            assert (saved / name).read_bytes() == (run / name).read_bytes(), name
    for name in ("friction.parquet", "states.parquet"):
        tables = [pyarrow.parquet.read_table(folder / name) for folder in (saved, run)]
        assert tables[0].equals(tables[1]), name
        assert tables[0].schema.metadata == tables[1].schema.metadata
    assert (saved / "tables.json").read_text() == (run / "tables.json").read_text()


def test_a_folder_in_use_is_refused(tmp_path: Path) -> None:
    model = stiction.loads(BLOCK)
    result = model.run(end=0.1)
    folder = tmp_path / "run"
    folder.mkdir()
    # An empty folder will do.
    result.save(folder)
    for write in (lambda: result.save(folder), lambda: model.run(end=0.1, output=folder)):
        with pytest.raises(stiction.OutputError, match="is not empty"):
            write()
    assert model.run(end=0.1, output=folder, overwrite=True).success
    assert sorted(file.name for file in folder.iterdir()) == ["model.msg", "model.req", "model.res"]
    with pytest.raises(stiction.ParameterError, match="is parquet meant"):
        result.save(tmp_path / "other", ["parkuet"])
    (tmp_path / "third.part").mkdir()
    with pytest.raises(stiction.OutputError, match="third.part is there"):
        result.save(tmp_path / "third")
    assert not (tmp_path / "other").exists() and not (tmp_path / "third").exists()


@pytest.mark.skipif(os.name != "posix", reason="limits of files are those of Unix")
def test_a_full_disk_leaves_nothing_that_looks_whole(tmp_path: Path) -> None:
    import resource
    import signal

    result = stiction.loads(BLOCK).run(end=1.0, steps=8000)
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    ignored = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, before[1]))
    try:
        with pytest.raises(stiction.OutputError, match="friction.parquet"):
            result.save(tmp_path / "saved")
        with pytest.raises(stiction.OutputError, match="friction.parquet"):
            stiction.loads(BLOCK).run(
                end=1.0, steps=8000, output=tmp_path / "run", formats=["parquet"]
            )
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
        signal.signal(signal.SIGXFSZ, ignored)
    assert [folder.name for folder in tmp_path.iterdir()] == ["run"]
    assert not list(tmp_path.glob("run/*.parquet"))
