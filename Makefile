# Everything sets up .venv by itself: make study · make test · make bench · make lab · make lint

PYTHON ?= $(shell for p in python3 python3.14 python3.13 python3.12 python3.11; do \
	$$p -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null && echo $$p && break; done)
VENV := .venv
BIN := $(VENV)/bin
READY := $(VENV)/.ready
PIP := $(BIN)/python -m pip install --quiet --disable-pip-version-check

.DEFAULT_GOAL := study
PEERS := opencv-python-headless imreg_dft arosics

.PHONY: study test bench setup lab lint clean

study: setup  ## Run all default pipelines and say where the report is.
	$(BIN)/kedro run $(ARGS)
	@echo "The report: file://$(CURDIR)/data/08_reporting/site/index.html"

test: setup  ## Run the tests.
	$(BIN)/python -m pytest $(ARGS)

setup: $(READY)  ## Make .venv with the locked dependencies and the package.

# The stamp is written last: an interrupted set-up starts anew.
$(READY): requirements.lock pyproject.toml
	@test -n "$(PYTHON)" || { echo "Python 3.11 or later is needed; install it, or name it: make PYTHON=/path/to/python3"; exit 1; }
	@rm -f $(READY)
	$(PYTHON) -m venv --clear $(VENV)
	$(PIP) --require-hashes -r requirements.lock
	$(PIP) --no-deps --no-build-isolation --editable .
	@touch $(READY)

bench: setup  ## Accuracy and speed against other libraries; an absent one is reported as absent.
	@for peer in $(PEERS); do $(PIP) $$peer || echo "$$peer cannot be installed here: it will be reported as absent"; done
	OMP_NUM_THREADS=1 $(BIN)/kedro run --pipelines=benchmark $(ARGS)
	@echo "The report: file://$(CURDIR)/data/08_reporting/site/index.html"

lab: setup  ## Open the notebooks in JupyterLab (right-click a .py: Open With, Notebook).
	$(PIP) "jupyterlab>=4.4"
	$(BIN)/jupyter lab notebooks

lint: setup  ## Style, types.
	$(BIN)/ruff check src tests notebooks
	$(BIN)/ruff format --check src tests notebooks
	$(BIN)/mypy

clean:  ## Remove .venv and caches; results under data/ stay.
	rm -rf $(VENV) .pytest_cache .mypy_cache .ruff_cache
