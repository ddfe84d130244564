"""The package as such: docstrings, types, notebooks, pictures."""
import inspect
import re
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


def test_names_listed_are_there_and_typed():
    folder = Path(rs.__file__).parent
    assert (folder / "py.typed").exists()
    stub = (folder / "_core.pyi").read_text()
    from railstrata import _core

    missing = [n for n in vars(_core) if not n.startswith("_") and not re.search(rf"(def|class) {n}\b", stub)]
    assert not missing


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


def test_the_tutorial_runs(tmp_path):
    nbformat = pytest.importorskip("nbformat")
    execute = pytest.importorskip("nbconvert.preprocessors").ExecutePreprocessor
    notebook = nbformat.read(Path(__file__).parents[2] / "docs" / "tutorial.ipynb", as_version=4)
    assert all(not cell.get("outputs") for cell in notebook.cells), "committed without outputs"
    execute(timeout=300, kernel_name="python3").preprocess(notebook, {"metadata": {"path": str(tmp_path)}})
