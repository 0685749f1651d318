# Readers of users' files on random bytes (libFuzzer), one after the other: a program, a folder and a record for each.

RUNS   ?= 1000000#  fuzz: inputs per reader
READER ?=#          fuzz: one reader alone
$(foreach v,RUNS READER,$(eval override $(v) := $(strip $($(v)))))

packages_for_fuzz := fuzz
FUZZED       := $(or $(READER),$(sort $(notdir $(wildcard tests/fuzz/corpus/*))))
FUZZ_BUILD   := build/fuzz
FUZZ         := $(OUT)/fuzz/$(RUNS)
FUZZ_RECORDS := $(FUZZED:%=$(FUZZ)/%/fuzz.yaml)
.PHONY: fuzz build-fuzz

# A separate build folder, because only clang has libFuzzer.
$(FUZZ_BUILD)/build.ninja: | packages $(OPENMESH_HEADERS)
	@$(call configure,$(FUZZ_BUILD),--preset fuzz)
build-fuzz: $(if $(filter no,$(REBUILD)),,$(FUZZ_BUILD)/build.ninja)
	@$(call compile,$(FUZZ_BUILD),$(FUZZED:%=fuzz_%) tacipc)

$(FUZZ)/%/fuzz.yaml: | build-fuzz
	bash pipelines/verification/fuzz.sh $(FUZZ_BUILD)/bin/fuzz_$* $* $(RUNS) $(@D)

fuzz: $(FUZZ_RECORDS) ## development: Readers of users' files on random bytes, under sanitizers (RUNS=1000000 each, READER=obj for one)
	@bash pipelines/verification/fuzz_table.sh $(FUZZ_BUILD)/bin/tacipc $(FUZZ_RECORDS)
