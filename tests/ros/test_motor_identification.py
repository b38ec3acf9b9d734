"""The identification node as a process: the service fits, the model is latched, and the node stays alive meanwhile."""

from collections.abc import Callable
from pathlib import Path
from subprocess import Popen

import pytest
from friction import KS
from rcl_interfaces.srv import GetParameters
from workbench import Bench, end

from motor_model.model_file import load
from motor_model.parameters import PAPER_KA, PAPER_KV
from motor_msgs.msg import MotorModel
from motor_msgs.srv import Identify
from motor_ros import qos

Start = Callable[..., "Popen[str]"]


def serve(start: Start, bags: Path, *arguments: str) -> "Popen[str]":
    return start(
        "motor_identification", "motor_identification", "--ros-args", "-p", f"bag_directory:={bags}", *arguments
    )


def test_identifies_latches_and_writes_the_model(bench: Bench, start: Start, bags: Path, tmp_path: Path) -> None:
    process = serve(start, bags, "-p", f"model_file:={tmp_path / 'model.yaml'}")
    request = Identify.Request(bag_uris=["staircase"], effects=["coulomb_friction"])
    response = bench.call(Identify, "motor/identify", request)
    assert response.success, response.message
    model = dict(zip(response.model.parameter_names, response.model.parameter_values, strict=True))
    for name, true in (("kv", PAPER_KV), ("ka", PAPER_KA), ("ks", KS)):
        assert model[name] == pytest.approx(true, rel=1e-4)
    assert response.model.effects == ["coulomb_friction"]
    assert all(
        0.0 < error < 0.01 * value for error, value in zip(response.model.standard_errors, model.values(), strict=True)
    )
    assert list(response.model.on_bound) == [False] * 3 and not response.not_identifiable
    assert 0.9 < response.model.residual_rms / response.model.noise_floor < 1.1
    assert 0.99999 < response.r_squared < 1.0 and 0.0 < response.duration < 60.0
    assert "kv = 0.06892" in response.message
    latched = bench.hear(MotorModel, "motor/model", qos.MODEL)  # later than the publication
    bench.wait(lambda: bool(latched), "the latched model")
    assert latched[0] == response.model
    assert load(tmp_path / "model.yaml").value("ks") == pytest.approx(KS, rel=1e-4)
    end(process)
    assert process.returncode == 0


def test_answers_others_while_it_computes_and_ends_at_once(bench: Bench, start: Start, bags: Path) -> None:
    process = serve(start, bags)
    client = bench.node.create_client(Identify, "motor/identify")
    bench.wait(client.service_is_ready, "the service")
    hard = Identify.Request(bag_uris=["staircase"], effects=["static_friction"], particles=2000, epochs=100_000)
    computing = client.call_async(hard)
    for _ in range(5):
        answer = bench.call(
            GetParameters, "motor_identification/get_parameters", GetParameters.Request(names=["particles"])
        )
        assert answer.values[0].integer_value == 50
        assert not computing.done()
    end(process)  # within a second, whatever its worker does
    assert process.returncode == 0


@pytest.mark.parametrize(
    ("request_", "words"),
    [
        (Identify.Request(), "bag_uris is empty"),
        (Identify.Request(bag_uris=["nowhere"]), "There is no bag"),
        (Identify.Request(bag_uris=["staircase"], effects=["magic"]), "'magic' is not an effect"),
        (Identify.Request(bag_uris=["staircase"], topic_namespace="left"), "/left/motor/speed"),
        (Identify.Request(bag_uris=["staircase"], start=100.0, stop=200.0), "--start 100 s is after its end"),
        (Identify.Request(bag_uris=["staircase"], start=2.0, stop=1.0), "--start"),
    ],
)
def test_a_bad_request_is_one_sentence(bench: Bench, node: None, request_: Identify.Request, words: str) -> None:
    response = bench.call(Identify, "motor/identify", request_)
    assert not response.success
    assert words in response.message and "\n" not in response.message
    assert response.model.parameter_names == []


@pytest.fixture(scope="module")
def node(bags: Path) -> object:
    """One node for all bad requests: it lives on after each."""
    import workbench

    process = workbench.start(
        "motor_identification", "motor_identification", "--ros-args", "-p", f"bag_directory:={bags}"
    )
    yield None
    assert process.poll() is None
    end(process)
