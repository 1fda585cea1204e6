"""In which order the files of tests are given out when several workers share them (pytest-xdist, --dist loadfile)."""

import pytest


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items):
    """What starts kernels takes longest, so it comes first: no worker is left alone with it in the end."""
    items.sort(key=lambda item: item.get_closest_marker("sandbox") is None)
