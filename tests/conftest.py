"""In which order the files of tests are given out when several workers share them (pytest-xdist, --dist loadfile)."""

import pytest

LONG = {"test_newcomer.py", "test_steps.py"}


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items):
    """What takes longest comes first, kernels most of all: no worker is left alone with it in the end."""
    items.sort(key=lambda item: item.path.name not in LONG and item.get_closest_marker("sandbox") is None)
