"""Time of a verdict for every question, beside sympy.simplify(student - reference) on the same answers.

    .venv/bin/python tests/benchmarks/verdicts.py [EXERCISE ...]

Each question is asked with its right answer, every mistake of its tree and ten answers that nothing explains: the last
ones walk the whole response tree and every pair of mistakes. Each verdict is timed as in a class: the references of a
question are ready, the answer is new. What the first verdict of a question costs, which prepares them, is shown apart.
"""

import sys
from dataclasses import dataclass, field
from pathlib import Path
from statistics import median
from time import perf_counter

import numpy as np
import sympy

sys.path.insert(0, str(Path(__file__).parents[1] / "questions"))

from answers import STUDENT, entries, evidence, mistaken, perturbed, right

from autograder.judge import judge
from autograder.questions import names, of_exercise


@dataclass
class Times:
    """Seconds of the verdicts on one question, the first one apart, and of simplify on the same answers."""

    id: str
    first: float = 0.0
    verdicts: list[float] = field(default_factory=list)
    simplify: list[float] = field(default_factory=list)


def timed(action):
    start = perf_counter()
    action()
    return perf_counter() - start


def answers(question):
    """Answers that walk all of the response tree: right, each mistake, and some that nothing explains."""
    reference, rng = right(question), np.random.default_rng(5)
    yield reference
    for node in question.mistakes:
        yield from (mistaken(question, way) for way in node.ways)
    if question.form.kind not in ("function", "choice"):
        yield from (answer for answer in (perturbed(question, rng) for _ in range(10)) if answer is not None)
    if question.form.kind == "function":
        yield lambda *args: np.array(getattr(found := reference(*args), "solutions", found), dtype=float) * 1.01


def measure(question, simplified=3):
    times = Times(question.id)
    collected = list(answers(question))
    all_evidence = [evidence(question, answer) for answer in collected]
    times.first = timed(lambda: judge(question, all_evidence[-1], STUDENT))
    times.verdicts = [timed(lambda found=found: judge(question, found, STUDENT)) for found in all_evidence]
    if question.form.symbols:
        reference = sympy.Matrix(entries(right(question)).reshape(-1).tolist())
        for answer in collected[:simplified]:
            difference = sympy.Matrix(entries(answer).reshape(-1).tolist()) - reference
            sympy.core.cache.clear_cache()
            times.simplify.append(timed(lambda: difference.applyfunc(sympy.simplify)))
    return times


def measure_all(chosen=()):
    return [measure(question) for name in chosen or names() for question in of_exercise(name)]


def main():
    found = measure_all(sys.argv[1:])
    print(f"{'question':34} {'median':>9} {'max':>9} {'first':>9} {'simplify':>10}  (ms)")
    for times in found:
        peer = f"{1000 * median(times.simplify):10.1f}" if times.simplify else f"{'':10}"
        print(
            f"{times.id:34} {1000 * median(times.verdicts):9.2f} {1000 * max(times.verdicts):9.2f} {1000 * times.first:9.1f} {peer}"
        )
    verdicts = [value for times in found for value in times.verdicts]
    simplify = [value for times in found for value in times.simplify]
    print(
        f"\n{len(verdicts)} verdicts: median {1000 * median(verdicts):.2f} ms, maximum {1000 * max(verdicts):.1f} ms",
        end="",
    )
    print(
        f"; simplify on {len(simplify)} of these answers: median {1000 * median(simplify):.1f} ms, maximum {1000 * max(simplify):.0f} ms"
    )


if __name__ == "__main__":
    main()
