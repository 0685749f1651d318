# Checks of the sources by CI in addition to the tests: format, scripts, clang-tidy; readers, contact and solver under
# sanitizers.

SINCE ?=#  lint: C++ sources that differ from this commit go through clang-tidy (default: the last commit; all: every source)
override SINCE := $(strip $(SINCE))

packages_for_lint            := tests lint wrap video predict depthnet
packages_for_check-sanitized := tests predict
.PHONY: lint check-sanitized
# Built without the precompiled headers, so that missing #include lines are found.
LINTED := build/lint
lint: build-all ## development: clang-format, shellcheck and clang-tidy (SINCE=commit, or SINCE=all for every source)
	@cmake --preset release -B $(LINTED) -G Ninja -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DCMAKE_UNITY_BUILD=OFF > /dev/null
	git ls-files '*.cpp' '*.h' | xargs clang-format --dry-run --Werror
	git ls-files '*.sh' .ci/run | xargs shellcheck --severity=info
	bash tests/lint/tidy.sh . $(LINTED) $(JOBS) $(or $(SINCE),HEAD~1)

# Programs under sanitizers have a build folder of their own.
SANITIZED_TESTS := common_depth_model_test common_files_test fuzz_test predict_test press_contact_test press_test
SANITIZED := build/sanitize
$(SANITIZED)/build.ninja: | build-all
	@$(call configure,$(SANITIZED),--preset sanitize)
check-sanitized: $(SANITIZED)/build.ninja ## development: Tests of readers, contact and solver under address and undefined-behaviour sanitizers
	@$(call compile,$(SANITIZED),$(SANITIZED_TESTS))
	ctest --test-dir $(SANITIZED) -R '^($(subst $(eval ) ,|,$(SANITIZED_TESTS)))\.' -LE slow -j $(JOBS) --output-on-failure --no-tests=error
