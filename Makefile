# Everything a newcomer runs. Each target sets up what it needs; a second run installs nothing.

PYTHON ?= python3
BIN    := .venv/bin
CLASS  := build/class

.PHONY: grade test setup lab bench clean

grade: setup  ## Release the exercises, write a sample class, grade it, show the table
	@$(BIN)/python tests/sample_class/write.py $(CLASS)
	@for exercise in $$(ls solutions); do \
	  $(BIN)/autograder --course $(CLASS) release $$exercise || exit 1; \
	done
	@$(BIN)/autograder --course $(CLASS) grade --all $$(cat .venv/sandbox)

test: setup  ## All tests, every notebook included
	@$(BIN)/pytest tests
	@$(BIN)/pytest --nbmake course solutions exercises

setup: .venv/installed .venv/sandbox

lab: setup  ## JupyterLab on the exercises
	@cd exercises && ../$(BIN)/jupyter lab

bench: setup .venv-bench/installed  ## Measurements against peers, as ratios
	@$(BIN)/python tests/benchmarks/run.py

clean:
	rm -rf build
