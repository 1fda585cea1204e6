"""Equal wrong answers: chance is told from copying, and what stands to reason counts once."""

import math
import random
from collections import Counter
from itertools import product

import pytest

from autograder.grading.overview.likeness import Wrong, _chance, pairs_alike

CLASS = [f"s{i:03d}" for i in range(120)]


def answers(kinds, rng, questions=12, wrong=0.5):
    """A class that works alone: each question has `kinds` wrong answers, the first ones far more frequent."""
    weights = [1 / (1 + kind) for kind in range(kinds)]
    return {
        f"q.{question}": {
            student: Wrong("answer", rng.choices(range(kinds), weights)[0]) for student in CLASS if rng.random() < wrong
        }
        for question in range(questions)
    }


@pytest.mark.parametrize("kinds", [3, 10, 60])
def test_a_class_that_works_alone_gives_no_pair(kinds):
    found = [pair for seed in range(2) for pair in pairs_alike(answers(kinds, random.Random(seed)), {})]
    assert found == []


def test_a_copy_of_rare_answers_is_found_and_a_copy_of_frequent_ones_is_not():
    class_ = answers(10, random.Random(1))
    for question in list(class_)[:5]:
        class_[question] |= {"s003": Wrong("answer", "rare"), "s077": Wrong("answer", "rare")}
        class_[question] |= {"s050": Wrong("answer", 0), "s051": Wrong("answer", 0)}
    found = pairs_alike(class_, {})
    assert [pair.students for pair in found] == [("s003", "s077")]
    assert {one.question for one in found[0].shared} >= set(list(class_)[:5])
    assert all((one.count, one.wrong.key) == (2, "rare") for one in found[0].shared[:5])


def test_one_mistake_that_both_make_everywhere_is_one_coincidence():
    class_ = answers(60, random.Random(2))
    for question in list(class_)[:6]:
        class_[question] |= {"s003": Wrong("mistake", "degrees"), "s077": Wrong("mistake", "degrees")}
    assert pairs_alike(class_, {}) == []


def test_what_follows_from_an_equal_answer_is_no_new_coincidence():
    class_ = answers(60, random.Random(3))
    chain = list(class_)[:5]
    for question in chain:
        class_[question] |= {"s003": Wrong("answer", "rare"), "s077": Wrong("answer", "rare")}
    assert [pair.students for pair in pairs_alike(class_, {})] == [("s003", "s077")]
    assert pairs_alike(class_, dict(zip(chain[1:], chain, strict=False))) == []


def test_many_questions_wrong_in_different_ways_speak_against_it():
    class_ = answers(10, random.Random(4), wrong=0.3)
    for question in list(class_)[:6]:
        class_[question] |= {"s003": Wrong("answer", "rare"), "s077": Wrong("answer", "rare")}
    (alone,) = [pair for pair in pairs_alike(class_, {}) if pair.students == ("s003", "s077")]
    for question in list(class_)[6:]:
        class_[question] |= {"s003": Wrong("answer", 8), "s077": Wrong("answer", 9)}
    (both,) = [pair for pair in pairs_alike(class_, {}) if pair.students == ("s003", "s077")] or [None]
    assert both is None or both.expected > alone.expected


def test_nobody_wrong_and_a_class_of_two():
    assert pairs_alike({}, {}) == []
    assert pairs_alike({f"q.{i}": {name: Wrong("answer", 0) for name in "ab"} for i in range(9)}, {}) == []


def test_chance_is_that_of_independent_answers():
    classes = ((5, 3, 1, 1), (2, 2, 2), (9, 1))
    counts = [Counter({Wrong("answer", kind): count for kind, count in enumerate(found)}) for found in classes]
    surprise = -math.log(3 / 10) - math.log(1 / 3)
    outcomes = []  # of each question: surprise and probability of each way to agree, and of differing
    for found in classes:
        shares = [count / sum(found) for count in found]
        outcomes.append(
            [*((-math.log(share), share**2) for share in shares), (0, 1 - sum(share**2 for share in shares))]
        )
    exact = sum(
        math.prod(probability for _, probability in ways)
        for ways in product(*outcomes)
        if sum(more for more, _ in ways) >= surprise - 1e-9
    )
    assert exact <= _chance(counts, surprise) <= 1.15 * exact
    assert _chance(counts, 0) == pytest.approx(1)
