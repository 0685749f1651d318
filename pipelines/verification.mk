# The press against closed forms, measurements and other solvers: one folder and record per case, then one page.

SHARED ?= $(or $(TACIPC_SHARED),../shared)#  folder with measured data
VERIFICATION := $(OUT)/verification
VERIFICATION_CASES := $(filter-out stress,$(sort $(basename $(notdir $(wildcard configs/verification/*.yaml)))))#  stress.yaml is the campaign of pipelines/stress.mk
VERIFICATION_RESULTS := $(VERIFICATION_CASES:%=$(VERIFICATION)/%)

# The programs belong to the tests; never built beside another build in the same folder.
.PHONY: build-verify
build-verify: build | $(if $(filter build-all check check-slow,$(MAKECMDGOALS)),build-all)
	@cmake --build $(BUILD) --target verify verify_table -j $(JOBS) -- --quiet

$(VERIFICATION)/%/verify.yaml: configs/verification/%.yaml | build-verify
	TACIPC_SHARED='$(SHARED)' $(call run,verify,--case $<)

# A case that missed, failed or was skipped is run again next time: its record goes.
define verification_table
	$(BIN)/verify_table --out $(1) --threads $(THREADS) $(addprefix --result ,$(2))
	while read -r folder; do rm -f "$$folder/verify.yaml"; done < $(1)/unfinished.txt
endef

.PHONY: verification verify-case
verification: $(addsuffix /verify.yaml,$(VERIFICATION_RESULTS)) ## Every case of configs/verification; writes docs/verification.md with its plots (hours)
	$(call verification_table,$(VERIFICATION)/page,$(VERIFICATION_RESULTS))
	mkdir -p docs/verification
	cp $(VERIFICATION)/page/verification.md docs/verification.md
	cp $(VERIFICATION)/page/verification/*.svg docs/verification/
	! grep -q '^  missed: [1-9]' $(VERIFICATION)/page/verify_table.yaml

ifdef CASE
override CASE := $(strip $(CASE))
$(call check_name,CASE)
ifeq ($(wildcard $(CASE)),)
  $(error CASE: $(CASE) does not exist)
endif
CASE_RESULT := $(OUT)/verify-case/$(basename $(notdir $(CASE)))
$(CASE_RESULT)/verify.yaml: $(CASE) | build-verify
	TACIPC_SHARED='$(SHARED)' $(call run,verify,--case $<)
verify-case: $(CASE_RESULT)/verify.yaml ## One case of your own: CASE=file.yaml (docs/verification_cases.md)
	$(call verification_table,$(CASE_RESULT)/page,$(CASE_RESULT))
	! grep -q '^  missed: [1-9]' $(CASE_RESULT)/page/verify_table.yaml
else
verify-case:
	@echo "verify-case: say which case: make -f Makefile.data verify-case CASE=file.yaml" >&2; exit 2
endif
