# Packages, build and tests.

.PHONY: packages build build-all check check-slow clean

packages: ## Install the Debian packages of packages.txt that are missing (PACKAGES=no: only say which)
	@command -v dpkg-query >/dev/null || { echo "packages: not a Debian system; packages.txt lists what the build needs"; exit 0; }; \
	missing=""; \
	for p in $$(cat packages.txt); do \
	  [ "$$(dpkg-query -W -f='$${db:Status-Status}' $$p 2>/dev/null || true)" = installed ] || missing="$$missing $$p"; \
	done; \
	[ -n "$$missing" ] || exit 0; \
	if [ "$(PACKAGES)" = no ]; then echo "packages: missing:$$missing"; exit 0; fi; \
	sudo=""; [ "$$(id -u)" = 0 ] || sudo=sudo; \
	echo "packages: installing$$missing"; \
	$$sudo apt-get update -q; \
	$$sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends $$missing

$(BUILD)/build.ninja: | packages
	@cmake --preset $(PRESET) -B $(BUILD) -G Ninja

# Ninja rebuilds what a killed build left half done, which make would take for finished.
ifeq ($(REBUILD),no)
build:
else
build: $(BUILD)/build.ninja ## Build all stages
	@cmake --build $(BUILD) --target stages -j $(JOBS) -- --quiet
endif

PREFIX ?= out/prefix#  where install puts everything
.PHONY: install
install: build ## Programs, configurations and pipelines into PREFIX=, from where they run wherever it is moved
	@cmake --install $(BUILD) --prefix '$(strip $(PREFIX))' > /dev/null
	@echo "make -C $(strip $(PREFIX))/share/tacipc -f Makefile.data dataset CONFIG=/your.yaml OUT=/your/out"

build-all: build # one after the other: two builds in one folder would trip over each other
	@cmake --build $(BUILD) -j $(JOBS) -- --quiet

check: build-all ## Build and run the tests (under 15 minutes)
	ctest --test-dir $(BUILD) -LE "slow|dev" -j $(JOBS) --output-on-failure --no-tests=error

check-slow: build-all ## Build and run the long tests
	ctest --test-dir $(BUILD) -L slow -j $(JOBS) --output-on-failure --no-tests=error

clean: ## Remove the build folder (generated data stay)
	$(if $(filter-out clean,$(MAKECMDGOALS)),$(error clean goes alone))
	rm -rf $(BUILD)
