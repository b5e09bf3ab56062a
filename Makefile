# One entry point for people and CI. Needs Python 3.11 or later with venv, and nothing else.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
INSTALLED := $(VENV)/installed
DOCS_INSTALLED := $(VENV)/docs-installed
PARALLEL := --numprocesses auto --maxprocesses 4 --dist loadfile
export OMP_NUM_THREADS := 1
export OPENBLAS_NUM_THREADS := 1

.PHONY: help install demo test coverage dist soak check lint format types bench peers urdf docs lock clean

help: ## List the targets
	@grep -E '^[a-z]+:.*## ' $(MAKEFILE_LIST) | sed 's/:.*## /\t/' | expand -t 12

$(INSTALLED): requirements.lock pyproject.toml
	$(PYTHON) -c 'import sys; sys.exit("Python 3.11 or later is needed; set PYTHON=...") if sys.version_info < (3, 11) else None'
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --require-hashes -r requirements.lock
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-build-isolation --no-deps -e .
	touch $@

install: $(INSTALLED) ## Make the environment from the lock file

demo: $(INSTALLED) ## Solve OC6 LC 5.1, write its report and the second mode's animation
	$(BIN)/offwind run oc6-lc5.1 --out out/oc6-lc5.1
	$(BIN)/offwind animate oc6_phase2 --foundation distributed_springs --mode FA2 --html out/oc6-lc5.1/fa2.html
	@echo "Open out/oc6-lc5.1/report.html and out/oc6-lc5.1/fa2.html in a browser."

test: $(INSTALLED) ## Run the whole test suite
	$(BIN)/python -m pytest $(PARALLEL)

coverage: $(INSTALLED) ## Run the whole test suite and print its branch coverage
	rm -rf out/coverage
	mkdir -p out/coverage
	$(BIN)/coverage run -m pytest $(PARALLEL)
	$(BIN)/coverage combine --quiet
	$(BIN)/coverage report --skip-covered
	@echo "Functions that Numba compiles are not counted: coverage does not see them run."

dist: $(INSTALLED) ## Build wheel and sdist, inspect them, and run the wheel in an environment of its own
	$(BIN)/python .ci/distributions.py

# Every round draws other examples and other moments; a failure is repeated with the seed of its round.
ROUNDS ?= 20
soak: $(INSTALLED) ## Repeat the random tests with other seeds; ROUNDS=20
	for seed in $$(seq 1001 $$((1000 + $(ROUNDS)))); do \
		echo "seed $$seed"; \
		$(BIN)/python -m pytest $(PARALLEL) -m "seeded or hypothesis" \
			--hypothesis-profile soak --hypothesis-seed $$seed --campaign-seed $$seed || exit 1; \
	done

check: lint types ## Lint, format and type checks

lint: $(INSTALLED)
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .

types: $(INSTALLED)
	$(BIN)/mypy

format: $(INSTALLED) ## Reformat the code
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

bench: $(INSTALLED) ## Measure speed; writes JSON and a page to out/benchmarks
	$(BIN)/python benchmarks/run_all.py

peers: $(INSTALLED) ## Install the codes that bench compares with
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-build-isolation -e '.[peers]'

urdf: $(INSTALLED) ## Write the shipped URDF files anew
	$(BIN)/python sim/write_urdf.py

# Sphinx has a lock file of its own, so that tests and demo need not install it. It is resolved under
# requirements.lock: what both hold is the same version, and the docs run what the tests ran.
$(DOCS_INSTALLED): $(INSTALLED) docs/requirements.lock
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --require-hashes -r docs/requirements.lock
	touch $@

# The pages are built from copies, because the gallery is written beside its sources.
docs: $(DOCS_INSTALLED) ## Build the documentation to out/docs
	rm -rf out/docs out/docs-source
	mkdir -p out/docs-source
	cp -R CHANGELOG.md CONTRIBUTING.md VERIFICATION.md docs out/docs-source/
	ln -s $(CURDIR)/sim $(CURDIR)/src out/docs-source/
	cat README.md docs/contents.md > out/docs-source/index.md
	$(BIN)/python -m sphinx -c docs -b html -W --keep-going --color out/docs-source out/docs
	@echo "Open out/docs/index.html in a browser."

lock: ## Resolve the dependencies anew into requirements.lock and docs/requirements.lock
	$(PYTHON) -m venv $(VENV)-lock
	$(VENV)-lock/bin/python -m pip install --quiet 'uv>=0.5,<1'
	$(VENV)-lock/bin/uv pip compile pyproject.toml --group dev --universal --python-version 3.11 \
		--generate-hashes --no-emit-index-url --no-header --no-annotate --output-file requirements.lock
	$(VENV)-lock/bin/uv pip compile pyproject.toml --group docs --universal --python-version 3.11 \
		--constraints requirements.lock --generate-hashes --no-emit-index-url --no-header --no-annotate \
		--output-file docs/requirements.lock
	rm -rf $(VENV)-lock

clean: ## Remove the environment and all results
	rm -rf $(VENV) out .mypy_cache .pytest_cache .ruff_cache
