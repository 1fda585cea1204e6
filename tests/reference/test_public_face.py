"""The tour of the solver in its docstring shows what really comes out, and names everything that is public."""

import doctest

import autograder.reference


def test_the_tour_is_true():
    result = doctest.testmod(autograder.reference, optionflags=doctest.ELLIPSIS)
    assert result.attempted > 30 and not result.failed
