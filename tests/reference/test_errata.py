"""Every erratum is proved by computation, and the proof can fail."""

import re
from collections import Counter
from dataclasses import FrozenInstanceError, replace

import pytest
import sympy as sp

from autograder.reference import errata
from autograder.reference.errata.proof import agree, assembled

pytestmark = [pytest.mark.filterwarnings("error"), pytest.mark.slow]
ALL = errata.ERRORS + errata.AMBIGUITIES


def with_roles(check, right):
    """The same check with other forms claimed to be right."""
    return replace(
        check, readings=tuple(replace(reading, right=claim) for reading, claim in zip(check.readings, right))
    )


@pytest.mark.parametrize("erratum", ALL, ids=lambda e: e.id)
def test_proved(erratum):
    proof = erratum.prove()
    assert proof.printed_fails, proof.detail
    assert proof.corrected_holds, proof.detail
    assert proof.proved and proof.detail.startswith("Test: ")
    assert {reading.right for reading in erratum.check.readings} == {True, False}


@pytest.mark.parametrize("erratum", ALL, ids=lambda e: e.id)
def test_swapping_printed_and_corrected_fails(erratum):
    swapped = with_roles(erratum.check, [not r.right for r in erratum.check.readings])()
    assert not swapped.printed_fails and not swapped.corrected_holds and not swapped.proved


@pytest.mark.parametrize("erratum", ALL, ids=lambda e: e.id)
def test_no_form_can_be_claimed_the_other_way(erratum):
    """Each form by itself decides its verdict: claim the opposite of one, and the proof fails."""
    truth = [reading.right for reading in erratum.check.readings]
    for k in range(len(truth)):
        claimed = [not right if n == k else right for n, right in enumerate(truth)]
        assert not with_roles(erratum.check, claimed)().proved, erratum.check.readings[k].words


def test_they_are_all_there():
    assert Counter(e.document for e in errata.ERRORS) == {
        "MECA 953 slides": 14,
        "EPFL slides": 4,
        "DH-m slides (Romanian)": 10,
        "pen robot sheet": 2,
        "Adept s600 tutorial": 4,
    }
    assert Counter(e.document for e in errata.AMBIGUITIES) == {
        "MECA 953 slides": 11,
        "EPFL slides": 9,
        "DH-m slides (Romanian)": 2,
        "pen robot sheet": 2,
        "Adept s600 tutorial": 3,
    }
    assert len({e.id for e in ALL}) == 61


def test_they_are_usable_as_data():
    for erratum in ALL:
        assert re.fullmatch(r"00[0-4]-[A-Za-z0-9-]+", erratum.id)
        assert re.fullmatch(r"L\d+(-\d+)?(, L\d+(-\d+)?)*", erratum.line), erratum.line
        assert erratum.printed and erratum.corrected and erratum.why
        assert erratum.printed != erratum.corrected
    assert errata.find("004-app-sin") in errata.ERRORS
    assert errata.find("003-remark") in errata.AMBIGUITIES
    with pytest.raises(KeyError, match="004-app-sin"):
        errata.find("004-app-cos")
    with pytest.raises(FrozenInstanceError):
        errata.ERRORS[0].line = "L1"


def test_the_proof_names_every_reading():
    detail = errata.find("003-remark").prove().detail
    assert detail.count("fails: ") == 3 and detail.count("holds: ") == 1


def test_agreement_notices_a_single_sign_and_shapes():
    x, y = sp.symbols("x y")
    assert agree(sp.sin(x + y), sp.sin(x) * sp.cos(y) + sp.cos(x) * sp.sin(y))
    assert not agree(sp.sin(x + y), sp.sin(x) * sp.cos(y) - sp.cos(x) * sp.sin(y))
    assert not agree(sp.Matrix([x, y]), sp.Matrix([[x, y]]))
    assert not agree(x, y)
    assert assembled([[sp.eye(2), sp.zeros(2, 1)], [sp.zeros(1, 2), 1]]) == sp.eye(3)
    assert assembled([[sp.eye(2), 1]]) is None and assembled([[sp.eye(2)], [1]]) is None


def test_the_page_shows_every_statement_and_says_when_a_proof_fails():
    page = errata.as_html(ALL)
    assert page.count("<tr>") == 1 + len(ALL) and page.count("<b>proved</b>") == len(ALL)
    fooled = replace(errata.find("004-app-sin"), printed="a < b")
    fooled = replace(fooled, check=with_roles(fooled.check, [True, True]))
    assert "a &lt; b" in errata.as_html([fooled]) and "NOT PROVED" in errata.as_html([fooled])
