"""Who may ask the app: every row of the table of limits, as a browser or an attacker would try it."""

import json
import socket
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

pytest.importorskip("starlette")
pytest.importorskip("uvicorn")

from served_app import TOKEN, Served, served

from lagrangian.web.guard import MAX_BODY, MAX_HEAD
from lagrangian.web.pool import PoolLimits
from lagrangian.web.serve import CONNECTIONS


@pytest.fixture(scope="module")
def app() -> Iterator[Served]:
    with served(PoolLimits(workers=1, spare=0), body_seconds=0.5) as found:  # one process starts: no job is long
        yield found


HOST = "127.0.0.1:PORT"


def head(app: Served, **changed: str | None) -> str:
    """The head of a request for the models, with lines changed or left out (None)."""
    lines: dict[str, str | None] = {
        "Host": HOST,
        "Content-Type": "application/json",
        "X-Lagrangian-Token": TOKEN,
        "Content-Length": "2",
        "Connection": "close",
    }
    lines |= {name.replace("_", "-"): value for name, value in changed.items()}
    listed = [f"{name}: {value}" for name, value in lines.items() if value is not None]
    return "\r\n".join(["POST /api/models HTTP/1.1", *listed, "", ""]).replace("PORT", str(app.port))


def status(answer: bytes) -> int:
    return int(answer.split(b" ", 2)[1])


def test_the_app_answers_its_own_page(app: Served) -> None:
    answer = app.raw(head(app).encode() + b"{}")
    assert status(answer) == 200
    assert b'"lecture-1"' in answer


@pytest.mark.parametrize("name", ["127.0.0.1", "localhost", "[::1]", "LocalHost"])
def test_the_app_has_the_names_of_this_computer(app: Served, name: str) -> None:
    assert status(app.raw(head(app, Host=f"{name}:PORT").encode() + b"{}")) == 200


REFUSED = {
    "a name that an attacker points here": (421, {"Host": "evil.example:PORT"}),
    "a name that ends as ours": (421, {"Host": "evil-127.0.0.1:PORT"}),
    "another port": (421, {"Host": "127.0.0.1:1"}),
    "no port": (421, {"Host": "127.0.0.1"}),
    "all addresses": (421, {"Host": "0.0.0.0:PORT"}),
    "an empty host": (421, {"Host": ""}),
    "another site": (403, {"Origin": "https://evil.example"}),
    "another app on this computer": (403, {"Origin": "http://127.0.0.1:1"}),
    "another name of this app": (403, {"Origin": "http://localhost:PORT"}),
    "a page without an origin": (403, {"Origin": "null"}),
    "an encrypted page of the same name": (403, {"Origin": f"https://{HOST}"}),
    "a request that the browser calls cross-site": (403, {"Sec_Fetch_Site": "cross-site"}),
    "another port, by the browser's word": (403, {"Sec_Fetch_Site": "same-site"}),
    "a form that somebody opened": (403, {"Sec_Fetch_Site": "none"}),
    "no token": (401, {"X_Lagrangian_Token": None}),
    "a wrong token": (401, {"X_Lagrangian_Token": "b" * 32}),
    "the beginning of the token": (401, {"X_Lagrangian_Token": TOKEN[:-1]}),
    "a token with more": (401, {"X_Lagrangian_Token": TOKEN + "a"}),
    "a form": (415, {"Content_Type": "application/x-www-form-urlencoded"}),
    "a form with a file": (415, {"Content_Type": "multipart/form-data; boundary=x"}),
    "plain text, as a form can send it": (415, {"Content_Type": "text/plain"}),
    "JSON in the name only": (415, {"Content_Type": "text/plain; application/json"}),
    "no type": (415, {"Content_Type": None}),
    "a body larger than a request may be": (413, {"Content_Length": str(MAX_BODY + 1)}),
    "a head larger than it may be": (431, {"X_Filler": "x" * MAX_HEAD}),
}


@pytest.mark.sampled(4)
@pytest.mark.parametrize("case", REFUSED)
def test_a_request_that_is_not_of_the_own_page_is_refused(app: Served, case: str) -> None:
    expected, changed = REFUSED[case]
    assert status(app.raw(head(app, **changed).encode() + b"{}")) == expected
    assert status(app.raw(head(app).encode() + b"{}")) == 200


def test_a_head_that_never_ends_is_refused(app: Served) -> None:
    begun = head(app)[:-4] + "\r\nX-Filler: "
    with socket.create_connection(("127.0.0.1", app.port)) as connection:
        connection.sendall(begun.encode())
        found = b""
        while not found:
            try:
                connection.sendall(b"x" * 8192)
                connection.setblocking(False)
                found = connection.recv(100)
            except BlockingIOError:
                pass
            except ConnectionError:
                found = b"closed"
            finally:
                connection.setblocking(True)
    assert found == b"closed" or status(found) in (400, 431)


def test_a_body_without_a_length_is_counted(app: Served) -> None:
    begun = head(app, Content_Length=None, Transfer_Encoding="chunked").encode()
    chunk = b"10000\r\n" + b"x" * 0x10000 + b"\r\n"
    assert status(app.raw(begun, *[chunk] * (MAX_BODY // 0x10000), b"1\r\nx\r\n")) == 413


def test_a_body_that_does_not_arrive_is_given_up(app: Served) -> None:
    assert status(app.raw(head(app, Content_Length="100").encode() + b"{")) == 408


@pytest.mark.parametrize(
    "body",
    [b"", b"{", b"[]", b"3", b'"{}"', b'{"a": NaN}', b"\xff\xfe{}", b"[" * 100_000, b'{"a": Infinity}', b"{} {}"],
    ids=repr,
)
def test_a_broken_body_is_one_answer(app: Served, body: bytes) -> None:
    answer = app.raw(head(app, Content_Length=str(len(body))).encode() + body)
    assert status(answer) == 400
    assert json.loads(answer.partition(b"\r\n\r\n")[2])["error"]["what"]


@pytest.mark.parametrize("method", ["GET", "PUT", "DELETE", "OPTIONS", "PATCH", "HEAD", "TRACE"])
def test_a_verb_is_asked_by_post_alone(app: Served, method: str) -> None:
    answer = app.raw(head(app).replace("POST", method).encode() + b"{}")
    assert status(answer) == 405


@pytest.mark.parametrize("path", ["/", "/app.js", "/api/models", "/none", "/api/none"])
def test_every_answer_has_the_headers_that_protect_it(app: Served, path: str) -> None:
    answer = app.raw(head(app).replace("POST /api/models", f"GET {path}").encode() + b"{}")
    lines = answer.partition(b"\r\n\r\n")[0].decode().lower().split("\r\n")[1:]
    found = dict(line.split(": ", 1) for line in lines)
    policy = dict(part.strip().split(" ", 1) for part in found["content-security-policy"].split(";"))
    assert policy["default-src"] == "'none'"
    assert policy["script-src"] == "'self' 'wasm-unsafe-eval'"
    assert policy["frame-ancestors"] == policy["base-uri"] == policy["form-action"] == "'none'"
    assert found["x-content-type-options"] == "nosniff"
    assert found["cross-origin-opener-policy"] == found["cross-origin-resource-policy"] == "same-origin"
    assert found["cache-control"] == "no-store"
    assert not [name for name in found if name.startswith("access-control-") or name == "server"]


@pytest.mark.parametrize(
    "path", ["/../app.py", "/%2e%2e/app.py", "/static/app.js", "//etc/passwd", "/app.js/..", "/..%5capp.py", "/app.py"]
)
def test_no_address_is_a_path(app: Served, path: str) -> None:
    answer = app.raw(head(app).replace("POST /api/models", f"GET {path}").encode() + b"{}")
    assert status(answer) == 404


def test_the_page_is_served_without_the_token(app: Served) -> None:
    for path in ("/", "/app.js", "/app.css", "/derivation.css", "/icon.svg"):
        request = head(app, X_Lagrangian_Token=None, Content_Type=None, Content_Length=None, Sec_Fetch_Site="none")
        assert status(app.raw(request.replace("POST /api/models", f"GET {path}").encode())) == 200


def test_no_answer_contains_the_token(app: Served) -> None:
    for path in ("/", "/app.js", "/none"):
        assert TOKEN.encode() not in app.raw(head(app).replace("POST /api/models", f"GET {path}").encode() + b"{}")


def test_connections_are_counted(app: Served) -> None:
    held = [socket.create_connection(("127.0.0.1", app.port)) for _ in range(CONNECTIONS + 4)]
    try:
        assert status(app.raw(head(app).encode() + b"{}")) == 503
    finally:
        for connection in held:
            connection.close()


@pytest.mark.skipif(sys.platform != "linux", reason="Linux lists the sockets that listen in a file")
def test_the_app_listens_on_this_computer_alone(app: Served) -> None:
    rows = [line.split() for line in Path("/proc/net/tcp").read_text(encoding="ascii").splitlines()[1:]]
    listening = "0A"
    own = [row[1] for row in rows if row[3] == listening and row[1].endswith(f":{app.port:04X}")]
    assert own == [f"0100007F:{app.port:04X}"]
