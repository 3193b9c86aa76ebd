"""Reading, changing, pickling and showing models."""

import pickle

import pytest
import stiction
from models import BLOCK, EXAMPLES


def test_a_dataset_and_a_command_file_are_read() -> None:
    model = stiction.load(EXAMPLES / "lugre-slider" / "lugre_slider.adm")
    assert model.title.startswith("A block pulled by a spring")
    assert list(model.parts) == ["ground", "BLOCK", "CARRIAGE"]
    assert model.parts["block"].mass == 1.0 and model.parts[1].ground
    assert model.commands == ()
    assert model.units["length"] == "meter"
    commands = stiction.load(str(EXAMPLES / "incline" / "incline.acf")).commands
    assert commands[1].startswith("SIMULATE/DYNAMIC")


def test_elements_are_found_by_name_and_id() -> None:
    model = stiction.loads(BLOCK)
    joint = model.joints["guide"]
    assert (joint.id, joint.kind, joint.i, joint.j) == (5, "TRANSLATIONAL", 20, 1)
    assert joint.friction is model.frictions["RUB"] is model.frictions[7] is model.frictions["GUIDE"]
    assert model.elements("sforce")["PULL"].text.startswith("SFORCE/1")
    assert list(model.frictions) == ["RUB"] and len(model.frictions) == 1


def test_frictions_have_their_arguments_with_units() -> None:
    friction = stiction.loads(BLOCK).frictions["RUB"]
    assert friction.mu_static == 0.3
    assert friction.inputs == ["REACTION_FORCE"]
    assert friction.stiction_transition_velocity == 0.001
    assert friction.units["stiction_transition_velocity"] == "meter/sec"
    assert friction.initial_overlap == 1000.0 and "initial_overlap" not in friction.given
    assert "max_stiction_deformation=1e-05 meter" in repr(friction)
    with pytest.raises(AttributeError, match="is mu_static .*meant"):
        friction.mu_statik  # noqa: B018


def test_a_change_makes_another_model() -> None:
    model = stiction.loads(BLOCK)
    other = model.replace({"guide.mu_static": 0.25, "FRICTION/7.MU_DYNAMIC": 0.1})
    assert model.frictions["RUB"].mu_static == 0.3
    assert (other.frictions["RUB"].mu_static, other.frictions["RUB"].mu_dynamic) == (0.25, 0.1)
    assert other.changes == ("FRICTION/7, MU_STATIC=0.25", "FRICTION/7, MU_DYNAMIC=0.1")
    assert other.checksum != model.checksum
    pulled = other.replace({"pull.function": "20*TIME", "INTEGRATOR.error": 1e-5})
    assert "20*TIME" in pulled.elements("SFORCE")["PULL"].text


def test_units_are_converted_or_refused() -> None:
    model = stiction.loads(BLOCK)
    slower = model.replace(
        {"guide.stiction_transition_velocity": stiction.Quantity(5.0, "mm/s")}
    )
    assert slower.frictions["RUB"].stiction_transition_velocity == pytest.approx(0.005, rel=1e-15)
    for unit, message in [("mm", "cannot be given in meter/sec"), ("m/ss", "no unit .ss.; is"), ("2", "no unit")]:
        wrong = stiction.Quantity(5.0, unit)
        with pytest.raises(stiction.ParameterError, match=message):
            model.replace({"guide.stiction_transition_velocity": wrong})
    with pytest.raises(stiction.ParameterError, match="a plain number"):
        model.replace({"guide.mu_static": stiction.Quantity(0.3, "N")})


@pytest.mark.parametrize(
    ("place", "value", "error", "message"),
    [
        ("gide.mu_static", 0.1, stiction.UnknownName, "is GUIDE meant"),
        ("mu_static", 0.1, stiction.ParameterError, "names no argument"),
        ("guide.mu_static", float("nan"), stiction.ParameterError, "finite"),
        ("guide.mu_static", float("inf"), stiction.ParameterError, "finite"),
        ("guide.mu_static", "0.1\nEND", stiction.ParameterError, "one line"),
        ("guide.mu_static", -0.1, stiction.InputError, "MU_STATIC"),
        ("guide.mu_statik", 0.1, stiction.InputError, "MU_STATIC"),
        ("guide.formulation", "LUGRE", stiction.InputError, "cannot change FORMULATION"),
    ],
)
def test_changes_that_cannot_be_made(
    place: str, value: stiction.Value, error: type[Exception], message: str
) -> None:
    with pytest.raises(error, match=message):
        stiction.loads(BLOCK).replace({place: value})


def test_errors_carry_their_place() -> None:
    wrong = BLOCK.replace("MU_STATIC=0.3", "MU_STATIK=0.3").replace("JOINT/5,", "JIONT/5,")
    with pytest.raises(stiction.InputError) as caught:
        stiction.loads(wrong, "folder/wrong.adm")
    first, *others = caught.value.diagnostics
    assert (first.file, first.line, first.column) == ("folder/wrong.adm", 10, 1)
    assert first.severity == "error" and first.code == "unknown-statement"
    assert others and str(caught.value).startswith("folder/wrong.adm:10:1: error[unknown-statement]")
    assert "JIONT" in caught.value.diagnostics._repr_html_()
    with pytest.raises(stiction.InputError, match="cannot read"):
        stiction.load("no such file.adm")


def test_a_command_file_in_memory_finds_its_dataset() -> None:
    commands = "\nFILE/MODEL=block\nSIMULATE/DYNAMIC, END=0.1, STEPS=10\nSTOP\n"
    model = stiction.loads(commands, "run.acf", {"block.adm": BLOCK})
    assert len(model.run().time) == 11


def test_models_survive_pickling() -> None:
    model = stiction.loads(BLOCK).replace({"guide.mu_static": 0.25})
    again = pickle.loads(pickle.dumps(model))
    assert again.frictions["RUB"].mu_static == 0.25
    assert again.checksum == model.checksum and again.changes == model.changes
    acf = stiction.load(EXAMPLES / "incline" / "incline.acf")
    assert pickle.loads(pickle.dumps(acf)).commands == acf.commands


def test_notebooks_show_models() -> None:
    html = stiction.loads(BLOCK.replace("A block that", "A <block> that"))._repr_html_()
    assert "A &lt;block&gt; that" in html and "RUB" in html
