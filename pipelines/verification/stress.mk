# The stress campaign: N random cases of a seed, each with a folder and record of its own, then one page. The page of
# 300 cases of seed 1 is docs/stress.md. `campaign` does the same with ten thousand small cases, docs/campaign.md.
$(call uses,verification/verification)

campaign_asked := $(filter campaign campaign-part,$(MAKECMDGOALS))
grasps_asked := $(filter grasp-campaign,$(MAKECMDGOALS))
SEED ?= 1#    seed of the random cases
N    ?= $(if $(campaign_asked),10000,300)#  number of cases
override SEED := $(strip $(SEED))
override N := $(strip $(N))
part_asked := $(filter campaign-part,$(MAKECMDGOALS))
campaign_part  := $(if $(part_asked),$(strip $(PART)),0)
campaign_parts := $(if $(part_asked),$(strip $(PARTS)),1)
STRESS_RANGES := $(if $(grasps_asked),grasp,$(if $(campaign_asked),small,stress))
STRESS := $(OUT)/stress/$(filter-out stress-,$(STRESS_RANGES)-)$(SEED)
STRESS_RECORD := $(STRESS)/first_$(N)/stress_table.yaml
STRESS_CONFIG := configs/studies/stress/$(STRESS_RANGES).yaml

# A crash leaves no record but does not stop the campaign: the page counts it. Only wrong ranges end the campaign.
$(STRESS)/case_%/stress_case.yaml: $(STRESS_CONFIG) | build-verification
	@mkdir -p $(@D)
	$(call try,stress_case,--config $< --seed $(SEED) --index $*)

# Cases count from 0, with four digits.
STRESS_CASES :=
ifneq ($(filter stress,$(LONG_ROWS))$(campaign_asked)$(grasps_asked),)
ifneq ($(shell [[ "$(SEED)" =~ ^[0-9]+$$ && "$(N)" =~ ^[1-9][0-9]*$$ && $(N) -le 10000 ]] && echo yes),yes)
  $(error $(or $(campaign_asked),stress): SEED and N (at most 10000) must be whole numbers: make -f Makefile.data stress SEED=1 N=300)
endif
ifneq ($(shell [[ "$(campaign_part)" =~ ^[0-9]+$$ && "$(campaign_parts)" =~ ^[1-9][0-9]*$$ && "$(campaign_part)" -lt "$(campaign_parts)" ]] && echo yes),yes)
  $(error campaign-part: PART must be one of 0 … PARTS - 1)
endif
STRESS_CASES := $(addprefix $(STRESS)/case_,$(shell seq -f %04.0f $(campaign_part) $(campaign_parts) $$(($(N) - 1))))
endif

STRESS_CASE_RECORDS := $(addsuffix /stress_case.yaml,$(STRESS_CASES))

# The shell writes the names of the cases: ten thousand are too long for one command of make.
$(STRESS_RECORD): $(STRESS_CASE_RECORDS) | build-verification
	$(call run,stress_table,--seed $(SEED) --ranges $(STRESS_RANGES) $$(seq -f '--case $(STRESS)/case_%04.0f' 0 $$(($(N) - 1))))

.PHONY: stress stress-page campaign campaign-part grasp-campaign
stress-page: $(STRESS_CASE_RECORDS) $(STRESS_RECORD) # the cases too: make would not miss those that crashed behind their table
	@grep -E 'cases of seed|^[|]' $(dir $(STRESS_RECORD))summary.md
	$(if $(filter stress-1-300,$(STRESS_RANGES)-$(SEED)-$(N)),@mkdir -p $(DOCS) && cp $(dir $(STRESS_RECORD))summary.md $(DOCS)/stress.md)
	$(if $(filter grasp-1-300,$(STRESS_RANGES)-$(SEED)-$(N)),@mkdir -p $(DOCS) && cp $(dir $(STRESS_RECORD))summary.md $(DOCS)/grasp_campaign.md)
	$(if $(filter small-1-10000,$(STRESS_RANGES)-$(SEED)-$(N)),@mkdir -p $(DOCS) && bash pipelines/verification/campaign_page.sh $(STRESS) \
	  $(dir $(STRESS_RECORD))summary.md > $(DOCS)/campaign.md)

stress: stress-page ## studies: Random objects, gels and extreme motions: SEED=1 N=300 (minutes; resumes)
	$(call holds,$(STRESS_RECORD))

grasp-campaign: stress-page ## studies: Random objects that two fingers grip, lift, shake and let go: SEED=1 N=300 (minutes; resumes)
	$(call holds,$(STRESS_RECORD))

campaign: stress-page ## studies: Ten thousand random small presses: SEED=1 N=10000 (an hour on two cores; resumes)
	$(call holds,$(STRESS_RECORD))

campaign-part: $(STRESS_CASE_RECORDS) ## studies: A part of them, as an element of a job array: PART=3 PARTS=20; then campaign
