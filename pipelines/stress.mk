# The stress campaign: N random cases of a seed, each with a folder and record of its own, then one page;
# that of 300 cases of seed 1 is docs/stress.md.

SEED ?= 1#    of the random cases
N    ?= 300#  how many
override SEED := $(strip $(SEED))
override N := $(strip $(N))
STRESS := $(OUT)/stress/$(SEED)

# The programs belong to the tests; never built beside another build in the same folder.
.PHONY: build-stress
build-stress: build | $(if $(filter build-all check check-slow,$(MAKECMDGOALS)),build-all) $(if $(filter verification verify-case,$(MAKECMDGOALS)),build-verify)
	@cmake --build $(BUILD) --target stress_case stress_table -j $(JOBS) -- --quiet

# A crash leaves no record and no reason to stop: the page counts it. Only wrong ranges (exit 2) end the campaign.
$(STRESS)/case_%/stress_case.yaml: configs/verification/stress.yaml | build-stress
	@mkdir -p $(@D)
	$(call run,stress_case,--config $< --seed $(SEED) --index $*) || { [ $$? != 2 ] && echo "case $* crashed" >&2; }

ifneq ($(filter stress,$(MAKECMDGOALS)),)
ifneq ($(shell [[ "$(SEED)" =~ ^[0-9]+$$ && "$(N)" =~ ^[1-9][0-9]*$$ ]] && echo yes),yes)
  $(error stress: SEED and N must be whole numbers: make -f Makefile.data stress SEED=1 N=300)
endif
STRESS_CASES := $(addprefix $(STRESS)/case_,$(shell seq -f %04.0f 0 $$(($(N) - 1))))
endif

.PHONY: stress
stress: $(addsuffix /stress_case.yaml,$(STRESS_CASES)) ## Random objects, gels and motions, driven hard: SEED=1 N=300 (an hour or two; resumes)
	$(BIN)/stress_table --out $(STRESS) --threads $(THREADS) --seed $(SEED) $(addprefix --case ,$(STRESS_CASES))
	@grep -E 'cases converged|^[|]' $(STRESS)/summary.md
	$(if $(filter 1-300,$(SEED)-$(N)),cp $(STRESS)/summary.md docs/stress.md)
	@grep -q '^  holds: true' $(STRESS)/stress_table.yaml
