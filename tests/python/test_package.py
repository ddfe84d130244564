"""The package as such: docstrings, types, notebooks, pictures."""
import ast
import inspect
import subprocess
import sys
from pathlib import Path

import pytest

import railstrata as rs


def public_members():
    for name in rs.__all__:
        thing = getattr(rs, name)
        yield name, thing
        if inspect.isclass(thing):
            for member, value in vars(thing).items():
                if not member.startswith("_") and (callable(value) or isinstance(value, (property, classmethod))):
                    yield f"{name}.{member}", value


@pytest.mark.parametrize("name,thing", list(public_members()), ids=lambda v: v if isinstance(v, str) else "")
def test_every_public_name_has_a_docstring(name, thing):
    assert (inspect.getdoc(thing) or "").strip(), name


def functions_of(thing):
    """The functions of a public name that say what they take."""
    if inspect.isclass(thing):
        return [f for name, f in vars(thing).items() if inspect.isfunction(f) and not name.startswith("_")]
    return [thing] if inspect.isfunction(thing) else []


def test_public_functions_are_typed():
    assert (Path(rs.__file__).parent / "py.typed").exists()
    for name in rs.__all__:
        for function in functions_of(getattr(rs, name)):
            signature = inspect.signature(function)
            untyped = [p.name for p in signature.parameters.values() if p.name != "self" and p.annotation is p.empty]
            assert not untyped and signature.return_annotation is not signature.empty, (name, function, untyped)


def test_the_files_are_python_3_9():
    """One package for all versions: nothing newer is used, in the syntax and where annotations are not evaluated."""
    for file in Path(rs.__file__).parent.glob("*.py"):
        text = file.read_text(encoding="utf-8")
        ast.parse(text, feature_version=(3, 9))
        assert "tomllib" not in text and "from __future__ import annotations\n" in text, file


def test_import_prints_nothing():
    done = subprocess.run([sys.executable, "-c", "import railstrata"], capture_output=True, text=True, check=True)
    assert done.stdout == done.stderr == ""


def test_notebook_picture_has_the_numbers_and_no_script(result):
    html = result._repr_html_()
    assert f"{result.p_max / 1e6:.1f} MPa" in html and "data:image/png" in html and "<script" not in html


def test_frames_and_datasets_name_their_units(result):
    frame = result.patch.to_dataframe()
    assert frame["p"].max() == result.patch.p.max() and frame.attrs["units"]["p"] == "Pa"
    data = result.patch.to_xarray()
    assert data.p.attrs["units"] == "Pa" and data.p.dims == ("x", "y")


@pytest.mark.slow
def test_the_tutorial_runs(tmp_path):
    nbformat = pytest.importorskip("nbformat")
    execute = pytest.importorskip("nbconvert.preprocessors").ExecutePreprocessor
    notebook = nbformat.read(Path(__file__).parents[2] / "docs" / "tutorial.ipynb", as_version=4)
    assert all(not cell.get("outputs") for cell in notebook.cells), "committed without outputs"
    execute(timeout=300, kernel_name="python3").preprocess(notebook, {"metadata": {"path": str(tmp_path)}})
