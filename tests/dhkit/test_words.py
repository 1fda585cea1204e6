"""What a page or a terminal without Markdown shows of things that say themselves in it."""

import pytest

from dhkit.arms import arm_of, log_of
from dhkit.own_arms import joint_list
from dhkit.sheets import sheet_of
from dhkit.variants import variant
from dhkit.words import plain


@pytest.mark.parametrize(
    ("markdown", "words"),
    [
        (r"**Your arm** `mine.t_min`: $q_{1}$ at $(l_1,\ -e)$", "Your arm mine.t_min: q1 at (l1, -e)"),
        (r"| $- \frac{\pi}{2}$ | $+Z_0$ |", "| - pi/2 | +Z0 |"),
        ("a_b and c", "a_b and c"),
    ],
)
def test_marks_are_left_out_and_words_stay(markdown, words):
    assert plain(markdown) == words


def test_what_a_statement_shows_is_readable_without_markdown():
    things = (
        arm_of({"arm": "crane"}), log_of({"arm": "crane"}),
        sheet_of(variant("direct_models", "ada")), joint_list(variant("tables", "ada")),
    )  # fmt: skip
    for thing in things:
        said = repr(thing)
        assert not set("$*`\\") & set(said) and "(" not in said.split("\n")[0] and said.count("\n") > 5, said
