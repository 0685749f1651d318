# Datasets: from one YAML to thousands of samples, on this machine or on a cluster: make -f Makefile.data dataset
# CONFIG=configs/datasets/mini.yaml
# docs/datasets.md is the guide. All files of a dataset lie in $(OUT)/datasets/<name of the file>.

CONFIG ?=#       the dataset: a file of configs/datasets or your own
PARTS  ?= 1#     number of parts of the samples, for a cluster
PART   ?=#       part to make, from 0
SHARDS ?= 8#     parts that submit hands to the cluster
SITE   ?= configs/datasets/slurm/default.sh#  settings of the cluster, for submit
RETRY  ?=#       yes: make failed samples again
PILOT  ?= 0#     samples that estimate makes first, to measure
SAMPLES ?=#      folders of samples below samples/, for dataset-some
K      ?= 3#     samples that reproduce makes again
STOP_AFTER ?=#   successive failures after which a run stops (default: from the dataset)
REPORT ?= configs/datasets/report/default.yaml#  number of samples with pages in dataset-report
$(foreach v,CONFIG PARTS PART SHARDS SITE RETRY PILOT SAMPLES K STOP_AFTER REPORT,$(eval override $(v) := $(strip $($(v)))))

DATASET_PLANNED := plan dataset dataset-part dataset-shared dataset-last retry submit estimate dataset-some drop#  targets that need the plan's rules
DATASET_READ := status dataset-report reproduce bundle clean-plan clean-press clean-render#         targets that only read its folder
DATASET_GOALS := $(DATASET_PLANNED) $(DATASET_READ)
.PHONY: $(DATASET_GOALS) dataset-samples

# A Slurm of one machine, to try submit.
LOCAL_SLURM ?= $(or $(TMPDIR),/tmp)/local-slurm-$(shell id -un)#  folder of that Slurm
packages_for_local-slurm := cluster
.PHONY: local-slurm local-slurm-stop
local-slurm: | packages ## datasets: Start a Slurm on this machine alone, to try submit (says what to export)
	@bash pipelines/dataset/local_slurm.sh start '$(strip $(LOCAL_SLURM))'
local-slurm-stop: ## datasets: Stop it
	@bash pipelines/dataset/local_slurm.sh stop '$(strip $(LOCAL_SLURM))'

ifeq ($(filter $(DATASET_GOALS),$(MAKECMDGOALS)),)
else ifeq ($(CONFIG),)
$(filter $(DATASET_GOALS),$(MAKECMDGOALS)):
	@echo "$@: say which dataset: make -f Makefile.data $@ CONFIG=configs/datasets/mini.yaml" >&2; exit 2
else
$(call check_name,CONFIG)
ifeq ($(wildcard $(CONFIG)),)
  $(error CONFIG: $(CONFIG) does not exist)
endif
DATASET_DIR := $(OUT)/datasets/$(basename $(notdir $(CONFIG)))
$(call check_writable,$(DATASET_DIR),plan plan/.making .ledger-lock)
dataset_packages := $(if $(shell grep '^[^\#]*\<wrap:' '$(CONFIG)'),wrap)# where an object asks for it
$(foreach g,$(DATASET_GOALS),$(eval packages_for_$(g) := $(dataset_packages)))

dataset_variables := CONFIG=$(CONFIG) OUT=$(OUT) BUILD=$(BUILD) PACKAGES=$(PACKAGES) REBUILD=$(REBUILD)
submit_variables := THREADS=$(THREADS) $(foreach v,PACK CARD,$(if $(filter command environment,$(firstword $(origin $(v)))),\
  $(v)=$(strip $($(v)))))# if they are given

# File that changes if another file is chosen for a gel, an object, a motion or a rendering, regardless of that file's
# age. A plan of an earlier version has none.
dataset_choice = $(if $(DATASET_CHOICES),$(DATASET_CHOICES)/$(1))
# If several runs lack a gel or an object, one makes it and the others use it. A gel that fails stops make; a failed
# object is recorded in failures.csv, like a sample. $(call dataset_shared,stage,prerequisites,flags)
dataset_shared = TACIPC='$(BIN)/tacipc' RETRY='$(DATASET_RETRY)' STOP_AFTER='$(or $(STOP_AFTER),$(DATASET_STOP_AFTER))' \
  bash pipelines/dataset/dataset_shared.sh '$(DATASET_DIR)' '$(DATASET_RUN)' '$@' '$(2)' $(call run,$(1),$(3))
# A gel: $(call dataset_gel,name,sensor,mesh,mesh to import,photographs and further sensors for render). An object is
# made from its pattern or mesh.
define dataset_gel
DATASET_SENSOR_$(1) := $(2)
DATASET_RENDERED_$(1) := $(5)
$(DATASET_DIR)/gels/$(1)/tetmesh.yaml: $(2) $(3) $(4) $(call dataset_choice,gel-$(1)) | build
	$$(call dataset_shared,tetmesh,$(2) $(3) $(4) $(call dataset_choice,gel-$(1)),--sensor $(2) --config $(3) $(if $(4),--import $(4)))
DATASET_SHARED += $(DATASET_DIR)/gels/$(1)/tetmesh.yaml
endef
define dataset_mesh
$(DATASET_DIR)/objects/$(1)/decimate.yaml: $(or $(3),$(2)) $(DATASET_DIR)/objects/$(1)/object.yaml $(DATASET_DECIMATE) \
    $(call dataset_choice,object-$(1)) | build
	$$(call dataset_shared,decimate,$(or $(3),$(2)) $(DATASET_DIR)/objects/$(1)/object.yaml $(DATASET_DECIMATE) $(call dataset_choice,object-$(1)),\
	  --mesh $(2) --object $$(@D)/$(4)object.yaml --config $(DATASET_DECIMATE))
DATASET_SHARED += $(DATASET_DIR)/objects/$(1)/decimate.yaml
endef
define dataset_embossed
$(DATASET_DIR)/objects/$(1)/emboss/emboss.yaml: $(2) $(wildcard $(dir $(2))*.png) $(call dataset_choice,object-$(1)) | build
	$$(call dataset_shared,emboss,$(2) $(dir $(2))*.png $(call dataset_choice,object-$(1)),--config $(2))
$(call dataset_mesh,$(1),$(DATASET_DIR)/objects/$(1)/emboss/object.ply,$(DATASET_DIR)/objects/$(1)/emboss/emboss.yaml)
endef

define dataset_wrapped
$(DATASET_DIR)/objects/$(1)/wrap/wrap.yaml: $(2) $(DATASET_DIR)/objects/$(1)/object.yaml $(call dataset_choice,object-$(1)) | build
	$$(wrap_is_built)
	$$(call dataset_shared,wrap,$(2) $(DATASET_DIR)/objects/$(1)/object.yaml $(call dataset_choice,object-$(1)),\
	  --mesh $(2) --object $(DATASET_DIR)/objects/$(1)/object.yaml)
$(call dataset_mesh,$(1),$(DATASET_DIR)/objects/$(1)/wrap/object.ply,$(DATASET_DIR)/objects/$(1)/wrap/wrap.yaml,wrap/)
endef

# The stages of a sample, in order: one rule, so that with several jobs samples are finished one by one. Failures are
# recorded in failures.csv and do not stop make, unless there are many in a row. $(call
# dataset_stage,stage,record,prerequisites,flags)
DATASET_RUN := $(DATASET_DIR)/.runs/$(shell hostname)-$(shell echo $$PPID)-$(shell date +%s%N)
dataset_stage = @TACIPC='$(BIN)/tacipc' RETRY='$(DATASET_RETRY)' STOP_AFTER='$(or $(STOP_AFTER),$(DATASET_STOP_AFTER))' \
  bash pipelines/dataset/dataset_stage.sh '$(DATASET_DIR)' '$(DATASET_RUN)' $(1) '$(2)' '$(3)' \
  OPENBLAS_NUM_THREADS=1 $(BIN)/$(1) --out $(patsubst %/,%,$(dir $(2))) --threads $(THREADS) $(4) --log-level warning
dataset_press_inputs = $(DATASET_DIR)/samples/$(1)/sample.yaml $(DATASET_DIR)/objects/$(2)/decimate.yaml $(DATASET_DIR)/gels/$(3)/tetmesh.yaml \
  $(DATASET_SENSOR_$(3)) $(4) $(5) $(call dataset_choice,motion-$(7))
dataset_render_inputs = $(DATASET_SENSOR_$(3)) $(DATASET_RENDER) $(DATASET_MAPS) $(DATASET_RENDERED_$(3)) $(call dataset_choice,render-$(3))
# $(call dataset_rendering,place,record of its press,gel,seed)
dataset_rendering = $$(call dataset_stage,render,$(DATASET_DIR)/samples/$(1)/render/render.yaml,$(DATASET_DIR)/samples/$(2) $(dataset_render_inputs),\
  --press $(DATASET_DIR)/samples/$(1)/press --gel $(DATASET_DIR)/gels/$(3)/gel.msh --sensor $(DATASET_SENSOR_$(3)) --config $(DATASET_RENDER) \
  $(if $(DATASET_MAPS),--maps $(DATASET_MAPS)) --seed $(4))
# Flags of a press: $(call dataset_pressing,place,object,gel,press,name); a grasp reads no YAML of its object.
dataset_gripping = --name $(5) --object $(DATASET_DIR)/objects/$(2)/object.ply $(6) --gel $(DATASET_DIR)/gels/$(3)/gel.msh --sensor $(DATASET_SENSOR_$(3)) \
  --config $(4) --sample $(DATASET_DIR)/samples/$(1)/sample.yaml
dataset_pressing = $(call dataset_gripping,$(1),$(2),$(3),$(4),$(5),--object-config $(DATASET_DIR)/objects/$(2)/object.yaml)
define dataset_sample
$(DATASET_DIR)/samples/$(1)/render/render.yaml: $(sort $(dataset_press_inputs) $(dataset_render_inputs)) | build
	$$(call dataset_stage,press,$(DATASET_DIR)/samples/$(1)/press/press.yaml,$(dataset_press_inputs),$(call dataset_pressing,$(1),$(2),$(3),$(4),$(notdir $(1))))
	$(call dataset_rendering,$(1),$(1)/press/press.yaml,$(3),$(6))
$(foreach m,$(DATASET_ENSEMBLE_$(3)),$(call dataset_member,$(1),$(2),$(word 1,$(subst :, ,$(m))),$(word 2,$(subst :, ,$(m))),$(4),$(5),$(7)))
endef

# Press of a sample by a member of an ensemble, after the sample and only if the sample was pressed. $(call
# dataset_member,place,object,member,its gel,press,paths,motion)
dataset_member_inputs = $(call dataset_press_inputs,$(1),$(2),$(4),$(5),$(6),,$(7))
dataset_member_record = $(DATASET_DIR)/samples/$(1)/ensemble/$(3)/press/press.yaml
define dataset_member
DATASET_MEMBERS_$(1) += $(dataset_member_record)
$(dataset_member_record): $(sort $(dataset_member_inputs)) | $(DATASET_DIR)/samples/$(1)/render/render.yaml
	$$(call dataset_stage,press,$(dataset_member_record),$(DATASET_DIR)/samples/$(1)/press/press.yaml $(dataset_member_inputs),\
	  $(call dataset_pressing,$(1),$(2),$(4),$(5),$(notdir $(1))-$(3)))

endef

# A grasp is pressed once, in its own folder; each of its fingers, left/ and right/ there, is a sample with press/ and
# render/. Both share a rule, which the plan contains twice if they belong to two blocks.
define dataset_grasp_rule
DATASET_GRASP_$(1) := known
$(DATASET_DIR)/samples/$(1)/left/render/render.yaml $(DATASET_DIR)/samples/$(1)/right/render/render.yaml &: \
    $(sort $(dataset_press_inputs) $(dataset_render_inputs)) | build
	$$(call dataset_stage,press,$(DATASET_DIR)/samples/$(1)/press.yaml,$(dataset_press_inputs),$(call dataset_gripping,$(1),$(2),$(3),$(4),$(notdir $(1))))
	$(call dataset_rendering,$(1)/left,$(1)/press.yaml,$(3),$(word 1,$(6)))
	$(call dataset_rendering,$(1)/right,$(1)/press.yaml,$(3),$(word 2,$(6)))
endef
dataset_grasp = $(if $(DATASET_GRASP_$(1)),,$(dataset_grasp_rule))

ifneq ($(filter $(DATASET_PLANNED),$(MAKECMDGOALS)),)
# The plan is made first, then make restarts with its rules: gels and objects, then the samples in blocks of a thousand,
# of which a part takes what it needs.
DATASET_BEGAN := $(shell date +%s.%N)
# Wait while a plan is made again, so that everything read below belongs to one plan. A plan without record remains only
# if the run that made it was killed before it wrote the record.
dataset_plan_lock := $(DATASET_DIR)/plan/.lock-plan
$(shell [ ! -e '$(dataset_plan_lock)' ] || flock -s -w 600 '$(dataset_plan_lock)' true)
# Parts use the plan as it is, because other parts of the same run work with it. (A folder of meshes becomes newer with
# every file added to it.) They have no rule for its files, so that make does not look for the record again while
# another run replaces it.
ifeq ($(and $(filter dataset-part dataset-last,$(MAKECMDGOALS)),$(wildcard $(DATASET_DIR)/plan/plan.yaml)),)
# If several runs lack the plan, one makes it and the others use it. A refused plan leaves record and times of the old
# one, so .DELETE_ON_ERROR deletes nothing; make stops here, and parts continue with the earlier plan.
$(DATASET_DIR)/plan/plan.yaml: $(CONFIG) | build
	@mkdir -p $(@D); exec 9> $(@D)/.making; flock 9; \
	if [ -e $@ ] && [ "$$(date -r $@ +%s.%N)" \> '$(DATASET_BEGAN)' ]; then exit 0; fi; \
	$(call run,plan,--config $(CONFIG)) 9>&-
$(DATASET_DIR)/plan/%.mk: $(DATASET_DIR)/plan/plan.yaml ;
-include $(DATASET_DIR)/plan/inputs.mk
DATASET_INPUTS := $(shell bash pipelines/dataset/dataset_inputs.sh '$(DATASET_DIR)' '$(CONFIG)')
ifeq ($(DATASET_INPUTS),future)
  $(error plan: not possible)
else ifeq ($(DATASET_INPUTS),changed)
  $(DATASET_DIR)/plan/plan.yaml: FORCE
endif
endif
include $(DATASET_DIR)/plan/dataset.mk
hash := \#
ifdef DATASET_SAMPLES
DATASET_FIRST := $(if $(PART),$(shell echo $$(($(DATASET_SAMPLES) * $(PART) / $(PARTS)))),0)
DATASET_END := $(if $(PART),$(shell echo $$(($(DATASET_SAMPLES) * ($(PART) + 1) / $(PARTS)))),$(DATASET_SAMPLES))
DATASET_TAKEN := $(if $(PART),$(shell for b in $(DATASET_BLOCKS); do f=$$((10$(hash)$$b * 1000)); \
  [ $$f -ge $(DATASET_END) ] || [ $$((f + 1000)) -le $(DATASET_FIRST) ] || echo $$b; done),$(DATASET_BLOCKS))
include $(DATASET_TAKEN:%=$(DATASET_DIR)/plan/blocks/%.mk)
DATASET_LIST := $(foreach b,$(DATASET_TAKEN),$(DATASET_BLOCK_$(b)))
ifneq ($(PART),)
  dataset_from := $(shell echo $$(($(DATASET_FIRST) - 10$(hash)$(or $(firstword $(DATASET_TAKEN)),0) * 1000)))
  DATASET_LIST := $(wordlist $(shell echo $$(($(dataset_from) + 1))),$(shell echo $$(($(dataset_from) + $(DATASET_END) - $(DATASET_FIRST)))),$(DATASET_LIST))
endif
endif

DATASET_RETRY := $(if $(filter retry,$(MAKECMDGOALS)),yes,$(RETRY))
dataset_members = $(if $(DATASET_ENSEMBLE),$(foreach s,$(1),$(DATASET_MEMBERS_$(s))))# presses of an ensemble for these samples
dataset-samples: $(DATASET_LIST:%=$(DATASET_DIR)/samples/%/render/render.yaml) $(call dataset_members,$(DATASET_LIST))

plan: $(DATASET_DIR)/plan/plan.yaml ## datasets: Samples of a dataset, without making them: CONFIG=configs/datasets/mini.yaml
	@echo; echo "$(DATASET_SAMPLES) samples; look at $(DATASET_DIR)/plan/samples.csv"

# End of a run: made samples are packed, failed ones listed, and files that outputs.keep does not name are dropped. Make
# starts again for this, because the packing inputs have only now been made. A failed sample does not stop the others;
# the last line reports it.
define dataset_end
	@ended=0; $(if $(filter none,$(DATASET_PROFILE)),,($(call dataset_alone,$@) && $(call make_again,-s dataset-pack REBUILD=no) && \
	  $(BIN)/survey drop --whole-shards '$(DATASET_DIR)' $(filter-out $(DATASET_KEEP),press render)) || ended=$$?;) \
	$(BIN)/survey status --all-made '$(DATASET_DIR)' && exit $$ended
endef

dataset: dataset-samples ## datasets: Make and pack a dataset: CONFIG=configs/datasets/mini.yaml (resumes; failed samples are skipped)
	@rm -f $(DATASET_RUN) $(DATASET_RUN).full
	$(dataset_end)

retry: dataset ## datasets: Samples of a dataset that failed or are missing, again: CONFIG=

dataset-shared: $(DATASET_SHARED)
	@rm -f $(DATASET_RUN) $(DATASET_RUN).full
dataset-some: $(SAMPLES:%=$(DATASET_DIR)/samples/%/render/render.yaml) $(call dataset_members,$(SAMPLES))
dataset-part: dataset-samples
	@rm -f $(DATASET_RUN) $(DATASET_RUN).full
	@$(BIN)/survey status --all-made '$(DATASET_DIR)' --first $(DATASET_FIRST) --end $(DATASET_END)

DATASET_PILOT := $(if $(and $(filter estimate,$(MAKECMDGOALS)),$(DATASET_SAMPLES),$(filter-out 0,$(PILOT))),\
  $(shell $(BIN)/survey pilot '$(DATASET_DIR)' '$(PILOT)'))
estimate: ## datasets: Core-hours and disk of a dataset in advance: CONFIG= [PILOT=20: measured on 20 samples]
estimate: $(DATASET_SHARED) $(DATASET_PILOT:%=$(DATASET_DIR)/samples/%/render/render.yaml) $(call dataset_members,$(DATASET_PILOT))
	@$(BIN)/survey estimate '$(DATASET_DIR)' --model $(COST_MODEL)
	@echo "  cost model: $(COST_MODEL)$(if $(filter $(COST_MODEL_SHIPPED),$(COST_MODEL)),$(comma) as shipped: bench-press measures this machine)"

# On a cluster there are three jobs: gels and objects, then the parts, then the end of the run.
dataset-last:
	$(dataset_end)
drop: ## datasets: Remove files of packed samples that outputs.keep does not name: CONFIG=
	@$(call dataset_alone,$@) && $(BIN)/survey drop '$(DATASET_DIR)' $(filter-out $(DATASET_KEEP),press render)
submit: ## datasets: A dataset on a cluster, as a Slurm job array: CONFIG= SHARDS=8 [SITE=configs/datasets/slurm/default.sh RETRY=yes]
submit: $(DATASET_DIR)/plan/plan.yaml
	@bash pipelines/dataset/dataset_submit.sh '$(DATASET_DIR)' '$(SITE)' '$(SHARDS)' $(dataset_variables) $(submit_variables) \
	  $(if $(RETRY),RETRY=$(RETRY)) $(if $(STOP_AFTER),STOP_AFTER=$(STOP_AFTER))
endif

status: | $(if $(wildcard $(BIN)/survey),,build) ## datasets: How many samples of a dataset are made, failed, running, and how fast: CONFIG=
	@$(BIN)/survey status '$(DATASET_DIR)'

dataset-report: | build ## datasets: Pages over a dataset, at any time: coverage, failures, costs, contact sheets, samples: CONFIG=
	@[ -e '$(DATASET_DIR)/plan/plan.yaml' ] || { echo "dataset-report: there is no plan yet: make -f Makefile.data plan CONFIG=$(CONFIG)" >&2; exit 1; }
	@OPENBLAS_NUM_THREADS=1 $(BIN)/report --plan $(DATASET_DIR)/plan/samples.csv --dataset $(DATASET_DIR)/plan/dataset.yaml --config $(REPORT) \
	  --title $(notdir $(DATASET_DIR)) --out $(DATASET_DIR)/report --threads $(JOBS)
	@echo; echo "Look at $(DATASET_DIR)/report/index.html"

reproduce: | build ## datasets: Make K=3 random samples of a dataset again and compare bytes: CONFIG=
	@bash pipelines/dataset/dataset_reproduce.sh '$(DATASET_DIR)' '$(K)' $(dataset_variables) JOBS=$(JOBS)
bundle: | $(if $(wildcard $(BIN)/tacipc),,build) ## datasets: A small archive that replays one sample elsewhere: CONFIG= SAMPLE=id (failed ones too)
	$(if $(SAMPLE),,$(error bundle: say which sample: SAMPLE=its id))
	@bash pipelines/dataset/dataset_bundle.sh '$(DATASET_DIR)' '$(SAMPLE)' '$(DATASET_DIR)/bundles/$(notdir $(SAMPLE)).tar.gz' '$(abspath $(BIN))'

clean-plan: ## datasets: Remove the plan of a dataset (samples stay): CONFIG=
	rm -rf '$(DATASET_DIR)/plan'
clean-press: clean-render
clean-press clean-render: clean-%: ## Remove what a stage, and those after it, made of every sample: CONFIG=
	@[ ! -d '$(DATASET_DIR)/samples' ] || find '$(DATASET_DIR)/samples' -mindepth 3 -maxdepth 5 \( -name '$*' -o -name '$*.*' \) -prune -exec rm -rf {} +
endif
