"""Shared by the tests of the Python package: the program beside it, and a case that is solved once."""
import os
from pathlib import Path

import pytest

import railstrata as rs


@pytest.fixture(scope="session")
def program():
    return Path(os.environ["RAILSTRATA_PROGRAM"])


@pytest.fixture(scope="session")
def case():
    return rs.Case("cases/quick")


@pytest.fixture(scope="session")
def result(case):
    return rs.bem(case)
