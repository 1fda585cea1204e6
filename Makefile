# Everything a newcomer runs. Each target sets up what it needs; a second run installs nothing.

PYTHON ?= python3
BIN    := .venv/bin
CLASS  := build/class

.PHONY: grade test setup lab bench clean bubblewrap

# The main job, on a sample class (tests/sample_class/write.py without --short writes all of it). Without a sandbox the harmful submissions are left out.
grade: setup
	@if $(BIN)/python -c 'import sys; from autograder.sandbox import available; sys.exit(available() is not None)'; then sandbox=bwrap; class=; \
	else sandbox=none; class=--harmless; \
	  echo "*** No sandbox on this machine: the sample class, which is our own, is graded with --sandbox none. ***"; \
	  echo "*** Never grade submissions of students that way. ***"; fi; \
	$(BIN)/python tests/sample_class/write.py $(CLASS) --short $$class && \
	$(BIN)/autograder release --course $(CLASS) && \
	$(BIN)/autograder grade --course $(CLASS) --sandbox $$sandbox

# All tests, and every notebook executed; a warning in a notebook is an error.
test: setup
	$(BIN)/pytest -n auto --dist loadfile
	PYTHONWARNINGS=error::RuntimeWarning,error::UserWarning,error::SyntaxWarning $(BIN)/pytest -n auto --nbmake course solutions exercises

# JupyterLab on the exercises.
lab: setup
	cd exercises && ../$(BIN)/jupyter lab

# Measurements against peers, as ratios within one run.
bench: setup .venv-bench/installed
	$(BIN)/python tests/benchmarks/verdicts.py
	$(BIN)/python tests/benchmarks/run.py

setup: .venv/installed bubblewrap

.venv/installed: requirements.txt course/requirements.txt pyproject.toml course/pyproject.toml
	@$(PYTHON) -c 'import sys; sys.exit("Python 3.11 or newer is needed" if sys.version_info < (3, 11) else 0)'
	$(PYTHON) -m venv .venv
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -r requirements.txt -e course -e .
	@touch $@

.venv-bench/installed: tests/benchmarks/requirements.txt
	$(PYTHON) -m venv .venv-bench
	.venv-bench/bin/python -m pip install --quiet --disable-pip-version-check -r $<
	@touch $@

# The sandbox of student code. Only root can install it; everyone else is told how.
bubblewrap:
	@command -v bwrap >/dev/null || { \
	  if [ "$$(id -u)" = 0 ] && command -v apt-get >/dev/null; then \
	    apt-get update -qq && apt-get install -qq -y bubblewrap >/dev/null; \
	  else echo "The sandbox needs bubblewrap (Linux): sudo apt-get install bubblewrap, or sudo dnf install bubblewrap"; fi; }

clean:
	rm -rf build
