# Everything a newcomer runs. Each target sets up what it needs; a second run installs nothing.

PYTHON ?= python3
BIN    := .venv/bin
PIP    := $(BIN)/python -m pip install --quiet --disable-pip-version-check
CLASS  := build/class
ENVIRONMENT := --requirement requirements.txt --constraint constraints.txt --editable course --editable autograder/solver --editable .

# Processes of a test run start by the hundred: none of them should compile the same modules anew.
unexport PYTHONDONTWRITEBYTECODE

.PHONY: grade test check lint format lock setup scene lab site bench clean bubblewrap

# The main job, on a sample class (tests/sample_class/write.py without --short writes all of it). Without a sandbox the harmful submissions are left out.
grade: setup
	@if $(BIN)/python -c 'import sys; from autograder.sandbox import available; sys.exit(available() is not None)'; then sandbox=bwrap; class=; \
	else sandbox=none; class=--harmless; \
	  echo "*** No sandbox on this machine: the sample class, which is our own, is graded with --sandbox none. ***"; \
	  echo "*** Never grade submissions of students that way. ***"; fi; \
	$(BIN)/python tests/sample_class/write.py $(CLASS) --short $$class && \
	$(BIN)/autograder release --course $(CLASS) --home form && \
	$(BIN)/autograder grade --course $(CLASS) --sandbox $$sandbox

# All tests, and every notebook executed; a warning in a notebook is an error.
test: setup
	$(BIN)/pytest -n auto --dist loadfile --no-loadscope-reorder
	PYTHONWARNINGS=error::RuntimeWarning,error::UserWarning,error::SyntaxWarning $(BIN)/pytest -n auto --nbmake course solutions exercises

# For every change: lint, types and the fast tests, those not marked slow, sandbox or notebook.
check: lint
	$(BIN)/pytest -n auto --dist worksteal -m "not slow and not sandbox and not notebook"

lint: setup
	$(BIN)/ruff check
	$(BIN)/ruff format --check
	$(BIN)/mypy

format: setup
	$(BIN)/ruff check --fix
	$(BIN)/ruff format

# After a change of requirements.txt: what the pinned packages need themselves, pinned too, for every system and Python.
lock: setup
	$(BIN)/uv pip compile --quiet --universal --python-version 3.11 --no-annotate --custom-compile-command "make lock" \
	  --output-file constraints.txt requirements.txt

# The program of dhkit.scene, bundled with three.js into one file that is committed: only who changes it needs node.
scene:
	cd course/dhkit/scene/js && npm ci --silent --ignore-scripts && npm run --silent lint && npm run --silent build

# JupyterLab on lectures and exercises.
lab: setup
	$(BIN)/jupyter lab course/01_parameters.ipynb

# The site, in build/site. Notebooks run again where a cell of theirs has changed, all of them where what they import has.
site: setup build/imported
	@$(BIN)/sphinx-build --quiet --fail-on-warning --jobs auto -c docs -d build/doctrees . build/site 2> build/site.log || { cat build/site.log; exit 1; }
	$(BIN)/python docs/check_links.py build/site
	$(BIN)/python docs/check_pages.py build/site
	@echo "the site is in build/site/index.html"

build/imported: $(shell find course/dhkit autograder -name '*.py' -o -name '*.toml' -o -name 'scene.js')
	@rm -rf build/executed build/doctrees && mkdir -p build && touch $@

# Measurements against peers, as ratios within one run; the site shows what was kept in docs/figures.
bench: SHELL := bash -o pipefail
bench: setup .venv-bench/installed
	$(BIN)/python tests/benchmarks/verdicts.py | tee docs/figures/verdicts.txt
	$(BIN)/python tests/benchmarks/run.py | tee docs/figures/solver.txt
	$(BIN)/python tests/benchmarks/grading.py | tee docs/figures/grading.txt

# Sandboxed kernels cannot keep what they compile: they find it compiled.
setup: .venv/installed bubblewrap
	@$(BIN)/python -m compileall -q autograder course/dhkit

# uv installs in seconds what takes pip minutes; pip does it where uv cannot. rfc3987-syntax, where jsonschema finds it,
# costs every process that reads a notebook two seconds, for the form of addresses that no notebook holds.
.venv/installed: requirements.txt constraints.txt course/requirements.txt pyproject.toml course/pyproject.toml autograder/solver/pyproject.toml
	@$(PYTHON) -c 'import sys; sys.exit("Python 3.11 or newer is needed" if sys.version_info < (3, 11) else 0)'
	$(PYTHON) -m venv .venv
	$(PIP) "$$(grep -o '^uv==[^ ]*' requirements.txt)" && \
	$(BIN)/uv pip install --quiet --compile-bytecode --python $(BIN)/python $(ENVIRONMENT) || $(PIP) $(ENVIRONMENT)
	$(BIN)/python -m pip uninstall --quiet --yes rfc3987-syntax
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
