# The stress campaign: N random cases of a seed, each with a folder and record of its own, then one page;
# that of 300 cases of seed 1 is docs/stress.md.
$(call uses,verification/verification)

SEED ?= 1#    of the random cases
N    ?= 300#  how many
override SEED := $(strip $(SEED))
override N := $(strip $(N))
STRESS := $(OUT)/stress/$(SEED)
STRESS_RECORD := $(STRESS)/first_$(N)/stress_table.yaml

# A crash leaves no record and no reason to stop: the page counts it. Only wrong ranges end the campaign.
$(STRESS)/case_%/stress_case.yaml: configs/studies/stress/stress.yaml | build-verification
	@mkdir -p $(@D)
	$(call try,stress_case,--config $< --seed $(SEED) --index $*)

STRESS_CASES :=
ifneq ($(filter stress,$(LONG_ROWS)),)
ifneq ($(shell [[ "$(SEED)" =~ ^[0-9]+$$ && "$(N)" =~ ^[1-9][0-9]*$$ ]] && echo yes),yes)
  $(error stress: SEED and N must be whole numbers: make -f Makefile.data stress SEED=1 N=300)
endif
STRESS_CASES := $(addprefix $(STRESS)/case_,$(shell seq -f %04.0f 0 $$(($(N) - 1))))
endif

STRESS_CASE_RECORDS := $(addsuffix /stress_case.yaml,$(STRESS_CASES))

$(STRESS_RECORD): $(STRESS_CASE_RECORDS) | build-verification
	$(call run,stress_table,--seed $(SEED) $(addprefix --case ,$(STRESS_CASES)))

.PHONY: stress stress-page
stress-page: $(STRESS_CASE_RECORDS) $(STRESS_RECORD) # the cases too: make would not miss those that crashed behind their table
	@grep -E 'cases of seed|^[|]' $(dir $(STRESS_RECORD))summary.md
	$(if $(filter 1-300,$(SEED)-$(N)),@mkdir -p $(DOCS) && cp $(dir $(STRESS_RECORD))summary.md $(DOCS)/stress.md)

stress: stress-page ## studies: Random objects, gels and extreme motions: SEED=1 N=300 (minutes; resumes)
	$(call holds,$(STRESS_RECORD))
