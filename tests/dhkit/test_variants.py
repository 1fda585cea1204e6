"""Numbers of one's own: the same on every machine, different from student to student, never outside their range."""

import importlib
import os
import subprocess
import sys

import pytest

from dhkit import variants, wire
from dhkit.variants import mark, normal_form, numbers, variant

RANGES = {"L1": (0.4, 0.6, 0.02), "x": (-0.3, 0.3, 0.1), "elbow": ("up", "down")}


@pytest.fixture(autouse=True)
def ranges(monkeypatch):
    monkeypatch.setattr(variants, "variant_ranges", lambda exercise: RANGES if exercise == "arm" else {})
    monkeypatch.setattr(variants, "_typed", {})


def test_the_numbers_of_a_student_never_change():
    """Written down once: a change of machine, of Python or of this code that moves them would make a class's answers wrong."""
    assert numbers("arm", "ada") == {"L1": 0.44, "x": 0.0, "elbow": "up"}
    assert numbers("arm", "Emmy Noether") == {"L1": 0.4, "x": -0.2, "elbow": "down"}
    assert numbers("arm", "学生") == {"L1": 0.42, "x": 0.3, "elbow": "up"}


@pytest.mark.slow
def test_a_fresh_process_with_another_hash_seed_finds_the_same():
    code = "from dhkit import variants; variants.variant_ranges = lambda _: {'a': (0.0, 1000.0, 1.0)}; print(variants.numbers('arm', 'ada'))"
    found = {
        subprocess.run(
            [sys.executable, "-c", code],
            env={**os.environ, "PYTHONHASHSEED": seed},
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for seed in "17"
    }
    assert len(found) == 1


def test_an_id_leads_to_one_of_the_sets_and_every_set_has_an_id():
    assert {variants.number_set("arm", f"student-{k}") for k in range(1000)} == set(range(variants.SETS))
    for which in (0, 17, variants.SETS - 1):
        member = variants.member("arm", which)
        assert variants.number_set("arm", member) == which
        assert numbers("arm", member) == variants.numbers_of_set("arm", which)


def test_numbers_stay_in_their_range_and_use_all_of_it():
    seen = {name: {numbers("arm", f"student-{k}")[name] for k in range(300)} for name in RANGES}
    assert seen["L1"] == {round(0.4 + 0.02 * k, 9) for k in range(11)}
    assert seen["x"] == {round(-0.3 + 0.1 * k, 9) for k in range(7)}
    assert seen["elbow"] == {"up", "down"}


SPELT = [
    [
        "ada lovelace",
        "Ada Lovelace",
        " Ada  Lovelace\n",
        "AdaLovelace",
        "ADA-LOVELACE",
        "ada_lovelace",
        "Ada\u00a0Lovelace",
    ],
    ["O'Brien", "OBrien", "o\u2019brien", "O`Brien"],
    ["François Élie", "Franc\u0327ois E\u0301lie", "FRANÇOIS ÉLIE", "Francois Elie"],
    ["Straße", "STRASSE"],
    ["\ufb01nn \uff14\uff12", "Finn 42"],
    ["İpek", "ipek"],
    ["\u03a3\u039f\u03a6\u039f\u03a3", "\u03c3\u03bf\u03c6\u03cc\u03c2"],
    ["...", " ... ", ". . ."],
]


@pytest.mark.parametrize("ways", SPELT, ids=lambda ways: ways[0])
def test_an_id_has_one_normal_form_however_it_is_spelt(ways):
    assert len({normal_form(way) for way in ways}) == 1 and normal_form(ways[0])
    assert len({str(numbers("arm", way)) for way in ways}) == 1


def test_different_ids_stay_different():
    ids = ["ada", "bob", "ada2", "adab", "学生", "学", "...", "__", "!", "🤖", "ł", "l"]
    assert len({normal_form(id) for id in ids}) == len(ids)
    assert numbers("arm", "ada") != numbers("arm", "bob")


def test_numbers_are_read_by_name_and_shown():
    mine = variant("arm", "ada")
    assert mine["L1"] == mine.L1 and "ada" in mine._repr_markdown_() and "L1" in mine._repr_markdown_()
    with pytest.raises(AttributeError, match="no number 'L9'; there are L1, x, elbow"):
        mine.L9


def test_without_an_id_they_are_nobodys():
    assert variant("arm") == variant("arm", ...) == variant("arm", "  ") == numbers("arm", variants.NOBODY)
    assert "Nobody" in variant("arm")._repr_markdown_()
    with pytest.raises(ValueError, match='for example "ada"; found 17'):
        variant("arm", 17)


def test_check_tells_the_grader_which_id_was_typed(monkeypatch):
    sent, check = [], importlib.import_module("dhkit.check")
    monkeypatch.setattr(check, "show", lambda report, data=None: sent.append(data[wire.MIME]))
    check.check("planar_2r.centre", "A")
    assert "student" not in sent[-1]
    variant("planar_2r", "ada")
    check.check("planar_2r.centre", "A")
    assert sent[-1]["student"] == "ada"


def test_an_id_that_is_not_in_the_list_of_the_course_is_told(monkeypatch):
    monkeypatch.setattr(variants, "_marks", lambda: frozenset(map(mark, ["José O'Brien", "ada"])))
    for listed in ("jose obrien", "ADA "):
        assert "not in the list" not in variant("arm", listed)._repr_markdown_()
    told = variant("arm", "Joes OBrien")._repr_markdown_()
    assert told.startswith("**Joes OBrien is not in the list of the course; ") and "L1 = " in told
    assert "type your id above" in variant("arm")._repr_markdown_()


def test_without_a_list_any_id_will_do():
    assert variants.is_listed("anybody") and "Numbers of **anybody**" in variant("arm", "anybody")._repr_markdown_()
