"""``lagrangian web`` from its start to its end."""

import asyncio
import json
import os
import signal
import socket
import subprocess
import sys
from pathlib import Path

import httpx
import pytest

from lagrangian import examples
from lagrangian.cli import main
from lagrangian.errors import Error
from lagrangian.web.app import Desk
from lagrangian.web.serve import ADDRESS, TOKEN_BYTES, bound, idle


@pytest.mark.slow
@pytest.mark.skipif(os.name != "posix", reason="Ctrl-C is sent as a signal")
def test_the_command_serves_its_model_until_it_is_interrupted(tmp_path: Path) -> None:
    model = tmp_path / "broken.toml"
    model.write_text("this is no model [", encoding="utf-8")
    command = [sys.executable, "-m", "lagrangian", "web", str(model), "--no-browser", "--json"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as running:
        assert running.stdout is not None and running.stderr is not None
        written = ""
        while not written.endswith("}\n"):
            written += running.stdout.readline()
        address, _, token = json.loads(written)["address"].partition("#")
        assert address.startswith(f"http://{ADDRESS}:")
        assert len(token) == TOKEN_BYTES * 4 // 3
        headers = {"x-lagrangian-token": token}
        post = {"headers": headers, "timeout": None}
        found = httpx.post(f"{address}api/models", json={}, **post).json()
        assert found["opened"] == {"name": "broken.toml", "text": "this is no model ["}
        asked = {"model": found["opened"]["text"]}
        assert httpx.post(f"{address}api/derive", json=asked, **post).json()["error"]["line"] == 1
        running.send_signal(signal.SIGINT)
        said = running.stderr.read()
        assert running.wait() == 0
    assert "Traceback" not in said
    assert token not in said
    with pytest.raises(httpx.ConnectError):
        httpx.get(address)


def test_a_port_that_is_taken_is_told() -> None:
    with bound(0) as first:
        first.listen()
        with pytest.raises(Error, match="cannot listen on port"):
            bound(first.getsockname()[1])


def test_the_socket_is_bound_to_this_computer_alone() -> None:
    with bound(0) as made:
        assert made.family == socket.AF_INET
        assert made.getsockname()[0] == "127.0.0.1"


@pytest.mark.parametrize("option", ["--host", "--address", "--listen"])
def test_no_option_changes_the_address(capsys: pytest.CaptureFixture[str], option: str) -> None:
    assert main(["web", option, "0.0.0.0"]) == 2
    assert "no such option" in capsys.readouterr().err.lower()


def test_a_file_that_cannot_be_read_is_told(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    assert main(["web", str(tmp_path / "none.toml"), "--no-browser"]) == 2
    assert "[E702]" in capsys.readouterr().err


@pytest.mark.slow
def test_after_hours_without_a_request_the_app_asks_to_be_ended() -> None:
    async def waited() -> list[str]:
        desk, said = Desk(), []
        desk.asked -= 1e6
        watching = asyncio.create_task(idle(desk, said.append))
        while not said:
            await asyncio.sleep(0.05)
        watching.cancel()
        return said

    assert asyncio.run(waited()) == ["Nothing was asked for 8 hours. If you are done, end the app with Ctrl-C."]


def test_the_page_needs_no_file_of_others() -> None:
    """What the page loads is in the package: no address of another site in it."""
    static = Path(main.__code__.co_filename).parent.parent / "web" / "static"
    for file in static.iterdir():
        text = file.read_text(encoding="utf-8").replace("http://www.w3.org/2000/svg", "")
        assert "http://" not in text and "https://" not in text and "//cdn" not in text
        assert "innerHTML" not in text and "eval(" not in text
    assert (static / "index.html").is_file() and examples.names()
