"""Shared by the tests of the Python package: the program beside it, and a case that is solved once."""
import os
import tempfile
from pathlib import Path

import pytest

import railstrata as rs


@pytest.hookimpl(tryfirst=True)
def pytest_configure(config):
    """Folders of tests stand in one that goes with the session: pytest by itself keeps those of the last three."""
    config.folder_of_session = tempfile.TemporaryDirectory()
    config.option.basetemp = str(Path(config.folder_of_session.name) / "tests")
    config.addinivalue_line("markers", "slow: looks deeper than another test; ./railstrata test --slow")


def pytest_unconfigure(config):
    config.folder_of_session.cleanup()


@pytest.fixture(scope="session")
def program():
    return Path(os.environ["RAILSTRATA_PROGRAM"])


@pytest.fixture(scope="session")
def case():
    return rs.Case("cases/quick")


@pytest.fixture(scope="session")
def result(case):
    return rs.bem(case)


@pytest.fixture(scope="session")
def tiny_text():
    """The case of the program's tests: a disc with a crowned tread on a block, 30 mm of rolling."""
    return (Path(__file__).parents[1] / "data" / "tiny.toml").read_text()
