"""Answers to any question there is: right ones in other forms, and wrong ones by a visible amount."""

import numpy as np
import sympy
from scipy.spatial.transform import Rotation

from autograder.judge import Evidence, Family, judge
from dhkit import wire
from dhkit.forms.dh_table import DH_COLUMNS

STUDENT = "ada"


def right(question):
    """The reference, as a student would write it."""
    answer = question.answer(STUDENT)
    return answer.solutions if isinstance(answer, Family) else answer


def mistaken(question, *ways):
    """The answer of somebody who makes these mistakes."""
    answer = question.answer(STUDENT, *ways)
    return answer.solutions if isinstance(answer, Family) else answer


def evidence(question, answer, student=STUDENT):
    """What the sandbox would find if a student handed in `answer`."""
    if question.form.kind != "function":
        return Evidence(wire.packet(question.id, answer=wire.encode(answer)))
    probes, results = question.probes(student, 7), []
    for args in probes:
        try:
            found = answer(*args)
            results.append(wire.encode(getattr(found, "solutions", found)))
        except Exception as error:
            results.append({"error": str(error)})
    handed_in = wire.packet(question.id, answer={"function": "f"})
    return Evidence(handed_in, (probes, wire.packet(question.id, probes=results)))


def verdict(question, answer):
    return judge(question, evidence(question, answer), STUDENT)


def entries(answer):
    """The answer as nested lists of SymPy expressions."""
    if isinstance(answer, str):
        return answer
    rows = np.array(sympy.Matrix(answer).tolist() if isinstance(answer, sympy.MatrixBase) else answer, dtype=object)
    return np.vectorize(sympy.sympify, otypes=[object])(rows)


def keyed(names, row):
    return dict(reversed(list(zip(names, row, strict=True))))


def other_forms(question, answer):
    """An answer written in other ways that a student may use: at least five of them for every kind but choices."""
    kind, form = question.form.kind, question.form
    if kind == "choice":
        return {"lower case": answer.lower(), "spaces": f" {answer}\n"}
    if kind == "point_cloud":
        cloud = np.array(answer, dtype=float)
        shuffled = np.random.default_rng(3).permutation(cloud)
        return {
            "other order": shuffled,
            "lists": cloud.tolist(),
            "tuples": tuple(map(tuple, cloud.tolist())),
            "twice": np.vstack([cloud, cloud])[:5000] if len(cloud) <= 2500 else shuffled,
            "rounded": np.round(cloud, 6),
        }
    if kind == "joint_solutions":
        solutions = np.array(answer, dtype=float).reshape(-1, len(form.joints))
        turned = solutions.copy()
        turned[:, list(question.angles)] += 2 * np.pi
        return {
            "other order": solutions[::-1],
            "a turn further": turned,
            "twice": np.vstack([solutions, solutions]),
            "list of tuples": [tuple(row) for row in solutions],
            "sympy matrix": sympy.Matrix(solutions.tolist()) if len(solutions) else [],
            "rounded": np.round(solutions, 4) if question.accuracy >= 1e-4 else solutions.tolist(),
            "by name": [keyed(form.joints, row) for row in solutions],
        }
    entry = entries(answer)
    change = lambda f: np.vectorize(f, otypes=[object])(entry)  # noqa: E731
    forms = {
        "nested lists": entry.tolist(),
        "array of objects": entry,
        "expanded": change(lambda e: sympy.expand(e, trig=True)),
        "exponentials": change(lambda e: e.rewrite(sympy.exp)),
        "floats": change(lambda e: e.evalf(12)),
        "unevaluated sum": change(lambda e: sympy.Add(e, 3, -3, evaluate=False)),
        "together": change(sympy.together),
    }
    if entry.ndim == 2:
        forms["sympy matrix"] = sympy.Matrix(entry.tolist())
        forms["immutable matrix"] = sympy.ImmutableMatrix(entry.tolist())
        forms["tuples"] = tuple(map(tuple, entry.tolist()))
    elif entry.ndim == 1:
        forms["column"] = sympy.Matrix(entry.tolist())
        forms["row"] = sympy.Matrix([entry.tolist()])
    if kind == "dh_table":
        forms["by name"] = [keyed(DH_COLUMNS, row) for row in entry.tolist()]
    if getattr(form, "names", ()):
        forms["by name"] = keyed(form.names, entry.tolist())
    if kind == "direction":
        forms["longer"] = change(lambda e: 7 * e)
        forms["the other way"] = change(lambda e: -e)
    return forms


def another_form(question, node, answer):
    """A mistaken answer in one of its other forms, in turn from mistake to mistake."""
    forms = list(other_forms(question, answer).items())
    return next(form for name, form in forms[len(node.note) % len(forms) :] + forms if name != "a turn further")


def perturbed(question, rng):
    """The reference with one entry changed by a visible amount; None where nothing has changed."""
    answer, kind = right(question), question.form.kind
    if kind == "point_cloud":
        cloud = np.array(answer, dtype=float)
        size, far = np.ptp(cloud, axis=0), 3 * question.accuracy
        chosen = rng.integers(3)
        if chosen == 0:  # a part is missing
            axis = rng.integers(cloud.shape[1])
            return cloud[cloud[:, axis] < np.quantile(cloud[:, axis], rng.uniform(0.3, 0.8))]
        if chosen == 1:
            return cloud * (1 + max(0.1, 4 * question.accuracy / size.min()))
        return np.vstack([cloud, cloud[: len(cloud) // 10] + size + far])[-5000:]
    if kind == "joint_solutions":
        solutions = np.array(answer, dtype=float).reshape(-1, len(question.form.joints))
        if not len(solutions):
            return rng.uniform(-1, 1, (1, len(question.form.joints)))
        changed = solutions.copy()
        changed[rng.integers(len(solutions)), rng.integers(solutions.shape[1])] += rng.choice([-1, 1]) * rng.uniform(
            0.05, 1
        )
        family = isinstance(question.answer(STUDENT), Family)
        return None if family and question.setting(STUDENT).residual(changed).max() < 1e-9 else changed
    form = entries(answer)
    place = rng.integers(form.size)
    symbols = sympy.symbols(question.form.symbols)
    amount = rng.uniform(0.01, 1)
    factor = symbols[rng.integers(len(symbols))] if symbols else 1 + amount
    old = form.reshape(-1)[place] if form.ndim else form.item()
    new = [old + amount, -old, old * factor, old + factor][rng.integers(4)]
    changed = form.reshape(-1).copy()
    changed[place] = new
    changed = changed.reshape(form.shape) if form.ndim else changed[0]
    return None if old == new or still_right(question, form, changed) else changed


def still_right(question, reference, changed):
    """Whether a changed entry leaves the meaning as it was, found without the judge's own algebra."""
    kind, form = question.form.kind, question.form
    values = {name: float(value[0]) for name, value in question.samples.items()}
    if kind in ("direction", "orientation", "dh_table", "classic_table"):
        joints = getattr(form, "joints", ())
        names = list({*form.symbols, *joints})
        rng = np.random.default_rng(0)
        values |= {name: rng.uniform(-2, 2) for name in joints}
        pair = [
            sympy.Matrix(each.tolist()).subs({name: values[name] for name in names}) for each in (reference, changed)
        ]
        first, second = (np.array(each.evalf(), dtype=float) for each in pair)
    if kind == "direction":
        return (
            np.linalg.norm(np.cross(first.ravel(), second.ravel())) < 1e-9
            if first.size == 3
            else np.linalg.matrix_rank([first.ravel(), second.ravel()], 1e-9) < 2
        )
    if kind == "orientation":
        axes = form.axes.upper() if form.frames == "moving" else form.axes.lower()
        turns = [Rotation.from_euler(axes, each.ravel()) for each in (first, second)]
        return (turns[0].inv() * turns[1]).magnitude() < 1e-7
    if kind in ("dh_table", "classic_table"):
        return np.allclose(hand(first), hand(second), atol=1e-9)
    if question.angles and kind in ("expression", "vector", "matrix"):
        gap = sympy.Matrix(np.ravel(np.array(changed - reference)).tolist()).subs(values)
        return all(
            abs(np.remainder(float(each) + np.pi, 2 * np.pi) - np.pi) < 1e-9 for each in gap if not each.free_symbols
        )
    return False


def hand(rows):
    """The product of a numeric DHm table, or of rows [a, alpha, d, theta] of a classic one, from elementary motions."""
    result = np.eye(4)
    for *sigma, a, alpha, d, theta in rows:
        along_x, along_z = (0, a, alpha), (2, d, theta)
        for axis, shift, turn in (along_x, along_z) if sigma else (along_z, along_x):
            step = np.eye(4)
            step[axis, 3] = shift
            step[:3, :3] = Rotation.from_rotvec(turn * np.eye(3)[axis]).as_matrix()
            result = result @ step
    return result
