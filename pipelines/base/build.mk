# Packages, build and tests.

# packages/<group>.txt lists packages. Every target needs `chain`; a target that needs more sets packages_for_<target>
# := <groups>.
PACKAGE_GROUPS := $(basename $(notdir $(wildcard packages/*.txt)))
groups_wanted   = $(sort chain $(foreach g,$(MAKECMDGOALS),$(packages_for_$(g))))
packages_wanted = $(sort $(foreach g,$(groups_wanted),$(file < packages/$(g).txt)))
packages_for_packages    := $(GROUPS)
packages_for_check       := tests loaders wrap identify robot video predict depthnet
packages_for_check-slow  := tests loaders cluster pages wrap identify robot video predict depthnet

# A target that needs only some stages sets programs_for_<target> := <their names>; other targets build all stages.
programs_wanted = $(sort $(or $(foreach g,$(MAKECMDGOALS),$(or $(programs_for_$(g)),stages)),stages))

.PHONY: packages build build-all check check-slow clean

packages: ## development: Install the Debian packages that are missing: of the chain, or GROUPS="tests cluster" too (PACKAGES=no: only say which)
	$(foreach g,$(filter-out $(PACKAGE_GROUPS),$(groups_wanted)),$(error GROUPS: there is no packages/$(g).txt (there are: $(PACKAGE_GROUPS))))
	@command -v dpkg-query >/dev/null || { echo "packages: not a Debian system; packages/*.txt list what is needed"; exit 0; }; \
	missing=""; \
	for p in $(packages_wanted); do \
	  [ "$$(dpkg-query -W -f='$${db:Status-Status}' $$p 2>/dev/null || true)" = installed ] || missing="$$missing $$p"; \
	done; \
	[ -n "$$missing" ] || exit 0; \
	if [ "$(PACKAGES)" = no ]; then echo "packages: missing:$$missing"; exit 0; fi; \
	sudo=""; [ "$$(id -u)" = 0 ] || sudo=sudo; \
	echo "packages: installing$$missing"; \
	$$sudo apt-get update -q; \
	$$sudo env DEBIAN_FRONTEND=noninteractive apt-get install -o DPkg::Lock::Timeout=300 -y -q --no-install-recommends $$missing

# Only the headers of libopenmesh-dev are unpacked: the package depends on OpenSceneGraph, a hundred packages that
# nothing here needs.
OPENMESH_HEADERS := $(firstword $(wildcard /usr/include/OpenMesh) $(BUILD)/unpacked/usr/include/OpenMesh)
$(BUILD)/unpacked/usr/include/OpenMesh: | packages
	@if [ "$(PACKAGES)" = no ] || ! command -v apt-get >/dev/null; then echo "packages: no headers of OpenMesh (libopenmesh-dev)"; exit 0; fi; \
	mkdir -p $(BUILD)/unpacked.new && cd $(BUILD)/unpacked.new && apt-get download -q libopenmesh-dev && dpkg-deb -x libopenmesh-dev_*.deb . && \
	mkdir -p ../unpacked && cp -r usr ../unpacked && rm -rf ../unpacked.new

# Commands are only shown with V=1. With `make -s` a build and a finished stage show nothing.
shown  = $(filter-out 0,$(V))
silent = $(findstring s,$(firstword -$(MAKEFLAGS)))
$(if $(shown),,$(eval .SILENT:))

# $(call configure,folder,flags of cmake): runs CMake; its report goes to configure.log.
configure = $(if $(shown),cmake -B $(1) -G Ninja $(2),$(if $(silent),,echo 'configure: $(1)';) mkdir -p $(1); \
  cmake -B $(1) -G Ninja $(2) > $(1)/configure.log 2>&1 || { cat $(1)/configure.log >&2; exit 1; })
# $(call compile,folder[,targets]): runs ninja, with its status on a terminal and an occasional line elsewhere; does
# nothing with REBUILD=no.
compile = $(if $(filter no,$(REBUILD)),:,$(call compile_now,$(1),$(2)))
compile_now = ninja() { cmake --build $(1) -j $(JOBS) $(2:%=--target %) -- "$$@"; }; \
  $(if $(shown),ninja -v,$(if $(silent),ninja --quiet,if [ -t 1 ]; then ninja; else ninja | bash pipelines/base/build_lines.sh; fi))

# Cached results of packages that CMake did not find before their group was installed; it searches for them again.
cached_of_wrap     := CGAL_INCLUDE_DIR
cached_of_identify := Ceres_DIR
cached_of_robot    := MUJOCO_INCLUDE_DIR
cached_of_video    := FFMPEG_INCLUDE_DIR
cached_of_predict  := ONNX_DIR OpenCV_dnn_LIBRARY Protobuf_INCLUDE_DIR
cached_of_depthnet := LIBTORCH_INCLUDE_DIR
# Tests are off until with-tests switches them on.
$(BUILD)/build.ninja: | packages $(OPENMESH_HEADERS)
	@$(call configure,$(BUILD),--preset $(PRESET) -DTACIPC_TESTS=OFF)

# Ninja rebuilds the unfinished files of a killed build, which make would take for finished.
ifeq ($(REBUILD),no)
build:
else
build: $(BUILD)/build.ninja ## development: Build all stages
	@for name in $(foreach g,$(groups_wanted),$(cached_of_$(g))); do ! grep -qs "^$$name:.*NOTFOUND" $(BUILD)/CMakeCache.txt || cmake $(BUILD) > /dev/null; done
	@$(call compile,$(BUILD),$(programs_wanted))
endif

PREFIX ?= out/prefix#  target folder of install
.PHONY: install
install: build ## development: Programs, configurations and pipelines into PREFIX=, which may be moved
	@cmake --install $(BUILD) --prefix '$(strip $(PREFIX))' > /dev/null
	@echo "make -C $(strip $(PREFIX))/share/tacipc -f Makefile.data dataset CONFIG=/your.yaml OUT=/your/out"

# From here on the build folder contains the tests.
.PHONY: with-tests
with-tests: build
	@[ '$(REBUILD)' = no ] || grep -qs '^TACIPC_TESTS:BOOL=ON' $(BUILD)/CMakeCache.txt || cmake -DTACIPC_TESTS=ON $(BUILD) > /dev/null

build-all: with-tests # one after the other: two builds in one folder would trip over each other
	@$(call compile,$(BUILD))

check: build-all ## start: Build and run the tests (under 15 minutes)
	ctest --test-dir $(BUILD) -LE "slow|dev" -j $(JOBS) --output-on-failure --no-tests=error

# Packages that read exports, only for tests: packages/loaders.pip in addition to Debian's Python, NumPy and PyTorch.
# lerobot is installed without its own list, which requires a newer Python (tests/pipeline/lerobot_on_debian.py).
LEROBOT := lerobot==0.6.1
packages_for_loaders-python := loaders
.PHONY: loaders-python
loaders-python: $(BUILD)/loaders/installed
$(BUILD)/loaders/installed: packages/loaders.pip pipelines/base/build.mk | packages
	@if [ "$(PACKAGES)" = no ]; then echo 'packages: no $(@D) (packages/loaders.pip)'; exit 0; fi; \
	rm -rf $(@D) && /usr/bin/python3 -m venv --system-site-packages $(@D); \
	pip() { $(@D)/bin/python -m pip install --quiet --no-cache-dir --disable-pip-version-check "$$@"; }; \
	pip -r packages/loaders.pip && pip --no-deps --ignore-requires-python $(LEROBOT) && echo '$(LEROBOT)' > $@

check-slow: build-all $(BUILD)/loaders/installed ## development: Build and run the long tests
	ctest --test-dir $(BUILD) -L slow -j $(JOBS) --output-on-failure --no-tests=error

clean: ## development: Remove the build folder (generated data stay)
	$(if $(filter-out clean,$(MAKECMDGOALS)),$(error clean goes alone))
	rm -rf $(BUILD)
