"""WebAssembly: modules that our linker makes, run in Node, and object files that it refuses."""

import json
import shutil
import subprocess

import numpy as np
import pytest
from compile_programs import oracle, program
from test_backends import every_function

from lagrangian.codegen import native, wasm
from lagrangian.codegen.emit import emit
from lagrangian.codegen.tape import lower
from lagrangian.codegen.wasm_link import LinkError, linked

NODE = shutil.which("node")
needs_node = pytest.mark.skipif(NODE is None, reason="node is not installed")
HEAD = 'target triple = "wasm32-unknown-unknown"\n'

HOST = """
const memory = new WebAssembly.Memory({initial: 4});
const stack = new WebAssembly.Global({value: "i32", mutable: true}, 131072);
const env = {__linear_memory: memory, __stack_pointer: stack};
const code = new WebAssembly.Instance(new WebAssembly.Module(require("fs").readFileSync(FILE)), {env, Math}).exports;
const at = 131072, block = (place, n) => new Float64Array(memory.buffer, place, n);
"""


def object_file(text: str) -> bytes:
    return native.object_code(HEAD + text, wasm.target(), 2)


def run(code: bytes, script: str, folder) -> list:
    (folder / "module.wasm").write_bytes(code)
    head = HOST.replace("FILE", json.dumps(str(folder / "module.wasm")))
    done = subprocess.run([NODE, "-e", head + script], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr[-2000:]
    return json.loads(done.stdout)


@needs_node
@pytest.mark.parametrize("lanes", [1, 2])
def test_every_function_in_one_lane_and_two(lanes, tmp_path):
    made = program(every_function, q=("a", "b"), p=("c",))
    tape = lower(made, ()).body
    found = wasm.compiled(lambda module: emit(module, "body", tape, lanes), ["body"])
    assert set(found.imports) <= wasm.IMPORTS and {name for _, name in found.imports} >= {"pow", "asinh"}
    q = np.random.default_rng(2).uniform(-3, 3, (20, 2))
    rows = json.dumps([[*row.tolist(), 1.7] for row in q])
    script = f"""const rows = {rows}, n = {len(tape.outputs)}, lanes = {lanes};
    console.log(JSON.stringify(rows.map((row, k) => {{
      const other = rows[(k + 1) % rows.length];
      row.forEach((x, i) => block(at, 3 * lanes).set(lanes === 1 ? [x] : [other[i], x], lanes * i));
      code.body(at, 0, at + 1024, at + 8192);
      return Array.from({{length: n}}, (_, i) => block(at + 1024, n * lanes)[lanes * i + lanes - 1]);
    }})));"""
    wanted = [oracle(made, {"q": row, "p": [1.7]}) for row in q]
    np.testing.assert_allclose(run(found.code, script, tmp_path), wanted, rtol=1e-12)


@needs_node
def test_sine_and_cosine_of_huge_angles_are_those_of_the_host(tmp_path):
    made = program(lambda g, x: {"r": [x["a"].apply("sin"), x["a"].apply("cos")]}, q=("a",))
    found = wasm.compiled(lambda module: emit(module, "body", lower(made, ()).body, 1), ["body"])
    script = """console.log(JSON.stringify([1.5, 1e10, 1e300].map((x) => {
      block(at, 1)[0] = x; code.body(at, 0, at + 64, at + 128); return Array.from(block(at + 64, 2)); })))"""
    wanted = [oracle(made, {"q": [x]}) for x in (1.5, 1e10, 1e300)]
    np.testing.assert_allclose(run(found.code, script, tmp_path), wanted, rtol=1e-14)


@needs_node
def test_data_of_a_module_are_where_it_looks_for_them(tmp_path):
    text = """@here = internal constant [3 x double] [double 1.5, double 2.5, double 3.5]
define double @f(i32 %k) {
  %a = getelementptr double, ptr @here, i32 %k
  %y = load double, ptr %a
  ret double %y
}"""
    found = linked(object_file(text), ["f"])
    assert found.data == 24 and found.imports == ()
    assert run(found.code, "console.log(JSON.stringify([0, 1, 2].map((k) => code.f(k))))", tmp_path) == [1.5, 2.5, 3.5]


UNDEFINED = {
    "a function": ("declare double @mystery()", "%y = call double @mystery()", "'mystery' of 'env' is not defined"),
    "a weak function": ("declare extern_weak double @w()", "%y = call double @w()", "'w' of 'env' is not defined"),
    "data": ("@where = external global double", "%y = load double, ptr @where", "the data 'where' are not defined"),
    "the C library": ("", "%z = load double, ptr null\n  %y = frem double %z, 3.0", "'fmod' of 'env' is not defined"),
    "an unknown import": (
        'declare double @s() "wasm-import-module"="Math" "wasm-import-name"="random"',
        "%y = call double @s()",
        "'random' of 'Math' is not defined",
    ),
    "a table of functions": (
        "define internal double @g() {\n  ret double 1.0\n}\n@t = global ptr @g",
        "%p = load volatile ptr, ptr @t\n  %y = call double %p()",
        "a relocation of kind 20, which is not in place",
    ),
}


@pytest.mark.parametrize("kind", UNDEFINED)
def test_what_is_not_defined_is_refused(kind):
    declared, used, said = UNDEFINED[kind]
    text = f"{declared}\ndefine double @f() {{\n  {used}\n  ret double %y\n}}"
    with pytest.raises(LinkError, match=said):
        linked(object_file(text), ["f"], wasm.IMPORTS)


def test_an_address_of_a_function_in_data_is_refused():
    text = "define internal double @g() {\n  ret double 1.0\n}\n@t = global ptr @g\ndefine ptr @f() {\n  ret ptr @t\n}"
    with pytest.raises(LinkError, match="not in place"):
        linked(object_file(text), ["f"])


def test_an_export_that_is_not_there_is_refused():
    with pytest.raises(LinkError, match="has no function g"):
        linked(object_file("define void @f() {\n  ret void\n}"), ["f", "g"])


@pytest.mark.parametrize("content", [b"", b"\x7fELF", b"\0asm\2\0\0\0"])
def test_other_files_are_refused(content):
    with pytest.raises(LinkError, match="not an object file"):
        linked(content, [])


def test_the_key_of_a_module_does_not_name_this_machine():
    target = wasm.target()
    assert target.triple.startswith("wasm32") and target.cpu == "generic" and not target.fma
    assert native.host().features not in target.features
