"""Which tests stay together when several workers share them (pytest-xdist, --dist loadgroup).

Long files name their own groups, so that two workers can share them.
"""

import pytest


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config, items):
    if config.pluginmanager.hasplugin("xdist"):
        for item in items:
            if item.get_closest_marker("xdist_group") is None:
                item.add_marker(pytest.mark.xdist_group(together(item)))


def together(item):
    """Name of the group: its question, so that each reference is computed once, or its file, with what it prepares."""
    question = getattr(item, "callspec", None) and item.callspec.params.get("question")
    if question is not None:
        return getattr(question, "id", question)
    return item.nodeid if item.get_closest_marker("notebook") else item.location[0]
