"""The worked example in the docstring of the package shows what really comes out."""

import doctest

from autograder.judge import chain


def test_the_worked_example_is_true():
    result = doctest.testmod(chain)
    assert result.attempted > 15 and not result.failed
